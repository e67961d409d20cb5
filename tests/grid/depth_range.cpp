// The oracle keeps, for each tile, every interval that was marked on it.
#include <gnomon/grid/depth_range.hpp>

#include "../support/bits.hpp"
#include "../support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace {
using gnomon::depth_interval;
using gnomon::depth_tiles;
using gnomon::texel_rect;
using test::dice;

struct marked {
    texel_rect reach;
    depth_interval depth;
};

/// Of all casters whose guard band touches a texel of the tile.
depth_interval depth_of(const std::vector<marked>& casters, texel_rect tile) {
    std::vector<float> depths;
    for (const marked& c : casters)
        if (!intersection(c.reach, tile).empty()) depths.insert(depths.end(), {c.depth.nearest, c.depth.farthest});
    if (depths.empty()) return {};
    const auto [nearest, farthest] = std::minmax_element(depths.begin(), depths.end());
    return {*nearest, *farthest};
}
} // namespace

TEST_CASE("whoever asks for a tile_grid is given that of the depth_tiles") {
    const depth_tiles tiles({90, 75}, 8);
    const gnomon::tile_grid& grid = tiles;
    CHECK(&grid == &tiles.tiles());
}

TEST_CASE("each tile knows the depths of the casters around it, frame after frame") {
    dice roll(51);
    depth_tiles tiles({90, 75}, 8);
    for (int frame = 0; frame < 300; ++frame) {
        tiles.clear();
        std::vector<marked> casters;
        for (int n = roll(0, 6); n > 0; --n) {
            const texel_rect r = roll.rect({90, 75}, 20);
            const int guard = roll(-1, 9);
            depth_interval depth{roll.unit(), roll.unit()};
            tiles.mark(r, depth, guard);
            if (depth.empty()) depth = {0.0f, 1.0f};
            casters.push_back({clip(grow(r, guard), {90, 75}), depth});
        }
        int wrong = 0;
        for (int y = 0; y < tiles.tiles().rows(); ++y)
            for (int x = 0; x < tiles.tiles().columns(); ++x) {
                const depth_interval expected = depth_of(casters, tiles.tiles().texels_of({x, y, x + 1, y + 1}));
                wrong += tiles.depth(x, y) != expected || tiles.tiles().test(x, y) == expected.empty();
            }
        for (int i = 0; i < 30; ++i) {
            const texel_rect r = roll.rect({90, 75}, 20);
            const float z = roll.unit();
            bool expected = false, at_any_depth = false;
            const texel_rect asked = intersection(r, tiles.tiles().bounds());
            for (int y = 0; y < tiles.tiles().rows(); ++y)
                for (int x = 0; x < tiles.tiles().columns(); ++x) {
                    const texel_rect tile = tiles.tiles().texels_of({x, y, x + 1, y + 1});
                    const depth_interval depth = depth_of(casters, tile);
                    const bool touched = !intersection(asked, tile).empty() && !depth.empty();
                    at_any_depth = at_any_depth || touched;
                    expected = expected || (touched && depth.nearest < z);
                }
            wrong += tiles.touches(r, z) != expected || tiles.touches(r) != at_any_depth;
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("a tall map has depths in its last tile, and no guard band unless it is asked for") {
    depth_tiles tiles({8, 80}, 8);
    tiles.mark({0, 72, 8, 80}, {0.25f, 0.5f});
    CHECK(tiles.depth(0, 9) == depth_interval{0.25f, 0.5f});
    CHECK(tiles.depth(0, 8).empty());
    CHECK(tiles.tiles().guard() == 0);
    CHECK(tiles.touches({0, 79, 1, 80}, 0.5f));
    CHECK_FALSE(tiles.touches({0, 79, 1, 80}, 0.25f));
}

TEST_CASE("a depth that is not known could be any, and a receiver at no depth is before everything") {
    constexpr float nan = test::nan<float>, inf = test::infinity<float>;
    for (const depth_interval unknown : {depth_interval{}, {0.9f, 0.1f}, {nan, 0.5f}, {0.5f, nan}, {nan, nan}}) {
        depth_tiles tiles({16, 16}, 8);
        tiles.mark({0, 0, 4, 4}, unknown);
        CHECK(tiles.depth(0, 0) == depth_interval{0.0f, 1.0f});
        CHECK(tiles.touches({0, 0, 1, 1}, 0x1p-149f));
        CHECK_FALSE(tiles.touches({0, 0, 1, 1}, 0.0f));
        CHECK_FALSE(tiles.touches({0, 0, 1, 1}, nan));
        CHECK_FALSE(tiles.touches({0, 0, 1, 1}, -inf));
        CHECK(tiles.touches({0, 0, 1, 1}, inf));
        CHECK_FALSE(tiles.touches({8, 0, 16, 16}, inf));
    }
}

TEST_CASE("the depths of an earlier frame are forgotten with its marks") {
    depth_tiles tiles({16, 16}, 8);
    tiles.mark({0, 0, 16, 16}, {0.1f, 0.2f});
    tiles.clear();
    CHECK(tiles.depth(0, 0).empty());
    tiles.mark({0, 0, 4, 4}, {0.8f, 0.9f});
    CHECK(tiles.depth(0, 0) == depth_interval{0.8f, 0.9f});
    CHECK(tiles.depth(1, 1).empty());
    CHECK_FALSE(tiles.touches({0, 0, 16, 16}, 0.8f));
    CHECK(tiles.touches({0, 0, 16, 16}, 0.81f));
}

TEST_CASE("depth tiles without a map take every call") {
    depth_tiles tiles;
    tiles.mark({0, 0, 9, 9}, {0.1f, 0.2f}, 3);
    CHECK_FALSE(tiles.touches({0, 0, 9, 9}, 1.0f));
    tiles.clear();
    CHECK(tiles.tiles().empty());
}
