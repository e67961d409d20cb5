// gnomon: soft shadow maps. The decision in lanes, fourth part: pairs and depths in codes, by whole numbers of 16 bits. Included by
// simd_receive.hpp after simd_rows.hpp, and in its way.

#include <gnomon/receive/receive.hpp>
#include <gnomon/simd/region.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// A register of one number.
template <typename Isa> [[nodiscard]] GNOMON_INLINE typename Isa::ints words(int n) noexcept {
    return Isa::repeat32(std::uint32_t{static_cast<std::uint16_t>(n)} * 0x10001u);
}

/// Floats that a register of codes stands for, in so many registers.
template <typename Isa, channel Channel> GNOMON_INLINE void store_fractions(float* to, const typename Isa::ints& codes) noexcept {
    using storage = typename Channel::storage;
    alignas(64) storage made[static_cast<std::size_t>(Isa::bytes) / sizeof(storage)];
    Isa::store(made, codes);
    GNOMON_UNROLL(4)
    for (int i = 0; i < Isa::bytes / static_cast<int>(sizeof(storage)); i += Isa::float_lanes)
        Isa::store(to + i, Isa::fraction(Isa::numbers(Isa::widen32(made + i)), Channel::scale));
}

/// Pairs of bytes, depths of 16 bits: a register of bytes at a time, in whole numbers of 16 bits.
///
/// In half codes a pair is e = 2E - k and m = 2M + k, with k the roundings towards the light; z is Z, already moved, and R = 65535 - Z.
/// A receiver is shadowed iff 65535 e > m R, see receive/decide.hpp; that is, iff m Z > 65535 f with f = m - e = 2 (M-E+k).
template <typename Isa, texel_format Texel, typename Intensity> struct byte_decision {
    using ints = typename Isa::ints;
    static constexpr int step = Isa::bytes;

    ints nearer, farther;            ///< codes by which z is moved
    ints last;                       ///< beyond is behind every caster
    ints to_light, to_shadow;        ///< half codes that are taken from e and added to m, or the other way: one of them is nothing
    bool one_rounding_towards_light; ///< k = 1, and z not moved away: the rule that is nearly always meant

    [[nodiscard]] static byte_decision of(const rule& r) noexcept {
        const int codes = codes_towards_light<Texel>(r.caster);
        const bool light = r.caster.towards == bias_towards::light, shadow = r.caster.towards == bias_towards::shadow;
        const int k = lesser(r.caster.roundings, 2 * 255); // which leave nothing of e, or of m, as more do
        const bool usual = light && k == 1 && codes >= 0;
        return {words<Isa>(greater(codes, 0)), words<Isa>(greater(-codes, 0)), words<Isa>(depth16::last + lesser(codes, 0)),
                words<Isa>(light ? k : 0),     words<Isa>(shadow ? k : 0),     usual};
    }

    /// Stores a register of masks, or of nothing.
    GNOMON_LANES_VOID void store(Intensity* to, const ints& bytes) noexcept {
        if constexpr (std::same_as<Intensity, float>) {
            store_fractions<Isa, unorm8>(to, bytes);
        } else if constexpr (std::same_as<Intensity, std::uint16_t>) { // 257 times what it was
            const ints low = Isa::low_pairs8(bytes, bytes), high = Isa::high_pairs8(bytes, bytes);
            Isa::store(to, Isa::first_half(low, high));
            Isa::store(to + Isa::bytes / 2, Isa::second_half(low, high));
        } else {
            Isa::store(to, bytes);
        }
    }

    /// k = 1. The high half of 128 m Z, h, against 128 f = 256 (M-E) + 256:
    ///     h >= 128 f       128 m Z >= 65536 * 128 f > 65535 * 128 f     shadowed
    ///     h <= 128 f - 2   128 m Z < 65536 (128 f - 1) <= 65535 * 128 f, for 128 f <= 65536     lit
    /// What is left, h = 128 f - 1, is unsure; so is h = 0 where E > M and the difference counts as nothing, since there every Z that
    /// is not 0 is shadowed. One receiver in 10,000, unless all lie where their shadow begins.
    GNOMON_LANES bool quick(const ints& moved, const std::uint8_t* texels, const std::uint16_t* depths, Intensity* to) noexcept {
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
        store(to, Isa::narrow16(shade[0], shade[1]));
        return true;
    }

    /// Any rule: 65536 e > m R + e, so iff the high half of m R + e is less than e. What a bias moves beyond nothing is nothing.
    GNOMON_LANES ints exact(const ints& pairs, const ints& depths, const byte_decision& by) noexcept {
        const ints ones = Isa::repeat32(0xFFFFFFFF);
        const ints nearer = Isa::subtract_to_zero16(depths, by.nearer);
        const ints rest = Isa::subtract_to_zero16(Isa::exclusive_or(nearer, ones), by.farther);
        const ints mask = Isa::template shift_right16<8>(pairs);
        const ints depth = Isa::template shift_right16<7>(Isa::template shift_left16<8>(pairs));
        const ints m = Isa::subtract_to_zero16(Isa::add16(Isa::add16(mask, mask), by.to_light), by.to_shadow);
        const ints e = Isa::subtract_to_zero16(Isa::add16(depth, by.to_shadow), by.to_light);
        const ints carried = Isa::greater16(Isa::multiply_low16(m, rest), Isa::exclusive_or(e, ones));
        const ints high = Isa::subtract16(Isa::multiply_high16(m, rest), carried);
        const ints lit = Isa::exclusive_or(Isa::greater16(depths, by.nearer), ones); // z = 0, or moved there
        return Isa::upper_where_greater16(pairs, Isa::either(e, Isa::greater16(depths, by.last)), Isa::either(high, lit));
    }

    static void slow(const byte_decision& by, const std::uint8_t* texels, const std::uint16_t* depths, Intensity* to) noexcept {
        const ints first = exact(Isa::load(texels), Isa::load(depths), by);
        store(to, Isa::narrow16(first, exact(Isa::load(texels + Isa::bytes), Isa::load(depths + Isa::bytes / 2), by)));
    }
    GNOMON_LANES_VOID void rows(const byte_decision& by, const Texel* pairs, const std::uint16_t* depths, Intensity* to,
                                int count) noexcept {
        const std::uint8_t* const texels = pairs->stored;
        const ints moved = by.nearer;
        const bool try_quick = by.one_rounding_towards_light;
        for (int i = 0; i < count; i += step) {
            const std::uint8_t* const at = texels + std::ptrdiff_t{2} * i;
            if (!try_quick || !quick(moved, at, depths + i, to + i)) slow(by, at, depths + i, to + i);
        }
    }
};

/// A register of pairs of 16 bits: their depths, and their masks.
template <typename Isa> struct word_pairs {
    using ints = typename Isa::ints;
    ints depth, mask;

    GNOMON_LANES word_pairs load(const std::uint16_t* texels) noexcept {
        const ints first = Isa::load(texels), second = Isa::load(texels + Isa::bytes / 2);
        const ints even = Isa::even_lanes(first, second), odd = Isa::odd_lanes(first, second);
        return {Isa::even_words(even, odd), Isa::odd_words(even, odd)};
    }
    /// A mask as the result is made of it: a code of 16 bits itself, or the nearest of 8 bits, floor(t / 257) where t is M + 128 or, if
    /// that is less, 65535; and that is the upper byte of t - floor(t / 256), for every t.
    template <typename Intensity> GNOMON_LANES ints stored(const ints& mask) noexcept {
        if constexpr (sizeof(Intensity) > 1) {
            return mask;
        } else {
            const ints ones = Isa::repeat32(0xFFFFFFFF);
            const ints t = Isa::exclusive_or(Isa::subtract_to_zero16(Isa::exclusive_or(mask, ones), words<Isa>(128)), ones);
            return Isa::template shift_right16<8>(Isa::subtract16(t, Isa::template shift_right16<8>(t)));
        }
    }
};

/// Pairs of 16 bits, depths of 16 bits: a register of 16-bit numbers at a time, or of bytes.
///
/// With k roundings towards the light, and z already moved, a receiver is shadowed iff (M + k/2) Z > 65535 F, F = M - E + k, as above.
/// Let h be the high half of M Z. For k of 1 or 2, and E <= M, where F is 65537 at most,
///     h >= F        M Z >= 65536 F > 65535 F     shadowed
///     h <= F - 3    (M + k/2) Z <= 65536 h + 2 * 65535 <= 65536 F - 65538 <= 65535 F, for F <= 65538     lit
/// What is left, h of F-1 or F-2, is unsure. Where E > M, h >= k > F is shadowed and less is unsure. The other decision sees to such a
/// register, and to any other rule. A mask M is unsure of 131072 / M codes of Z, two where it is full.
template <typename Isa, texel_format Texel, typename Intensity> struct word_decision {
    using ints = typename Isa::ints;
    using any_decision = decision<Isa, Texel, std::uint16_t, Intensity>;
    static constexpr int at_once = Isa::bytes / 2; ///< 16-bit numbers in a register
    static constexpr int step = sizeof(Intensity) == 1 ? 2 * at_once : at_once;

    any_decision any;
    ints nearer;               ///< codes by which z is moved
    ints fewer;                ///< k - 1
    bool asked_for_by_filters; ///< k is 1 or 2, towards light, and z not moved away

    [[nodiscard]] static word_decision of(const rule& r) noexcept {
        const int codes = codes_towards_light<Texel>(r.caster), k = r.caster.roundings;
        const bool quick = r.caster.towards == bias_towards::light && codes >= 0 && (k == 1 || k == 2);
        return {any_decision::of(r), words<Isa>(codes), words<Isa>(k - 1), quick};
    }

    /// The shadows of a register of receivers. False if it does not tell. A mask less than two codes counts as two, so that clear
    /// texels, of which most maps are full, are surely lit. So is a mask of one code where E is 0; for a greater E it is unsure.
    GNOMON_LANES bool shade(const word_decision& by, const std::uint16_t* texels, const std::uint16_t* depths,
                            ints& shades) noexcept {
        const auto [depth, mask] = word_pairs<Isa>::load(texels);
        const ints two = words<Isa>(2), z = Isa::subtract_to_zero16(Isa::load(depths), by.nearer);
        const ints high = Isa::subtract_to_zero16(Isa::multiply_high16(mask, z), by.fewer);                    // h - (k-1)
        const ints last = Isa::subtract_to_zero16(Isa::add16(Isa::subtract_to_zero16(mask, two), two), depth); // F - k
        shades = Isa::both(word_pairs<Isa>::template stored<Intensity>(mask), Isa::greater16(high, last));
        return !Isa::any_equal16(high, last, high, Isa::subtract16(last, words<Isa>(1)));
    }
    GNOMON_LANES bool quick(const word_decision& by, const std::uint16_t* texels, const std::uint16_t* depths,
                            Intensity* to) noexcept {
        ints shades;
        if (!shade(by, texels, depths, shades)) return false;
        if constexpr (std::same_as<Intensity, float>) {
            store_fractions<Isa, unorm16>(to, shades);
            return true;
        } else if constexpr (sizeof(Intensity) == 2) {
            Isa::store(to, shades);
            return true;
        } else {
            ints more;
            if (!shade(by, texels + 2 * at_once, depths + at_once, more)) return false;
            Isa::store(to, Isa::narrow16(shades, more));
            return true;
        }
    }
    static void slow(const any_decision& by, const Texel* texels, const std::uint16_t* depths, Intensity* to) noexcept {
        any_decision::rows(by, texels, depths, to, step);
    }
    GNOMON_LANES_VOID void rows(const word_decision& by, const Texel* pairs, const std::uint16_t* depths, Intensity* to,
                                int count) noexcept {
        const bool try_quick = by.asked_for_by_filters;
        for (int i = 0; i < count; i += step)
            if (!try_quick || !quick(by, pairs[i].stored, depths + i, to + i)) slow(by.any, pairs + i, depths + i, to + i);
    }
};

/// Ratios, depths of 16 bits, results in codes. A receiver is shadowed iff Z > 65535 - T, T in 16 bits and Z already moved: no product. The
/// other decision sees to a Z that is moved away from the light.
template <typename Isa, texel_format Texel, typename Intensity> struct ratio_decision {
    using ints = typename Isa::ints;
    using storage = typename Texel::storage;
    using any_decision = decision<Isa, Texel, std::uint16_t, Intensity>;
    static constexpr int step = Isa::bytes / static_cast<int>(sizeof(Intensity));
    static constexpr int at_once = Isa::bytes / 2; ///< 16-bit numbers in a register

    any_decision any;
    ints nearer; ///< codes by which z is moved
    bool towards_light;

    [[nodiscard]] static ratio_decision of(const rule& r) noexcept {
        const int codes = codes_towards_light<Texel>(r.caster);
        return {any_decision::of(r), words<Isa>(codes), codes >= 0};
    }

    /// The shadows of a register of depths, in words.
    GNOMON_LANES ints shade(const ratio_decision& by, const storage* texels, const std::uint16_t* depths) noexcept {
        const ints z = Isa::subtract_to_zero16(Isa::load(depths), by.nearer), ones = Isa::repeat32(0xFFFFFFFF);
        if constexpr (sizeof(storage) == 1) {
            const ints pairs = Isa::load(texels);
            const ints both_bytes =
                Isa::either(Isa::both(pairs, Isa::repeat32(0x00FF00FF)), Isa::template shift_left16<8>(pairs)); // 257 T
            return Isa::upper_where_greater16(pairs, z, Isa::exclusive_or(both_bytes, ones));
        } else {
            const auto [depth, mask] = word_pairs<Isa>::load(texels);
            const ints stored = word_pairs<Isa>::template stored<Intensity>(mask);
            return Isa::both(stored, Isa::greater16(z, Isa::exclusive_or(depth, ones)));
        }
    }
    GNOMON_LANES_VOID void rows(const ratio_decision& by, const Texel* texels, const std::uint16_t* depths, Intensity* to,
                                int count) noexcept {
        if (!by.towards_light) return any_decision::rows(by.any, texels, depths, to, count);
        for (int i = 0; i < count; i += step) {
            const ints first = shade(by, texels[i].stored, depths + i);
            if constexpr (sizeof(Intensity) == 2)
                Isa::store(to + i, first);
            else
                Isa::store(to + i, Isa::narrow16(first, shade(by, texels[i + at_once].stored, depths + i + at_once)));
        }
    }
};

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
