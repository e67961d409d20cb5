// A program of marks, dilations, clears and questions, run on the grids and on one bool a tile in 64-bit arithmetic.
#include "bytes.hpp"

#include <gnomon/grid/depth_range.hpp>
#include <gnomon/grid/reference_grid.hpp>
#include <gnomon/grid/regions.hpp>

#include <algorithm>
#include <vector>

using namespace gnomon;
using fuzz::demand;

namespace {

constexpr int lowest = -2147483647 - 1, highest = 2147483647;
constexpr int most_columns = 140, most_rows = 20;

/// A whole map: how many tiles of which size, and how much narrower the last ones are.
struct shape {
    extent size;
    int tile;

    explicit shape(fuzz::bytes& in) : size{}, tile(in.one_of({1, 2, 3, 7, 8, 32, 1 << 20, 1 << 24, highest})) {
        size = {side(in, most_columns), side(in, most_rows)};
    }

  private:
    int side(fuzz::bytes& in, int most) const {
        const std::int64_t tiles = in.within(0, most), cut = in.within(0, 7) % tile, texels = tiles * tile - cut;
        return static_cast<int>(std::clamp<std::int64_t>(texels, -1, highest));
    }
};

/// A coordinate on the map, on the border of a tile or beside it, or where arithmetic overflows.
int coordinate(fuzz::bytes& in, int side, int tile) {
    const int kind = in.within(0, 7);
    if (kind < 3) return in.within(-3, 250);
    if (kind < 6) {
        const std::int64_t border = std::int64_t{in.within(-2, most_columns + 2)} * tile + in.within(-1, 1);
        return static_cast<int>(std::clamp<std::int64_t>(border, lowest, highest));
    }
    if (kind == 6) return side - in.within(0, 2);
    return in.one_of({lowest, lowest + 1, -(1 << 30), -1, 0, 1 << 30, highest - 1, highest});
}
texel_rect rect(fuzz::bytes& in, const shape& s) {
    const int x0 = coordinate(in, s.size.width, s.tile), y0 = coordinate(in, s.size.height, s.tile);
    return {x0, y0, coordinate(in, s.size.width, s.tile), coordinate(in, s.size.height, s.tile)};
}
int guard_band(fuzz::bytes& in) { return in.flip() ? in.within(-1, 40) : in.one_of({lowest, -1, 0, 1 << 30, highest}); }

/// The sets of tiles and texels by their definitions.
class oracle {
  public:
    explicit oracle(const shape& s)
        : width_(greater(s.size.width, 0)), height_(greater(s.size.height, 0)), tile_(s.tile),
          columns(static_cast<int>((width_ + tile_ - 1) / tile_)), rows(static_cast<int>((height_ + tile_ - 1) / tile_)),
          set_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)), depth_(set_.size()) {}

    /// Sides in 64 bits, cut to the map.
    struct area {
        std::int64_t x0, y0, x1, y1;
        [[nodiscard]] bool empty() const { return x0 >= x1 || y0 >= y1; }
        friend bool operator==(const area&, const area&) = default;
    };
    [[nodiscard]] area grown(texel_rect r, std::int64_t by) const {
        if (r.empty()) return {0, 0, 0, 0};
        by = std::max<std::int64_t>(by, 0);
        const area a{std::max<std::int64_t>(r.x0 - by, 0), std::max<std::int64_t>(r.y0 - by, 0), std::min(r.x1 + by, width_),
                     std::min(r.y1 + by, height_)};
        return a.empty() ? area{0, 0, 0, 0} : a;
    }

    void mark(texel_rect r, std::int64_t guard, depth_interval depth) {
        const area a = grown(r, guard);
        if (a.empty()) return;
        for_each_tile_of(a, [&](int column, int row) {
            depth_interval& here = depth_[index(column, row)];
            here = set_[index(column, row)]
                       ? depth_interval{std::min(here.nearest, depth.nearest), std::max(here.farthest, depth.farthest)}
                       : depth;
            set_[index(column, row)] = true;
        });
        box_ = box_.empty()
                   ? a
                   : area{std::min(box_.x0, a.x0), std::min(box_.y0, a.y0), std::max(box_.x1, a.x1), std::max(box_.y1, a.y1)};
        guard_ = std::min(guard_, std::max<std::int64_t>(guard, 0));
    }
    void dilate(std::int64_t tiles) {
        if (box_.empty() || tiles <= 0) return;
        const std::vector<bool> before = set_;
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) {
                if (!before[index(column, row)]) continue;
                const auto reach = [tiles](int at, int all) {
                    return std::pair(static_cast<int>(std::max<std::int64_t>(at - tiles, 0)),
                                     static_cast<int>(std::min<std::int64_t>(at + tiles, all - 1)));
                };
                const auto [x0, x1] = reach(column, columns);
                const auto [y0, y1] = reach(row, rows);
                for (int y = y0; y <= y1; ++y)
                    for (int x = x0; x <= x1; ++x) set_[index(x, y)] = true;
            }
        const std::int64_t texels = std::min<std::int64_t>(tiles * tile_, highest);
        box_ = {std::max<std::int64_t>(box_.x0 - texels, 0), std::max<std::int64_t>(box_.y0 - texels, 0),
                std::min(box_.x1 + texels, width_), std::min(box_.y1 + texels, height_)};
        guard_ = std::min<std::int64_t>(guard_ + texels, highest);
    }
    void clear() {
        std::fill(set_.begin(), set_.end(), false);
        box_ = {0, 0, 0, 0};
        guard_ = highest;
    }

    [[nodiscard]] bool test(int column, int row) const { return set_[index(column, row)]; }
    [[nodiscard]] depth_interval depth(int column, int row) const { return depth_[index(column, row)]; }
    /// Does `r`, cut to the union of all marks, touch a tile that is set and of which `wanted` holds?
    template <typename Wanted> [[nodiscard]] bool touches(texel_rect r, Wanted&& wanted) const {
        area a = grown(r, 0);
        a = {std::max(a.x0, box_.x0), std::max(a.y0, box_.y0), std::min(a.x1, box_.x1), std::min(a.y1, box_.y1)};
        bool found = false;
        if (!a.empty())
            for_each_tile_of(a, [&](int column, int row) { found = found || (test(column, row) && wanted(column, row)); });
        return found;
    }
    [[nodiscard]] bool agrees_on_marks(const tile_grid& grid) const {
        const texel_rect b = grid.bounds();
        return area{b.x0, b.y0, b.x1, b.y1} == box_ && grid.guard() == guard_ && grid.empty() == box_.empty();
    }
    /// A run is a tile that is set and whose left neighbour is not, and all that are set after it.
    [[nodiscard]] bool is_run(int row, int first, int last) const {
        if (row < 0 || row >= rows || (first > 0 && test(first - 1, row)) || (last < columns && test(last, row))) return false;
        for (int column = first; column < last; ++column)
            if (!test(column, row)) return false;
        return first < last;
    }

  private:
    std::int64_t width_, height_, tile_;

  public:
    int columns, rows;

  private:
    [[nodiscard]] std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
    }
    template <typename F> void for_each_tile_of(const area& a, F&& f) const {
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column)
                if (a.x0 < (column + 1) * tile_ && a.x1 > column * tile_ && a.y0 < (row + 1) * tile_ && a.y1 > row * tile_)
                    f(column, row);
    }

    std::vector<bool> set_;
    std::vector<depth_interval> depth_;
    area box_{0, 0, 0, 0};
    std::int64_t guard_ = highest;
};

/// Each set tile once and no other. `largest(r, later)` says whether r could not have been larger; `later(column, row)` is what was
/// left when r was emitted.
template <typename Largest>
void check_rects(const oracle& truth, const std::vector<tile_rect>& rects, bool in_order, Largest&& largest) {
    std::vector<int> painted(static_cast<std::size_t>(truth.columns) * static_cast<std::size_t>(truth.rows), -1);
    const auto at = [&](int column, int row) -> int& {
        return painted[static_cast<std::size_t>(row) * static_cast<std::size_t>(truth.columns) + static_cast<std::size_t>(column)];
    };
    for (std::size_t i = 0; i < rects.size(); ++i) {
        const tile_rect r = rects[i];
        demand(!r.empty() && r.x0 >= 0 && r.y0 >= 0 && r.x1 <= truth.columns && r.y1 <= truth.rows, "a rectangle lies in the grid");
        for (int y = r.y0; y < r.y1; ++y)
            for (int x = r.x0; x < r.x1; ++x) {
                demand(truth.test(x, y), "a rectangle holds set tiles only");
                demand(at(x, y) < 0, "rectangles are disjoint");
                at(x, y) = static_cast<int>(i);
            }
        demand(!in_order || i == 0 || rects[i - 1].y0 < r.y0 || (rects[i - 1].y0 == r.y0 && rects[i - 1].x0 < r.x0),
               "rectangles come from row 0 upwards and from the left");
    }
    for (int y = 0; y < truth.rows; ++y)
        for (int x = 0; x < truth.columns; ++x) demand(truth.test(x, y) == (at(x, y) >= 0), "rectangles hold every set tile");
    for (std::size_t i = 0; i < rects.size(); ++i)
        demand(largest(rects[i],
                       [&, i](int column, int row) { return truth.test(column, row) && at(column, row) >= static_cast<int>(i); }),
               "a rectangle is as large as the merge promises");
}

void check_merges(const oracle& truth, const tile_grid& grid, fuzz::bytes& in) {
    std::vector<tile_rect> rects;
    const auto collect = [&rects](tile_rect r) { rects.push_back(r); };
    const auto whole_runs = [&truth](tile_rect r, auto&&) {
        for (int y = r.y0; y < r.y1; ++y)
            if (!truth.is_run(y, r.x0, r.x1)) return false;
        return !truth.is_run(r.y0 - 1, r.x0, r.x1) && !truth.is_run(r.y1, r.x0, r.x1);
    };
    for_each_tile_rect(grid, collect);
    check_rects(truth, rects, true, whole_runs);

    std::vector<texel_rect> regions;
    for_each_region(grid, [&regions](texel_rect r) { regions.push_back(r); });
    demand(regions.size() == rects.size(), "there is a region for every rectangle");
    for (std::size_t i = 0; i < rects.size(); ++i) {
        const tile_rect t = rects[i];
        const auto edge = [&grid](int tiles, int side) {
            return static_cast<int>(std::min(std::int64_t{tiles} * grid.tile(), std::int64_t{side}));
        };
        demand(regions[i] == texel_rect{t.x0 * grid.tile(), t.y0 * grid.tile(), edge(t.x1, grid.size().width),
                                        edge(t.y1, grid.size().height)},
               "a region is the texels of its tiles");
    }

    const auto words = static_cast<std::size_t>(words_for(grid.columns())) * static_cast<std::size_t>(grid.rows());
    const std::size_t missing = in.byte() % 4; // mostly enough
    std::vector<bit_word> scratch(words > missing ? words - missing : 0, 0xDEADBEEF01234567u * in.byte());
    const bool enough = scratch.size() == words;
    rects.clear();
    {
        const fuzz::wrong_call too_short;
        for_each_tile_rect_greedy(grid, scratch, collect);
    }
    if (!enough) return check_rects(truth, rects, true, whole_runs);
    // What a rectangle left over: its row begins and ends where no later rectangle has a tile, and the next row does not hold it.
    check_rects(truth, rects, false, [&truth](tile_rect r, auto&& later) {
        if ((r.x0 > 0 && later(r.x0 - 1, r.y0)) || (r.x1 < truth.columns && later(r.x1, r.y0))) return false;
        if (r.y1 == truth.rows) return true;
        for (int x = r.x0; x < r.x1; ++x)
            if (!later(x, r.y1)) return true;
        return false;
    });
}

void check_row(const oracle& truth, const tile_grid& grid, fuzz::bytes& in) {
    if (truth.rows == 0 || truth.columns == 0) return;
    const int y = in.within(0, truth.rows - 1), a = in.within(0, truth.columns), b = in.within(0, truth.columns);
    const int first = std::min(a, b), last = std::max(a, b);
    int set = 0, next_set = truth.columns, next_clear = truth.columns;
    for (int x = first; x < last; ++x) set += truth.test(x, y);
    for (int x = truth.columns - 1; x >= first; --x) (truth.test(x, y) ? next_set : next_clear) = x;
    const const_bit_row row = grid.row(y);
    demand(row.any(first, last) == (set > 0), "any");
    demand(row.all(first, last) == (set == last - first), "all");
    demand(row.next_set(first) == next_set && row.next_clear(first) == next_clear, "next_set and next_clear");
    demand(first == last || row.is_run(first, last) == truth.is_run(y, first, last), "is_run");
}

void check_all(const oracle& truth, const tile_grid& grid, fuzz::bytes& in) {
    demand(grid.columns() == truth.columns && grid.rows() == truth.rows, "the grid has the tiles of its map");
    demand(truth.agrees_on_marks(grid), "bounds, guard and empty are those of the marks");
    int count = 0;
    for (int y = 0; y < truth.rows; ++y) {
        bool any = false;
        for (int x = 0; x < truth.columns; ++x) {
            demand(grid.test(x, y) == truth.test(x, y), "a tile is set if a mark touches it");
            count += truth.test(x, y);
            any = any || truth.test(x, y);
        }
        demand(grid.occupied_rows().test(y) == any, "a row is occupied if a tile of it is set");
    }
    demand(grid.count() == count, "count");
    check_row(truth, grid, in);
    check_merges(truth, grid, in);
}

/// The compatibility grid has no oracle here, but it may not lose what was cast, whatever the numbers.
void run_reference(fuzz::bytes& in) {
    const extent map{in.within(1, 300), in.within(1, 300)};
    reference_grid grid(map, in.within(-1, 40), in.within(-1, 40));
    const auto side = [&in](int texels) { return in.flip() ? in.any_double() : in.within(-20, 275) * texels / 255.0; };
    for (int n = in.within(0, 5); n > 0; --n) {
        const double x0 = side(map.width), y0 = side(map.height), x1 = side(map.width), y1 = side(map.height);
        const real_rect r{x0, y0, x1, y1};
        const bool cast = grid.cast(r);
        demand(!cast || grid.receives(r), "what was cast is received by the same rectangle");
        const bool apart = !(x0 <= x1 && y0 <= y1) || x1 <= 0 || y1 <= 0 || x0 >= map.width || y0 >= map.height;
        demand(cast == !apart, "a caster is refused exactly if it is none or lies off the map");
    }
    std::uint32_t painted[reference_grid::side]{};
    bool whole_grid = false;
    grid.for_each_tile_rect([&](tile_rect r) {
        whole_grid = whole_grid || r == tile_rect{0, 0, reference_grid::side, reference_grid::side};
        for (int y = r.y0; y < r.y1; ++y)
            for (int x = r.x0; x < r.x1; ++x) {
                demand((painted[y] >> x & 1) == 0, "the engine's rectangles are disjoint");
                painted[y] |= 1u << x;
            }
    });
    for (int y = 0; y < reference_grid::side; ++y)
        demand(whole_grid || painted[y] == grid.row(y), "the engine's rectangles cover the set tiles exactly");
    demand(intersection(grid.blur_scissor(), whole(map)) == (grid.blur_scissor().empty() ? texel_rect{} : grid.blur_scissor()),
           "the scissor lies on the map");
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::bytes in(data, size);
    const shape s(in);
    tile_grid grid(s.size, s.tile);
    depth_tiles deep(s.size, s.tile);
    oracle truth(s), deep_truth(s);
    for (int step = 0; step < 24 && !in.empty(); ++step) {
        switch (in.within(0, 6)) {
        case 0:
        case 1: {
            const texel_rect r = rect(in, s);
            const int guard = guard_band(in);
            grid.mark(r, guard);
            truth.mark(r, guard, {0.0f, 1.0f});
            break;
        }
        case 2: {
            const texel_rect r = rect(in, s);
            const int guard = guard_band(in);
            const float nearest = in.any_float();
            const depth_interval depth{nearest, in.flip() ? nearest : in.any_float()};
            deep.mark(r, depth, guard);
            deep_truth.mark(r, guard, depth.empty() ? depth_interval{0.0f, 1.0f} : depth);
            break;
        }
        case 3: {
            const int tiles = in.one_of({1, 1, 2, 3, 0, -1, 63, 64, highest});
            grid.dilate(tiles);
            truth.dilate(tiles);
            break;
        }
        case 4:
            if (in.flip()) {
                grid.clear();
                truth.clear();
            } else {
                deep.clear();
                deep_truth.clear();
            }
            break;
        case 5: {
            const texel_rect r = rect(in, s);
            const float z = in.any_float();
            const auto any = [](int, int) { return true; };
            demand(grid.touches(r) == truth.touches(r, any), "touches");
            demand(deep.touches(r) == deep_truth.touches(r, any), "touches, with depths");
            demand(deep.touches(r, z) == deep_truth.touches(r, [&](int x, int y) { return deep_truth.depth(x, y).nearest < z; }),
                   "touches a tile with a nearer caster");
            break;
        }
        default: check_all(truth, grid, in);
        }
    }
    check_all(truth, grid, in);
    check_all(deep_truth, deep.tiles(), in);
    for (int y = 0; y < truth.rows; ++y)
        for (int x = 0; x < truth.columns; ++x)
            demand(deep.depth(x, y) == (deep_truth.test(x, y) ? deep_truth.depth(x, y) : depth_interval{}), "depths of a tile");
    if (!in.empty()) run_reference(in);
    return 0;
}
