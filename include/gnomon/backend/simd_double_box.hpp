// gnomon: soft shadow maps. The box filter in lanes, second part: sums that run in doubles and round nothing, of half and float, of codes
// where 32 bits are not enough, and of pairs of a ratio. Included by simd_box.hpp after simd_filter.hpp, and in its way.

#include <gnomon/backend/lane_formats.hpp>
#include <gnomon/filter/separable.hpp>
#include <gnomon/simd/region.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// Equal weights. Multiples of 2^-24 in [0, 1] are all halves there, and what opaque casters at float depths are stored as. Of (2R+1)^2
/// of them, or of codes, or products of two, a double holds any sum, for R up to 256, and a line's 36 bits hold those of 2R+1: so sums may
/// run, and have the bits of any other order.
template <typename Isa, kernel Kernel, texel_format Texel> struct double_box {
    using sum = double;
    using wide = wide_filter<Isa, Kernel, Texel, double>; // the same arithmetic, tap by tap
    using channel_type = typename Texel::channel_type;
    using storage = typename Texel::storage;
    using ints = typename Isa::ints;
    using floats = typename Isa::floats;
    using doubles = typename Isa::doubles;
    static constexpr int channels = Texel::channels, step = Isa::double_lanes;
    static constexpr int taps = 2 * Kernel::radius + 1, margin = Kernel::radius * channels, window = taps * channels;
    static constexpr int strip = piece_bytes / 8 / channels * channels;
    static constexpr int line_size = window + strip + step;

    /// Is a row what sums may run over?
    [[nodiscard]] static bool is_summable(const storage* row, int count) noexcept {
        if constexpr (channel_type::whole_codes)
            return true;
        else
            return is_of_parts(row, count);
    }
    /// Are they multiples of 2^-24?
    [[nodiscard]] static bool is_of_parts(const storage* row, int count) noexcept {
        constexpr int at_once = Isa::float_lanes;
        constexpr bool halves = sizeof(storage) == 2;
        ints least = Isa::repeat32(0), most = Isa::repeat32(0);
        bool other = false; // is any of them?
        int i = 0;
        for (; i + at_once <= count; i += at_once) {
            ints bits;
            if constexpr (halves) {
                bits = Isa::widen32(row + i);
            } else {
                bits = Isa::load(static_cast<const void*>(row + i));
                const floats scaled = Isa::multiply(Isa::template codes_of<channel_type, 1>(row + i, 0), Isa::repeat(0x1p24f));
                other |= Isa::any(Isa::greater(scaled, Isa::numbers(Isa::floor32(scaled))));
            }
            least = Isa::lesser32(least, bits);
            most = Isa::greater32(most, bits);
        }
        std::int32_t ends[static_cast<std::size_t>(2 * at_once)];
        Isa::store(ends, least);
        Isa::store(ends + at_once, most);
        for (const std::int32_t each : ends) other |= each < 0 || each > (halves ? 0x3C00 : 0x3F800000);
        for (; i < count; ++i) {
            const float code = channel_type::code(row[i]);
            const float scaled = std::bit_cast<std::uint32_t>(code) <= 0x3F800000 ? code * 0x1p24f : 0.5f;
            other |= scaled > static_cast<float>(static_cast<std::int32_t>(scaled));
        }
        return !other;
    }

    /// Adds a row to the sums of columns and takes one away.
    static void run(double* sums, const storage* in, const storage* out, int count) noexcept {
        int i = 0;
        for (; i + step <= count; i += step) {
            const auto change = Isa::subtract(wide::codes(in + i), wide::codes(out + i));
            Isa::store(sums + i, Isa::add(Isa::load(sums + i), change));
        }
        for (; i < count; ++i) sums[i] += linear(in, i) - linear(out, i);
    }

    /// A row of texels from the sums of columns, and a register more.
    void make(const double* sums, storage* to, int count) noexcept {
        slide(sums, count);
        for (int i = 0; i < count; i += step) {
            if constexpr (Texel::representation_type::premultiplied)
                Isa::template store_codes<channel_type>(to + i, mean(Isa::load(all_ + i)));
            else
                wide::store_ratios(all_ + i, to + i);
        }
    }

  private:
    /// A number of a row that begins with a whole texel, as it is filtered.
    [[nodiscard]] static double linear(const storage* row, int i) noexcept {
        return reinterpret_cast<const Texel*>(row)[i / channels].template linear<double>(i % channels);
    }
    GNOMON_LANES doubles mean(const doubles& sum) noexcept {
        if constexpr (channel_type::whole_codes)
            return wide::quotient(sum);
        else
            return Isa::divide(sum, Isa::repeat(detail::sums<Texel, Kernel>::whole));
    }
    /// The sums of windows: what comes in on the right goes out on the left.
    void slide(const double* sums, int count) noexcept {
        constexpr int chains = 4 * channels; // one addition waits for another
        double here[static_cast<std::size_t>(chains)]{};
        int first = 0;
        for (; first + chains <= window; first += chains) {
            GNOMON_UNROLL(16)
            for (int k = 0; k < chains; ++k) here[k] += sums[first + k];
        }
        for (; first < window; ++first) here[first % channels] += sums[first];
        for (int k = channels; k < chains; ++k) here[k % channels] += here[k];
        for (int i = 0; i < count; i += channels) {
            GNOMON_UNROLL(4)
            for (int c = 0; c < channels; ++c) {
                all_[i + c] = here[c];
                here[c] += sums[i + c + window] - sums[i + c];
            }
        }
    }

    alignas(64) double all_[static_cast<std::size_t>(strip + step)]{};
};

/// Can sums of this texel and kernel run in doubles, and is that quicker than tap by tap?
template <kernel Kernel, texel_format Texel>
inline constexpr bool runs_in_doubles = [] {
    using by = detail::sums<Texel, Kernel>;
    return detail::channel_of_lanes<typename Texel::channel_type> && !by::stored_between && !by::in_floats &&
           detail::is_box<typename by::weights_of> && Kernel::radius >= 8 && Kernel::radius <= 256;
}();

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
