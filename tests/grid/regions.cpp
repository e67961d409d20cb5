// Rectangles are judged by painting them: each set tile once, no other tile at all. What is fewest is found by search.
#include <gnomon/grid/regions.hpp>

#include "../support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace {
using gnomon::tile_grid;
using gnomon::tile_rect;
using rects = std::vector<tile_rect>;

rects merged(const tile_grid& grid) {
    rects found;
    for_each_tile_rect(grid, [&](tile_rect r) { found.push_back(r); });
    return found;
}
rects merged_greedily(const tile_grid& grid) {
    const auto words = static_cast<std::size_t>(gnomon::words_for(grid.columns())) * static_cast<std::size_t>(grid.rows());
    std::vector<gnomon::bit_word> scratch(words, 0xDEADBEEFDEADBEEFu); // whatever it held
    rects found;
    for_each_tile_rect_greedy(grid, scratch, [&](tile_rect r) { found.push_back(r); });
    return found;
}

bool cover_exactly(const tile_grid& grid, const rects& found) {
    std::vector<int> painted(static_cast<std::size_t>(grid.columns() * grid.rows()));
    for (const tile_rect r : found) {
        if (r.empty() || r.x0 < 0 || r.y0 < 0 || r.x1 > grid.columns() || r.y1 > grid.rows()) return false;
        for (int y = r.y0; y < r.y1; ++y)
            for (int x = r.x0; x < r.x1; ++x) ++painted[static_cast<std::size_t>(y * grid.columns() + x)];
    }
    for (int y = 0; y < grid.rows(); ++y)
        for (int x = 0; x < grid.columns(); ++x)
            if (painted[static_cast<std::size_t>(y * grid.columns() + x)] != (grid.test(x, y) ? 1 : 0)) return false;
    return true;
}

bool joinable(tile_rect a, tile_rect b) {
    const bool stacked = a.x0 == b.x0 && a.x1 == b.x1 && (a.y1 == b.y0 || b.y1 == a.y0);
    const bool abreast = a.y0 == b.y0 && a.y1 == b.y1 && (a.x1 == b.x0 || b.x1 == a.x0);
    return stacked || abreast;
}
bool none_joinable(const rects& found) {
    for (std::size_t i = 0; i < found.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (joinable(found[i], found[j])) return false;
    return true;
}
bool in_order(const rects& found) {
    return std::is_sorted(found.begin(), found.end(),
                          [](tile_rect a, tile_rect b) { return a.y0 != b.y0 ? a.y0 < b.y0 : a.x0 < b.x0; });
}
/// Every row of every rectangle is one whole run of its row.
bool whole_runs(const tile_grid& grid, const rects& found) {
    for (const tile_rect r : found)
        for (int y = r.y0; y < r.y1; ++y)
            if ((r.x0 > 0 && grid.test(r.x0 - 1, y)) || (r.x1 < grid.columns() && grid.test(r.x1, y))) return false;
    return true;
}

constexpr int side = 4, patterns = 1 << (side * side);

tile_grid pattern(int bits) {
    tile_grid grid({side, side}, 1);
    for (int i = 0; i < side * side; ++i)
        if ((bits >> i & 1) != 0) grid.mark({i % side, i / side, i % side + 1, i / side + 1});
    return grid;
}

/// The fewest rectangles that each pattern can be cut into. The first set tile is the first corner of one of them: try them all.
std::vector<int> fewest_rectangles() {
    std::vector<int> fewest(static_cast<std::size_t>(patterns));
    for (int bits = 1; bits < patterns; ++bits) {
        int first = 0, best = side * side;
        while ((bits >> first & 1) == 0) ++first;
        for (int y1 = first / side + 1; y1 <= side; ++y1)
            for (int x1 = first % side + 1; x1 <= side; ++x1) {
                int rect = 0;
                for (int y = first / side; y < y1; ++y)
                    for (int x = first % side; x < x1; ++x) rect |= 1 << (y * side + x);
                if ((bits & rect) == rect) best = std::min(best, 1 + fewest[static_cast<std::size_t>(bits ^ rect)]);
            }
        fewest[static_cast<std::size_t>(bits)] = best;
    }
    return fewest;
}
} // namespace

TEST_CASE("all 65,536 grids of 4 x 4 tiles are merged into disjoint rectangles that cover exactly the set tiles") {
    int inexact = 0, joinable_left = 0, unordered = 0, cut_runs = 0, greedy_inexact = 0;
    for (int bits = 0; bits < patterns; ++bits) {
        const tile_grid grid = pattern(bits);
        const rects found = merged(grid);
        inexact += !cover_exactly(grid, found);
        joinable_left += !none_joinable(found);
        unordered += !in_order(found);
        cut_runs += !whole_runs(grid, found);
        greedy_inexact += !cover_exactly(grid, merged_greedily(grid));
    }
    CHECK(inexact == 0);
    CHECK(joinable_left == 0);
    CHECK(unordered == 0);
    CHECK(cut_runs == 0);
    CHECK(greedy_inexact == 0);
}

TEST_CASE("how many rectangles: by equal runs, by the reference engine's greed, and the fewest possible, over all 4 x 4 grids") {
    const std::vector<int> fewest = fewest_rectangles();
    std::int64_t by_runs = 0, by_greed = 0, at_least = 0;
    int runs_at_best = 0, greed_at_best = 0, runs_worse = 0, greed_worse = 0, below = 0;
    std::int64_t rows_by_runs = 0, rows_by_greed = 0; // a filter sums a kernel's width of columns more for each row of a rectangle
    for (int bits = 0; bits < patterns; ++bits) {
        const tile_grid grid = pattern(bits);
        const int runs = static_cast<int>(merged(grid).size()), greed = static_cast<int>(merged_greedily(grid).size()),
                  best = fewest[static_cast<std::size_t>(bits)];
        for (const tile_rect r : merged(grid)) rows_by_runs += r.y1 - r.y0;
        for (const tile_rect r : merged_greedily(grid)) rows_by_greed += r.y1 - r.y0;
        by_runs += runs;
        by_greed += greed;
        at_least += best;
        runs_at_best += runs == best;
        greed_at_best += greed == best;
        runs_worse = std::max(runs_worse, runs - best);
        greed_worse = std::max(greed_worse, greed - best);
        below += runs < best || greed < best;
    }
    CHECK(below == 0);
    CHECK(at_least == 275'208);
    CHECK(by_runs == 287'744);
    CHECK(by_greed == 278'964);
    CHECK(runs_at_best == 53'495);
    CHECK(greed_at_best == 61'790);
    CHECK(runs_worse == 2);
    CHECK(greed_worse == 2);
    CHECK(rows_by_runs == patterns * side * 20 / 16); // the 16 patterns of a row hold 20 runs
    CHECK(rows_by_greed == 403'342);
}

#ifdef NDEBUG
TEST_CASE("without asserts, a greedy merge that has too little scratch merges by equal runs") {
    const tile_grid grid = pattern(0b0110'1111'0010'0010);
    std::vector<gnomon::bit_word> scratch(side - 1);
    rects found;
    for_each_tile_rect_greedy(grid, scratch, [&](tile_rect r) { found.push_back(r); });
    CHECK(found == merged(grid));
    CHECK(found != merged_greedily(grid));
}
#endif

TEST_CASE("grids of any size are merged exactly, also across the borders of words and of the map") {
    test::dice roll(31);
    for (int i = 0; i < 400; ++i) {
        const int tile = roll(1, 6);
        tile_grid grid({roll(1, 200) * tile - roll(0, tile - 1), roll(1, 40) * tile - roll(0, tile - 1)}, tile);
        const int sparseness = roll(1, 12);
        for (int y = 0; y < grid.rows(); ++y)
            for (int x = 0; x < grid.columns(); ++x)
                if (!roll.one_in(sparseness)) grid.mark(grid.texels_of({x, y, x + 1, y + 1}));
        for (int holes = roll(0, 1); holes > 0; --holes) grid.clear();
        const rects found = merged(grid);
        CHECK(cover_exactly(grid, found));
        CHECK(cover_exactly(grid, merged_greedily(grid)));
        CHECK(in_order(found));
        CHECK(whole_runs(grid, found));
        if (found.size() < 500) CHECK(none_joinable(found));

        std::size_t n = 0;
        int wrong = 0;
        for_each_region(grid, [&](gnomon::texel_rect r) { wrong += r != grid.texels_of(found[n++]) || r != clip(r, grid.size()); });
        CHECK(n == found.size());
        CHECK(wrong == 0);
    }
}

TEST_CASE("shapes in a few words: nothing, everything, a cross, a checkerboard") {
    tile_grid grid({96, 96}, 1);
    CHECK(merged(grid).empty());
    CHECK(merged_greedily(grid).empty());
    grid.mark({40, 20, 44, 70});
    grid.mark({10, 40, 90, 44});
    CHECK(merged(grid) == rects{{40, 20, 44, 40}, {10, 40, 90, 44}, {40, 44, 44, 70}});
    CHECK(merged_greedily(grid) == rects{{40, 20, 44, 70}, {10, 40, 40, 44}, {44, 40, 90, 44}});
    grid.mark(whole(grid.size()));
    CHECK(merged(grid) == rects{{0, 0, 96, 96}});
    CHECK(merged_greedily(grid) == rects{{0, 0, 96, 96}});
    grid = tile_grid({96, 40}, 1); // two words a row, and all rows in one
    grid.mark({0, 0, 1, 40});
    grid.mark({80, 10, 90, 30});
    CHECK(merged(grid) == rects{{0, 0, 1, 40}, {80, 10, 90, 30}});
    CHECK(merged_greedily(grid) == rects{{0, 0, 1, 40}, {80, 10, 90, 30}});
    grid = tile_grid({96, 96}, 1);
    for (int y = 0; y < 96; ++y)
        for (int x = y % 2; x < 96; x += 2) grid.mark({x, y, x + 1, y + 1});
    CHECK(merged(grid).size() == 96 * 96 / 2);
    CHECK(merged_greedily(grid).size() == 96 * 96 / 2);
}
