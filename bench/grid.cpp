// What the grid itself costs, 32 x 32 tiles of a map of 1024 x 1024 with a tenth of them under clusters of casters, and those that a radius
// of 4 texels reaches marked: nanoseconds, not ratios.
//
//     merge32    for_each_tile_rect: scan, and merge into rectangles
//     grow32     for_each_region_within four texels of the casters' tiles: what a filter asks
//     left32     for_each_region_left of the casters' last place, half a tile away: what is cleared
//     mark, clear, touches    one caster marked; all forgotten; one receiver asked
//     scan32     the floor of the first three: the ends of every run of marks, each row by itself, and nothing merged
//
// The counter `calls` tells how many there were. Of whole grids 64 take turns, so that no branch learns them.
#include <gnomon/grid/grown_regions.hpp>
#include <gnomon/grid/regions.hpp>

#include <benchmark/benchmark.h>

#include <bit>
#include <cstddef>
#include <random>
#include <vector>

namespace {
using namespace gnomon;

constexpr int side = 1024, tile = 32, radius = 4;

/// Boxes of 1 to 5 tiles a side, wherever they fall, until a tenth is covered: the casters of bench/sparse.cpp.
std::vector<texel_rect> clusters(int x_offset, unsigned seed = 1) {
    std::mt19937 dice(seed);
    const auto roll = [&dice](int first, int last) {
        return first + static_cast<int>(dice() % static_cast<unsigned>(last - first + 1));
    };
    std::vector<texel_rect> boxes;
    tile_grid covered({side / tile, side / tile}, 1);
    while (covered.count() * 10 < side / tile * side / tile) {
        const int width = roll(1, 5), height = roll(1, 5), x = roll(0, side / tile - width), y = roll(0, side / tile - height);
        covered.mark({x, y, x + width, y + height});
        boxes.push_back({x * tile + x_offset, y * tile, (x + width) * tile + x_offset, (y + height) * tile});
    }
    return boxes;
}
tile_grid marked(int x_offset, unsigned seed = 1) {
    tile_grid grid({side, side}, tile);
    for (const texel_rect r : clusters(x_offset, seed)) grid.mark(r, radius);
    return grid;
}

/// Runs `work`, so many calls, which answers something that depends on all they did.
template <typename Work> void add(const char* name, int calls, Work work) {
    benchmark::RegisterBenchmark(name, [work, calls](benchmark::State& state) {
        for (auto _ : state) benchmark::DoNotOptimize(work());
        state.counters["calls"] = calls;
    });
}
} // namespace

int main(int count, char** words) {
    constexpr int turns = 64;
    std::vector<tile_grid> before, now;
    for (unsigned seed = 1; seed <= turns; ++seed) {
        before.push_back(marked(tile / 2, seed));
        now.push_back(marked(0, seed));
    }
    const std::vector<texel_rect> casters = clusters(0);
    tile_grid grid({side, side}, tile);
    static_assert(side / tile <= bits_per_word); // a row is a word, and the next lies behind it
    add("scan32", turns, [&now] {
        int sum = 0;
        for (const tile_grid& each : now)
            for (const bit_word *at = each.row(0).words, *end = at + each.rows(); at != end; ++at)
                for (bit_word row = *at; row != 0;) {
                    const bit_word first = row & (~row + 1), rest = row + first; // past the run's end lies what it carries into
                    sum += std::countr_zero(first) + std::countr_zero(rest);
                    row &= rest;
                }
        return sum;
    });
    add("merge32", turns, [&now] {
        int sum = 0;
        for (const tile_grid& each : now) for_each_tile_rect(each, [&sum](tile_rect t) { sum += t.x0 + t.y1; });
        return sum;
    });
    add("grow32", turns, [&now] {
        int sum = 0;
        for (const tile_grid& each : now) for_each_region_within(each, radius, [&sum](texel_rect r) { sum += r.x0 + r.y1; });
        return sum;
    });
    add("left32", turns, [&] {
        int sum = 0;
        for (std::size_t i = 0; i < turns; ++i)
            for_each_region_left(before[i], now[i], radius, [&sum](texel_rect r) { sum += r.x0 + r.y1; });
        return sum;
    });
    add("mark", static_cast<int>(casters.size()), [&] {
        for (const texel_rect r : casters) grid.mark(r, radius);
        return grid.guard();
    });
    add("clear", 1, [&grid] {
        grid.clear();
        return grid.guard();
    });
    add("touches", static_cast<int>(casters.size()), [&] {
        int sum = 0;
        for (const texel_rect r : casters) sum += now[0].touches({r.x0 + side / 2, r.y0, r.x1 + side / 2, r.y1});
        return sum;
    });
    benchmark::Initialize(&count, words);
    if (benchmark::ReportUnrecognizedArguments(count, words)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
