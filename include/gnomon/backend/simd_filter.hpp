// gnomon: soft shadow maps. The filter in lanes. backend/simd.hpp includes it once for each target, inside its region, so there is
// no #pragma once: GNOMON_ON names the namespace it goes to; without it there is nothing.
//
// As in filter/separable.hpp columns come first, into a line, and the line goes into a row with one rounding; but four rows are
// summed at once, from the same loads, and a region is cut into strips whose lines stay in the first cache.

#include <gnomon/backend/simd_wide.hpp>
#include <gnomon/backend/simd_words.hpp>
#include <gnomon/filter/separable.hpp>
#include <gnomon/simd/region.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// What lanes filter: premultiplied texels, and pairs of a ratio whose sums, of products of two codes, are exact in double.
template <kernel Kernel, texel_format Texel>
inline constexpr bool filtered_in_lanes = [] {
    constexpr double total = detail::sums<Texel, Kernel>::weights_of::total;
    constexpr bool exact = Texel::channels == 2 && Texel::linear_scale * total * total < 0x1p53;
    return Kernel::radius <= 256 && !detail::is_narrow<Kernel> && (Texel::representation_type::premultiplied || exact);
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
