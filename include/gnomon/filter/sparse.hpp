// gnomon: soft shadow maps. Filter and clear only where something is: the same bits as the whole map, for a part of its cost.
#pragma once

#include <gnomon/filter/separable.hpp>
#include <gnomon/grid/grown_regions.hpp>
#include <gnomon/grid/regions.hpp>

#include <cstdint>
#include <cstring>

namespace gnomon::inline GNOMON_BUILD {

/// Share of the map, in percent, from which on filtering all of it is cheaper than filtering parts. Measured, see bench/sparse.cpp.
inline constexpr int dense_from_percent = 90;

namespace detail {

/// Do parts cost so much of what the whole does that a filter takes it?
[[nodiscard]] constexpr bool is_dense(double parts, double whole) noexcept { return parts * 100 >= dense_from_percent * whole; }

/// What filtering a region costs, in texels of a large one. Where sums run, which must first be made, all that is read has its share;
/// so flat pieces within a wide radius cost many times their area. Measured with box<32> at 32, 256 and 1024 texels a side.
template <kernel Kernel> [[nodiscard]] constexpr double filter_cost(texel_rect r, bool sums_run) noexcept {
    const double width = r.width(), height = r.height(), around = 2.0 * Kernel::radius;
    if (!sums_run) return width * height;
    return 0.2 * (width + around) * (height + around) + 0.3 * (width + around) * height + 0.5 * width * height;
}

/// Texels of the rectangles that walk(f) hands out.
template <typename Walk> [[nodiscard]] std::int64_t texels_in(Walk&& walk) {
    std::int64_t texels = 0;
    walk([&texels](texel_rect r) { texels += std::int64_t{r.width()} * r.height(); });
    return texels;
}

} // namespace detail

/// What a filter of this kernel has to write: all texels within its radius of a mark, whatever the guard bands; or the whole map,
/// where that is cheaper, or asked for. Elsewhere its result is clear. The grid is looked at again by each call. `sums_run`: a box, by a
/// backend whose time does not know its radius.
template <kernel Kernel> class regions_to_filter {
  public:
    explicit regions_to_filter(const tile_grid& tiles, bool all = false, bool sums_run = false) noexcept : tiles_(tiles) {
        const auto cost = [sums_run](texel_rect r) { return detail::filter_cost<Kernel>(r, sums_run); };
        const double of_whole = cost(gnomon::whole(tiles.size()));
        // So many texels could they be at most; most frames are settled by that.
        const double side = 1.0 * tiles.tile() + 2 * Kernel::radius;
        const auto are_dense = [&] {
            if (!sums_run && !detail::is_dense(side * side * tiles.held_count(), of_whole)) return false;
            double parts = 0.0;
            (*this)([&](texel_rect r) { parts += cost(r); });
            return detail::is_dense(parts, of_whole);
        };
        whole_ = !tiles.size().empty() && (all || are_dense());
    }
    /// Is it the whole map?
    [[nodiscard]] bool all() const noexcept { return whole_; }
    /// Calls f(texel_rect) for disjoint rectangles.
    template <typename F> void operator()(F&& f) const {
        if (whole_)
            f(whole(tiles_.size()));
        else
            for_each_region_within(tiles_, Kernel::radius, f);
    }

  private:
    const tile_grid& tiles_;
    bool whole_ = false;
};

template <kernel Kernel, typename F> void for_each_region_to_filter(const tile_grid& tiles, F&& f) {
    regions_to_filter<Kernel>{tiles}(f);
}

/// Clears the texels of a rectangle on the map. Cost: its area, at the speed of memcpy.
template <texel_format Texel> void clear_region(image_view<Texel> texels, texel_rect r) noexcept {
    r = clip(r, texels.size());
    texels.fill({r.x0, r.y0, r.x1, r.y0 + 1}, Texel::clear());
    for (int y = r.y0 + 1; y < r.y1; ++y)
        std::memcpy(&texels(r.x0, y), &texels(r.x0, r.y0), static_cast<std::size_t>(r.width()) * sizeof(Texel));
}

/// Clears every texel of the marked tiles: all that a filter left there, if guard bands were as wide as its radius. Cost: their area.
template <texel_format Texel> void clear_tiles(image_view<Texel> texels, const tile_grid& tiles) noexcept {
    for_each_region(tiles, [&](texel_rect r) { clear_region(texels, r); });
}

/// Clears an image of casters: the tiles that hold a mark, guard bands not counted.
template <texel_format Texel> void clear_casters(image_view<Texel> casters, const tile_grid& tiles) noexcept {
    for_each_region_within(tiles, 0, [&](texel_rect r) { clear_region(casters, r); });
}

/// Clears, of an image that was filtered for `before`, what filtering it for `now` will not write; or all that was written for
/// `before`, if `now` has another size or tile.
template <kernel Kernel, texel_format Texel>
void clear_what_is_left(image_view<Texel> soft, const tile_grid& before, const tile_grid& now) noexcept {
    for_each_region_left(before, now, Kernel::radius, [&](texel_rect r) { clear_region(soft, r); });
}

} // namespace gnomon::inline GNOMON_BUILD
