// What flags of the compiler buy, which is to be nothing: lanes are compiled for each target, and the processor is asked which.
//
// Names are WHAT/KERNEL/SIZE, and all run in one process.
//     o2_plain, o3_native   flags/kernels.cpp at -O2 without -march, and at -O3 -march=native; with .avx2 behind it in those lanes
//     asked, unasked        on 64 x 64 texels simd<>, which asks each time, and the same lanes without
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

/// These lanes, and nobody asks whether the processor has them.
template <typename Isa> struct unasked {
    template <typename Texel, kernel Kernel>
    void filter_region(image_view<const Texel> from, image_view<Texel> to, texel_rect region,
                       filter_scratch<Texel, Kernel>& scratch) const noexcept {
        detail::filter_on<Isa, Kernel>(from, to, region, scratch.line());
    }
    template <typename Texel>
    void receive(strided_span<const Texel> texels, strided_span<const float> z, strided_span<float> intensity,
                 const rule& r) const noexcept {
        detail::receive_on<Isa>(texels, z, intensity, r);
    }
};

constexpr extent size{64, 64};

template <typename Backend> void add_small(const std::string& how) {
    benchmark::RegisterBenchmark((how + "/filter.u8x2.k9/64").c_str(), [](benchmark::State& state) {
        const image<rg8> from(size, rg8::caster(0.25f));
        image<rg8> to(size);
        filter_scratch<rg8, fast<gaussian<4>>> scratch(size.width);
        for ([[maybe_unused]] auto _ : state) {
            Backend{}.filter_region(from.view(), to.view(), whole(size), scratch);
            benchmark::ClobberMemory();
        }
    });
    const auto add_receive = [&how](const char* name, int calls) {
        benchmark::RegisterBenchmark((how + name).c_str(), [calls](benchmark::State& state) {
            constexpr extent row{size.width * size.height, 1};
            const image<rg8> map(row, rg8::caster(0.25f));
            const image<float> z(row, 0.5f);
            image<float> intensity(row);
            const int count = row.width / calls;
            for ([[maybe_unused]] auto _ : state) {
                for (int i = 0; i < calls; ++i)
                    Backend{}.receive(strided_span(&map(0, 0) + i * count, count), strided_span(&z(0, 0) + i * count, count),
                                      strided_span(&intensity(0, 0) + i * count, count), rule{});
                benchmark::ClobberMemory();
            }
        });
    };
    add_receive("/receive.u8x2/64", 1);
    add_receive("/receive.u8x2.by_rows/64", size.height);
}
} // namespace

int main(int count, char** words) {
    add("o2_plain", flags::o2_plain(flags::lanes::best));
    add("o3_native", flags::o3_native(flags::lanes::best));
    if (best_lanes() >= cpu_level::avx2) {
        add("o2_plain.avx2", flags::o2_plain(flags::lanes::avx2));
        add("o3_native.avx2", flags::o3_native(flags::lanes::avx2));
    }
    add_small<simd<>>("asked");
    detail::with_lanes(best_lanes(), []<typename Isa>() { add_small<unasked<Isa>>("unasked"); });
    benchmark::Initialize(&count, words);
    if (benchmark::ReportUnrecognizedArguments(count, words)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
