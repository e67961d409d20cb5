// How many triangles go onto a map: lanes against the scalar rasteriser, by the size of a triangle.
//
// Names are WHAT/LIGHT/eEDGE/SIZE: triangles with legs of EDGE texels, as a terrain that fills a map of SIZE x SIZE rg8 once, so the
// smaller, the more; or 2000 needles all across it. LIGHT is a sun, or a spot lamp, which divides at every texel. All run in one process;
// clearing the map between two rounds is not timed. copy/eEDGE/SIZE is the floor: memcpy that moves as many bytes as the mesh and its
// map have.
#include "floors.hpp"

#include <gnomon/geometry/rasterize_lanes.hpp>
#include <gnomon/geometry/spot_light.hpp>

#include <benchmark/benchmark.h>

#include <cstdint>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace {
using namespace gnomon;

constexpr int side = 1024;

struct terrain {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    [[nodiscard]] triangle_mesh mesh() const { return {.positions = positions, .indices = indices}; }
};

/// Over [-1, 1]^2, in `cells` x `cells` quads of two triangles, row after row, as exporters write it.
terrain heights(int cells) {
    terrain t;
    std::mt19937 dice(1);
    const auto at = [cells](int i) { return 2.0f * static_cast<float>(i) / static_cast<float>(cells) - 1.0f; };
    for (int v = 0; v <= cells; ++v)
        for (int u = 0; u <= cells; ++u) t.positions.emplace_back(at(u), static_cast<float>(dice() % 1000) * 1e-6f, at(v));
    for (int v = 0; v < cells; ++v)
        for (int u = 0; u < cells; ++u) {
            const auto corner = [&](int du, int dv) { return static_cast<std::uint32_t>((v + dv) * (cells + 1) + u + du); };
            for (const std::uint32_t index : {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 0), corner(1, 1), corner(0, 1)})
                t.indices.push_back(index);
        }
    return t;
}

/// Triangles two texels wide and as long as the map, at any angle.
terrain needles(int count) {
    terrain t;
    std::mt19937 dice(2);
    const auto anywhere = [&dice] { return static_cast<float>(dice() % 2000) * 1e-3f - 1.0f; };
    for (int i = 0; i < count; ++i) {
        const glm::vec3 a(anywhere(), anywhere() * 0.01f, anywhere()), b(anywhere(), anywhere() * 0.01f, anywhere());
        for (const glm::vec3& p : {a, b, a + glm::vec3(4.0f / side, 0.0f, 4.0f / side)}) {
            t.indices.push_back(static_cast<std::uint32_t>(t.positions.size()));
            t.positions.push_back(p);
        }
    }
    return t;
}

/// [-1, 1]^2 on the whole map, a little turned, so that no edge lies on a row of centres.
light_frame sun() {
    const glm::dmat4 to_map(glm::dvec4(511.9, 3.1, 0.01, 0.0), glm::dvec4(20.0, 10.0, -0.5, 0.0),
                            glm::dvec4(-3.1, 511.9, 0.02, 0.0), glm::dvec4(512.0, 512.0, 0.5, 1.0));
    return {to_map, {side, side}, 1.0, 1.0};
}
light_frame lamp() {
    return spot_light{.position = {0.0, 1.5, 0.0},
                      .direction = {0.02, -1.0, 0.01},
                      .outer_angle = 0.588,
                      .near_plane = 0.5,
                      .far_plane = 2.5,
                      .up = {0, 0, 1}}
        .frame({side, side});
}

std::size_t bytes_of(const terrain& t) {
    return t.positions.size() * sizeof(t.positions[0]) + t.indices.size() * sizeof(t.indices[0]) +
           std::size_t{side} * side * sizeof(rg8);
}

template <typename Cast> void add(const std::string& what, const light_frame& light, const terrain& t, Cast cast) {
    benchmark::RegisterBenchmark(what.c_str(), [&t, light, cast](benchmark::State& state) {
        image<rg8> map({side, side}, rg8::clear());
        for ([[maybe_unused]] auto _ : state) {
            state.PauseTiming();
            map.view().fill(rg8::clear());
            state.ResumeTiming();
            cast(map.view(), t.mesh(), light);
            benchmark::ClobberMemory();
        }
        std::int64_t covered = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) covered += map(x, y).occupied() ? 1 : 0;
        state.counters["covered"] = static_cast<double>(covered) / (side * side);
        state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes_of(t)));
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(t.indices.size() / 3));
    });
}

void add_floor(const std::string& edge, const terrain& t) {
    benchmark::RegisterBenchmark(("copy/" + edge).c_str(), [&t](benchmark::State& state) {
        const std::size_t half = bytes_of(t) / 128 * 64;
        floors::copy(state, half);
        state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(2 * half));
    });
}

void add_all(const std::string& name, const light_frame& light, const terrain& t) {
    add("scalar/" + name, light, t, [](auto... given) { cast_triangles(given...); });
    add("simd/" + name, light, t, [](auto... given) { cast_triangles(simd<>{}, given...); });
#if GNOMON_X86
    add("simd.sse2/" + name, light, t, [](auto... given) { cast_triangles(simd<sse2>{}, given...); });
    if (best_lanes() >= cpu_level::avx2)
        add("simd.avx2/" + name, light, t, [](auto... given) { cast_triangles(simd<avx2>{}, given...); });
#endif
}
} // namespace

int main(int count, char** words) {
    std::vector<terrain> terrains;
    const int edges[] = {1, 2, 4, 8, 16, 64, 256};
    for (const int edge : edges) terrains.push_back(heights(side / edge));
    terrains.push_back(needles(2000));
    for (std::size_t i = 0; i < terrains.size(); ++i) {
        const std::string edge = (i < std::size(edges) ? "e" + std::to_string(edges[i]) : "needles") + "/" + std::to_string(side);
        add_floor(edge, terrains[i]);
        add_all("sun/" + edge, sun(), terrains[i]);
        add_all("lamp/" + edge, lamp(), terrains[i]);
    }
    benchmark::Initialize(&count, words);
    if (benchmark::ReportUnrecognizedArguments(count, words)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
