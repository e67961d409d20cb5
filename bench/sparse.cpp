// What a frame costs that is mostly empty: filtering what clusters of casters reach, beside filtering the whole map.
//
// Names are WHAT/u8x2/k9/1024, the map is cut into 32 x 32 tiles, and all run in one process:
//     dense            the whole map
//     10pct, 50pct     of the tiles hold casters; the counter `area` is the share of the map within the radius of these
//     85pct            the same where that share is nearly so large (filter/sparse.hpp) that all of the map is filtered instead
//     frame.10pct ...  a frame of a soft_shadow_map where everything moved by half a tile: clear, mark, filter
//     empty            a frame without casters
// With .avx2 behind WHAT it is simd<avx2>.
#include "clusters.hpp"

#include <gnomon/backend/simd.hpp>
#include <gnomon/soft_shadow_map.hpp>

#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <vector>

namespace {
using namespace gnomon;

using texel = rg8;
using kernel_9 = eight_bit<gaussian<4>>;
constexpr int side = 1024, tile = 32, columns = side / tile;
constexpr extent size{side, side};

std::vector<tile_rect> clustered(int percent) { return clusters::covering(percent, columns); }

struct scene {
    image<texel> casters{size, texel::clear()};
    image<texel> soft{size, texel::clear()};
    tile_grid tiles{size, tile};
    filter_scratch<texel, kernel_9> scratch{side};

    explicit scene(int percent) {
        for (const tile_rect t : clustered(percent)) {
            tiles.mark(tiles.texels_of(t), kernel_9::radius);
            casters.view().fill(tiles.texels_of(t), texel::caster(static_cast<float>(t.x0) / columns));
        }
    }
    /// The share of the map that lies within the radius of a caster.
    [[nodiscard]] double grown() const { return clusters::grown_area(tiles, side, kernel_9::radius); }
};

/// Work on a share of the map, or on all of it, which is read and written.
template <typename F> void add(const std::string& what, F&& work) {
    benchmark::RegisterBenchmark((what + "/u8x2/k9/1024").c_str(), [work](benchmark::State& state) {
        const double share = work(state), bytes = 2.0 * side * side * sizeof(texel) * share;
        state.SetBytesProcessed(static_cast<std::int64_t>(static_cast<double>(state.iterations()) * bytes));
    });
}

template <typename Isa> void add_all(const std::string& suffix) {
    add("dense" + suffix, [](benchmark::State& state) {
        scene all(100);
        for ([[maybe_unused]] auto _ : state) {
            simd<Isa>{}.filter_region(image_view<const texel>(all.casters.view()), all.soft.view(), whole(size), all.scratch);
            benchmark::ClobberMemory();
        }
        return 1.0;
    });
    for (const int percent : {10, 50, 85}) {
        const std::string what = std::to_string(percent) + "pct" + suffix;
        add(what, [percent](benchmark::State& state) {
            scene some(percent);
            for ([[maybe_unused]] auto _ : state) {
                filter(simd<Isa>{}, some.casters.view(), some.soft.view(), some.tiles, some.scratch);
                benchmark::ClobberMemory();
            }
            state.counters["area"] = some.grown();
            return some.grown();
        });
        add("frame." + what, [percent](benchmark::State& state) {
            soft_shadow_map<texel, kernel_9, simd<Isa>> map({.width = side, .height = side, .tile = tile});
            const std::vector<tile_rect> boxes = clustered(percent);
            for (int frame = 0; [[maybe_unused]] auto _ : state) {
                map.clear();
                const int x = ++frame % 2 * tile / 2;
                for (const tile_rect t : boxes) {
                    const texel_rect r{t.x0 * tile + x, t.y0 * tile, t.x1 * tile + x, t.y1 * tile};
                    map.mark(r, {0.5f, 0.5f});
                }
                map.filter();
                benchmark::ClobberMemory();
            }
            return scene(percent).grown();
        });
    }
    add("empty" + suffix, [](benchmark::State& state) {
        soft_shadow_map<texel, kernel_9, simd<Isa>> map({.width = side, .height = side, .tile = tile});
        for ([[maybe_unused]] auto _ : state) {
            map.clear();
            map.filter();
            benchmark::ClobberMemory();
        }
        return 0.0;
    });
}
} // namespace

int main(int count, char** words) {
    add_all<best_isa>("");
#if GNOMON_X86
    if (best_lanes() >= cpu_level::avx2) add_all<avx2>(".avx2");
#endif
    benchmark::Initialize(&count, words);
    if (benchmark::ReportUnrecognizedArguments(count, words)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
