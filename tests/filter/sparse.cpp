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

TEST_CASE_TEMPLATE("any guard band gives the dense result: too wide costs time, too narrow filters the whole map", Texel,
                   gnomon::rg8, gnomon::rgba32f) {
    dice roll(102);
    int whole_maps = 0, parts = 0;
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
            if (!tiles.empty()) ++(tiles.guard() < Kernel::radius ? whole_maps : parts);
        });
    }
    CHECK(whole_maps > 50);
    CHECK(parts > 50);
}

TEST_CASE("what has to be written is the marked tiles, or the whole map if they were marked too narrowly, or nothing") {
    const auto regions = [](const tile_grid& tiles) {
        std::vector<texel_rect> found;
        gnomon::for_each_region_to_filter<binomial<3>>(tiles, [&](texel_rect r) { found.push_back(r); });
        return found;
    };
    tile_grid tiles({50, 30}, 10);
    CHECK(regions(tiles).empty());
    tiles.mark({14, 14, 16, 16}, 3);
    CHECK(regions(tiles) == std::vector<texel_rect>{{10, 10, 20, 20}});
    tiles.mark({44, 25, 47, 27}, 4);
    CHECK(regions(tiles) == std::vector<texel_rect>{{10, 10, 20, 20}, {40, 20, 50, 30}}); // 40 is the first column of 44 - 4
    tiles.mark({15, 15, 16, 16}, 2);
    CHECK(regions(tiles) == std::vector<texel_rect>{{0, 0, 50, 30}});
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
