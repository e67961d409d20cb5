// gnomon: soft shadow maps. The compatibility setting: the 32 x 32 grid of the technique's production engine, to the bit.
#pragma once

#include <gnomon/grid/regions.hpp>

#include <array>

namespace gnomon::inline GNOMON_BUILD {

/// A rectangle with real sides, in texels: what the reference engine's casters and receivers are.
struct real_rect {
    double x0 = 0.0;
    double y0 = 0.0;
    double x1 = 0.0;
    double y1 = 0.0;
};

/// The grid of Cube 2: Sauerbraten: always 32 x 32 tiles, whatever the map. Use tile_grid unless you must match that engine.
///
/// What it does otherwise than tile_grid, and why tile_grid does not: a caster off the map is dropped *before* its penumbra is
/// added, so soft edges pop in at the border; the last tile of a span is inclusive, so an edge on a tile border marks one tile
/// too many; a receiver off the map is pulled to the edge tiles; the filter reaches 2R texels and a margin is added. A rectangle
/// with a NaN side or an inverted one is rejected, and every rectangle on an empty map; the engine has no rule for them.
class reference_grid {
  public:
    static constexpr int side = 32;
    /// Texels at the map's edge that the engine never writes.
    static constexpr int border = 2;
    /// The largest radius and the largest margin; more counts as this.
    static constexpr int most = 1 << 20;

    /// `radius` is the engine's blur setting R; the blur reaches 2R texels. `margin` widens the guard; the engine uses 2.
    reference_grid(extent map, int radius, int margin = 2)
        : map_(map), reach_(2 * lesser(greater(radius, 0), most)), guard_(reach_ + lesser(greater(margin, 0), most)),
          tiles_({side, side}, 1) {}

    /// Marks a caster; false if it lies wholly off the map.
    bool cast(real_rect r) noexcept {
        if (!(r.x0 <= r.x1) || !(r.y0 <= r.y1) || map_.empty()) return false;
        if (r.x1 <= 0.0 || r.y1 <= 0.0 || r.x0 >= map_.width || r.y0 >= map_.height) return false;
        const real_rect inside{greater(r.x0, 0.0), greater(r.y0, 0.0), lesser(r.x1, 1.0 * map_.width),
                               lesser(r.y1, 1.0 * map_.height)};
        if (!any_) box_ = inside;
        any_ = true;
        box_ = {lesser(box_.x0, inside.x0), lesser(box_.y0, inside.y0), greater(box_.x1, inside.x1), greater(box_.y1, inside.y1)};
        const tile_rect t = span_of({r.x0 - guard_, r.y0 - guard_, r.x1 + guard_, r.y1 + guard_});
        tiles_.mark({t.x0, t.y0, t.x1, t.y1});
        return true;
    }

    /// May the rectangle of a receiver lie in shadow?
    [[nodiscard]] bool receives(real_rect r) const noexcept {
        if (!any_ || !(r.x0 <= r.x1) || !(r.y0 <= r.y1)) return false;
        if (!(r.x1 >= box_.x0 - guard_ && r.y1 >= box_.y0 - guard_ && r.x0 <= box_.x1 + guard_ && r.y0 <= box_.y1 + guard_))
            return false;
        const tile_rect t = span_of(r);
        return tiles_.touches({t.x0, t.y0, t.x1, t.y1});
    }

    /// One row of tiles; bit 0 is the leftmost, row 0 the lowest. \pre 0 <= y < 32
    [[nodiscard]] std::uint32_t row(int y) const noexcept { return static_cast<std::uint32_t>(tiles_.row(y).words[0]); }

    /// Calls f(tile_rect) in the engine's order of emission. A union box without area makes it blur the whole map.
    template <typename F> void for_each_tile_rect(F&& f) const {
        if (!any_) return;
        if (!(box_.x0 < box_.x1 && box_.y0 < box_.y1)) {
            f(tile_rect{0, 0, side, side});
            return;
        }
        std::array<bit_word, side> scratch{};
        for_each_tile_rect_greedy(tiles_, scratch, f);
    }

    /// The texels one blur pass may write; empty without casters.
    [[nodiscard]] texel_rect blur_scissor() const noexcept {
        if (!any_) return {};
        const texel_rect box{detail::floor_to_int(box_.x0), detail::floor_to_int(box_.y0), detail::ceil_to_int(box_.x1),
                             detail::ceil_to_int(box_.y1)};
        return intersection({box.x0 - reach_, box.y0 - reach_, box.x1 + reach_, box.y1 + reach_},
                            {border, border, map_.width - border, map_.height - border});
    }

    [[nodiscard]] const tile_grid& tiles() const noexcept { return tiles_; }

    void clear() noexcept {
        tiles_.clear();
        any_ = false;
    }

  private:
    /// Divided by the tile size, truncated, clamped to the grid, both ends inclusive.
    [[nodiscard]] tile_rect span_of(real_rect r) const noexcept {
        const auto tile = [](double edge, int texels) {
            return lesser(greater(static_cast<int>(detail::within_reach(edge * side / texels)), 0), side - 1);
        };
        return {tile(r.x0, map_.width), tile(r.y0, map_.height), tile(r.x1, map_.width) + 1, tile(r.y1, map_.height) + 1};
    }

    extent map_;
    int reach_;
    int guard_;
    tile_grid tiles_;
    real_rect box_{}; ///< of the casters, if there are any
    bool any_ = false;
};

} // namespace gnomon::inline GNOMON_BUILD
