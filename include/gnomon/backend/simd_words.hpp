// gnomon: soft shadow maps. The filter in lanes, second part: sums in whole numbers of 16 and 32 bits. Included by simd_filter.hpp after
// simd_wide.hpp, and in its way.

#include <gnomon/filter/separable.hpp>
#include <gnomon/simd/region.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// A kernel's weights, some side by side, as the products of whole numbers take them; zero beyond both ends.
template <kernel Kernel, int Total> struct neighbouring_weights {
    static constexpr int taps = 2 * Kernel::radius + 1;
    template <int Bits, int Count>
    static constexpr auto all = [] {
        std::array<std::uint32_t, static_cast<std::size_t>(taps + 2 * rows_at_once)> w{};
        for (int i = 0; i < taps + 2 * rows_at_once; ++i)
            for (int k = 0; k < 32 / Bits; ++k)
                if (const int t = i - rows_at_once + k % Count; t >= 0 && t < taps)
                    w[static_cast<std::size_t>(i)] |=
                        static_cast<std::uint32_t>(Kernel::weights[static_cast<std::size_t>(t)] * (Total / Kernel::total))
                        << Bits * k;
        return w;
    }();
    /// 32 bits that hold, of so many bits each, `Count` weights from tap `t` on, again and again.
    template <int Bits, int Count = 2> [[nodiscard]] static constexpr std::uint32_t at(int t) noexcept {
        return all<Bits, Count>[static_cast<std::size_t>(t + rows_at_once)];
    }
    /// Are both weights from tap `t` on zero, for they lie beyond the ends? Asked where all taps are written out, so that it is known.
    [[nodiscard]] static constexpr bool none(int t) noexcept { return taps + rows_at_once <= 17 && (t + 1 < 0 || t >= taps); }
    static constexpr bool fit_signed_bytes = [] {
        for (const int w : Kernel::weights)
            if (w * (Total / Kernel::total) > 127) return false;
        return true;
    }();
};

/// Has the centre all of the weight? 256 of 256 is no factor that a product takes, nor 2^15 of 2^15.
template <kernel Kernel>
inline constexpr bool is_one_tap = Kernel::weights[static_cast<std::size_t>(Kernel::radius)] == Kernel::total;

/// Do bytes go by whole numbers of 16 bits? Weights of eight bits do.
template <kernel Kernel>
inline constexpr bool in_eight_bits = !is_one_tap<Kernel> && Kernel::total <= 256 && 256 % Kernel::total == 0;

/// What filters of whole codes share. Bytes and weights of eight bits: column sums of 16 bits, exact in 8.8, then sums of 32 bits and
/// one rounding. 16-bit codes and weights of 15 bits: sums of 32 bits, rounded to 16 after each pass. Codes are taken less half their
/// range, and column sums less 2^15, for the products of processors are of one unsigned and one signed factor, or of two signed.
template <typename Isa, kernel Kernel, texel_format Texel> struct whole_sums {
    static constexpr bool bytes = sizeof(typename Texel::storage) == 1;
    static constexpr int weight_bits = bytes ? 8 : 15;
    using weights = neighbouring_weights<typename detail::sums<Texel, Kernel>::weights_of, 1 << weight_bits>;
    using storage = typename Texel::storage;
    using ints = typename Isa::ints;
    using element = std::int16_t;

    static constexpr int taps = 2 * Kernel::radius + 1;
    static constexpr int margin = Kernel::radius * Texel::channels;
    static constexpr int in_register = Isa::bytes / static_cast<int>(sizeof(storage)); ///< codes
    static constexpr std::uint32_t signs = bytes ? 0x80808080u : 0x80008000u;
    /// Where a row's sums begin: with the half that rounds them, and with the 256 * 2^15 that bytes' columns lack.
    static constexpr std::uint32_t half = bytes ? (1u << 23) + (1u << 15) : 1u << 14;

    /// What a sum of clear columns is.
    [[nodiscard]] static constexpr std::int16_t clear_sum(int channel) noexcept {
        const int code = Texel::clear().stored[channel];
        return static_cast<std::int16_t>((bytes ? code * 256 : code) - 32768);
    }

    /// Of the numbers of a register the lower eight bytes of each 16, and the upper.
    struct halves {
        ints low, high;
    };

    /// A register of codes of four rows: 16-bit sums of bytes, 32-bit sums of words.
    GNOMON_LANES_VOID void sum_columns(const storage* const* rows, int i, halves* sum) noexcept {
        const ints sign = Isa::repeat32(signs), start = Isa::repeat32(bytes ? 0 : half);
        GNOMON_UNROLL(4)
        for (int j = 0; j < rows_at_once; ++j) sum[j] = {start, start};
        GNOMON_UNROLL(8)
        for (int t = 0; t < taps + rows_at_once - 1; t += 2) {
            const ints above = Isa::exclusive_or(Isa::load(rows[t] + i), sign),
                       below = Isa::exclusive_or(Isa::load(rows[t + 1] + i), sign);
            const halves values = bytes ? halves{Isa::low_pairs8(above, below), Isa::high_pairs8(above, below)}
                                        : halves{Isa::low_pairs16(above, below), Isa::high_pairs16(above, below)};
            GNOMON_UNROLL(4)
            for (int j = 0; j < rows_at_once; ++j) {
                if (weights::none(t - j)) continue;
                const ints w = Isa::repeat32(weights::template at<bytes ? 8 : 16>(t - j));
                sum[j] = {add(sum[j].low, w, values.low), add(sum[j].high, w, values.high)};
                Isa::settle(sum[j].low);
                Isa::settle(sum[j].high);
            }
        }
    }
    GNOMON_LANES ints add(ints sum, ints w, ints values) noexcept {
        if constexpr (bytes)
            return Isa::add16(sum, Isa::multiply_pairs8(w, values));
        else
            return Isa::add_dot16(sum, w, values);
    }
    /// Rounded by what the sums began with.
    template <int Bits> GNOMON_LANES ints rounded(halves sum) noexcept {
        return Isa::narrow32(Isa::template shift_right32<Bits>(sum.low), Isa::template shift_right32<Bits>(sum.high));
    }
};

/// A pair of whole codes. The line holds all depths, then all masks: a row needs no shuffles.
template <typename Isa, kernel Kernel, texel_format Texel> struct pair_filter : whole_sums<Isa, Kernel, Texel> {
    using base = whole_sums<Isa, Kernel, Texel>;
    using storage = typename base::storage;
    using ints = typename base::ints;
    using weights = typename base::weights;
    using halves = typename base::halves;
    using base::bytes, base::in_register, base::margin, base::taps;

    static constexpr int step = Isa::bytes; ///< as many sums of 16 bits as two registers hold
    static constexpr int planes = 2, piece = piece_bytes / 2;
    [[nodiscard]] static constexpr int place(int i) noexcept { return i / 2; }

    static void columns(const storage* const* rows, const storage* const* ahead, std::int16_t* line, int plane,
                        int count) noexcept {
        for (int at = 0; at < count; at += step) {
            const int i = lesser(at, count - step);
            call_for<Isa>(ahead, i);
            ints depth[rows_at_once], mask[rows_at_once];
            if constexpr (!bytes)
                sum_words(rows, i, depth, mask);
            else if constexpr (sums_quads<Isa> && weights::fit_signed_bytes && taps > 11)
                sum_fours(rows, i, depth, mask);
            else
                sum_pairs(rows, i, depth, mask);
            GNOMON_UNROLL(4)
            for (int j = 0; j < rows_at_once; ++j) {
                Isa::store(line + 2 * j * plane + i / 2, depth[j]);
                Isa::store(line + (2 * j + 1) * plane + i / 2, mask[j]);
            }
        }
    }

    static void clear(std::int16_t* line, int plane, int first, int last) noexcept {
        for (int i = first / 2; i < last / 2; ++i) {
            line[i] = base::clear_sum(0);
            line[i + plane] = base::clear_sum(1);
        }
    }

    GNOMON_LANES_VOID void row(const std::int16_t* line, int plane, storage* to) noexcept {
        const ints start = Isa::repeat32(base::half);
        ints depth[2] = {start, start}, mask[2] = {start, start}; // of every even texel, and of every odd one
        GNOMON_UNROLL(8)
        for (int t = 0; t < taps; t += 2) {
            ints depths = Isa::load(line + t), masks = Isa::load(line + plane + t);
            Isa::settle(depths);
            Isa::settle(masks);
            GNOMON_UNROLL(2)
            for (int odd = 0; odd < 2; ++odd) { // an odd one finds its taps in the same pairs, one place later
                const ints w = Isa::repeat32(weights::template at<16>(t - odd));
                depth[odd] = Isa::add_dot16(depth[odd], w, depths);
                mask[odd] = Isa::add_dot16(mask[odd], w, masks);
                Isa::settle(depth[odd]);
                Isa::settle(mask[odd]);
            }
        }
        if constexpr (bytes) {
            Isa::store(to, Isa::interleave_byte2(depth[0], mask[0], depth[1], mask[1]));
        } else {
            const ints even = Isa::template join_words<15>(depth[0], mask[0]),
                       odd = Isa::template join_words<15>(depth[1], mask[1]);
            const ints low = Isa::low_pairs32(even, odd), high = Isa::high_pairs32(even, odd), sign = Isa::repeat32(base::signs);
            Isa::store(to, Isa::exclusive_or(Isa::first_half(low, high), sign));
            Isa::store(to + in_register, Isa::exclusive_or(Isa::second_half(low, high), sign));
        }
    }

  private:
    /// Bytes, row by row in pairs of rows.
    GNOMON_LANES_VOID void sum_pairs(const storage* const* rows, int i, ints* depth, ints* mask) noexcept {
        const ints sign = Isa::repeat32(base::signs);
        GNOMON_UNROLL(4)
        for (int j = 0; j < rows_at_once; ++j) depth[j] = mask[j] = Isa::repeat32(0);
        GNOMON_UNROLL(8)
        for (int t = 0; t < taps + rows_at_once - 1; t += 2) {
            const ints above = Isa::exclusive_or(Isa::load(rows[t] + i), sign),
                       below = Isa::exclusive_or(Isa::load(rows[t + 1] + i), sign);
            const ints depths = Isa::even_pairs8(above, below), masks = Isa::odd_pairs8(above, below);
            GNOMON_UNROLL(4)
            for (int j = 0; j < rows_at_once; ++j) {
                if (weights::none(t - j)) continue;
                const ints w = Isa::repeat32(weights::template at<8>(t - j));
                depth[j] = Isa::add16(depth[j], Isa::multiply_pairs8(w, depths));
                mask[j] = Isa::add16(mask[j], Isa::multiply_pairs8(w, masks));
                Isa::settle(depth[j]);
                Isa::settle(mask[j]);
            }
        }
    }

    /// Bytes, four rows at a time, where lanes sum four products: of many taps, for few do not fill the fours.
    GNOMON_LANES_VOID void sum_fours(const storage* const* rows, int i, ints* depth, ints* mask) noexcept {
        ints sum[rows_at_once][4];
        GNOMON_UNROLL(4)
        for (int j = 0; j < rows_at_once; ++j) sum[j][0] = sum[j][1] = sum[j][2] = sum[j][3] = Isa::repeat32(0xFFFF8000u); // -2^15
        GNOMON_UNROLL(8)
        for (int t = 0; t < taps + rows_at_once - 1; t += 4) {
            const ints a = Isa::load(rows[t] + i), b = Isa::load(rows[t + 1] + i), c = Isa::load(rows[t + 2] + i),
                       d = Isa::load(rows[t + 3] + i);
            const ints low_ab = Isa::low_pairs8(a, b), low_cd = Isa::low_pairs8(c, d);
            const ints high_ab = Isa::high_pairs8(a, b), high_cd = Isa::high_pairs8(c, d);
            const ints values[4] = {Isa::low_pairs16(low_ab, low_cd), Isa::high_pairs16(low_ab, low_cd),
                                    Isa::low_pairs16(high_ab, high_cd), Isa::high_pairs16(high_ab, high_cd)};
            GNOMON_UNROLL(4)
            for (int j = 0; j < rows_at_once; ++j) {
                const ints w = Isa::repeat32(weights::template at<8, 4>(t - j));
                GNOMON_UNROLL(4)
                for (int k = 0; k < 4; ++k) {
                    sum[j][k] = Isa::add_dot8(sum[j][k], w, values[k]);
                    Isa::settle(sum[j][k]);
                }
            }
        }
        GNOMON_UNROLL(4)
        for (int j = 0; j < rows_at_once; ++j) { // depth and mask in turn
            const ints first = Isa::narrow32(sum[j][0], sum[j][1]), second = Isa::narrow32(sum[j][2], sum[j][3]);
            depth[j] = Isa::even_words(first, second);
            mask[j] = Isa::odd_words(first, second);
        }
    }

    /// Words, two registers of them, apart only when they are summed.
    GNOMON_LANES_VOID void sum_words(const storage* const* rows, int i, ints* depth, ints* mask) noexcept {
        halves first[rows_at_once], second[rows_at_once];
        base::sum_columns(rows, i, first);
        ints a[rows_at_once];
        GNOMON_UNROLL(4)
        for (int j = 0; j < rows_at_once; ++j) a[j] = base::template rounded<15>(first[j]);
        base::sum_columns(rows, i + in_register, second);
        GNOMON_UNROLL(4)
        for (int j = 0; j < rows_at_once; ++j) {
            const ints b = base::template rounded<15>(second[j]);
            const ints even = Isa::even_lanes(a[j], b), odd = Isa::odd_lanes(a[j], b);
            depth[j] = Isa::even_words(even, odd);
            mask[j] = Isa::odd_words(even, odd);
        }
    }
};

/// Whole codes of any number of channels, each beside the next in the line as in the texel.
template <typename Isa, kernel Kernel, texel_format Texel> struct word_filter : whole_sums<Isa, Kernel, Texel> {
    using base = whole_sums<Isa, Kernel, Texel>;
    using storage = typename base::storage;
    using ints = typename base::ints;
    using halves = typename base::halves;
    using base::bytes, base::in_register, base::margin, base::taps;

    static constexpr int step = in_register;
    static constexpr int words = Isa::bytes / 2; ///< elements of the line in a register
    static constexpr int planes = 1, piece = piece_bytes / 2 / Texel::channels * Texel::channels;
    [[nodiscard]] static constexpr int place(int i) noexcept { return i; }

    static void columns(const storage* const* rows, const storage* const* ahead, std::int16_t* line, int plane,
                        int count) noexcept {
        for (int at = 0; at < count; at += step) {
            const int i = lesser(at, count - step);
            call_for<Isa>(ahead, i);
            halves sum[rows_at_once];
            base::sum_columns(rows, i, sum);
            GNOMON_UNROLL(4)
            for (int j = 0; j < rows_at_once; ++j) {
                std::int16_t* const to = line + j * plane + i;
                if constexpr (bytes) {
                    Isa::store(to, Isa::first_half(sum[j].low, sum[j].high));
                    Isa::store(to + words, Isa::second_half(sum[j].low, sum[j].high));
                } else {
                    Isa::store(to, base::template rounded<15>(sum[j]));
                }
            }
        }
    }

    static void clear(std::int16_t* line, int, int first, int last) noexcept {
        for (int i = first; i < last; ++i) line[i] = base::clear_sum(i % Texel::channels);
    }

    GNOMON_LANES_VOID void row(const std::int16_t* line, int, storage* to) noexcept {
        if constexpr (bytes)
            Isa::store(to,
                       Isa::narrow16(base::template rounded<16>(sum_row(line)), base::template rounded<16>(sum_row(line + words))));
        else
            Isa::store(to, Isa::exclusive_or(base::template rounded<15>(sum_row(line)), Isa::repeat32(base::signs)));
    }

  private:
    /// A register's worth of the line, with what lies around it.
    GNOMON_LANES halves sum_row(const std::int16_t* line) noexcept {
        const ints start = Isa::repeat32(base::half);
        halves sum = {start, start};
        GNOMON_UNROLL(8)
        for (int t = 0; t < taps; t += 2) {
            const ints here = Isa::load(line + t * Texel::channels), next = Isa::load(line + (t + 1) * Texel::channels);
            const ints w = Isa::repeat32(base::weights::template at<16>(t));
            sum = {Isa::add_dot16(sum.low, w, Isa::low_pairs16(here, next)),
                   Isa::add_dot16(sum.high, w, Isa::high_pairs16(here, next))};
            Isa::settle(sum.low);
            Isa::settle(sum.high);
        }
        return sum;
    }
};

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
