// gnomon: soft shadow maps. The decision in lanes, third part: a receiver to each texel. Included by simd_receive.hpp after
// simd_shade.hpp, and in its way.

#include <gnomon/receive/receive.hpp>
#include <gnomon/simd/region.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// One register of receivers at a time.
template <typename Isa, texel_format Texel, typename Depth, typename Intensity> struct decision {
    using channel_type = typename Texel::channel_type;
    using storage = typename Texel::storage;
    using floats = typename Isa::floats;
    using masks = typename Isa::masks;
    using caster = surface<Isa, Texel, Depth>;
    using far_bound = surface<Isa, Texel, float>;
    using shades = shade<Isa, Texel, Intensity>;
    static constexpr int step = Isa::float_lanes;
    static constexpr bool whole_codes = channel_type::whole_codes;
    using numbers = float[static_cast<std::size_t>(step)];

    caster by_caster;
    far_bound by_bound;
    const rule* by_rule;

    [[nodiscard]] static decision of(const rule& r) noexcept { return {caster::of(r.caster), far_bound::of(r.far_bound), &r}; }

    GNOMON_LANES floats codes(const storage* texels, int index) noexcept {
        return Isa::template codes_of<channel_type, Texel::channels>(texels, index);
    }
    GNOMON_LANES floats loaded(const float* depths) noexcept { return Isa::load(depths); }
    GNOMON_LANES floats loaded(const std::uint16_t* depths) noexcept { return Isa::template codes_of<unorm16, 1>(depths, 0); }

    /// Who is shadowed by the caster, of codes as they are stored, or of a blend of them in float. False if lanes do not tell.
    GNOMON_LANES bool decided(const decision& by, const floats& depth, const floats& mask, const floats& z,
                              masks& shadowed) noexcept {
        const masks there = Isa::greater(mask, Isa::repeat(0.0f));
        const bool told = caster::decided(by.by_caster, depth, mask, there, z, shadowed);
        if constexpr (std::same_as<Depth, float>) {
            shadowed = may_be_shadowed<Isa>(shadowed, z, by.by_rule->lit_beyond);
            if constexpr (whole_codes && Texel::effects.translucency) { // else the mask is stored, and is 0 there
                shadowed = Isa::both(shadowed, there);
            }
        }
        return told;
    }

    /// Stores darkness in codes. What is less than nothing or more than all, or NaN, is in doubles.
    GNOMON_LANES_VOID void store(Intensity* to, const floats& darkness) noexcept {
        if constexpr (!whole_codes && (Texel::effects.translucency || !std::same_as<Intensity, float>)) {
            alignas(64) numbers dark;
            Isa::store(dark, darkness);
            for (int i = 0; i < step; i += Isa::double_lanes) shades::store(to + i, shades::wide(dark + i), Isa::repeat(1.0));
        } else if constexpr (std::same_as<Intensity, float> && whole_codes)
            Isa::store(to, Isa::fraction(darkness, channel_type::scale));
        else if constexpr (std::same_as<Intensity, float>)
            Isa::store(to, Isa::lesser(darkness, Isa::repeat(1.0f)));
        else if constexpr (sizeof(Intensity) == sizeof(storage))
            Isa::template store_codes<unorm<Intensity>>(to, darkness);
        else if constexpr (sizeof(Intensity) > sizeof(storage))
            Isa::template store_codes<unorm16>(to, Isa::multiply(darkness, Isa::repeat(257.0f)));
        else // (m + 128) / 257, rounded down: with a half more it is never near a whole number
            Isa::template store_codes<unorm8>(to,
                                              Isa::multiply(Isa::add(darkness, Isa::repeat(128.5f)), Isa::repeat(1.0f / 257.0f)));
    }

    /// Stores what is left of shadows that fade, of those `beyond` their bound; the others are whole.
    GNOMON_LANES_VOID void store_faded(const decision& by, Intensity* to, const floats& darkness, typename far_bound::pair of,
                                       const floats& z, const masks& beyond) noexcept {
        alignas(64) numbers dark, e, m, depth, past;
        Isa::store(dark, darkness);
        Isa::store(e, of.e);
        Isa::store(m, of.m);
        Isa::store(depth, Isa::subtract(z, by.by_bound.nearer));
        Isa::store(past, Isa::keep(beyond, Isa::repeat(1.0f)));
        for (int i = 0; i < step; i += Isa::double_lanes) {
            const auto faded = shades::faded(shades::wide(e + i), shades::wide(m + i), shades::wide(depth + i), by.by_rule->fade);
            shades::store(to + i, shades::wide(dark + i),
                          shades::where_greater(shades::wide(past + i), Isa::repeat(0.0), faded, Isa::repeat(1.0)));
        }
    }
    /// Stores shadows up to their far bound. False, and nothing stored, if lanes do not tell.
    GNOMON_LANES bool store_bounded(const decision& by, Intensity* to, const floats& bound, const floats& mask, const floats& z,
                                    const masks& shadowed, const floats& darkness) noexcept {
        const masks bounded = Isa::both(shadowed, Isa::greater(bound, Isa::repeat(0.0f)));
        masks beyond;
        if (!far_bound::decided(by.by_bound, bound, mask, bounded, z, beyond)) return false;
        beyond = Isa::both(beyond, bounded);
        if (by.by_rule->fade > 0.0f && Isa::any(beyond))
            store_faded(by, to, darkness, far_bound::moved(by.by_bound, bound, mask, bounded), z, beyond);
        else
            store(to, Isa::drop(beyond, darkness));
        return true;
    }

    /// False, and nothing stored, if lanes do not tell.
    GNOMON_LANES bool one(const decision& by, const storage* texels, const Depth* depths, Intensity* to) noexcept {
        const floats mask = codes(texels, Texel::mask_index), z = loaded(depths);
        masks shadowed;
        if (!decided(by, codes(texels, Texel::depth_index), mask, z, shadowed)) return false;
        const floats dark = Texel::effects.translucency ? codes(texels, Texel::contribution_index) : mask;
        const floats darkness = Isa::keep(shadowed, dark);
        if constexpr (Texel::effects.far_bound) {
            const floats depth = std::same_as<Depth, float> ? z : Isa::fraction(z, unorm16::scale);
            return store_bounded(by, to, codes(texels, Texel::far_index), mask, depth, shadowed, darkness);
        } else {
            store(to, darkness);
            return true;
        }
    }
    static void slow(const rule& r, const Texel* texels, const Depth* depths, Intensity* to) noexcept {
        for (int i = 0; i < step; ++i) to[i] = shadow_as<Intensity>(read(texels[i]), detail::as_depth(depths[i]), r);
    }
    GNOMON_LANES_VOID void rows(const decision& by, const Texel* texels, const Depth* depths, Intensity* to, int count) noexcept {
        for (int i = 0; i < count; i += step)
            if (!one(by, texels[i].stored, depths + i, to + i)) slow(*by.by_rule, texels + i, depths + i, to + i);
    }
};

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
