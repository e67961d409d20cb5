// gnomon: soft shadow maps. A tile grid that also knows how near to the light the casters of each tile come.
#pragma once

#include <gnomon/grid/tile_grid.hpp>

namespace gnomon::inline GNOMON_BUILD {

/// A tile grid with the depth interval of the casters whose shadow may lie in each tile.
///
/// It lets a receiver be skipped that lies under casters' tiles but before every caster in them. Marks go through this class
/// alone, so that an interval is never older than its bit; `clear` touches no interval.
class depth_tiles {
  public:
    depth_tiles() = default;
    depth_tiles(extent size, int tile)
        : tiles_(size, tile), depths_(static_cast<std::size_t>(tiles_.columns()) * static_cast<std::size_t>(tiles_.rows())) {}

    [[nodiscard]] const tile_grid& tiles() const noexcept { return tiles_; }
    operator const tile_grid&() const noexcept { return tiles_; }

    /// Marks `r` with its guard band as holding casters in `depth`. An empty interval could be anywhere, so it counts as [0, 1].
    void mark(texel_rect r, depth_interval depth, int guard = 0) noexcept {
        if (depth.empty()) depth = {0.0f, 1.0f};
        const tile_rect t = tiles_.tiles_of(grow(r, guard));
        for (int y = t.y0; y < t.y1; ++y)
            for (int x = t.x0; x < t.x1; ++x) {
                if (!tiles_.test(x, y)) at(x, y) = {};
                at(x, y).include(depth);
            }
        tiles_.mark(r, guard);
    }

    /// Depths of the casters around one tile; empty if it is not marked. \pre the tile lies in the grid
    [[nodiscard]] depth_interval depth(int column, int row) const noexcept {
        return tiles_.test(column, row) ? depths_[index(column, row)] : depth_interval{};
    }

    /// Does `r` touch a marked tile?
    [[nodiscard]] bool touches(texel_rect r) const noexcept { return tiles_.touches(r); }
    /// Could a caster of a tile that `r` touches be nearer to the light than `z`? NaN: no.
    [[nodiscard]] bool touches(texel_rect r, float z) const noexcept {
        const tile_rect t = tiles_.tiles_of(intersection(r, tiles_.bounds()));
        for (int y = t.y0; y < t.y1; ++y)
            for (int x = tiles_.row(y).next_set(t.x0); x < t.x1; x = tiles_.row(y).next_set(x + 1))
                if (depths_[index(x, y)].nearest < z) return true;
        return false;
    }

    void clear() noexcept { tiles_.clear(); }

  private:
    [[nodiscard]] std::size_t index(int column, int row) const noexcept {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(tiles_.columns()) + static_cast<std::size_t>(column);
    }
    [[nodiscard]] depth_interval& at(int column, int row) noexcept { return depths_[index(column, row)]; }

    tile_grid tiles_;
    std::vector<depth_interval> depths_;
};

} // namespace gnomon::inline GNOMON_BUILD
