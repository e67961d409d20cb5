// The oracle marks texels, one by one and in 64 bits: a tile is set if one of its texels is.
#include <gnomon/grid/tile_grid.hpp>

#include "../support/dice.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace {
using gnomon::extent;
using gnomon::texel_rect;
using gnomon::tile_grid;
using gnomon::tile_rect;
using test::dice;
constexpr int lowest = std::numeric_limits<int>::min(), highest = std::numeric_limits<int>::max();

class oracle {
  public:
    oracle(extent size, int tile)
        : size_{size.width > 0 ? size.width : 0, size.height > 0 ? size.height : 0}, tile_(tile),
          columns((size_.width + tile - 1) / tile), rows((size_.height + tile - 1) / tile),
          set_(static_cast<std::size_t>(columns * rows)), held_(set_) {}

    bool test(int column, int row) const { return set_[index(column, row)]; }
    bool held(int column, int row) const { return held_[index(column, row)]; }
    int tile() const { return tile_; }
    texel_rect bounds() const { return box_; }
    int guard() const { return guard_; }

    void mark(texel_rect r, std::int64_t guard) {
        if (guard < 0) guard = 0;
        bool hit = false;
        for_each_texel_of(r, guard, [&](int x, int y) {
            set_[index(x / tile_, y / tile_)] = true;
            box_ = hit || !box_.empty() ? texel_rect{x < box_.x0 ? x : box_.x0, y < box_.y0 ? y : box_.y0,
                                                     x >= box_.x1 ? x + 1 : box_.x1, y >= box_.y1 ? y + 1 : box_.y1}
                                        : texel_rect{x, y, x + 1, y + 1};
            hit = true;
        });
        if (hit && guard < guard_) guard_ = static_cast<int>(guard);
        for_each_texel_of(r, 0, [&](int x, int y) { held_[index(x / tile_, y / tile_)] = true; });
    }
    bool touches(texel_rect r) const {
        bool found = false;
        for_each_texel_of(r, 0, [&](int x, int y) { found = found || (box_.contains(x, y) && test(x / tile_, y / tile_)); });
        return found;
    }
    void dilate(int tiles) {
        const std::vector<bool> before = set_;
        bool any = false;
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) {
                if (!before[index(column, row)]) continue;
                any = true;
                for (int y = row - tiles; y <= row + tiles; ++y)
                    for (int x = column - tiles; x <= column + tiles; ++x)
                        if (x >= 0 && y >= 0 && x < columns && y < rows) set_[index(x, y)] = true;
            }
        if (!any) return;
        const int texels = tiles * tile_;
        box_ = {box_.x0 > texels ? box_.x0 - texels : 0, box_.y0 > texels ? box_.y0 - texels : 0,
                box_.x1 + texels < size_.width ? box_.x1 + texels : size_.width,
                box_.y1 + texels < size_.height ? box_.y1 + texels : size_.height};
        guard_ += texels;
    }

  private:
    std::size_t index(int column, int row) const { return static_cast<std::size_t>(row * columns + column); }
    template <typename F> void for_each_texel_of(texel_rect r, std::int64_t guard, F&& f) const {
        if (r.x0 >= r.x1 || r.y0 >= r.y1) return;
        for (int y = 0; y < size_.height; ++y)
            if (y >= r.y0 - guard && y < r.y1 + guard)
                for (int x = 0; x < size_.width; ++x)
                    if (x >= r.x0 - guard && x < r.x1 + guard) f(x, y);
    }

    extent size_;
    int tile_;

  public:
    int columns, rows;

  private:
    std::vector<bool> set_, held_;
    texel_rect box_{};
    int guard_ = highest;
};

/// Differences in anything that a grid tells about itself.
int differences(const tile_grid& grid, const oracle& truth) {
    int wrong = (grid.columns() != truth.columns) + (grid.rows() != truth.rows) + (grid.tile() != truth.tile());
    if (wrong != 0) return wrong;
    int set = 0, held = 0;
    for (int y = 0; y < truth.rows; ++y) {
        bool occupied = false, holds = false;
        for (int x = 0; x < truth.columns; ++x) {
            wrong += grid.test(x, y) != truth.test(x, y) || grid.row(y).test(x) != truth.test(x, y);
            occupied = occupied || truth.test(x, y);
            set += truth.test(x, y);
            wrong += grid.held(y).test(x) != truth.held(x, y);
            holds = holds || truth.held(x, y);
            held += truth.held(x, y);
        }
        wrong += grid.occupied_rows().test(y) != occupied;
        wrong += grid.held_rows().test(y) != holds;
    }
    return wrong + (grid.count() != set) + (grid.held_count() != held) + (grid.empty() != (set == 0)) +
           (grid.bounds() != truth.bounds()) + (grid.guard() != truth.guard());
}

struct shape {
    extent size;
    int tile;
};
constexpr shape shapes[] = {{{0, 0}, 8},     {{0, 5}, 1},    {{5, 0}, 3},     {{-3, 7}, 2},    {{1, 1}, 1},
                            {{1, 1}, 100},   {{65, 1}, 1},   {{1, 65}, 1},    {{64, 64}, 64},  {{63, 65}, 64},
                            {{128, 96}, 32}, {{100, 37}, 7}, {{37, 100}, 16}, {{300, 300}, 1}, {{299, 3}, 1},
                            {{512, 64}, 2},  {{513, 65}, 2}, {{129, 40}, 1},  {{90, 200}, 89}, {{30, 20}, 1000}};
} // namespace

TEST_CASE("a tile is set if and only if a marked rectangle, grown by its guard band, touches one of its texels") {
    dice roll(21);
    for (const shape& s : shapes) {
        tile_grid grid(s.size, s.tile);
        oracle truth(s.size, s.tile);
        int wrong = differences(grid, truth);
        for (int step = 0; step < 60; ++step) {
            if (roll.one_in(12)) {
                grid.clear();
                truth = oracle(s.size, s.tile);
            } else if (roll.one_in(8)) {
                const int tiles = roll(0, 3);
                grid.dilate(tiles);
                truth.dilate(tiles);
            } else {
                texel_rect r = roll.rect(grid.size(), 20);
                if (roll.one_in(2)) r = {r.x0, r.y0, r.x0 + roll(1, 4), r.y0 + roll(1, 4)}; // small ones leave tiles unset
                const int guard = roll(-2, 9);
                const tile_rect marked = grid.mark(r, guard);
                truth.mark(r, guard);
                wrong += marked != grid.tiles_of(grow(r, guard));
            }
            wrong += differences(grid, truth);
            for (int i = 0; i < 5; ++i) {
                const texel_rect r = roll.rect(grid.size(), 30);
                wrong += grid.touches(r) != truth.touches(r);
            }
        }
        CAPTURE(s.size.width);
        CAPTURE(s.size.height);
        CAPTURE(s.tile);
        CHECK(wrong == 0);
    }
}

TEST_CASE("no rectangle and no guard band is too large, too far out, or too inverted") {
    constexpr int sides[] = {lowest, lowest + 1, -1000, -1, 0, 1, 17, 41, 42, 1000, highest - 1, highest};
    constexpr texel_rect rows[] = {{0, lowest, 0, highest},    {0, 5, 0, 6}, {0, highest, 0, lowest}, {0, highest - 1, 0, highest},
                                   {0, lowest, 0, lowest + 1}, {0, 3, 0, 3}};
    constexpr extent size{42, 18};
    tile_grid grid(size, 5);
    int wrong = 0, marked = 0, unmarked = 0;
    for (const int x0 : sides)
        for (const int x1 : sides)
            for (const texel_rect row : rows)
                for (const int guard : {lowest, -1, 0, 1, 7, 999, 1000, highest - 1, highest}) {
                    const texel_rect r{x0, row.y0, x1, row.y1};
                    oracle truth(size, 5);
                    truth.mark(r, guard);
                    grid.clear();
                    grid.mark(r, guard);
                    wrong += differences(grid, truth) + (grid.touches(r) != truth.touches(r));
                    ++(grid.empty() ? unmarked : marked);
                }
    CHECK(wrong == 0);
    CHECK(marked > 500);
    CHECK(unmarked > 500);
}

TEST_CASE("a caster just off the map marks where its penumbra enters, and one that nothing enters from marks nothing") {
    tile_grid grid({64, 64}, 8);
    CHECK(grid.mark({-30, 10, 0, 20}, 0) == tile_rect{});
    CHECK(grid.mark({-30, 10, -5, 20}, 5) == tile_rect{});
    CHECK(grid.empty());
    CHECK(grid.guard() == highest);
    CHECK(grid.mark({-30, 10, -5, 20}, 6) == tile_rect{0, 0, 1, 4});
    CHECK(grid.bounds() == texel_rect{0, 4, 1, 26});
    CHECK(grid.guard() == 6);
}

TEST_CASE("texels_of covers exactly the texels that integer division gives to the tiles") {
    for (const shape& s : shapes) {
        const tile_grid grid(s.size, s.tile);
        const int tile = s.tile;
        int wrong = 0;
        for (int y0 = 0; y0 < grid.rows(); y0 += 1 + grid.rows() / 7)
            for (int y1 = y0 + 1; y1 <= grid.rows(); y1 += 1 + grid.rows() / 7)
                for (int x0 = 0; x0 < grid.columns(); x0 += 1 + grid.columns() / 7)
                    for (int x1 = x0 + 1; x1 <= grid.columns(); x1 += 1 + grid.columns() / 7) {
                        const texel_rect r = grid.texels_of({x0, y0, x1, y1});
                        const auto first = [tile](int t) { return t * tile; };
                        const auto last = [tile](int t, int texels) {
                            int end = 0;
                            while (end < texels && end / tile < t) ++end;
                            return end;
                        };
                        wrong += r != texel_rect{first(x0), first(y0), last(x1, grid.size().width), last(y1, grid.size().height)};
                        wrong += grid.tiles_of(r) != tile_rect{x0, y0, x1, y1};
                    }
        CAPTURE(s.size.width);
        CAPTURE(s.tile);
        CHECK(wrong == 0);
    }
}

TEST_CASE("the largest map there can be is cut without overflow") {
    const tile_grid grid({highest, 1}, 1 << 20);
    CHECK(grid.columns() == 2048);
    CHECK(grid.texels_of({2047, 0, 2048, 1}) == texel_rect{2047 << 20, 0, highest, 1});
    CHECK(grid.tiles_of({highest - 1, 0, highest, 1}) == tile_rect{2047, 0, 2048, 1});
    const tile_grid one({highest, highest}, highest);
    CHECK(one.columns() == 1);
    CHECK(one.texels_of({0, 0, 1, 1}) == texel_rect{0, 0, highest, highest});
}

TEST_CASE("dilating holds at least what marking with a wider guard band would have") {
    dice roll(22);
    for (int i = 0; i < 300; ++i) {
        const int tile = roll(1, 9), tiles = roll(0, 4), guard = roll(0, 5);
        tile_grid dilated({roll(1, 150), roll(1, 60)}, tile), wider = dilated;
        for (int casters = roll(1, 3); casters > 0; --casters) {
            const int x = roll(0, dilated.size().width - 1), y = roll(0, dilated.size().height - 1);
            const texel_rect r{x, y, x + roll(1, 20),
                               y + roll(1, 20)}; // on the map: dilation cannot bring in what was never marked
            dilated.mark(r, guard);
            wider.mark(r, guard + tiles * tile);
        }
        dilated.dilate(tiles);
        int missing = 0;
        for (int y = 0; y < wider.rows(); ++y)
            for (int x = 0; x < wider.columns(); ++x) missing += wider.test(x, y) && !dilated.test(x, y);
        CHECK(missing == 0);
        CHECK(dilated.bounds() == wider.bounds());
        CHECK(dilated.guard() == wider.guard());
    }
}

TEST_CASE("a mark at the left edge dilates into no other row's right edge") {
    tile_grid grid({128, 4}, 1); // two whole words a row
    oracle truth({128, 4}, 1);
    for (const texel_rect r : {texel_rect{30, 0, 31, 1}, {0, 1, 1, 2}, {127, 3, 128, 4}}) {
        grid.mark(r);
        truth.mark(r, 0);
    }
    grid.dilate(1);
    truth.dilate(1);
    CHECK(differences(grid, truth) == 0);
}

TEST_CASE("dilating by any number of tiles ends, and without marks does nothing") {
    tile_grid grid({100, 50}, 10);
    for (const int tiles : {lowest, -1, 0, 1, highest}) grid.dilate(tiles);
    CHECK(grid.empty());
    CHECK(grid.guard() == highest);
    grid.mark({50, 20, 51, 21}, 1);
    for (const int tiles : {lowest, -1, 0}) grid.dilate(tiles);
    CHECK(grid.count() == 4);
    CHECK(grid.guard() == 1);
    tile_grid far = grid;
    far.dilate(highest / 10);
    CHECK(far.guard() == highest / 10 * 10 + 1); // the widest that is no more than an int holds
    grid.dilate(highest);
    CHECK(grid.count() == 50);
    CHECK(grid.bounds() == whole(grid.size()));
    CHECK(grid.guard() == highest);
}

TEST_CASE("a cleared grid is a new one") {
    dice roll(23);
    for (const shape& s : shapes) {
        tile_grid grid(s.size, s.tile);
        for (int i = 0; i < 20; ++i) grid.mark(roll.rect(grid.size(), 5), roll(0, 4));
        grid.dilate(roll(0, 2));
        grid.clear();
        CHECK(differences(grid, oracle(s.size, s.tile)) == 0);
        CHECK_FALSE(grid.touches({lowest, lowest, highest, highest}));
    }
}

TEST_CASE("a grid without a map has no tiles and takes every call") {
    tile_grid grid;
    CHECK((grid.columns() == 0 && grid.rows() == 0));
    CHECK(differences(grid, oracle({0, 0}, 1)) == 0);
    CHECK(grid.mark({0, 0, 9, 9}, 3) == tile_rect{});
    grid.dilate(2);
    grid.clear();
    CHECK(grid.empty());
    CHECK(grid.count() == 0);
    CHECK_FALSE(grid.touches({0, 0, 9, 9}));
    CHECK(grid.tiles_of({0, 0, 9, 9}) == tile_rect{});
}

#ifdef NDEBUG
TEST_CASE("without asserts a tile below one texel counts as one") {
    for (const int tile : {0, -1, lowest}) {
        const tile_grid grid({7, 3}, tile);
        CHECK(grid.tile() == 1);
        CHECK(grid.columns() == 7);
        CHECK(grid.rows() == 3);
    }
}
#endif
