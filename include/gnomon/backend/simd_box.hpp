// gnomon: soft shadow maps. The box filter in lanes, whose cost does not know its radius. backend/simd.hpp includes it once for each
// target, inside its region, so there is no #pragma once: GNOMON_ON names the namespace it goes to; without it there is nothing.
//
// Down the columns a sum runs: from row to row one code comes in and one goes out. Across them it is the difference of two sums from
// the left end, which a register makes in a few steps. All in whole numbers modulo 2^32, so that nothing drifts.

#include <gnomon/backend/simd_double_box.hpp>
#include <gnomon/filter/separable.hpp>
#include <gnomon/simd/region.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// Whole codes under equal weights.
template <typename Isa, kernel Kernel, texel_format Texel> struct box_filter {
    using sum = std::uint32_t;
    using mean = mean_of<Kernel, Texel, 32>;
    using storage = typename Texel::storage;
    using ints = typename Isa::ints;
    static constexpr int channels = Texel::channels, step = Isa::float_lanes;
    static constexpr int margin = Kernel::radius * channels, window = Kernel::total * channels;
    static constexpr int strip = piece_bytes / 4 / channels * channels;
    static constexpr int line_size = window + strip + 2 * step;

    box_filter() noexcept {
        for (int i = 0; i < step; ++i) all_[i] = 0;
    }

    [[nodiscard]] static bool is_summable(const storage*, int) noexcept { return true; }

    /// Adds a row to the sums of columns and takes one away.
    static void run(std::uint32_t* sums, const storage* in, const storage* out, int count) noexcept {
        int i = 0;
        for (; i + step <= count; i += step)
            Isa::store(sums + i, Isa::add32(Isa::load(sums + i), Isa::subtract32(Isa::widen32(in + i), Isa::widen32(out + i))));
        for (; i < count; ++i) sums[i] += std::uint32_t{in[i]} - out[i];
    }

    /// A row of texels from the sums of columns, and a register more: rounded means of windows, which are what lies between their ends.
    void make(const std::uint32_t* sums, storage* to, int count) noexcept {
        accumulate(sums, window - channels + count);
        const std::uint32_t* const first = all_ + step - channels;
        const ints half = Isa::repeat32(static_cast<std::uint32_t>(Kernel::total) * Kernel::total / 2);
        const ints factor = Isa::repeat32(static_cast<std::uint32_t>(mean::factor));
        for (int i = 0; i < count; i += step) {
            const ints sum_of_window = Isa::subtract32(Isa::load(first + window + i), Isa::load(first + i));
            Isa::store_low(to + i, Isa::template multiply_shift32<mean::shift>(Isa::add32(sum_of_window, half), factor));
        }
    }

  private:
    /// Each sum and all before it of its channel.
    void accumulate(const std::uint32_t* sums, int count) noexcept {
        ints before = Isa::repeat32(0);
        for (int i = 0; i < count; i += step) {
            const ints here = added<channels>(Isa::load(sums + i)), all = Isa::add32(here, before);
            Isa::store(all_ + step + i, all);
            if constexpr (step % channels == 0) // what the next register waits for is one addition
                before = Isa::add32(before, Isa::template repeat_last32<channels>(here));
            else
                before = Isa::template repeat_last32<channels>(all);
        }
    }

    /// What stands `Places`, twice, four times as many places before, added in.
    template <int Places> GNOMON_LANES ints added(ints a) noexcept {
        if constexpr (Places < step)
            return added<2 * Places>(Isa::add32(a, Isa::template shift_up32<Places>(a)));
        else
            return a;
    }

    alignas(64) std::uint32_t all_[static_cast<std::size_t>(step + line_size)]; // from a register of zeros on
};

/// Can lanes run sums of this texel and kernel? A kernel of one tap is as quick without, and a small box quicker.
template <kernel Kernel, texel_format Texel>
inline constexpr bool runs_sums = [] {
    if constexpr (Texel::channel_type::whole_codes && Texel::representation_type::premultiplied && Kernel::radius > 0 &&
                  !is_small_box<Kernel, Texel> && detail::is_box<typename detail::sums<Texel, Kernel>::weights_of>)
        return mean_of<Kernel, Texel, 32>::exact;
    else
        return false;
}();

/// Do they, in whole numbers or in doubles?
template <kernel Kernel, texel_format Texel>
inline constexpr bool sums_of_box_run =
    filtered_in_lanes<Kernel, Texel> && (runs_sums<Kernel, Texel> || runs_in_doubles<Kernel, Texel>);

/// filter_region for a box whose sums run, for a region within both images. False, with part of it written, where a row is not summable.
template <typename Box, kernel Kernel, texel_format Texel>
bool filter_box(image_view<const Texel> from, image_view<Texel> to, texel_rect region) noexcept {
    using storage = typename Texel::storage;
    constexpr int channels = Texel::channels, radius = Kernel::radius;
    const int row_size = from.width() * channels;
    const int widest = lesser(Box::strip, region.width() * channels) + Box::window + Box::step; // that is read of a row of sums

    Box box;
    alignas(64) typename Box::sum sums[static_cast<std::size_t>(Box::line_size)];
    alignas(64) storage made[static_cast<std::size_t>(Box::strip + Box::step)];
    Texel nothing[static_cast<std::size_t>(Box::line_size / channels + 1)];
    for (int i = 0; i <= widest / channels; ++i) nothing[i] = Texel::clear();

    for (int x0 = region.x0 * channels; x0 < region.x1 * channels; x0 += Box::strip) {
        const int x1 = lesser(x0 + Box::strip, region.x1 * channels), left = x0 - Box::margin, right = x1 + Box::margin;
        const int first = greater(left, 0), last = greater(lesser(right, row_size), first); // the columns that are there
        const auto row = [&](int y) {
            return y >= 0 && y < from.height() ? channels_of(from.row(y)) + first : channels_of(nothing);
        };
        const auto step_to = [&](int y, const storage* out) {
            if (!Box::is_summable(row(y), last - first)) return false;
            Box::run(sums + (first - left), row(y), out, last - first);
            return true;
        };
        // What a column of clear sums to; then row by row what is there in its place, but for the last row of the first window.
        using sum = typename Box::sum;
        for (int i = 0; i < widest; ++i)
            sums[i] = static_cast<sum>(Kernel::total) * Texel::clear().template linear<sum>(i % channels);
        for (int y = region.y0 - radius; y < region.y0 + radius; ++y)
            if (!step_to(y, channels_of(nothing))) return false;
        for (int y = region.y0; y < region.y1; ++y) {
            if (!step_to(y + radius, y == region.y0 ? channels_of(nothing) : row(y - radius - 1))) return false;
            box.make(sums, made, x1 - x0);
            std::memcpy(channels_of(to.row(y)) + x0, made, static_cast<std::size_t>(x1 - x0) * sizeof(storage));
        }
    }
    return true;
}

/// filter_region in lanes, for a region within both images. False, and nothing done, without a scratch, which boxes can do without
/// but `scalar` cannot; where a row with what is read beside it has more channels than an int counts; and where filter_rows says so.
template <typename Isa, kernel Kernel, texel_format Texel>
bool filter(image_view<const Texel> from, image_view<Texel> to, texel_rect region,
            std::span<line_element<Texel>> scratch) noexcept {
    constexpr int widest = (detail::int_max - 4 * strip_bytes) / Texel::channels - 4 * Kernel::radius;
    if (from.width() > widest) return false;
    if constexpr (runs_sums<Kernel, Texel>) {
        if (scratch.empty()) return false;
        return filter_box<box_filter<Isa, Kernel, Texel>, Kernel>(from, to, region);
    } else {
        if constexpr (runs_in_doubles<Kernel, Texel>)
            if (!scratch.empty() && filter_box<double_box<Isa, Kernel, Texel>, Kernel>(from, to, region)) return true;
        return filter_rows<Isa, Kernel, Texel>(from, to, region, scratch);
    }
}

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
