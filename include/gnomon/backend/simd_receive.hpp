// gnomon: soft shadow maps. The decision in lanes. backend/simd.hpp includes it once for each target, inside its region, so there is
// no #pragma once: GNOMON_ON names the namespace it goes to; without it there is nothing.

#include <gnomon/receive/receive.hpp>
#include <gnomon/simd/region.hpp>

#include <concepts>
#include <cstddef>
#include <limits>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// What lanes decide themselves: whole codes of premultiplied pairs that no receiver bounds.
template <texel_format Texel>
inline constexpr bool decided_in_lanes =
    Texel::channel_type::whole_codes && !Texel::effects.far_bound && std::same_as<typename Texel::representation_type, depth_mask>;

/// One register of receivers at a time. A receiver is shadowed iff e > m (1-z), see receive/decide.hpp; here it is m z + (e-m) > 0.
/// Codes, and the halves they are biased by, keep e-m exact in float, and the sum is asked for nothing but its sign.
template <typename Isa, texel_format Texel> struct decision {
    using channel_type = typename Texel::channel_type;
    using storage = typename Texel::storage;
    using floats = typename Isa::floats;
    static constexpr int step = Isa::float_lanes;

    floats e, m, z;  ///< the bias: what the pair and the receiver are moved by
    floats farthest; ///< beyond is lit

    [[nodiscard]] static decision of(const rule& r) noexcept {
        const biased moved = apply<Texel>(r.caster, 0.0, 0.0, 0.0f);
        constexpr float nowhere = std::numeric_limits<float>::infinity();
        return {Isa::repeat(static_cast<float>(moved.e)), Isa::repeat(static_cast<float>(moved.m)), Isa::repeat(moved.z),
                Isa::repeat(r.lit_beyond ? 1.0f : nowhere)};
    }

    GNOMON_LANES floats codes(const storage* texels, int index) noexcept {
        return Isa::template codes_of<channel_type, Texel::channels>(texels, index);
    }

    void operator()(const storage* texels, const float* depths, float* intensities) const noexcept {
        const floats zero = Isa::repeat(0.0f), depth = Isa::load(depths);
        const floats mask = codes(texels, Texel::mask_index), biased_mask = Isa::add(mask, m);
        const floats rest = Isa::subtract(Isa::add(codes(texels, Texel::depth_index), e), biased_mask);
        // Doubled they are whole, and times the least depth there is still something.
        auto shadowed = Isa::positive(Isa::add(biased_mask, biased_mask), Isa::add(depth, z), Isa::add(rest, rest));
        shadowed = Isa::both(Isa::both(shadowed, Isa::greater(depth, zero)),
                             Isa::both(Isa::greater(mask, zero), Isa::not_greater(depth, farthest)));
        floats darkness = mask;
        if constexpr (Texel::effects.translucency) darkness = codes(texels, Texel::contribution_index);
        Isa::store(intensities, Isa::keep(shadowed, Isa::fraction(darkness, channel_type::scale)));
    }
};

/// Receivers one to one on texels. Spans of any stride; what is not side by side, and the last few, go through a register's worth of
/// memory.
template <typename Isa, texel_format Texel>
void receive_row(strided_span<const Texel> texels, strided_span<const float> z, strided_span<float> intensity,
                 const rule& r) noexcept {
    using one = decision<Isa, Texel>;
    const auto decide = one::of(r);
    const int count = lesser(texels.size(), lesser(z.size(), intensity.size()));
    const bool side_by_side = texels.contiguous() && z.contiguous() && intensity.contiguous();
    int i = 0;
    if (side_by_side)
        for (; i + one::step <= count; i += one::step) decide(texels[i].stored, &z[i], &intensity[i]);
    for (; i < count; i += one::step) {
        const int some = lesser(one::step, count - i);
        Texel texel[static_cast<std::size_t>(one::step)]{};
        float depth[static_cast<std::size_t>(one::step)]{}, made[static_cast<std::size_t>(one::step)];
        for (int k = 0; k < some; ++k) texel[k] = texels[i + k], depth[k] = z[i + k];
        decide(texel->stored, depth, made);
        for (int k = 0; k < some; ++k) intensity[i + k] = made[k];
    }
}

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
