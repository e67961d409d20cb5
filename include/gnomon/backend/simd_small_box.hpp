// gnomon: soft shadow maps. The box filter in lanes, third part: boxes so small that their taps are summed sooner than sums run.
// Included by simd_filter.hpp after simd_wide.hpp, and in its way.

#include <gnomon/filter/separable.hpp>
#include <gnomon/simd/region.hpp>

#include <bit>
#include <concepts>
#include <cstdint>
#include <type_traits>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// sum / Divisor to nearest, halves upwards, for sums up to Divisor * codes, in lanes of so many bits: times 2^shift / Divisor rounded up.
/// That is right as long as what rounding up adds, at most sum * excess / 2^shift / Divisor, stays below one of the steps of 1 / Divisor.
template <std::uint64_t Divisor, std::uint64_t Codes, int Bits> struct division {
    static constexpr std::uint64_t largest = Divisor * Codes + Divisor / 2, one = 1;
    static constexpr int shift = Bits - 1 + std::bit_width(Divisor);
    static constexpr std::uint64_t factor = ((one << shift) + Divisor - 1) / Divisor;
    static constexpr std::uint64_t excess = factor * Divisor - (one << shift);
    static constexpr bool exact = largest < (one << Bits) && factor < (one << Bits) && excess * largest < (one << shift);
};

/// The sum of a window, divided by its weight, in lanes of so many bits.
template <kernel Kernel, texel_format Texel, int Bits>
using mean_of =
    division<std::uint64_t{Kernel::total} * Kernel::total, static_cast<std::uint64_t>(Texel::channel_type::scale), Bits>;

/// Whole codes under equal weights, bytes in lanes of 16 bits, words in lanes of 32: down the columns a sum goes on from row to row of the
/// four, along the row its taps are added one by one.
template <typename Isa, kernel Kernel, texel_format Texel> struct small_box {
    using storage = typename Texel::storage;
    using ints = typename Isa::ints;
    static constexpr bool bytes = sizeof(storage) == 1;
    using element = std::conditional_t<bytes, std::uint16_t, std::uint32_t>;
    using mean = mean_of<Kernel, Texel, 8 * static_cast<int>(sizeof(element))>;
    static_assert(mean::exact);

    static constexpr int taps = 2 * Kernel::radius + 1, margin = Kernel::radius * Texel::channels;
    static constexpr int step = Isa::bytes / static_cast<int>(sizeof(storage)); ///< codes in a register
    static constexpr int planes = 1, piece = piece_bytes / 4 / Texel::channels * Texel::channels;
    [[nodiscard]] static constexpr int place(int i) noexcept { return i; }

    static void columns(const storage* const* rows, const storage* const* ahead, element* line, int plane, int count) noexcept {
        for (int at = 0; at < count; at += step) {
            const int i = lesser(at, count - step);
            call_for<Isa>(ahead, i);
            ints low = Isa::repeat32(0), high = low;
            GNOMON_UNROLL(8)
            for (int t = 0; t < taps - 1; ++t) add_codes(rows[t] + i, low, high);
            GNOMON_UNROLL(4)
            for (int j = 0; j < rows_at_once; ++j) {
                add_codes(rows[j + taps - 1] + i, low, high);
                Isa::store(line + j * plane + i, Isa::first_half(low, high));
                Isa::store(line + j * plane + i + step / 2, Isa::second_half(low, high));
                const ints codes = Isa::load(rows[j] + i);
                low = subtract(low, lower(codes));
                high = subtract(high, upper(codes));
            }
        }
    }

    static void clear(element* line, int, int first, int last) noexcept {
        for (int i = first; i < last; ++i)
            line[i] = static_cast<element>(Kernel::total * int{Texel::clear().stored[i % Texel::channels]});
    }

    GNOMON_LANES_VOID void row(const element* line, int, storage* to) noexcept {
        const ints first = quotient(sum_row(line)), second = quotient(sum_row(line + step / 2));
        if constexpr (bytes) {
            Isa::store(to, Isa::narrow16(first, second));
        } else {
            Isa::store_low(to, first);
            Isa::store_low(to + step / 2, second);
        }
    }

  private:
    GNOMON_LANES ints lower(ints codes) noexcept {
        if constexpr (bytes)
            return Isa::low_pairs8(codes, Isa::repeat32(0));
        else
            return Isa::low_pairs16(codes, Isa::repeat32(0));
    }
    GNOMON_LANES ints upper(ints codes) noexcept {
        if constexpr (bytes)
            return Isa::high_pairs8(codes, Isa::repeat32(0));
        else
            return Isa::high_pairs16(codes, Isa::repeat32(0));
    }
    GNOMON_LANES ints add(ints a, ints b) noexcept {
        if constexpr (bytes)
            return Isa::add16(a, b);
        else
            return Isa::add32(a, b);
    }
    GNOMON_LANES ints subtract(ints a, ints b) noexcept {
        if constexpr (bytes)
            return Isa::subtract16(a, b);
        else
            return Isa::subtract32(a, b);
    }
    GNOMON_LANES_VOID void add_codes(const storage* from, ints& low, ints& high) noexcept {
        const ints codes = Isa::load(from);
        low = add(low, lower(codes));
        high = add(high, upper(codes));
    }

    /// A register of windows, with the half that rounds them.
    GNOMON_LANES ints sum_row(const element* line) noexcept {
        constexpr std::uint32_t half = static_cast<std::uint32_t>(Kernel::total) * Kernel::total / 2;
        ints sum = Isa::repeat32(bytes ? half << 16 | half : half);
        GNOMON_UNROLL(8)
        for (int t = 0; t < taps; ++t) sum = add(sum, Isa::load(line + t * Texel::channels));
        return sum;
    }
    GNOMON_LANES ints quotient(ints sum) noexcept {
        constexpr auto factor = static_cast<std::uint32_t>(mean::factor);
        if constexpr (bytes)
            return Isa::template shift_right16<mean::shift - 16>(Isa::multiply_high16(sum, Isa::repeat32(factor << 16 | factor)));
        else
            return Isa::template multiply_shift32<mean::shift>(sum, Isa::repeat32(factor));
    }
};

/// Is this a box that small? Of bytes as far as a sum has 16 bits, of words the last radius that was quicker so.
template <kernel Kernel, texel_format Texel>
inline constexpr bool is_small_box = [] {
    using channel = typename Texel::channel_type;
    constexpr int widest = std::same_as<channel, unorm8> ? 7 : std::same_as<channel, unorm16> ? 4 : 0;
    return Texel::representation_type::premultiplied && Kernel::radius > 0 && Kernel::radius <= widest &&
           detail::is_box<typename detail::sums<Texel, Kernel>::weights_of>;
}();

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
