// gnomon: soft shadow maps. Filter and clear only where something is: the same bits as the whole map, for a part of its cost.
#pragma once

#include <gnomon/filter/separable.hpp>
#include <gnomon/grid/regions.hpp>

namespace gnomon::inline GNOMON_BUILD {

/// Calls f(texel_rect) for what a filter of this kernel has to write. Where the grid was marked with a guard band narrower than
/// the kernel's radius, that is the whole map: slower, never wrong. (Then the whole result is to be cleared before the next
/// frame, too.)
template <kernel Kernel, typename F> void for_each_region_to_filter(const tile_grid& tiles, F&& f) {
    if (!tiles.empty() && tiles.guard() < Kernel::radius) return f(whole(tiles.size()));
    for_each_region(tiles, f);
}

/// Clears every texel of the marked tiles. Cost: their area.
template <texel_format Texel> void clear_tiles(image_view<Texel> texels, const tile_grid& tiles) noexcept {
    for_each_region(tiles, [&](texel_rect r) { texels.fill(r, Texel::clear()); });
}

} // namespace gnomon::inline GNOMON_BUILD
