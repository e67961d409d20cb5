// What memory allows: the floors that several benches stand beside.
#pragma once

#include <gnomon/simd/region.hpp>

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstring>
#include <vector>
#if GNOMON_X86
#include <emmintrin.h>
#endif

namespace floors {

struct alignas(64) line {
    unsigned char byte[64];
};

/// Work that was done once before it is measured: then all memory is there, whosever it is.
template <typename Work> void measure(benchmark::State& state, Work&& work) {
    work();
    for ([[maybe_unused]] auto _ : state) {
        work();
        benchmark::ClobberMemory();
    }
}

/// memcpy of so many bytes. \pre a multiple of 64
inline void copy(benchmark::State& state, std::size_t bytes) {
    const std::vector<line> from(bytes / sizeof(line), line{{1}});
    std::vector<line> to(from.size());
    measure(state, [&] { std::memcpy(to.data(), from.data(), bytes); });
}

#if GNOMON_X86
/// Reading so many bytes, with stores that pass the caches by. \pre a multiple of 64
inline void stream(benchmark::State& state, std::size_t bytes) {
    const std::vector<line> from(bytes / sizeof(line), line{{1}});
    std::vector<line> to(from.size());
    measure(state, [&] {
        const auto* in = reinterpret_cast<const __m128i*>(from.data());
        auto* out = reinterpret_cast<__m128i*>(to.data());
        for (std::size_t i = 0; i < bytes / 16; ++i) _mm_stream_si128(out + i, _mm_load_si128(in + i));
    });
}
#endif

} // namespace floors
