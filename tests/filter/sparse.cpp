// Sparse equals dense (h15): what is filtered tile by tile has the bits of the whole map filtered from scratch.
#include <gnomon/backend/scalar.hpp>

#include "../support/filtering.hpp"
#include "../support/formats.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace {
using gnomon::binomial;
using gnomon::box;
using gnomon::extent;
using gnomon::filter_scratch;
using gnomon::gaussian;
using gnomon::image;
using gnomon::tent;
using gnomon::texel_rect;
using gnomon::tile_grid;
using test::dense;
using test::dice;

using some_kernels = test::kernels<box<0>, box<1>, tent<2>, binomial<3>, gaussian<8>>;

template <gnomon::kernel Kernel, typename Texel> image<Texel> sparse(const image<Texel>& casters, const tile_grid& tiles) {
    image<Texel> soft(casters.size(), Texel::clear());
    filter_scratch<Texel, Kernel> scratch(casters.size().width);
    gnomon::filter(gnomon::scalar{}, casters.view(), soft.view(), tiles, scratch);
    return soft;
}
} // namespace

TEST_CASE_TEMPLATE("for each of the 512 patterns of 3 x 3 tiles, sparse equals dense", Texel, gnomon::rg8, gnomon::rgba16,
                   gnomon::rgb16f, gnomon::rga32f, gnomon::tm8, test::ratio_rgba16, test::paper8, test::paper32f) {
    constexpr extent size{14, 13};
    constexpr int tile = 5; // the last ones are cut off
    dice roll(101);
    test::for_each_kernel(some_kernels{}, [&]<typename Kernel>() {
        int wrong = 0;
        for (int pattern = 0; pattern < 512; ++pattern) {
            image<Texel> casters(size, Texel::clear());
            tile_grid tiles(size, tile);
            for (int i = 0; i < 9; ++i) {
                if ((pattern >> i & 1) == 0) continue;
                texel_rect r = tiles.texels_of({i % 3, i / 3, i % 3 + 1, i / 3 + 1});
                if (roll.one_in(2)) r = {r.x0 + 1, r.y0, r.x0 + 2, r.y1}; // a tile that is only partly covered
                casters.view().fill(r, test::any_caster<Texel>(roll));
                tiles.mark(r, Kernel::radius);
            }
            wrong += test::differences(sparse<Kernel>(casters, tiles), dense<Kernel>(casters)) != 0;
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE_TEMPLATE("any guard band gives the dense result: a filter grows what was marked by its own radius", Texel, gnomon::rg8,
                   gnomon::rgba32f) {
    dice roll(102);
    int whole_maps = 0, parts = 0, narrow = 0;
    for (int round = 0; round < 150; ++round) {
        const extent size{roll(1, 70), roll(1, 60)};
        image<Texel> casters(size, Texel::clear());
        std::vector<texel_rect> drawn;
        for (int n = roll(0, 4); n > 0; --n) {
            drawn.push_back(roll.rect(size, 6));
            casters.view().fill(drawn.back(), test::any_caster<Texel>(roll));
        }
        test::for_each_kernel(some_kernels{}, [&]<typename Kernel>() {
            tile_grid tiles(size, roll(1, 20));
            for (const texel_rect r : drawn) tiles.mark(clip(r, size), roll(0, 2) * Kernel::radius + roll(-1, 2));
            CHECK(test::differences(sparse<Kernel>(casters, tiles), dense<Kernel>(casters)) == 0);
            if (!tiles.empty()) ++(gnomon::regions_to_filter<Kernel>(tiles).all() ? whole_maps : parts);
            narrow += !tiles.empty() && tiles.guard() < Kernel::radius;
        });
    }
    CHECK(whole_maps > 50);
    CHECK(parts > 50);
    CHECK(narrow > 50);
}

TEST_CASE("what has to be written is what lies within the radius of the casters' tiles, or nothing") {
    const auto regions = [](const tile_grid& tiles) {
        std::vector<texel_rect> found;
        gnomon::for_each_region_to_filter<binomial<3>>(tiles, [&](texel_rect r) { found.push_back(r); });
        return found;
    };
    tile_grid tiles({50, 30}, 10);
    CHECK(regions(tiles).empty());
    tiles.mark({14, 14, 16, 16}, 3);
    CHECK(regions(tiles) == std::vector<texel_rect>{{10, 10, 20, 20}}); // no guard band left the tile
    tiles.mark({42, 25, 47, 27}, 4);
    CHECK(regions(tiles) == std::vector<texel_rect>{{10, 10, 20, 20}, {37, 20, 50, 30}}); // 38 is the first column of 42 - 4
    tiles.mark({15, 15, 16, 16}, 2);
    CHECK(regions(tiles) == std::vector<texel_rect>{{7, 7, 23, 23}, {37, 17, 50, 30}});
}

TEST_CASE("a map of which so much has to be written that the whole is cheaper is filtered whole, from the stated share on") {
    constexpr int side = 200, rows = gnomon::dense_from_percent;
    // So many rows of a hundred, or columns, that have to be written, but for some texels of the last.
    const auto all_but = [](int texels, bool turned) {
        tile_grid tiles(turned ? extent{100, side} : extent{side, 100}, 1);
        for (const texel_rect r : {texel_rect{0, 0, side, rows - 1}, {0, 0, side - texels, rows}})
            tiles.mark(turned ? texel_rect{r.y0, r.x0, r.y1, r.x1} : r);
        return tiles;
    };
    for (const bool turned : {false, true}) {
        CHECK(gnomon::regions_to_filter<box<0>>(all_but(0, turned)).all());
        CHECK_FALSE(gnomon::regions_to_filter<box<0>>(all_but(1, turned)).all());
    }
    tile_grid cut({1, 99}, 2); // 89 of 99 texels, in tiles that could hold 180
    cut.mark({0, 0, 1, 88});
    cut.mark({0, 98, 1, 99});
    CHECK_FALSE(gnomon::regions_to_filter<box<0>>(cut).all());
    tile_grid middle({12, 12}, 4); // one tile, and all texels within its radius
    middle.mark({4, 4, 8, 8}, 4);
    CHECK(gnomon::regions_to_filter<box<4>>(middle).all());
    tile_grid scattered({side, side}, 10); // could be everything, by the number of tiles, and is not
    for (int y = 0; y < 20; ++y)
        for (int x = y % 2; x < 20; x += 2) scattered.mark({10 * x + 5, 10 * y + 5, 10 * x + 6, 10 * y + 6}, 4);
    CHECK_FALSE(gnomon::regions_to_filter<box<4>>(scattered).all());
    const gnomon::regions_to_filter<box<5>> everything(scattered);
    CHECK(everything.all());
    std::vector<texel_rect> as_one;
    everything([&](texel_rect r) { as_one.push_back(r); });
    CHECK(as_one == std::vector{texel_rect{0, 0, side, side}});
    CHECK_FALSE(gnomon::regions_to_filter<box<5>>(tile_grid{}).all());
}

TEST_CASE("where sums run, parts are weighed by what is read for them: flat steps within a wide radius cost more than the whole") {
    constexpr int side = 512, tile = 16;
    tile_grid steps({side, side}, tile); // a diagonal of tiles, whose surroundings come in pieces as flat as these
    for (int i = 0; i < side / tile; ++i) steps.mark({i * tile, i * tile, (i + 1) * tile, (i + 1) * tile}, 64);
    CHECK((!gnomon::regions_to_filter<box<64>>(steps).all() && gnomon::regions_to_filter<box<64>>(steps, false, true).all()));
    tile_grid corner({side, side}, tile); // of one piece
    corner.mark({0, 0, side / 4, side / 4}, 64);
    CHECK_FALSE(gnomon::regions_to_filter<box<64>>(corner, false, true).all());
    const texel_rect r{10, 20, 42, 120};
    CHECK(gnomon::detail::filter_cost<box<8>>(r, false) == 3200.0);
    CHECK(gnomon::detail::filter_cost<box<8>>(r, true) == doctest::Approx(0.2 * 48 * 116 + 0.3 * 48 * 100 + 0.5 * 3200));
}

TEST_CASE("clearing the marked tiles clears every texel of them and no other") {
    dice roll(103);
    for (int round = 0; round < 50; ++round) {
        const extent size{roll(1, 60), roll(1, 60)};
        tile_grid tiles(size, roll(1, 13));
        for (int n = roll(0, 4); n > 0; --n) tiles.mark(roll.rect(size, 5), roll(0, 3));
        const image<gnomon::rgb8> full(size, gnomon::rgb8::caster(0.5f));
        image<gnomon::rgb8> cleared = full;
        gnomon::clear_tiles(cleared.view(), tiles);
        int wrong = 0;
        test::for_each_texel(whole(size), [&](int x, int y) {
            wrong += !(cleared(x, y) == (tiles.test(x / tiles.tile(), y / tiles.tile()) ? gnomon::rgb8::clear() : full(x, y)));
        });
        CHECK(wrong == 0);
    }
}

TEST_CASE("clearing casters clears the tiles that they were marked in, and no guard band") {
    const image<gnomon::rg16> full({40, 30}, gnomon::rg16::caster(0.5f));
    image<gnomon::rg16> cleared = full;
    tile_grid tiles(full.size(), 10);
    tiles.mark({12, 12, 19, 19}, 9);
    gnomon::clear_casters(cleared.view(), tiles);
    int wrong = 0;
    test::for_each_texel(whole(full.size()), [&](int x, int y) {
        wrong += !(cleared(x, y) == (x / 10 == 1 && y / 10 == 1 ? gnomon::rg16::clear() : full(x, y)));
    });
    CHECK(wrong == 0);
}

TEST_CASE_TEMPLATE("the next frame may be filtered over the last one once what is left of that is cleared", Texel, gnomon::rg8,
                   test::paper16) {
    dice roll(104);
    test::for_each_kernel(some_kernels{}, [&]<typename Kernel>() {
        constexpr extent size{70, 50};
        filter_scratch<Texel, Kernel> scratch(size.width);
        image<Texel> soft(size, Texel::clear());
        tile_grid before(size, 8);
        int wrong = 0;
        for (int frame = 0; frame < 40; ++frame) {
            image<Texel> casters(size, Texel::clear());
            tile_grid now(size, 8);
            for (int n = roll(0, 3); n > 0; --n) {
                const texel_rect r = roll.rect(size, 6);
                casters.view().fill(r, test::any_caster<Texel>(roll));
                now.mark(r, Kernel::radius);
            }
            gnomon::clear_what_is_left<Kernel>(soft.view(), before, now);
            gnomon::filter(gnomon::scalar{}, casters.view(), soft.view(), now, scratch);
            wrong += test::differences(soft, dense<Kernel>(casters)) != 0;
            before = now;
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE("a region is cleared where it lies on the map, row by row, and no texel beside it") {
    for (const texel_rect r : {texel_rect{-5, -5, 3, 2}, texel_rect{4, 4, 9, 5}, texel_rect{3, 2, 99, 99}, texel_rect{5, 5, 5, 9},
                               texel_rect{50, 50, 60, 60}}) {
        const image<gnomon::rgb16f> full({10, 8}, gnomon::rgb16f::caster(0.5f));
        image<gnomon::rgb16f> cleared = full;
        gnomon::clear_region(cleared.view(), r);
        int wrong = 0;
        test::for_each_texel(whole(full.size()), [&](int x, int y) {
            wrong += !(cleared(x, y) == (r.contains(x, y) ? gnomon::rgb16f::clear() : full(x, y)));
        });
        CHECK(wrong == 0);
    }
}
