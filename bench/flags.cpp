// What flags of the compiler buy, which is to be nothing: lanes are compiled for each target, and the processor is asked which.
//
// Names are WHAT/KERNEL/SIZE, and all run in one process.
//     o2_plain, o3_native   flags/kernels.cpp at -O2 without -march, and at -O3 -march=native
//     asked, pinned         on 64 x 64 texels simd<>, which asks each time, and the same lanes by name
#include "flags/kernels.hpp"

#include <gnomon/backend/simd.hpp>

#include <benchmark/benchmark.h>

#include <string>

namespace {
using namespace gnomon;

void add(const char* build, std::span<const flags::kernel> kernels) {
    for (const flags::kernel& each : kernels)
        benchmark::RegisterBenchmark((std::string(build) + "/" + each.name + "/1024").c_str(), [each](benchmark::State& state) {
            each.run();
            for ([[maybe_unused]] auto _ : state) {
                each.run();
                benchmark::ClobberMemory();
            }
        });
}

constexpr extent size{64, 64};

template <typename Isa> void add_small(const std::string& how) {
    benchmark::RegisterBenchmark((how + "/filter.u8x2.k9/64").c_str(), [](benchmark::State& state) {
        const image<rg8> from(size, rg8::caster(0.25f));
        image<rg8> to(size);
        filter_scratch<rg8, fast<gaussian<4>>> scratch(size.width);
        for ([[maybe_unused]] auto _ : state) {
            simd<Isa>{}.filter_region(from.view(), to.view(), whole(size), scratch);
            benchmark::ClobberMemory();
        }
    });
    benchmark::RegisterBenchmark((how + "/receive.u8x2.rows/64").c_str(), [](benchmark::State& state) { // it asks 64 times
        const image<rg8> map(size, rg8::caster(0.25f));
        const image<float> z(size, 0.5f);
        image<float> intensity(size);
        for ([[maybe_unused]] auto _ : state) {
            for (int y = 0; y < size.height; ++y)
                receive(simd<Isa>{}, map.view().row_span(y), z.view().row_span(y), intensity.view().row_span(y));
            benchmark::ClobberMemory();
        }
    });
}
} // namespace

int main(int count, char** words) {
    add("o2_plain", flags::o2_plain());
    add("o3_native", flags::o3_native());
    add_small<best_isa>("asked");
    detail::with_lanes(best_lanes(), []<typename Isa>() { add_small<Isa>("pinned"); });
    benchmark::Initialize(&count, words);
    if (benchmark::ReportUnrecognizedArguments(count, words)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
