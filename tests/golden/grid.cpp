// Rectangles, tiles and their regions: whole numbers, but for the edges of real rectangles and the depths of tiles.
#include "golden.hpp"

#include <gnomon/geometry/scan.hpp>
#include <gnomon/grid/reference_grid.hpp>
#include <gnomon/receive/cull.hpp>

#include <array>
#include <vector>

namespace golden {
namespace {

hash marks(const tile_grid& grid) {
    hash h;
    h.add(grid.columns(), grid.rows(), grid.count(), grid.guard(), grid.bounds());
    for (int y = 0; y < grid.rows(); ++y)
        for (int w = 0; w < words_for(grid.columns()); ++w) h.add(grid.row(y).words[w]);
    return h;
}

constexpr std::array<extent, 6> map_sizes{extent{512, 512}, {61, 47}, {1, 1}, {2049, 33}, {4200, 17}, {0, 5}};

/// Calls f(grid, roll) for grids of every size, after each of some marks.
template <typename Grid, typename F> void for_each_grid(F&& f) {
    test::dice roll(100);
    for (const extent size : map_sizes)
        for (const int tile : {1, 7, 32}) {
            Grid grid(size, tile);
            for (int i = 0; i < 12; ++i) {
                const texel_rect r = roll.rect(size, 40);
                if constexpr (std::same_as<Grid, tile_grid>) {
                    grid.mark(r, roll(0, 9));
                } else {
                    const float nearest = roll.unit(), farthest = roll.unit();
                    grid.mark(r, {nearest, farthest}, roll(0, 9));
                }
                f(grid, roll);
            }
        }
}

} // namespace

void print_grid() {
    hash rectangles, marked, regions, greedy, dilated, touched, culled, reference, spans;
    test::dice roll(101);
    for (int i = 0; i < 10'000; ++i) {
        const texel_rect a = roll.rect({100, 80}, 30), b = roll.rect({100, 80}, 30);
        rectangles.add(intersection(a, b), union_box(a, b), grow(a, roll(-3, 40)), clip(a, {100, 80}));
        const double x0 = digits(roll, -3, 33), y0 = -digits(roll, -3, 33), x1 = x0 + digits(roll, -3, 33), y1 = -y0;
        rectangles.add(enclosing_texels(x0, y0, x1, y1), enclosing_texels(-x1, y0, -x0, y1));
    }
    print("rectangles", "-", "-", rectangles);

    for_each_grid<tile_grid>([&](const tile_grid& grid, test::dice& dice) {
        marked.add(marks(grid).value());
        for_each_region(grid, [&](texel_rect r) { regions.add(r); });
        std::vector<bit_word> scratch(static_cast<std::size_t>(words_for(grid.columns()) * grid.rows()));
        for_each_tile_rect_greedy(grid, scratch, [&](tile_rect r) { greedy.add(r); });
        tile_grid wider = grid;
        wider.dilate(dice(0, 3));
        dilated.add(marks(wider).value());
        for (int i = 0; i < 20; ++i) touched.add(grid.touches(dice.rect(grid.size(), 40)));
    });
    print("tile_grid_marks", "-", "-", marked);
    print("tile_grid_regions", "-", "-", regions);
    print("tile_grid_greedy_regions", "-", "-", greedy);
    print("tile_grid_dilate", "-", "-", dilated);
    print("tile_grid_touches", "-", "-", touched);

    for_each_grid<depth_tiles>([&](const depth_tiles& tiles, test::dice& dice) {
        for (int y = 0; y < tiles.tiles().rows(); y += 5)
            for (int x = 0; x < tiles.tiles().columns(); x += 5) culled.add(tiles.depth(x, y));
        for (int i = 0; i < 20; ++i) {
            const texel_rect r = dice.rect(tiles.tiles().size(), 40);
            const float nearest = dice.unit(), farthest = dice.unit();
            culled.add(tiles.touches(r, farthest), casters_reach(tiles, r, {nearest, farthest}),
                       casters_reach(tiles, r, {nearest, farthest}, {.towards = bias_towards::shadow}));
        }
    });
    print("depth_tiles_casters_reach", "-", "-", culled);

    for (const extent size : {extent{512, 512}, {640, 360}, {100, 77}})
        for (int radius = 0; radius < 6; ++radius) {
            reference_grid grid(size, radius);
            const auto any_rect = [&] {
                const double x0 = digits(roll, -2, 9) - 40.0, y0 = digits(roll, -2, 9) - 40.0;
                return real_rect{x0, y0, x0 + digits(roll, -2, 7), y0 + digits(roll, -2, 7)};
            };
            for (int i = 0; i < 10; ++i) {
                reference.add(grid.cast(any_rect()));
                reference.add(grid.receives(any_rect()));
                reference.add(grid.blur_scissor());
                for (int y = 0; y < reference_grid::side; ++y) reference.add(grid.row(y));
                grid.for_each_tile_rect([&](tile_rect r) { reference.add(r); });
            }
        }
    print("reference_grid", "-", "-", reference);

    for (int i = 0; i < 2'000; ++i) {
        std::array<detail::fixed_point, 8> corners{};
        for (detail::fixed_point& corner : corners) {
            const double x = digits(roll, -3, 8), y = digits(roll, -3, 8);
            corner = detail::fixed_point::nearest(x - 40.0, y - 40.0);
        }
        const int count = roll(3, 8);
        detail::scan(corners.data(), count, {0, 0, 100, 100}, [&](int y, int x0, int x1) { spans.add(y, x0, x1); });
    }
    print("scan", "-", "-", spans);
}

} // namespace golden
