// gnomon: soft shadow maps. The decision in lanes. backend/simd.hpp includes it once for each target, inside its region, so there is
// no #pragma once: GNOMON_ON names the namespace it goes to; without it there is nothing.

#include <gnomon/receive/receive.hpp>
#include <gnomon/simd/region.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// Premultiplied pairs that no receiver bounds: what lanes decide.
template <texel_format Texel>
inline constexpr bool decidable_pairs = !Texel::effects.far_bound && std::same_as<typename Texel::representation_type, depth_mask>;

/// Pairs of two numbers of a channel; and of two bytes.
template <texel_format Texel, typename Channel>
inline constexpr bool pairs_of =
    decidable_pairs<Texel> && Texel::channels == 2 && std::same_as<typename Texel::channel_type, Channel>;
template <texel_format Texel> inline constexpr bool byte_pairs = pairs_of<Texel, unorm8>;

/// One register of receivers at a time. A receiver is shadowed iff e > m (1-z), see receive/decide.hpp: of a biased pair and depth, the
/// sign of a product and a sum, and exact wherever `decided` says that it is. What is left goes by the scalar loop. With float depths
/// that is no code, and floats only if m <= 2^-50 or z is moved by more than the range; with depths in codes it is one receiver in a
/// million, and who is moved behind every caster.
template <typename Isa, texel_format Texel, typename Depth, typename Intensity> struct decision {
    using channel_type = typename Texel::channel_type;
    using storage = typename Texel::storage;
    using floats = typename Isa::floats;
    using masks = typename Isa::masks;
    static constexpr int step = Isa::float_lanes;
    static constexpr bool whole_codes = channel_type::whole_codes;

    floats depth_less, depth_share, mask_more, mask_share, nearer; ///< the bias
    floats before;                                                 ///< a depth in codes there, once moved, is lit
    floats least_mask;                                             ///< what float decides of
    bool next_to_nothing; ///< may a float depth be, once moved? Then it tells where e = m, and the scalar loop sees to it.
    const rule* by_rule;

    [[nodiscard]] static decision of(const rule& r) noexcept {
        const auto steps = bias_steps<Texel>::of(r.caster);
        constexpr float nothing = std::numeric_limits<float>::infinity();
        const float moved = std::same_as<Depth, float> ? steps.nearer : static_cast<float>(codes_towards_light<Texel>(r.caster));
        return {Isa::repeat(static_cast<float>(steps.depth_less)),
                Isa::repeat(static_cast<float>(steps.depth_share)),
                Isa::repeat(static_cast<float>(steps.mask_more)),
                Isa::repeat(static_cast<float>(steps.mask_share)),
                Isa::repeat(moved),
                Isa::repeat(greater(0.0f, -moved)),
                Isa::repeat(whole_codes ? 0.0f : (moved > 1.0f && std::same_as<Depth, float> ? nothing : 0x1p-50f)),
                moved < 0x1p-26f && moved > -0x1p-26f, // beyond, what is left of a difference is more
                &r};
    }

    GNOMON_LANES floats codes(const storage* texels, int index) noexcept {
        return Isa::template codes_of<channel_type, Texel::channels>(texels, index);
    }
    /// a share, as `apply` has it: rounded before anything is added, which g++ would fuse with it from -O2 on.
    GNOMON_LANES floats moved(const floats& a, const floats& share) noexcept {
        if constexpr (whole_codes) {
            return a; // the share is 1
        } else {
            floats product = Isa::multiply(a, share);
            Isa::settle(product);
            return product;
        }
    }

    /// m z + (e-m) > 0. Codes, and the halves they are biased by, keep e-m exact, and the product is asked for its sign.
    GNOMON_LANES masks decided_codes(const decision& by, const floats& e, const floats& m, const float* depths) noexcept {
        const floats depth = Isa::load(depths), rest = Isa::subtract(e, m);
        // Doubled they are whole, and times the least depth there is still something.
        masks shadowed = Isa::positive(Isa::add(m, m), Isa::subtract(depth, by.nearer), Isa::add(rest, rest));
        shadowed = Isa::both(shadowed, Isa::greater(depth, Isa::repeat(0.0f)));
        if (by.by_rule->lit_beyond) shadowed = Isa::both(shadowed, Isa::not_greater(depth, Isa::repeat(1.0f)));
        return shadowed;
    }
    /// For z < 1/2 the same: e-m is exact if m/2 <= e <= 2m, and if e is less, m z < m/2 is less than m-e either way, if more, all from
    /// z = -1 on are shadowed. Else m (z-1) + e > 0, where z-1 is exact up to 2^24, and beyond that everything is behind every caster.
    GNOMON_LANES bool decided_floats(const decision& by, const floats& e, const floats& m, const masks& there, const float* depths,
                                     masks& shadowed) noexcept {
        const floats depth = Isa::load(depths), zero = Isa::repeat(0.0f), half = Isa::repeat(0.5f);
        const floats z = Isa::subtract(depth, by.nearer);
        const floats beyond = Isa::subtract(z, Isa::keep(Isa::not_greater(half, z), Isa::repeat(1.0f)));
        const floats rest = Isa::subtract(e, Isa::keep(Isa::greater(half, z), m));
        shadowed = Isa::both(Isa::positive(m, beyond, rest), Isa::both(there, Isa::greater(depth, zero)));
        if (by.by_rule->lit_beyond) shadowed = Isa::both(shadowed, Isa::not_greater(depth, Isa::repeat(1.0f)));
        return !Isa::any(Isa::both(there, Isa::not_greater(m, by.least_mask))) &&
               !(by.next_to_nothing && Isa::any(Isa::both(Isa::greater(z, zero), Isa::greater(Isa::repeat(0x1p-50f), z))));
    }
    /// m z + (e-m) 65535 > 0, z in codes. Three roundings are wrong by 3 * 2^-24 * 65535 m < m/64 at most where the two cancel; so
    /// within m/16 of nothing the sum says nothing.
    GNOMON_LANES bool decided_sums(const decision& by, const floats& e, const floats& m, const masks& there,
                                   const std::uint16_t* depths, masks& shadowed) noexcept {
        const floats last = Isa::repeat(static_cast<float>(depth16::last));
        const floats z = Isa::subtract(Isa::template codes_of<unorm16, 1>(depths, 0), by.nearer);
        const floats sum = Isa::add_product(Isa::multiply(Isa::subtract(e, m), last), m, z),
                     doubt = Isa::multiply(m, Isa::repeat(0.0625f));
        const masks asked = Isa::both(there, Isa::greater(z, by.before));
        shadowed = Isa::both(asked, Isa::not_greater(Isa::subtract(Isa::repeat(0.0f), doubt), sum));
        return !Isa::any(Isa::both(shadowed, Isa::not_greater(sum, doubt))) &&
               !Isa::any(Isa::both(asked, Isa::not_greater(m, by.least_mask))) &&
               !Isa::any(Isa::both(asked, Isa::greater(z, last)));
    }

    GNOMON_LANES_VOID void store(Intensity* to, const masks& shadowed, const floats& darkness) noexcept {
        if constexpr (std::same_as<Intensity, float> && whole_codes)
            Isa::store(to, Isa::keep(shadowed, Isa::fraction(darkness, channel_type::scale)));
        else if constexpr (std::same_as<Intensity, float>)
            Isa::store(to, Isa::keep(shadowed, Isa::lesser(darkness, Isa::repeat(1.0f))));
        else if constexpr (sizeof(Intensity) == sizeof(storage))
            Isa::template store_codes<unorm<Intensity>>(to, Isa::keep(shadowed, darkness));
        else if constexpr (sizeof(Intensity) > sizeof(storage))
            Isa::template store_codes<unorm16>(to, Isa::keep(shadowed, Isa::multiply(darkness, Isa::repeat(257.0f))));
        else // (m + 128) / 257, rounded down: with a half more it is never near a whole number
            Isa::template store_codes<unorm8>(
                to, Isa::keep(shadowed, Isa::multiply(Isa::add(darkness, Isa::repeat(128.5f)), Isa::repeat(1.0f / 257.0f))));
    }

    /// False, and nothing stored, if lanes do not tell.
    GNOMON_LANES bool one(const decision& by, const storage* texels, const Depth* depths, Intensity* to) noexcept {
        const floats mask = codes(texels, Texel::mask_index);
        const floats e = moved(Isa::subtract(codes(texels, Texel::depth_index), by.depth_less), by.depth_share);
        const floats m = moved(Isa::add(mask, by.mask_more), by.mask_share);
        const masks there = Isa::greater(mask, Isa::repeat(0.0f));
        masks shadowed;
        if constexpr (std::same_as<Depth, std::uint16_t>) {
            if (!decided_sums(by, e, m, there, depths, shadowed)) return false;
        } else if constexpr (whole_codes) {
            shadowed = decided_codes(by, e, m, depths);
            if constexpr (Texel::effects.translucency) { // else the mask is stored, and is 0 there
                shadowed = Isa::both(shadowed, there);
            }
        } else {
            if (!decided_floats(by, e, m, there, depths, shadowed)) return false;
        }
        if constexpr (Texel::effects.translucency)
            store(to, shadowed, codes(texels, Texel::contribution_index));
        else
            store(to, shadowed, mask);
        return true;
    }
    static void slow(const rule& r, const Texel* texels, const Depth* depths, Intensity* to) noexcept {
        for (int i = 0; i < step; ++i) to[i] = shadow_as<Intensity>(read(texels[i]), detail::as_depth(depths[i]), r);
    }
    GNOMON_LANES_VOID void rows(const decision& by, const Texel* texels, const Depth* depths, Intensity* to, int count) noexcept {
        for (int i = 0; i < count; i += step)
            if (!one(by, texels[i].stored, depths + i, to + i)) slow(*by.by_rule, texels + i, depths + i, to + i);
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
        const int k = lesser(r.caster.roundings, 2 * 255); // which leave nothing of e, or of m, as more do
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
    GNOMON_LANES_VOID void rows(const byte_decision& by, const Texel* pairs, const std::uint16_t* depths, std::uint8_t* to,
                                int count) noexcept {
        const std::uint8_t* const texels = pairs->stored;
        const ints moved = by.nearer;
        const bool try_quick = by.one_rounding_towards_light;
        for (int i = 0; i < count; i += step)
            if (!try_quick || !quick(moved, texels + 2 * i, depths + i, to + i)) slow(by, texels + 2 * i, depths + i, to + i);
    }
};

/// Pairs of 16 bits, depths of 16 bits, results in codes: a register of results at a time, in whole numbers of 16 bits.
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
    static constexpr int step = Isa::bytes / static_cast<int>(sizeof(Intensity));
    static constexpr int at_once = Isa::bytes / 2; ///< 16-bit numbers in a register

    any_decision any;
    ints nearer;               ///< codes by which z is moved
    ints fewer;                ///< k - 1
    bool asked_for_by_filters; ///< k is 1 or 2, towards light, and z not moved away

    [[nodiscard]] static word_decision of(const rule& r) noexcept {
        const int codes = codes_towards_light<Texel>(r.caster), k = r.caster.roundings;
        const bool quick = r.caster.towards == bias_towards::light && codes >= 0 && (k == 1 || k == 2);
        return {any_decision::of(r), words(codes), words(k - 1), quick};
    }

    GNOMON_LANES ints words(int n) noexcept { return Isa::repeat32(std::uint32_t{static_cast<std::uint16_t>(n)} * 0x10001u); }
    /// As the result is stored: a code of 16 bits itself, or the nearest of 8 bits, floor(t / 257) where t is M + 128 or, if that is
    /// less, 65535; and that is the upper byte of t - floor(t / 256), for every t.
    GNOMON_LANES ints stored(const ints& mask) noexcept {
        if constexpr (sizeof(Intensity) == 2) {
            return mask;
        } else {
            const ints ones = Isa::repeat32(0xFFFFFFFF);
            const ints t = Isa::exclusive_or(Isa::subtract_to_zero16(Isa::exclusive_or(mask, ones), words(128)), ones);
            return Isa::template shift_right16<8>(Isa::subtract16(t, Isa::template shift_right16<8>(t)));
        }
    }
    /// The shadows of a register of receivers. False if it does not tell. A mask less than two codes counts as two, so that clear
    /// texels, of which most maps are full, are surely lit. So is a mask of one code where E is 0; for a greater E it is unsure.
    GNOMON_LANES bool shade(const word_decision& by, const std::uint16_t* texels, const std::uint16_t* depths,
                            ints& shades) noexcept {
        const ints first = Isa::load(texels), second = Isa::load(texels + at_once), two = words(2);
        const ints even = Isa::even_lanes(first, second), odd = Isa::odd_lanes(first, second);
        const ints depth = Isa::even_words(even, odd), mask = Isa::odd_words(even, odd);
        const ints z = Isa::subtract_to_zero16(Isa::load(depths), by.nearer);
        const ints high = Isa::subtract_to_zero16(Isa::multiply_high16(mask, z), by.fewer);                    // h - (k-1)
        const ints last = Isa::subtract_to_zero16(Isa::add16(Isa::subtract_to_zero16(mask, two), two), depth); // F - k
        shades = Isa::both(stored(mask), Isa::greater16(high, last));
        return !Isa::any_equal16(high, last, high, Isa::subtract16(last, words(1)));
    }
    GNOMON_LANES bool quick(const word_decision& by, const std::uint16_t* texels, const std::uint16_t* depths,
                            Intensity* to) noexcept {
        ints shades;
        if (!shade(by, texels, depths, shades)) return false;
        if constexpr (sizeof(Intensity) == 1) {
            ints more;
            if (!shade(by, texels + 2 * at_once, depths + at_once, more)) return false;
            shades = Isa::narrow16(shades, more);
        }
        Isa::store(to, shades);
        return true;
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

/// What lanes decide: all of it but intensities in codes of half and float texels.
template <texel_format Texel, typename Depth, typename Intensity>
inline constexpr bool decided_in_lanes =
    decidable_pairs<Texel> && (Texel::channel_type::whole_codes || (Texel::channels == 2 && std::same_as<Intensity, float>));

/// And what decides.
template <typename Isa, texel_format Texel, typename Depth, typename Intensity> consteval auto choose_decision() {
    constexpr bool codes = std::same_as<Depth, std::uint16_t>;
    if constexpr (byte_pairs<Texel> && codes && std::same_as<Intensity, std::uint8_t>)
        return std::type_identity<byte_decision<Isa, Texel>>{};
    else if constexpr (pairs_of<Texel, unorm16> && codes && !std::same_as<Intensity, float>)
        return std::type_identity<word_decision<Isa, Texel, Intensity>>{};
    else
        return std::type_identity<decision<Isa, Texel, Depth, Intensity>>{};
}
template <typename Isa, texel_format Texel, typename Depth, typename Intensity>
using decision_for = typename decltype(choose_decision<Isa, Texel, Depth, Intensity>())::type;

/// Receivers one to one on texels. Spans of any stride; what is not side by side, and the last few, go through a register's worth of
/// memory.
template <typename Isa, texel_format Texel, typename Depth, typename Intensity>
void receive_row(strided_span<const Texel> texels, strided_span<const Depth> z, strided_span<Intensity> intensity,
                 const rule& r) noexcept {
    using one = decision_for<Isa, Texel, Depth, Intensity>;
    const auto decide = one::of(r);
    const int count = lesser(texels.size(), lesser(z.size(), intensity.size()));
    const bool side_by_side = texels.contiguous() && z.contiguous() && intensity.contiguous();
    const int whole = side_by_side ? count - count % one::step : 0;
    if (whole > 0) one::rows(decide, &texels[0], &z[0], &intensity[0], whole);
    for (int i = whole; i < count; i += one::step) {
        const int some = lesser(one::step, count - i);
        Texel texel[static_cast<std::size_t>(one::step)]{};
        Depth depth[static_cast<std::size_t>(one::step)]{};
        Intensity made[static_cast<std::size_t>(one::step)];
        for (int k = 0; k < some; ++k) texel[k] = texels[i + k], depth[k] = z[i + k];
        one::rows(decide, texel, depth, made, one::step);
        for (int k = 0; k < some; ++k) intensity[i + k] = made[k];
    }
}

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
