// gnomon: soft shadow maps. The decision in lanes. backend/simd.hpp includes it once for each target, inside its region, so there is
// no #pragma once: GNOMON_ON names the namespace it goes to; without it there is nothing.

#include <gnomon/receive/receive.hpp>
#include <gnomon/simd/region.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>

#ifdef GNOMON_ON
namespace gnomon::GNOMON_ON {

/// Whole codes of premultiplied pairs that no receiver bounds: what lanes can decide exactly.
template <texel_format Texel>
inline constexpr bool pairs_of_codes =
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

    GNOMON_LANES_VOID void one(const decision& by, const storage* texels, const float* depths, float* intensities) noexcept {
        const floats zero = Isa::repeat(0.0f), depth = Isa::load(depths);
        const floats mask = codes(texels, Texel::mask_index), biased_mask = Isa::add(mask, by.m);
        const floats rest = Isa::subtract(Isa::add(codes(texels, Texel::depth_index), by.e), biased_mask);
        // Doubled they are whole, and times the least depth there is still something.
        auto shadowed = Isa::positive(Isa::add(biased_mask, biased_mask), Isa::add(depth, by.z), Isa::add(rest, rest));
        shadowed = Isa::both(Isa::both(shadowed, Isa::greater(depth, zero)),
                             Isa::both(Isa::greater(mask, zero), Isa::not_greater(depth, by.farthest)));
        floats darkness = mask;
        if constexpr (Texel::effects.translucency) darkness = codes(texels, Texel::contribution_index);
        Isa::store(intensities, Isa::keep(shadowed, Isa::fraction(darkness, channel_type::scale)));
    }
    GNOMON_LANES_VOID void rows(const decision& by, const storage* texels, const float* depths, float* intensities,
                                int count) noexcept {
        for (int i = 0; i < count; i += step) one(by, texels + i * Texel::channels, depths + i, intensities + i);
    }
};

/// Pairs of bytes, depths of 16 bits, results of 8: a register of results at a time, in whole numbers of 16 bits.
///
/// In half codes a pair is e = 2E - k and m = 2M + k, with k the roundings towards the light; z is Z, already moved, and R = 65535 - Z.
/// A receiver is shadowed iff 65535 e > m R, see receive/decide.hpp; that is, iff m Z > 65535 f with f = m - e = 2 (M-E+k).
template <typename Isa, texel_format Texel> struct byte_decision {
    using ints = typename Isa::ints;
    static constexpr int step = Isa::bytes;

    ints nearer, farther;      ///< codes by which z is moved
    ints last;                 ///< beyond is behind every caster
    ints depth_up, depth_down; ///< half codes by which the pair is moved
    ints mask_up, mask_down;
    bool one_rounding_towards_light; ///< k = 1, and z not moved away: the rule that is nearly always meant

    [[nodiscard]] static byte_decision of(const rule& r) noexcept {
        const int codes = codes_towards_light<Texel>(r.caster);
        const bool light = r.caster.towards == bias_towards::light, shadow = r.caster.towards == bias_towards::shadow;
        const int k = r.caster.roundings;
        return {words(codes > 0, codes),
                words(codes < 0, -codes),
                words(true, depth16::last + lesser(codes, 0)),
                words(shadow, k),
                words(light, k),
                words(light, k),
                words(shadow, k),
                light && k == 1 && codes >= 0};
    }

    GNOMON_LANES ints words(bool on, int n) noexcept { return Isa::repeat32(on ? static_cast<std::uint32_t>(n) * 0x10001u : 0u); }

    /// k = 1. The high half of 128 m Z, h, against 128 f = 256 (M-E) + 256:
    ///     h >= 128 f       128 m Z >= 65536 * 128 f > 65535 * 128 f     shadowed
    ///     h <= 128 f - 2   128 m Z < 65536 (128 f - 1) <= 65535 * 128 f, for 128 f <= 65536     lit
    /// What is left, h = 128 f - 1, is unsure; so is h = 0 where E > M and the difference counts as nothing, since there every Z that
    /// is not 0 is shadowed. One receiver in 10,000, unless all lie where their shadow begins.
    GNOMON_LANES bool quick(const ints& moved, const std::uint8_t* texels, const std::uint16_t* depths, std::uint8_t* to) noexcept {
        const ints low = Isa::repeat32(0x00FF00FF), half = Isa::repeat32(0x007F007F);
        ints high[2], last[2], shade[2];
        GNOMON_UNROLL(2)
        for (int i = 0; i < 2; ++i) {
            const ints pairs = Isa::load(texels + i * Isa::bytes), filled = Isa::either(pairs, low); // 256 M + 255
            const ints z = Isa::subtract_to_zero16(Isa::load(depths + i * (Isa::bytes / 2)), moved);
            high[i] = Isa::multiply_high16(Isa::subtract16(filled, half), z);
            last[i] = Isa::subtract_to_zero16(filled, Isa::template shift_left16<8>(pairs));
            shade[i] = Isa::upper_where_greater16(pairs, high[i], last[i]);
        }
        if (Isa::any_equal16(high[0], last[0], high[1], last[1])) return false;
        Isa::store(to, Isa::narrow16(shade[0], shade[1]));
        return true;
    }

    /// Any rule: 65536 e > m R + e, so iff the high half of m R + e is less than e. What a bias moves beyond nothing is nothing.
    GNOMON_LANES ints exact(const ints& pairs, const ints& depths, const byte_decision& by) noexcept {
        const ints ones = Isa::repeat32(0xFFFFFFFF);
        const ints nearer = Isa::subtract_to_zero16(depths, by.nearer);
        const ints rest = Isa::subtract_to_zero16(Isa::exclusive_or(nearer, ones), by.farther);
        const ints mask = Isa::template shift_right16<8>(pairs);
        const ints depth = Isa::template shift_right16<7>(Isa::template shift_left16<8>(pairs));
        const ints m = Isa::subtract_to_zero16(Isa::add16(Isa::add16(mask, mask), by.mask_up), by.mask_down);
        const ints e = Isa::subtract_to_zero16(Isa::add16(depth, by.depth_up), by.depth_down);
        const ints carried = Isa::greater16(Isa::multiply_low16(m, rest), Isa::exclusive_or(e, ones));
        const ints high = Isa::subtract16(Isa::multiply_high16(m, rest), carried);
        const ints lit = Isa::exclusive_or(Isa::greater16(depths, by.nearer), ones); // z = 0, or moved there
        return Isa::upper_where_greater16(pairs, Isa::either(e, Isa::greater16(depths, by.last)), Isa::either(high, lit));
    }

    static void slow(const byte_decision& by, const std::uint8_t* texels, const std::uint16_t* depths, std::uint8_t* to) noexcept {
        const ints first = exact(Isa::load(texels), Isa::load(depths), by);
        Isa::store(to, Isa::narrow16(first, exact(Isa::load(texels + Isa::bytes), Isa::load(depths + Isa::bytes / 2), by)));
    }
    GNOMON_LANES_VOID void rows(const byte_decision& by, const std::uint8_t* texels, const std::uint16_t* depths, std::uint8_t* to,
                                int count) noexcept {
        const ints moved = by.nearer;
        const bool try_quick = by.one_rounding_towards_light;
        for (int i = 0; i < count; i += step)
            if (!try_quick || !quick(moved, texels + 2 * i, depths + i, to + i)) slow(by, texels + 2 * i, depths + i, to + i);
    }
};

/// What decides for a texel, a depth and an intensity; void where the scalar loop does.
template <typename Isa, texel_format Texel, typename Depth, typename Intensity> struct decision_for {
    using type = void;
};
template <typename Isa, texel_format Texel>
    requires pairs_of_codes<Texel>
struct decision_for<Isa, Texel, float, float> {
    using type = decision<Isa, Texel>;
};
template <typename Isa, texel_format Texel>
    requires(pairs_of_codes<Texel> && Texel::channels == 2 && std::same_as<typename Texel::channel_type, unorm8>)
struct decision_for<Isa, Texel, std::uint16_t, std::uint8_t> {
    using type = byte_decision<Isa, Texel>;
};
template <texel_format Texel, typename Depth, typename Intensity>
inline constexpr bool decided_in_lanes = !std::same_as<typename decision_for<emulated<16>, Texel, Depth, Intensity>::type, void>;

/// Receivers one to one on texels. Spans of any stride; what is not side by side, and the last few, go through a register's worth of
/// memory.
template <typename Isa, texel_format Texel, typename Depth, typename Intensity>
void receive_row(strided_span<const Texel> texels, strided_span<const Depth> z, strided_span<Intensity> intensity,
                 const rule& r) noexcept {
    using one = typename decision_for<Isa, Texel, Depth, Intensity>::type;
    const auto decide = one::of(r);
    const int count = lesser(texels.size(), lesser(z.size(), intensity.size()));
    const bool side_by_side = texels.contiguous() && z.contiguous() && intensity.contiguous();
    const int whole = side_by_side ? count - count % one::step : 0;
    if (whole > 0) one::rows(decide, texels[0].stored, &z[0], &intensity[0], whole);
    for (int i = whole; i < count; i += one::step) {
        const int some = lesser(one::step, count - i);
        Texel texel[static_cast<std::size_t>(one::step)]{};
        Depth depth[static_cast<std::size_t>(one::step)]{};
        Intensity made[static_cast<std::size_t>(one::step)];
        for (int k = 0; k < some; ++k) texel[k] = texels[i + k], depth[k] = z[i + k];
        one::rows(decide, texel->stored, depth, made, one::step);
        for (int k = 0; k < some; ++k) intensity[i + k] = made[k];
    }
}

} // namespace gnomon::GNOMON_ON
#endif
