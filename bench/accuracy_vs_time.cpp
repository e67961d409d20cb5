// What accuracy costs in time: every texel format through filter and receive, exactly and fast, with its error beside its nanoseconds.
//
// Errors are of 16 discs, each alone in its footprints; times of a map that is half covered, with receivers at any depth, since loops
// that look at their texels are soon done with empty ones. Copying the same bytes is the floor, in the same run. Use
// --benchmark_enable_random_interleaving=true and --benchmark_repetitions=9, and compare medians of cpu time within one run only.
// Counters: bytes (a texel), rmse and worst (intensity against the exact filter in double, receivers 2 % of the range behind their
// caster, bias towards light; with suffix _shadow, towards shadow), tiles (share of the map that was filtered).
#include <gnomon/gnomon.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace {

using namespace gnomon;
using exact = gaussian<4>;
using quick = fast<exact>;

constexpr extent size{1024, 1024};
constexpr float gap = 0.02f;

struct disc {
    int x, y, radius;
    float depth;
};

/// Discs far enough apart for every footprint to hold one depth: then the method is exact, and what is left is storage.
std::vector<disc> scene() {
    std::vector<disc> discs;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            discs.push_back({96 + 256 * column, 96 + 256 * row, 12 + 4 * row + 9 * column,
                             0.1f + 0.05f * static_cast<float>(4 * row + column)});
    return discs;
}

bool covers(const disc& d, int x, int y) { return (x - d.x) * (x - d.x) + (y - d.y) * (y - d.y) < d.radius * d.radius; }

texel_rect box_of(const disc& d) { return {d.x - d.radius, d.y - d.radius, d.x + d.radius + 1, d.y + d.radius + 1}; }

template <typename Texel, typename Kernel> void cast_scene(soft_shadow_map<Texel, Kernel>& map) {
    for (const disc& d : scene()) {
        const texel_rect box = box_of(d);
        for (int y = box.y0; y < box.y1; ++y)
            for (int x = box.x0; x < box.x1; ++x)
                if (covers(d, x, y)) map.casters()(x, y).cast(Texel::caster(d.depth));
        map.mark(box, {d.depth, d.depth});
    }
}

double exact_mask(const disc& d, int x, int y) {
    double sum = 0.0;
    for (int j = -exact::radius; j <= exact::radius; ++j)
        for (int i = -exact::radius; i <= exact::radius; ++i)
            if (covers(d, x + i, y + j))
                sum += 1.0 * exact::weights[static_cast<std::size_t>(i + exact::radius)] *
                       exact::weights[static_cast<std::size_t>(j + exact::radius)];
    return sum / (1.0 * exact::total * exact::total);
}

template <typename Texel, typename Kernel>
void report_error(benchmark::State& state, soft_shadow_map<Texel, Kernel>& map, bias towards, const char* rmse, const char* worst) {
    map.decision.caster = towards;
    map.decision.caster.roundings = filter_roundings<Texel, Kernel>;
    double squares = 0.0, largest = 0.0;
    std::size_t count = 0;
    for (const disc& d : scene()) {
        const texel_rect reach = grow(box_of(d), exact::radius);
        for (int y = reach.y0; y < reach.y1; ++y)
            for (int x = reach.x0; x < reach.x1; ++x, ++count) {
                const double error = static_cast<double>(map.shadow(x, y, d.depth + gap)) - exact_mask(d, x, y);
                squares += error * error;
                largest = std::max(largest, std::abs(error));
            }
    }
    state.counters[rmse] = std::sqrt(squares / static_cast<double>(count));
    state.counters[worst] = largest;
}

template <typename Texel, typename Kernel> void report(benchmark::State& state, soft_shadow_map<Texel, Kernel>& map) {
    report_error(state, map, towards_light, "rmse", "worst");
    report_error(state, map, towards_shadow, "rmse_shadow", "worst_shadow");
    state.counters["bytes"] = sizeof(Texel);
    state.SetItemsProcessed(state.iterations() * size.width * size.height);
}

template <typename Texel> image<Texel> half_covered() {
    image<Texel> casters(size, Texel::clear());
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            if (covers({32, 32, 26, 0.0f}, x % 64, y % 64)) casters(x, y).cast(Texel::caster(static_cast<float>(x + y) * 0x1p-11f));
    return casters;
}

template <typename Texel, typename Kernel> void filter_whole(benchmark::State& state) {
    soft_shadow_map<Texel, Kernel> map({size.width, size.height});
    cast_scene(map);
    map.filter();
    const image<Texel> casters = half_covered<Texel>();
    image<Texel> result(size);
    filter_scratch<Texel, Kernel> scratch(size.width);
    for (auto _ : state) {
        simd<>{}.filter_region(casters.view(), result.view(), whole(size), scratch);
        benchmark::ClobberMemory();
    }
    report(state, map);
}

template <typename Texel, typename Kernel> void filter_tiles(benchmark::State& state) {
    soft_shadow_map<Texel, Kernel> map({size.width, size.height});
    cast_scene(map);
    for (auto _ : state) {
        map.filter();
        benchmark::ClobberMemory();
    }
    report(state, map);
    state.counters["tiles"] = map.tiles().tiles().count() / (1.0 * map.tiles().tiles().columns() * map.tiles().tiles().rows());
}

template <typename Texel, typename Kernel> void receive_rows(benchmark::State& state) {
    soft_shadow_map<Texel, Kernel> map({size.width, size.height});
    cast_scene(map);
    map.filter();
    const image<Texel> casters = half_covered<Texel>();
    image<Texel> soft(size);
    filter_scratch<Texel, Kernel> scratch(size.width);
    simd<>{}.filter_region(casters.view(), soft.view(), whole(size), scratch);
    std::minstd_rand dice;
    std::vector<float> z(static_cast<std::size_t>(size.width)), intensity(z.size());
    for (float& each : z) each = static_cast<float>(dice()) * 0x1p-31f;
    for (auto _ : state)
        for (int y = 0; y < size.height; ++y) {
            receive(simd<>{}, soft.view().row_span(y), z, intensity);
            benchmark::DoNotOptimize(intensity.data());
            benchmark::ClobberMemory();
        }
    report(state, map);
}

template <typename Texel> void copy_floor(benchmark::State& state) {
    const image<Texel> from(size);
    image<Texel> to(size);
    const auto bytes = static_cast<std::size_t>(from.view().stride()) * static_cast<std::size_t>(size.height);
    for (auto _ : state) {
        std::memcpy(to.view().data(), from.view().data(), bytes);
        benchmark::ClobberMemory();
    }
    state.counters["bytes"] = sizeof(Texel);
    state.SetItemsProcessed(state.iterations() * size.width * size.height);
}

} // namespace

#define GNOMON_BENCH_FORMAT(texel)                                                                                                 \
    BENCHMARK_TEMPLATE(copy_floor, texel);                                                                                         \
    BENCHMARK_TEMPLATE(filter_whole, texel, exact);                                                                                \
    BENCHMARK_TEMPLATE(filter_whole, texel, quick);                                                                                \
    BENCHMARK_TEMPLATE(filter_tiles, texel, exact);                                                                                \
    BENCHMARK_TEMPLATE(filter_tiles, texel, quick);                                                                                \
    BENCHMARK_TEMPLATE(receive_rows, texel, exact)

using paper8 = texel<unorm8, paper_depth_mask>;
using paper16f = texel<half16, paper_depth_mask>;

GNOMON_BENCH_FORMAT(rg8);
GNOMON_BENCH_FORMAT(tm8);
GNOMON_BENCH_FORMAT(tm16);
GNOMON_BENCH_FORMAT(rgba8);
GNOMON_BENCH_FORMAT(rg16);
GNOMON_BENCH_FORMAT(rg16f);
GNOMON_BENCH_FORMAT(rg32f);
GNOMON_BENCH_FORMAT(paper8);
GNOMON_BENCH_FORMAT(paper16f);

BENCHMARK_MAIN();
