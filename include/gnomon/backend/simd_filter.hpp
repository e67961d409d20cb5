// gnomon: soft shadow maps. The filter in lanes. backend/simd.hpp includes it once for each target, inside its region, so there is
// no #pragma once: GNOMON_ON names the namespace it goes to; without it there is nothing.
//
// As in filter/separable.hpp columns come first, into a line, and the line goes into a row with one rounding; but four rows are
// summed at once, from the same loads, and a region is cut into strips whose lines stay in the first cache.

#include <gnomon/filter/separable.hpp>
#include <gnomon/simd/region.hpp>

#include <array>
#include <concepts>
#include <cstring>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// Rows that are summed side by side, and bytes of a row that a strip takes.
inline constexpr int rows_at_once = 4, strip_bytes = 2048;

/// Any texel that is filtered channel by channel: sums in double, which are exact. (See filter/separable.hpp for the line's 36 bits.)
template <typename Isa, kernel Kernel, texel_format Texel> struct wide_filter {
    using channel_type = typename Texel::channel_type;
    using storage = typename Texel::storage;
    using doubles = typename Isa::doubles;
    using element = double;

    static constexpr int step = Isa::double_lanes; ///< channels that are made at a time
    static constexpr int strip = strip_bytes / static_cast<int>(sizeof(double)) / Texel::channels * Texel::channels;
    static constexpr int margin = Kernel::radius * Texel::channels;
    static constexpr int line_size = step + strip + 2 * margin + step + Texel::channels; ///< for one row, in elements
    static constexpr int taps = 2 * Kernel::radius + 1;
    [[nodiscard]] static constexpr int place(int i) noexcept { return i; }

    static constexpr auto weights = [] {
        std::array<double, static_cast<std::size_t>(taps + 2 * rows_at_once)> w{};
        for (int t = 0; t < taps; ++t) w[static_cast<std::size_t>(t + rows_at_once)] = Kernel::weights[static_cast<std::size_t>(t)];
        return w;
    }();

    static void columns(const storage* const* rows, double* line, int count) noexcept {
        for (int at = 0; at < count; at += step) {
            const int i = lesser(at, count - step);
            doubles sum[rows_at_once];
            GNOMON_UNROLL(4)
            for (int j = 0; j < rows_at_once; ++j) sum[j] = Isa::repeat(0.0);
            GNOMON_UNROLL(16)
            for (int t = 0; t < taps + rows_at_once - 1; ++t) {
                const doubles codes = Isa::template codes<channel_type>(rows[t] + i);
                const double* w = weights.data() + rows_at_once + t;
                GNOMON_UNROLL(4)
                for (int j = 0; j < rows_at_once; ++j)
                    if (channel_type::whole_codes || (t >= j && t < taps + j)) // an infinity times no weight is no zero
                        sum[j] = Isa::add_product(sum[j], codes, Isa::repeat(w[-j]));
            }
            GNOMON_UNROLL(4)
            for (int j = 0; j < rows_at_once; ++j) {
                if constexpr (!channel_type::whole_codes) { // detail::to_bits<36>
                    constexpr std::uint64_t dropped = (1 << 17) - 1;
                    sum[j] = Isa::add_and_mask(sum[j], dropped / 2 + 1, ~dropped);
                }
                Isa::store(line + j * line_size + i, sum[j]);
            }
        }
    }

    static void clear(double* line, int first, int last) noexcept {
        for (int i = first; i < last; ++i)
            line[i] = Kernel::total * static_cast<double>(channel_type::code(Texel::clear().stored[i % Texel::channels]));
    }

    GNOMON_LANES_VOID void row(const double* line, storage* to) noexcept {
        constexpr double whole = static_cast<double>(Kernel::total) * static_cast<double>(Kernel::total);
        doubles sum = Isa::repeat(0.0);
        GNOMON_UNROLL(16)
        for (int t = 0; t < taps; ++t)
            sum = Isa::add_product(sum, Isa::load(line + t * Texel::channels),
                                   Isa::repeat(weights[static_cast<std::size_t>(t + rows_at_once)]));
        if constexpr (channel_type::whole_codes) {
            // Halves upwards, then down. The quarter keeps what is whole from being rounded below itself: sum and whole are whole, and
            // a quarter of 1/whole is more than the product can be wrong by, for every total there is.
            constexpr double half = static_cast<double>(static_cast<std::uint64_t>(whole) / 2) + 0.25;
            sum = Isa::multiply(Isa::add(sum, Isa::repeat(half)), Isa::repeat(1.0 / whole));
        } else {
            sum = Isa::divide(sum, Isa::repeat(whole));
        }
        Isa::template store_codes<channel_type>(to, sum);
    }
};

/// A pair of bytes and a kernel of 8-bit weights: 16-bit sums of columns, exact in 8.8, then 32-bit sums of these. Pixels are taken
/// less 128 and column sums less 2^15, for the products of processors are of one unsigned and one signed factor, or of two signed.
template <typename Isa, kernel Kernel, texel_format Texel> struct byte_filter {
    using storage = typename Texel::storage;
    using ints = typename Isa::ints;
    using element = std::int16_t;

    static constexpr int step = Isa::bytes;
    static constexpr int strip = strip_bytes;
    static constexpr int margin = Kernel::radius * Texel::channels;
    static constexpr int plane_size = (step + strip + 2 * margin + step + Texel::channels) / 2; ///< depths first, masks behind them
    static constexpr int line_size = 2 * plane_size;
    static constexpr int taps = 2 * Kernel::radius + 1;
    [[nodiscard]] static constexpr int place(int i) noexcept { return i / 2; }

    /// weight t beside weight t + 1, in each 32 bits; zero beyond both ends.
    template <int Bits>
    static constexpr auto pairs = [] {
        std::array<std::uint32_t, static_cast<std::size_t>(taps + 2 * rows_at_once)> p{};
        const auto weight = [](int t) {
            return t < 0 || t >= taps
                       ? 0u
                       : static_cast<std::uint32_t>(Kernel::weights[static_cast<std::size_t>(t)] * (256 / Kernel::total));
        };
        for (int t = -rows_at_once; t < taps + rows_at_once; ++t) {
            const std::uint32_t pair = weight(t) | weight(t + 1) << Bits;
            p[static_cast<std::size_t>(t + rows_at_once)] = Bits == 8 ? pair | pair << 16 : pair;
        }
        return p;
    }();
    template <int Bits> GNOMON_LANES ints pair(int t) noexcept {
        return Isa::repeat32(pairs<Bits>[static_cast<std::size_t>(t + rows_at_once)]);
    }

    static void columns(const storage* const* rows, std::int16_t* line, int count) noexcept {
        const ints sign = Isa::repeat32(0x80808080u);
        for (int at = 0; at < count; at += step) {
            const int i = lesser(at, count - step);
            ints depth[rows_at_once], mask[rows_at_once];
            GNOMON_UNROLL(4)
            for (int j = 0; j < rows_at_once; ++j) depth[j] = mask[j] = Isa::repeat32(0);
            GNOMON_UNROLL(1)
            for (int t = 0; t < taps + rows_at_once - 1; t += 2) {
                const ints above = Isa::exclusive_or(Isa::load(rows[t] + i), sign),
                           below = Isa::exclusive_or(Isa::load(rows[t + 1] + i), sign);
                const ints depths = Isa::even_pairs8(above, below), masks = Isa::odd_pairs8(above, below);
                GNOMON_UNROLL(4)
                for (int j = 0; j < rows_at_once; ++j) {
                    const ints w = pair<8>(t - j);
                    depth[j] = Isa::add16(depth[j], Isa::multiply_pairs8(w, depths));
                    mask[j] = Isa::add16(mask[j], Isa::multiply_pairs8(w, masks));
                    Isa::settle(depth[j]);
                    Isa::settle(mask[j]);
                }
            }
            GNOMON_UNROLL(4)
            for (int j = 0; j < rows_at_once; ++j) {
                Isa::store(line + j * line_size + i / 2, depth[j]);
                Isa::store(line + j * line_size + plane_size + i / 2, mask[j]);
            }
        }
    }

    static void clear(std::int16_t* line, int first, int last) noexcept {
        constexpr Texel nothing = Texel::clear();
        for (int i = first / 2; i < last / 2; ++i) {
            line[i] = static_cast<std::int16_t>(nothing.stored[0] * 256 - 32768);
            line[i + plane_size] = static_cast<std::int16_t>(nothing.stored[1] * 256 - 32768);
        }
    }

    GNOMON_LANES_VOID void row(const std::int16_t* line, storage* to) noexcept {
        const ints start = Isa::repeat32((1u << 23) + (1u << 15)); // 256 * 2^15 that the columns lack, and a half
        ints depth[2] = {start, start}, mask[2] = {start, start};  // of every even texel, and of every odd one
        GNOMON_UNROLL(2)
        for (int t = 0; t < taps; t += 2) {
            ints depths = Isa::load(line + t), masks = Isa::load(line + plane_size + t);
            Isa::settle(depths);
            Isa::settle(masks);
            GNOMON_UNROLL(2)
            for (int odd = 0; odd < 2; ++odd) { // an odd one finds its taps in the same pairs, one place later
                const ints w = pair<16>(t - odd);
                depth[odd] = Isa::add_dot16(depth[odd], w, depths);
                mask[odd] = Isa::add_dot16(mask[odd], w, masks);
                Isa::settle(depth[odd]);
                Isa::settle(mask[odd]);
            }
        }
        Isa::store(to, Isa::interleave_byte2(depth[0], mask[0], depth[1], mask[1]));
    }
};

/// What serves a texel and a kernel best. Both give the same bits where both can.
template <typename Isa, kernel Kernel, texel_format Texel>
using filter_of = std::conditional_t<std::same_as<typename Texel::channel_type, unorm8> && Texel::channels == 2 &&
                                         (Kernel::radius > 0) && (Kernel::total <= 256) && 256 % Kernel::total == 0,
                                     byte_filter<Isa, Kernel, Texel>, wide_filter<Isa, Kernel, Texel>>;

/// A row of texels as a row of channels: the object is the memory.
template <texel_format Texel> const typename Texel::storage* channels_of(const Texel* row) noexcept {
    return reinterpret_cast<const typename Texel::storage*>(row);
}
template <texel_format Texel> typename Texel::storage* channels_of(Texel* row) noexcept {
    return reinterpret_cast<typename Texel::storage*>(row);
}

/// filter_region in lanes, for a region within both images. False, and nothing done, where rows are shorter than a register.
template <typename Isa, kernel Kernel, texel_format Texel>
bool filter_rows(image_view<const Texel> from, image_view<Texel> to, texel_rect region) noexcept {
    using pass = filter_of<Isa, Kernel, Texel>;
    using storage = typename Texel::storage;
    constexpr int channels = Texel::channels, margin = pass::margin, taps = 2 * Kernel::radius + 1;
    const int row_size = from.width() * channels;
    if (row_size < pass::step) return false;

    alignas(64) typename pass::element line[static_cast<std::size_t>(rows_at_once * pass::line_size)];
    Texel nothing[static_cast<std::size_t>((pass::strip + 2 * margin + pass::step + channels - 1) / channels)];
    const bool beyond = region.y0 < Kernel::radius || region.y1 > from.height() - Kernel::radius - rows_at_once;
    if (beyond)
        for (Texel& each : nothing) each = Texel::clear();

    for (int x0 = region.x0 * channels; x0 < region.x1 * channels; x0 += pass::strip) {
        const int x1 = lesser(x0 + pass::strip, region.x1 * channels);
        // The columns that are there, and enough of them for one register.
        const int last = greater(lesser(x1 + margin, row_size), pass::step);
        const int first = greater(lesser(x0 - margin, last - pass::step), 0);
        for (int y = region.y0; y < region.y1; y += rows_at_once) {
            const storage* rows[static_cast<std::size_t>(taps + rows_at_once)];
            for (int t = 0; t < taps + rows_at_once - 1; ++t) {
                const int row = y + t - Kernel::radius;
                rows[t] =
                    row >= 0 && row < from.height() ? channels_of(from.row(row)) + first : channels_of(nothing) + first % channels;
            }
            typename pass::element* const sums = line + pass::place(pass::step); // of the column x0 - margin
            pass::columns(rows, sums + pass::place(first - (x0 - margin)), last - first);
            for (int j = 0; j < lesser(rows_at_once, region.y1 - y); ++j) {
                typename pass::element* const here = sums + j * pass::line_size;
                pass::clear(here, 0, -(x0 - margin));
                const int end = x1 - x0 + 2 * margin; // and one texel more, which a pair of taps may read without a weight
                pass::clear(here, lesser(row_size - (x0 - margin), end), end + channels);
                storage* const out = channels_of(to.row(y + j)) + x0;
                for (int at = 0; at < x1 - x0; at += pass::step) {
                    if (x1 - x0 < pass::step) {
                        storage part[static_cast<std::size_t>(pass::step)];
                        pass::row(here, part);
                        std::memcpy(out, part, static_cast<std::size_t>(x1 - x0) * sizeof(storage));
                        break;
                    }
                    const int i = lesser(at, x1 - x0 - pass::step);
                    pass::row(here + pass::place(i), out + i);
                }
            }
        }
    }
    return true;
}

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
