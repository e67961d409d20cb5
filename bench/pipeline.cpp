// What a frame costs from casters to light: the whole map filtered, and a receiver on each texel decided, against moving the bytes.
//
// Names are WHAT/u8x2/k9/1024, and all run in one process:
//     both             filter, then receive depths of 16 bits into bytes; with .avx2 behind it by simd<avx2>
//     copy, stream     the filter's floor: memcpy of the map, and reading it with stores that pass the caches by
//     receive.copy     the receivers' floor: a memcpy that moves as many bytes
#include "floors.hpp"

#include <gnomon/backend/simd.hpp>

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace {
using namespace gnomon;

using texel = rg8;
using kernel_9 = eight_bit<gaussian<4>>;
using depth_code = std::uint16_t;
using intensity_code = std::uint8_t;
constexpr int side = 1024;
constexpr extent size{side, side};
constexpr std::size_t texels = std::size_t{side} * side;

constexpr std::size_t filtered = texels * sizeof(texel), ///< and written again
    received = texels * (sizeof(texel) + sizeof(depth_code) + sizeof(intensity_code));

template <typename F> void add(const std::string& what, std::size_t bytes, F&& work) {
    benchmark::RegisterBenchmark((what + "/u8x2/k9/1024").c_str(), [work, bytes](benchmark::State& state) {
        work(state);
        state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
    });
}

template <typename Isa> void add_pipeline(const char* what) {
    add(what, 2 * filtered + received, [](benchmark::State& state) {
        image<texel> casters(size, texel::clear()), soft(size, texel::clear());
        image<depth_code> z(size);
        image<intensity_code> intensity(size);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                if ((x / 32 + y / 32) % 2 == 0) casters(x, y) = texel::caster(static_cast<float>(x) / side);
                z(x, y) = unorm16::encode(static_cast<float>(y) / side);
            }
        filter_scratch<texel, kernel_9> scratch(side);
        floors::measure(state, [&] {
            simd<Isa>{}.filter_region(image_view<const texel>(casters.view()), soft.view(), whole(size), scratch);
            receive(simd<Isa>{}, soft.view(), z.view(), intensity.view());
        });
    });
}

void add_copy(const char* what, std::size_t bytes) {
    add(what, 2 * bytes, [bytes](benchmark::State& state) { floors::copy(state, bytes); });
}

#if GNOMON_X86
void add_avx2() {
    if (best_lanes() >= cpu_level::avx2) add_pipeline<avx2>("both.avx2");
}
void add_stream() {
    add("stream", 2 * filtered, [](benchmark::State& state) { floors::stream(state, filtered); });
}
#else
void add_avx2() {}
void add_stream() {}
#endif
void add_all() {
    add_pipeline<best_isa>("both");
    add_avx2();
    add_copy("copy", filtered);
    add_stream();
    add_copy("receive.copy", received / 2);
}
} // namespace

int main(int count, char** words) {
    add_all();
    benchmark::Initialize(&count, words);
    if (benchmark::ReportUnrecognizedArguments(count, words)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
