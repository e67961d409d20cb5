// gnomon: soft shadow maps. The filter in lanes. backend/simd.hpp includes it once for each target, inside its region, so there is
// no #pragma once: GNOMON_ON names the namespace it goes to; without it there is nothing.
//
// As in filter/separable.hpp columns come first, into a line, and the line goes into a row with one rounding; but four rows are
// summed at once, from the same loads. Strips are as wide as the region where there is room: processors fetch what a row goes on with
// by themselves, but not where the next row of a strip begins.

#include <gnomon/backend/simd_wide.hpp>
#include <gnomon/backend/simd_words.hpp>
#include <gnomon/backend/simd_small_box.hpp>
#include <gnomon/filter/separable.hpp>
#include <gnomon/simd/region.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// What lanes filter: premultiplied texels, and pairs of a ratio whose sums, of products of two codes, are exact in double; not by
/// `narrow`, but floats, which it leaves as they are, nor by what `fast` makes a single tap of in words.
template <kernel Kernel, texel_format Texel>
inline constexpr bool filtered_in_lanes = [] {
    using by = detail::sums<Texel, Kernel>;
    constexpr double total = by::weights_of::total;
    constexpr bool exact = Texel::channels == 2 && Texel::linear_scale * total * total < 0x1p53;
    constexpr bool as_wide = !detail::is_narrow<Kernel> || std::same_as<typename Texel::channel_type, float32>;
    constexpr bool known = Kernel::radius <= 256 && as_wide && !(by::stored_between && is_one_tap<typename by::weights_of>);
    return known && (Texel::representation_type::premultiplied || exact);
}();

/// What serves a texel and a kernel best. All give the same bits where several can.
template <typename Isa, kernel Kernel, texel_format Texel> consteval auto choose_filter() {
    using by = detail::sums<Texel, Kernel>;
    constexpr bool bytes = detail::premultiplied_bytes<Texel> && in_eight_bits<typename by::weights_of>;
    constexpr bool words = by::stored_between;
    if constexpr (is_small_box<Kernel, Texel>)
        return std::type_identity<small_box<Isa, Kernel, Texel>>{};
    else if constexpr ((bytes || words) && Texel::channels == 2)
        return std::type_identity<pair_filter<Isa, Kernel, Texel>>{};
    else if constexpr (bytes || words)
        return std::type_identity<word_filter<Isa, Kernel, Texel>>{};
    else
        return std::type_identity<wide_filter<Isa, Kernel, Texel, detail::lane_number<Texel, Kernel>>>{};
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

/// The caller's scratch in use: lines of sums for four rows, and a row of nothing for what lies off the map. What a line holds of the
/// first column that is summed begins on a cache line, and a register of what is before it can be read.
template <typename Pass, texel_format Texel> struct filter_room {
    using element = typename Pass::element;
    [[nodiscard]] static constexpr int whole_cache_lines(int elements) noexcept {
        constexpr int in_one = 64 / static_cast<int>(sizeof(element));
        return (elements + in_one - 1) / in_one * in_one;
    }
    static constexpr int before = whole_cache_lines(Pass::place(greater(Pass::margin, Pass::step)));
    /// Channels beside those of a strip: both margins, a register on either side, and a texel that a pair of taps may read without a
    /// weight.
    static constexpr int around = 2 * (Pass::margin + Pass::step) + Texel::channels;
    [[nodiscard]] static constexpr int plane_of(int strip) noexcept {
        return before + whole_cache_lines(Pass::place(strip + around));
    }
    [[nodiscard]] static constexpr std::size_t bytes(int strip) noexcept {
        return 63 + static_cast<std::size_t>(rows_at_once * Pass::planes * plane_of(strip)) * sizeof(element) +
               static_cast<std::size_t>(strip + around) * sizeof(typename Texel::storage);
    }

    /// As many texels of a row as there is room for: all, or a half, or a quarter ...
    [[nodiscard]] static constexpr int widest(std::size_t room, int width) noexcept {
        width = lesser(width, strip_bytes / static_cast<int>(sizeof(element)) / Texel::channels);
        while (width > 1 && bytes(width * Texel::channels) > room) width = (width + 1) / 2;
        return bytes(width * Texel::channels) > room ? 0 : width * Texel::channels;
    }

    int strip; ///< channels; 0 if there is no room for one texel
    int plane; ///< elements from one plane of a line to the next, or to the next line
    element* lines;

    filter_room(std::span<line_element<Texel>> scratch, int width) noexcept
        : strip(widest(scratch.size_bytes(), width)), plane(plane_of(strip)),
          lines(reinterpret_cast<element*>((reinterpret_cast<std::uintptr_t>(scratch.data()) + 63) / 64 * 64)) {}
    [[nodiscard]] element* line(int row) const noexcept { return lines + row * Pass::planes * plane + before; }
    [[nodiscard]] Texel* nothing() const noexcept { return reinterpret_cast<Texel*>(line(rows_at_once) - before); }
    void clear_nothing() const noexcept {
        for (int i = 0; i < (strip + around) / Texel::channels; ++i) nothing()[i] = Texel::clear();
    }
};

/// So many channels of a row out of a line by way of memory of its own: past the caches, or because a register would reach beyond it.
template <typename Isa, typename Pass, typename Storage>
void make_row(const typename Pass::element* line, int plane, Storage* to, int count, bool past_caches) noexcept {
    alignas(64) Storage made[static_cast<std::size_t>(Pass::piece + Pass::step)];
    for (int first = 0; first < count; first += Pass::piece) {
        const int channels = lesser(Pass::piece, count - first);
        for (int at = 0; at < channels; at += Pass::step) {
            const int i = greater(lesser(at, channels - Pass::step), 0);
            Pass::row(line + Pass::place(first + i), plane, made + i);
        }
        const auto bytes = static_cast<std::size_t>(channels) * sizeof(Storage);
        if (past_caches)
            stream<Isa>(to + first, made, bytes);
        else
            std::memcpy(to + first, made, bytes);
    }
}

/// So many channels of some rows out of the lines that `line` begins, a register of each row in turn.
template <typename Isa, typename Pass, typename Storage>
void make_rows(const typename Pass::element* line, int plane, Storage* const* to, int rows, int count, bool past_caches) noexcept {
    const auto line_of = [&](int row) { return line + row * Pass::planes * plane; };
    if (past_caches || count < Pass::step) {
        for (int j = 0; j < rows; ++j) make_row<Isa, Pass>(line_of(j), plane, to[j], count, past_caches);
        return;
    }
    for (int at = 0; at < count; at += Pass::step) {
        const int i = lesser(at, count - Pass::step);
        for (int j = 0; j < rows; ++j) Pass::row(line_of(j) + Pass::place(i), plane, to[j] + i);
    }
}

/// filter_region in lanes, for a region within both images. False, and nothing done, where rows are shorter than a register or the
/// scratch has no room for a strip of one texel.
template <typename Isa, kernel Kernel, texel_format Texel>
bool filter_rows(image_view<const Texel> from, image_view<Texel> to, texel_rect region,
                 std::span<line_element<Texel>> scratch) noexcept {
    using pass = filter_of<Isa, Kernel, Texel>;
    using storage = typename Texel::storage;
    constexpr int channels = Texel::channels, margin = pass::margin;
    constexpr int rows_summed =
        2 * Kernel::radius + rows_at_once; // and a few more are told, to those that take them by twos and fours
    const int row_size = from.width() * channels;
    const filter_room<pass, Texel> room(scratch, region.width());
    if (row_size < pass::step || room.strip == 0) return false;
    const auto bytes_of = [](int width, int height) { return std::int64_t{width} * height * std::int64_t{sizeof(Texel)}; };
    // Rows of a region narrower than the map are soon over, and no processor foresees where the next ones begin.
    const bool narrow = region.width() < from.width();
    const bool prefetched = bytes_of(from.width(), from.height()) >= (narrow ? prefetched_bytes / 4 : prefetched_bytes);
    // Whole rows may be one band of many.
    const bool past_caches = bytes_of(region.width(), narrow ? region.height() : from.height()) >= streamed_bytes;
    if (region.y0 < Kernel::radius || region.y1 > from.height() - Kernel::radius - 2 * rows_at_once) room.clear_nothing();
    for (int x0 = region.x0 * channels; x0 < region.x1 * channels; x0 += room.strip) {
        const int x1 = lesser(x0 + room.strip, region.x1 * channels), left = x0 - margin, right = x1 + margin;
        // The columns that are there, and enough of them for one register.
        const int last = greater(lesser(right, row_size), pass::step);
        const int first = greater(lesser(left, last - pass::step), 0);
        const auto sums = [&](int row) { return room.line(row) + pass::place(left - first); }; // of the column `left`
        for (int j = 0; j < rows_at_once; ++j) { // stays clear: what is summed lies between
            pass::clear(sums(j), room.plane, 0, -left);
            pass::clear(sums(j), room.plane, lesser(row_size, right) - left,
                        greater(right - left, pass::step + 2 * margin) + channels); // all that one register reads
        }
        for (int y = region.y0; y < region.y1; y += rows_at_once) {
            const storage* rows[static_cast<std::size_t>(rows_summed + rows_at_once)];
            for (int t = 0; t < rows_summed + rows_at_once; ++t) {
                const int row = y + t - Kernel::radius;
                const bool there = row >= 0 && row < from.height();
                rows[t] = there ? channels_of(from.row(row)) + first : channels_of(room.nothing()) + first % channels;
            }
            pass::columns(rows, prefetched ? rows + rows_summed : nullptr, room.line(0), room.plane, last - first);
            storage* out[static_cast<std::size_t>(rows_at_once)];
            const int count = lesser(rows_at_once, region.y1 - y);
            for (int j = 0; j < count; ++j) out[j] = channels_of(to.row(y + j)) + x0;
            make_rows<Isa, pass>(sums(0), room.plane, out, count, x1 - x0, past_caches);
        }
    }
    if (past_caches) Isa::fence();
    return true;
}

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
