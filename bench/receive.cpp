// How long a decision takes, receivers one to one on texels: lanes against the scalar loop and against what memory allows.
//
// Names are WHAT/FORMAT/SIZE, SIZE the side of the map, and all run in one process. The floor is a copy that moves as many bytes.
#include <gnomon/backend/simd.hpp>

#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace {
using namespace gnomon;

template <typename F> void add(const std::string& what, const char* format, int size, std::size_t bytes, F&& work) {
    const std::string name = what + "/" + format + "/" + std::to_string(size);
    benchmark::RegisterBenchmark(name.c_str(), [work, bytes](benchmark::State& state) {
        work(state);
        state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
    });
}

/// Casters and receivers without any order, so that a branch cannot learn who is in shadow.
template <typename Texel, typename Backend> void add_ours(const char* what, const char* format, int size) {
    const auto count = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    add(what, format, size, count * (sizeof(Texel) + 2 * sizeof(float)), [count](benchmark::State& state) {
        std::mt19937 dice(1);
        std::vector<Texel> texels;
        std::vector<float> z, intensity(count);
        while (texels.size() < count) {
            texels.push_back(Texel::caster(static_cast<float>(dice() % 256) / 255.0f));
            z.push_back(static_cast<float>(dice() % 1000) / 1000.0f);
        }
        for ([[maybe_unused]] auto _ : state) {
            receive(Backend{}, texels, z, intensity);
            benchmark::ClobberMemory();
        }
    });
}

template <typename Texel> void add_format(const char* format) {
    for (const int size : {128, 256, 1024}) {
        add_ours<Texel, scalar>("scalar", format, size);
        add_ours<Texel, simd<>>("simd", format, size);
#if GNOMON_X86
        add_ours<Texel, simd<sse2>>("simd.sse2", format, size);
        if (best_lanes() >= cpu_level::avx2) add_ours<Texel, simd<avx2>>("simd.avx2", format, size);
#endif
        const auto half = static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * (sizeof(Texel) + 2 * sizeof(float)) / 2;
        add("copy", format, size, 2 * half, [half](benchmark::State& state) {
            const std::vector<unsigned char> from(half, 1);
            std::vector<unsigned char> to(half);
            for ([[maybe_unused]] auto _ : state) {
                std::memcpy(to.data(), from.data(), half);
                benchmark::ClobberMemory();
            }
        });
    }
}
} // namespace

int main(int count, char** words) {
    add_format<rg8>("u8x2");
    add_format<rg16>("u16x2");
    benchmark::Initialize(&count, words);
    if (benchmark::ReportUnrecognizedArguments(count, words)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
