// A receiver may be skipped only if every point of it is lit: asked of the densely filtered map, point by point.
#include <gnomon/receive/cull.hpp>
#include <gnomon/receive/receive.hpp>

#include "../support/filtering.hpp"
#include "../support/formats.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace {
using gnomon::depth_interval;
using gnomon::depth_tiles;
using gnomon::extent;
using gnomon::image;
using gnomon::texel_rect;
using test::dice;
using blur = gnomon::binomial<3>;

struct caster {
    texel_rect where;
    float depth;
};

template <typename Texel> struct scene {
    static constexpr extent size{60, 44};
    std::vector<caster> casters;
    image<Texel> soft;
    depth_tiles tiles;

    scene(dice& roll, int tile) : tiles(size, tile) {
        image<Texel> drawn(size, Texel::clear());
        for (int n = roll(0, 4); n > 0; --n) {
            const int x = roll(-5, size.width), y = roll(-5, size.height);
            const caster c{clip({x, y, x + roll(1, 14), y + roll(1, 14)}, size), static_cast<float>(roll(0, 256)) / 256.0f};
            test::for_each_texel(c.where, [&](int i, int j) { drawn(i, j).cast(Texel::caster(c.depth)); });
            tiles.mark(c.where, {c.depth, c.depth}, blur::radius);
            casters.push_back(c);
        }
        soft = test::dense<blur>(drawn);
    }
    /// The nearest caster that the filter, and a blend of four, can bring to a texel of `r`; beyond everything if there is none.
    float nearest_around(texel_rect r) const {
        float nearest = 2.0f;
        for (const caster& c : casters)
            if (!intersection(grow(c.where, blur::radius), grow(r, 1)).empty() && c.depth < nearest) nearest = c.depth;
        return nearest;
    }
    /// Does a receiver at depth `z` find shadow at any texel of `r`, or between texels?
    bool shadowed(texel_rect r, float z, const gnomon::rule& rule) const {
        bool any = false;
        test::for_each_texel(clip(r, size), [&](int x, int y) { any = any || gnomon::shadow(soft(x, y), z, rule) > 0.0f; });
        for (int y = 2 * r.y0; y <= 2 * r.y1; ++y)
            for (int x = 2 * r.x0; x <= 2 * r.x1; ++x)
                any = any || gnomon::shadow(gnomon::sample(soft.view(), static_cast<float>(x) / 2, static_cast<float>(y) / 2), z,
                                            rule) > 0.0f;
        return any;
    }
};
} // namespace

TEST_CASE_TEMPLATE("a receiver that is culled is lit at every texel and between them, and many are culled", Texel, gnomon::rg16,
                   gnomon::rg32f, gnomon::rg8, gnomon::tm8) {
    dice roll(111);
    constexpr gnomon::rule careful = gnomon::rule{}, exact = gnomon::rule{.caster = gnomon::unbiased};
    int lost = 0, culled = 0, culled_by_depth = 0, shadowed = 0, asked = 0;
    for (int round = 0; round < 200; ++round) {
        const scene<Texel> s(roll, roll(1, 3) * 8);
        for (int i = 0; i < 12; ++i, ++asked) {
            const int x = roll(-6, scene<Texel>::size.width + 2), y = roll(-6, scene<Texel>::size.height + 2);
            const texel_rect footprint{x, y, x + roll(1, 8), y + roll(1, 8)};
            const float z = static_cast<float>(roll(0, 1024)) / 1024.0f, nearer = z * roll.unit();
            const bool reached = gnomon::casters_reach(s.tiles, footprint, {nearer, z}),
                       near_tiles = gnomon::casters_reach(s.tiles.tiles(), footprint);
            // Without a bias a quantised caster may shadow what lies just before it: only receivers behind the true caster count.
            const bool truly =
                s.shadowed(footprint, z, careful) || (z > s.nearest_around(footprint) && s.shadowed(footprint, z, exact));
            const bool at_any_depth = s.shadowed(footprint, 2.0f, exact);
            lost += (truly && !reached) || (at_any_depth && !near_tiles) ||
                    (at_any_depth && !gnomon::casters_reach(s.tiles, footprint)) || (reached && !near_tiles);
            for (const gnomon::bias b : {gnomon::unbiased, gnomon::towards_shadow,
                                         gnomon::bias{.depth = -0.05f}}) // may shadow before the caster: any depth counts
                lost += s.shadowed(footprint, z, gnomon::rule{.caster = b}) &&
                        !gnomon::casters_reach(s.tiles, footprint, {nearer, z}, b);
            culled += !reached;
            culled_by_depth += near_tiles && !reached;
            shadowed += truly;
        }
    }
    CHECK(lost == 0);
    CHECK(culled > asked / 2);
    CHECK(culled_by_depth > asked / 20);
    CHECK(shadowed > asked / 20);
}

TEST_CASE("the texel beside a footprint counts, because a blended sample reads it, and so does the one across the map's edge") {
    depth_tiles tiles({64, 64}, 8);
    tiles.mark({16, 16, 24, 24}, {0.5f, 0.5f}, 0);
    CHECK(gnomon::casters_reach(tiles, {24, 16, 30, 20}));
    CHECK_FALSE(gnomon::casters_reach(tiles, {25, 16, 30, 20}));
    CHECK(gnomon::casters_reach(tiles.tiles(), {24, 16, 30, 20}));
    CHECK_FALSE(gnomon::casters_reach(tiles.tiles(), {25, 16, 30, 20}));
    CHECK(gnomon::casters_reach(tiles, {10, 24, 17, 30}));
    CHECK_FALSE(gnomon::casters_reach(tiles, {10, 25, 17, 30}));
    tiles.mark({0, 40, 1, 41}, {0.5f, 0.5f}, 0);
    CHECK(gnomon::casters_reach(tiles, {-4, 40, 0, 41}));
    CHECK_FALSE(gnomon::casters_reach(tiles, {-4, 40, -1, 41}));
}

TEST_CASE("a receiver of unknown depth is culled by tiles alone, and one at a caster's depth is lit") {
    depth_tiles tiles({64, 64}, 8);
    tiles.mark({16, 16, 24, 24}, {0.25f, 0.75f}, 3);
    constexpr texel_rect here{18, 18, 20, 20}, elsewhere{40, 40, 50, 50};
    CHECK(gnomon::casters_reach(tiles, here));
    CHECK(gnomon::casters_reach(tiles, here, {0.9f, 0.1f}));
    CHECK(gnomon::casters_reach(tiles, here, {0.0f, 0.26f}));
    CHECK_FALSE(gnomon::casters_reach(tiles, here, {0.0f, 0.25f}));
    CHECK_FALSE(gnomon::casters_reach(tiles, elsewhere));
    CHECK_FALSE(gnomon::casters_reach(tiles, {}, {0.0f, 1.0f}));
    CHECK_FALSE(gnomon::casters_reach(tiles, {20, 20, 10, 10}));
    tiles.clear();
    CHECK_FALSE(gnomon::casters_reach(tiles, here));
}
