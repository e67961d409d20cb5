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

/// Are regions of so many texels so much of the map that a filter takes it whole?
[[nodiscard]] constexpr bool is_dense(double texels, extent size) noexcept {
    return texels * 100 >= 1.0 * dense_from_percent * size.width * size.height;
}

/// Texels of the rectangles that walk(f) hands out.
template <typename Walk> [[nodiscard]] std::int64_t texels_in(Walk&& walk) {
    std::int64_t texels = 0;
    walk([&texels](texel_rect r) { texels += std::int64_t{r.width()} * r.height(); });
    return texels;
}

} // namespace detail

/// What a filter of this kernel has to write: all texels within its radius of a mark, whatever the guard bands; or the whole map,
/// where that is cheaper, or asked for. Elsewhere its result is clear. The grid is looked at again by each call.
template <kernel Kernel> class regions_to_filter {
  public:
    explicit regions_to_filter(const tile_grid& tiles, bool all = false) noexcept : tiles_(tiles) {
        // So many texels could they be at most; most frames are settled by that.
        const double side = 1.0 * tiles.tile() + 2 * Kernel::radius;
        whole_ = !tiles.size().empty() && (all || (detail::is_dense(side * side * tiles.held_count(), tiles.size()) &&
                                                   detail::is_dense(static_cast<double>(detail::texels_in(*this)), tiles.size())));
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
