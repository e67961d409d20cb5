// How much faster two threads are: the same work on one and on two of the example's pool, by the clock on the wall.
//
// Names are WHAT/THREADS/u8x2/k9/1024/real_time; WHAT is
//     filter, sparse   the whole map, and half of it in tiles
//     receive          an image of receivers, one to one
// With .avx2 behind WHAT it is simd<avx2>.
#include "../examples/jthread_pool.hpp"

#include <gnomon/backend/executor.hpp>
#include <gnomon/backend/simd.hpp>

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace {
using namespace gnomon;

using texel = rg8;
using kernel_9 = eight_bit<gaussian<4>>;
constexpr int side = 1024, tile = 32;
constexpr extent size{side, side};

struct scene {
    image<texel> casters{size, texel::clear()};
    image<texel> soft{size, texel::clear()};
    image<float> z{size, 0.5f};
    image<float> intensity{size};
    tile_grid tiles{size, tile};
    band_scratch<texel, kernel_9> scratch{side};

    scene() {
        for (int y = 0; y < side; y += 4 * tile)
            for (int x = 0; x < side; x += 4 * tile) {
                const texel_rect r{x, y, x + 3 * tile, y + 2 * tile + tile / 2};
                casters.view().fill(r, texel::caster(static_cast<float>(x) / side));
                tiles.mark(r, kernel_9::radius);
            }
    }
};

template <typename Work> void add(const std::string& what, std::size_t bytes, Work work) {
    for (const unsigned threads : {1u, 2u}) {
        const std::string name = what + "/" + std::to_string(threads) + "/u8x2/k9/1024";
        benchmark::RegisterBenchmark(name.c_str(), [work, bytes, threads](benchmark::State& state) {
            scene s;
            jthread_pool pool(threads);
            for ([[maybe_unused]] auto _ : state) {
                work(s, pool);
                benchmark::ClobberMemory();
            }
            state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
        })->UseRealTime();
    }
}

template <typename Isa> void add_all(const std::string& suffix) {
    static constexpr simd<Isa> run;
    constexpr std::size_t texels = std::size_t{side} * side, filtered = 2 * texels * sizeof(texel); // read and written
    add("filter" + suffix, filtered,
        [](scene& s, jthread_pool& pool) { filter(run, s.casters.view(), s.soft.view(), whole(size), s.scratch, pool); });
    add("sparse" + suffix, filtered / 2, // about
        [](scene& s, jthread_pool& pool) { filter(run, s.casters.view(), s.soft.view(), s.tiles, s.scratch, pool); });
    add("receive" + suffix, texels * (sizeof(texel) + 2 * sizeof(float)),
        [](scene& s, jthread_pool& pool) { receive(run, s.soft.view(), s.z.view(), s.intensity.view(), {}, pool); });
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
