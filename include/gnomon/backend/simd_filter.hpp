// gnomon: soft shadow maps. The filter in lanes. backend/simd.hpp includes it once for each target, inside its region, so there is
// no #pragma once: GNOMON_ON names the namespace it goes to; without it there is nothing.
//
// As in filter/separable.hpp columns come first, into a line, and the line goes into a row with one rounding; but four rows are
// summed at once, from the same loads, and a region is cut into strips whose lines stay in the first cache.

#include <gnomon/filter/separable.hpp>
#include <gnomon/simd/region.hpp>

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// Rows that are summed side by side, and bytes of a row that a strip takes.
inline constexpr int rows_at_once = 4, strip_bytes = 4096;

/// What is read is called for ahead of time in a map as large as this, and a result as large as that is written past the caches:
/// both where filtering and receiving together gained by it.
inline constexpr std::int64_t prefetched_bytes = 4 << 20, streamed_bytes = 16 << 20;

/// Calls for what the next rows hold at `i`, if they are to be called for.
template <typename Isa, typename Storage> GNOMON_INLINE void call_for(const Storage* const* ahead, int i) noexcept {
    if (ahead == nullptr) return;
    GNOMON_UNROLL(4)
    for (int j = 0; j < rows_at_once; ++j) Isa::prefetch(ahead[j] + i);
}

/// Any texel that is filtered channel by channel, in doubles, whose sums are exact, or in floats. (See filter/separable.hpp.)
template <typename Isa, kernel Kernel, texel_format Texel, typename Number> struct wide_filter {
    using by = detail::sums<Texel, Kernel>;
    using channel_type = typename Texel::channel_type;
    using storage = typename Texel::storage;
    using element = Number;
    using numbers = decltype(Isa::repeat(Number{}));

    static constexpr int step = Isa::bytes / static_cast<int>(sizeof(Number)); ///< channels that are made at a time
    static constexpr int strip = strip_bytes / static_cast<int>(sizeof(Number)) / Texel::channels * Texel::channels;
    static constexpr int margin = Kernel::radius * Texel::channels;
    static constexpr int line_size = step + strip + 2 * margin + step + Texel::channels; ///< for one row, in elements
    static constexpr int taps = 2 * Kernel::radius + 1;
    [[nodiscard]] static constexpr int place(int i) noexcept { return i; }

    static constexpr auto weights = [] {
        std::array<Number, static_cast<std::size_t>(taps + 2 * rows_at_once)> w{};
        for (int t = 0; t < taps; ++t) w[static_cast<std::size_t>(t + rows_at_once)] = by::template weight<Number>(t);
        return w;
    }();
    GNOMON_LANES numbers codes(const storage* from) noexcept {
        if constexpr (by::in_floats)
            return Isa::template codes_of<channel_type, 1>(from, 0);
        else if constexpr (Texel::representation_type::premultiplied)
            return Isa::template codes<channel_type>(from);
        else
            return Isa::multiply_pairs(Isa::template codes<channel_type>(from), static_cast<double>(channel_type::scale));
    }

    static void columns(const storage* const* rows, const storage* const* ahead, Number* line, int count) noexcept {
        for (int at = 0; at < count; at += step) {
            const int i = lesser(at, count - step);
            call_for<Isa>(ahead, i);
            numbers sum[rows_at_once];
            GNOMON_UNROLL(4)
            for (int j = 0; j < rows_at_once; ++j) sum[j] = Isa::repeat(Number{});
            GNOMON_UNROLL(16)
            for (int t = 0; t < taps + rows_at_once - 1; ++t) {
                const numbers values = codes(rows[t] + i);
                const Number* w = weights.data() + rows_at_once + t;
                GNOMON_UNROLL(4)
                for (int j = 0; j < rows_at_once; ++j)
                    if (channel_type::whole_codes || (t >= j && t < taps + j)) // an infinity times no weight is no zero
                        sum[j] = Isa::add_product(sum[j], values, Isa::repeat(w[-j]));
            }
            GNOMON_UNROLL(4)
            for (int j = 0; j < rows_at_once; ++j) {
                if constexpr (!channel_type::whole_codes && !by::in_floats) { // detail::to_bits<36>
                    constexpr std::uint64_t dropped = (1 << 17) - 1;
                    sum[j] = Isa::add_and_mask(sum[j], dropped / 2 + 1, ~dropped);
                }
                Isa::store(line + j * line_size + i, sum[j]);
            }
        }
    }

    static void clear(Number* line, int first, int last) noexcept {
        for (int i = first; i < last; ++i) {
            const auto code = Texel::clear().template linear<Number>(i % Texel::channels);
            line[i] = static_cast<Number>(by::weights_of::total) / by::unit * code;
        }
    }

    GNOMON_LANES_VOID void row(const Number* line, storage* to) noexcept {
        constexpr auto whole = static_cast<Number>(by::whole);
        numbers sum = Isa::repeat(Number{});
        GNOMON_UNROLL(16)
        for (int t = 0; t < taps; ++t)
            sum = Isa::add_product(sum, Isa::load(line + t * Texel::channels),
                                   Isa::repeat(weights[static_cast<std::size_t>(t + rows_at_once)]));
        if constexpr (!Texel::representation_type::premultiplied) {
            double sums[static_cast<std::size_t>(step)];
            Isa::store(sums, sum);
            for (int k = 0; k < step; k += Texel::channels) {
                const std::uint64_t linear[] = {static_cast<std::uint64_t>(sums[k]), static_cast<std::uint64_t>(sums[k + 1])};
                const Texel made = Texel::from_linear(linear, by::whole);
                to[k] = made.stored[0];
                to[k + 1] = made.stored[1];
            }
        } else if constexpr (channel_type::whole_codes) {
            // Halves upwards, then down. The quarter keeps what is whole from being rounded below itself: sum and whole are whole, and
            // a quarter of 1/whole is more than the product can be wrong by, for every total there is.
            constexpr double half = static_cast<double>(by::whole / 2) + 0.25;
            sum = Isa::multiply(Isa::add(sum, Isa::repeat(half)), Isa::repeat(1.0 / whole));
        } else if constexpr (!by::in_floats || !std::has_single_bit(static_cast<unsigned>(by::weights_of::total))) {
            sum = Isa::divide(sum, Isa::repeat(whole));
        }
        if constexpr (Texel::representation_type::premultiplied) Isa::template store_codes<channel_type>(to, sum);
    }
};

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
    static constexpr bool fit_signed_bytes = [] {
        for (const int w : Kernel::weights)
            if (w * (Total / Kernel::total) > 127) return false;
        return true;
    }();
};

/// Do bytes go by whole numbers of 16 bits? Weights of eight bits do.
template <kernel Kernel>
inline constexpr bool in_eight_bits = Kernel::radius > 0 && Kernel::total <= 256 && 256 % Kernel::total == 0;

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
    static constexpr int strip = strip_bytes / 2;
    static constexpr int plane_size = (step + strip + 2 * margin + step + Texel::channels) / 2;
    static constexpr int line_size = 2 * plane_size;
    [[nodiscard]] static constexpr int place(int i) noexcept { return i / 2; }

    static void columns(const storage* const* rows, const storage* const* ahead, std::int16_t* line, int count) noexcept {
        for (int at = 0; at < count; at += step) {
            const int i = lesser(at, count - step);
            call_for<Isa>(ahead, i);
            ints depth[rows_at_once], mask[rows_at_once];
            if constexpr (!bytes)
                sum_words(rows, i, depth, mask);
            else if constexpr (sums_quads<Isa> && weights::fit_signed_bytes)
                sum_fours(rows, i, depth, mask);
            else
                sum_pairs(rows, i, depth, mask);
            GNOMON_UNROLL(4)
            for (int j = 0; j < rows_at_once; ++j) {
                Isa::store(line + j * line_size + i / 2, depth[j]);
                Isa::store(line + j * line_size + plane_size + i / 2, mask[j]);
            }
        }
    }

    static void clear(std::int16_t* line, int first, int last) noexcept {
        for (int i = first / 2; i < last / 2; ++i) {
            line[i] = base::clear_sum(0);
            line[i + plane_size] = base::clear_sum(1);
        }
    }

    GNOMON_LANES_VOID void row(const std::int16_t* line, storage* to) noexcept {
        const ints start = Isa::repeat32(base::half);
        ints depth[2] = {start, start}, mask[2] = {start, start}; // of every even texel, and of every odd one
        GNOMON_UNROLL(8)
        for (int t = 0; t < taps; t += 2) {
            ints depths = Isa::load(line + t), masks = Isa::load(line + plane_size + t);
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
                const ints w = Isa::repeat32(weights::template at<8>(t - j));
                depth[j] = Isa::add16(depth[j], Isa::multiply_pairs8(w, depths));
                mask[j] = Isa::add16(mask[j], Isa::multiply_pairs8(w, masks));
                Isa::settle(depth[j]);
                Isa::settle(mask[j]);
            }
        }
    }

    /// Bytes, four rows at a time, where lanes sum four products.
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
    static constexpr int strip = strip_bytes / 2 / Texel::channels * Texel::channels;
    static constexpr int line_size = step + strip + 2 * margin + step + Texel::channels;
    [[nodiscard]] static constexpr int place(int i) noexcept { return i; }

    static void columns(const storage* const* rows, const storage* const* ahead, std::int16_t* line, int count) noexcept {
        for (int at = 0; at < count; at += step) {
            const int i = lesser(at, count - step);
            call_for<Isa>(ahead, i);
            halves sum[rows_at_once];
            base::sum_columns(rows, i, sum);
            GNOMON_UNROLL(4)
            for (int j = 0; j < rows_at_once; ++j) {
                std::int16_t* const to = line + j * line_size + i;
                if constexpr (bytes) {
                    Isa::store(to, Isa::first_half(sum[j].low, sum[j].high));
                    Isa::store(to + words, Isa::second_half(sum[j].low, sum[j].high));
                } else {
                    Isa::store(to, base::template rounded<15>(sum[j]));
                }
            }
        }
    }

    static void clear(std::int16_t* line, int first, int last) noexcept {
        for (int i = first; i < last; ++i) line[i] = base::clear_sum(i % Texel::channels);
    }

    GNOMON_LANES_VOID void row(const std::int16_t* line, storage* to) noexcept {
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

/// What lanes filter: premultiplied texels, and pairs of a ratio whose sums, of products of two codes, are exact in double.
template <kernel Kernel, texel_format Texel>
inline constexpr bool filtered_in_lanes = [] {
    constexpr double total = detail::sums<Texel, Kernel>::weights_of::total;
    constexpr bool exact = Texel::channels == 2 && Texel::linear_scale * total * total < 0x1p53;
    return Kernel::radius <= 256 && (Texel::representation_type::premultiplied || exact);
}();

/// What serves a texel and a kernel best. All give the same bits where several can.
template <typename Isa, kernel Kernel, texel_format Texel> consteval auto choose_filter() {
    using by = detail::sums<Texel, Kernel>;
    constexpr bool bytes = Texel::representation_type::premultiplied && std::same_as<typename Texel::channel_type, unorm8> &&
                           in_eight_bits<typename by::weights_of>;
    constexpr bool words = by::stored_between;
    if constexpr ((bytes || words) && Texel::channels == 2)
        return std::type_identity<pair_filter<Isa, Kernel, Texel>>{};
    else if constexpr (bytes || words)
        return std::type_identity<word_filter<Isa, Kernel, Texel>>{};
    else
        return std::type_identity<wide_filter<Isa, Kernel, Texel, std::conditional_t<by::in_floats, float, double>>>{};
}
template <typename Isa, kernel Kernel, texel_format Texel>
using filter_of = typename decltype(choose_filter<Isa, Kernel, Texel>())::type;

/// A row of texels as a row of channels: the object is the memory.
template <texel_format Texel> const typename Texel::storage* channels_of(const Texel* row) noexcept {
    return reinterpret_cast<const typename Texel::storage*>(row);
}
template <texel_format Texel> typename Texel::storage* channels_of(Texel* row) noexcept {
    return reinterpret_cast<typename Texel::storage*>(row);
}

/// Copies so many bytes past the caches, as far as whole registers reach.
template <typename Isa> void stream(void* to, const void* from, std::size_t bytes) noexcept {
    auto* const out = static_cast<unsigned char*>(to);
    const auto* const in = static_cast<const unsigned char*>(from);
    constexpr auto step = static_cast<std::size_t>(Isa::bytes);
    std::size_t i = (step - reinterpret_cast<std::uintptr_t>(to) % step) % step;
    i = i < bytes ? i : bytes;
    std::memcpy(out, in, i);
    for (; i + step <= bytes; i += step) Isa::stream(out + i, Isa::load(in + i));
    std::memcpy(out + i, in + i, bytes - i);
}

/// So many channels of a row out of a line: straight to where they go, or by way of `made`, past the caches or because a register
/// would reach beyond the row.
template <typename Isa, typename Pass, typename Storage>
void make_row(const typename Pass::element* line, Storage* to, int count, bool past_caches, Storage* made) noexcept {
    Storage* const out = past_caches || count < Pass::step ? made : to;
    for (int at = 0; at < count; at += Pass::step) {
        const int i = greater(lesser(at, count - Pass::step), 0);
        Pass::row(line + Pass::place(i), out + i);
    }
    const auto bytes = static_cast<std::size_t>(count) * sizeof(Storage);
    if (past_caches)
        stream<Isa>(to, made, bytes);
    else if (out == made)
        std::memcpy(to, made, bytes);
}

/// filter_region in lanes, for a region within both images. False, and nothing done, where rows are shorter than a register.
template <typename Isa, kernel Kernel, texel_format Texel>
bool filter_rows(image_view<const Texel> from, image_view<Texel> to, texel_rect region) noexcept {
    using pass = filter_of<Isa, Kernel, Texel>;
    using storage = typename Texel::storage;
    constexpr int channels = Texel::channels, margin = pass::margin;
    constexpr int rows_summed =
        2 * Kernel::radius + rows_at_once; // and a few more are told, to those that take them by twos and fours
    const int row_size = from.width() * channels;
    if (row_size < pass::step) return false;
    const auto bytes_of = [](int width, int height) { return std::int64_t{width} * height * std::int64_t{sizeof(Texel)}; };
    const bool prefetched = bytes_of(from.width(), from.height()) >= prefetched_bytes;
    const bool past_caches = bytes_of(region.width(), region.height()) >= streamed_bytes;

    alignas(64) storage made[static_cast<std::size_t>(pass::strip + pass::step)];
    alignas(64) typename pass::element line[static_cast<std::size_t>(rows_at_once * pass::line_size)];
    Texel nothing[static_cast<std::size_t>((pass::strip + 2 * margin + pass::step + channels - 1) / channels)];
    const bool beyond = region.y0 < Kernel::radius || region.y1 > from.height() - Kernel::radius - 2 * rows_at_once;
    if (beyond)
        for (Texel& each : nothing) each = Texel::clear();

    for (int x0 = region.x0 * channels; x0 < region.x1 * channels; x0 += pass::strip) {
        const int x1 = lesser(x0 + pass::strip, region.x1 * channels), left = x0 - margin, right = x1 + margin;
        // The columns that are there, and enough of them for one register.
        const int last = greater(lesser(right, row_size), pass::step);
        const int first = greater(lesser(left, last - pass::step), 0);
        for (int y = region.y0; y < region.y1; y += rows_at_once) {
            const storage* rows[static_cast<std::size_t>(rows_summed + rows_at_once)];
            for (int t = 0; t < rows_summed + rows_at_once; ++t) {
                const int row = y + t - Kernel::radius;
                const bool there = row >= 0 && row < from.height();
                rows[t] = there ? channels_of(from.row(row)) + first : channels_of(nothing) + first % channels;
            }
            typename pass::element* const sums = line + pass::place(pass::step); // of the column `left`
            pass::columns(rows, prefetched ? rows + rows_summed : nullptr, sums + pass::place(first - left), last - first);
            for (int j = 0; j < lesser(rows_at_once, region.y1 - y); ++j) {
                typename pass::element* const here = sums + j * pass::line_size;
                pass::clear(here, 0, -left); // and one texel more at the end, which a pair of taps may read without a weight
                pass::clear(here, lesser(row_size, right) - left, right - left + channels);
                make_row<Isa, pass>(here, channels_of(to.row(y + j)) + x0, x1 - x0, past_caches, made);
            }
        }
    }
    if (past_caches) Isa::fence();
    return true;
}

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
