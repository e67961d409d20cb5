// gnomon: soft shadow maps. Receiver culling: which receivers no caster can reach, and need no shadow code at all.
#pragma once

#include <gnomon/grid/depth_range.hpp>
#include <gnomon/receive/bias.hpp>

namespace gnomon::inline GNOMON_BUILD {

/// Could any caster shadow a receiver whose texels are `footprint` and whose depths are `depth`, under this bias?
///
/// False only if every point of it is lit: no marked tile touches it, or it lies before every caster of the tiles it touches. Only
/// towards light, and not the other way by a depth of its own, does the second settle it: any other bias may shadow what lies before
/// a caster. One texel is added on each side for the taps of a blended sample. An empty interval has unknown depth and is not culled
/// by it.
[[nodiscard]] inline bool casters_reach(const depth_tiles& tiles, texel_rect footprint, depth_interval depth = {},
                                        const bias& by = {}) noexcept {
    const texel_rect read = grow(footprint, 1);
    const bool keeps_light = by.towards == bias_towards::light && by.depth >= 0.0f;
    return depth.empty() || !keeps_light ? tiles.touches(read) : tiles.touches(read, depth.farthest);
}
[[nodiscard]] inline bool casters_reach(const tile_grid& tiles, texel_rect footprint) noexcept {
    return tiles.touches(grow(footprint, 1));
}

} // namespace gnomon::inline GNOMON_BUILD
