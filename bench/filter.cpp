// How long a Gaussian takes: the lanes of this processor, pinned and by themselves, against what memory allows and against OpenCV.
//
// Names are WHAT/FORMAT/kTAPS/SIZE, and all run in one process, so that their ratios mean something: bench/run prints these.
//     fast, exact               simd<>, fast<gaussian> and gaussian
//     fast.avx2, exact.avx2     simd<avx2>
//     box, box.avx2             the same of a box, of bytes and of floats; its peer is boxcv, cv::boxFilter
//     blur, sep                 cv::GaussianBlur and cv::sepFilter2D in one thread, if CMake found OpenCV
//     copy, stream              the floor: memcpy of the same bytes, and reading with stores that pass the caches by (kTAPS is k0)
//     work, work.avx2           the other floor: the products of fast, or of floats the sums, in registers and nothing else; k5 and k9
#include "floors.hpp"

#include <gnomon/backend/simd.hpp>

#include <benchmark/benchmark.h>

#include <string>
#if GNOMON_BENCH_OPENCV
#include <opencv2/imgproc.hpp>
#endif

#if GNOMON_X86
GNOMON_TARGET_BEGIN(GNOMON_AVX2)
#define ARITHMETIC_ON with_avx2
#include "arithmetic.inl"
#undef ARITHMETIC_ON
GNOMON_TARGET_END
GNOMON_TARGET_BEGIN(GNOMON_AVX512)
#define ARITHMETIC_ON with_avx512
#include "arithmetic.inl"
#undef ARITHMETIC_ON
GNOMON_TARGET_END
#endif

namespace {
using namespace gnomon;

constexpr int sizes[] = {256, 512, 1024, 2048, 4096};

template <typename Texel>
constexpr const char* format = std::same_as<Texel, rg8>    ? "u8x2"
                               : std::same_as<Texel, rg16> ? "u16x2"
                                                           : "f32x2";

template <typename F> void add(const std::string& what, const char* of, int taps, int size, std::size_t bytes, F&& work) {
    const std::string name = what + "/" + of + "/k" + std::to_string(taps) + "/" + std::to_string(size);
    benchmark::RegisterBenchmark(name.c_str(), [work, bytes](benchmark::State& state) {
        work(state);
        state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(2 * bytes)); // read and written
    });
}

/// Half the texels hold casters, at depths that are floats, as boxes of floats want them: else no time depends on what a map holds.
template <typename Texel> image<Texel> discs(int size) {
    image<Texel> map({size, size}, Texel::clear());
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            if ((x % 64 - 32) * (x % 64 - 32) + (y % 64 - 32) * (y % 64 - 32) < 650)
                map(x, y) = Texel::caster(static_cast<float>(x % 200) / 200.0f);
    return map;
}

template <typename Isa, kernel Kernel, typename Texel> void add_ours(const std::string& what, int size) {
    const auto bytes = static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * sizeof(Texel);
    add(what, format<Texel>, 2 * Kernel::radius + 1, size, bytes, [size](benchmark::State& state) {
        const image<Texel> from = discs<Texel>(size);
        image<Texel> to(from.size(), Texel::clear());
        filter_scratch<Texel, Kernel> scratch(size);
        floors::measure(state, [&] { simd<Isa>{}.filter_region(from.view(), to.view(), whole(from.size()), scratch); });
    });
}

#if GNOMON_BENCH_OPENCV
template <typename Texel, int Taps, typename F> void add_cv(const char* what, int size, F&& filter) {
    constexpr int type = std::same_as<Texel, rg8> ? CV_8UC2 : std::same_as<Texel, rg16> ? CV_16UC2 : CV_32FC2;
    const auto bytes = static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * sizeof(Texel);
    add(what, format<Texel>, Taps, size, bytes, [size, filter](benchmark::State& state) {
        cv::setNumThreads(1);
        image<Texel> map = discs<Texel>(size);
        const cv::Mat from(size, size, type, &map(0, 0), static_cast<std::size_t>(map.view().stride()));
        cv::Mat to(size, size, type);
        floors::measure(state, [&] { filter(from, to); });
    });
}
#endif

template <kernel Kernel, typename Texel> void add_all(int size) {
    add_ours<best_isa, fast<Kernel>, Texel>("fast", size);
    add_ours<best_isa, Kernel, Texel>("exact", size);
#if GNOMON_X86
    if (best_lanes() >= cpu_level::avx2) {
        add_ours<avx2, fast<Kernel>, Texel>("fast.avx2", size);
        add_ours<avx2, Kernel, Texel>("exact.avx2", size);
    }
#endif
#if GNOMON_BENCH_OPENCV
    constexpr int taps = 2 * Kernel::radius + 1;
    const cv::Mat weights = cv::getGaussianKernel(taps, Kernel::radius / 2.0, CV_32F);
    add_cv<Texel, taps>("blur", size, [](const cv::Mat& from, cv::Mat& to) {
        cv::GaussianBlur(from, to, {taps, taps}, Kernel::radius / 2.0, Kernel::radius / 2.0, cv::BORDER_CONSTANT);
    });
    add_cv<Texel, taps>("sep", size, [weights](const cv::Mat& from, cv::Mat& to) {
        cv::sepFilter2D(from, to, -1, weights, weights, {-1, -1}, 0.0, cv::BORDER_CONSTANT);
    });
#endif
}

template <typename Texel> void add_floor(int size) {
    const auto bytes = static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * sizeof(Texel);
    add("copy", format<Texel>, 0, size, bytes, [bytes](benchmark::State& state) { floors::copy(state, bytes); });
#if GNOMON_X86
    add("stream", format<Texel>, 0, size, bytes, [bytes](benchmark::State& state) { floors::stream(state, bytes); });
#endif
}

#if GNOMON_X86
/// What fast asks of a register of texels: bytes go in pairs of taps through columns of 16 bits and rows of 32, 16-bit codes through 32
/// both times, and of floats the sums, 2R a pass, are more than the products, which other units make.
template <typename Texel> constexpr int operations(int taps) {
    return std::same_as<Texel, rg32f> ? 2 * (taps - 1) : (sizeof(Texel) == 2 ? 3 : 2) * (taps + 1);
}
template <typename Isa, typename Texel> void add_work(const std::string& what, int size, void (*calculate)(std::int64_t)) {
    const auto bytes = static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * sizeof(Texel);
    for (const int taps : {5, 9}) {
        const auto count = static_cast<std::int64_t>(bytes) / Isa::bytes * operations<Texel>(taps);
        add(what, format<Texel>, taps, size, bytes, [count, calculate](benchmark::State& state) {
            for ([[maybe_unused]] auto _ : state) calculate(count);
        });
    }
}
#endif

/// Boxes: box and box.avx2, and OpenCV's.
template <kernel Kernel, typename Texel> void add_box(int size) {
    add_ours<best_isa, Kernel, Texel>("box", size);
#if GNOMON_X86
    if (best_lanes() >= cpu_level::avx2) add_ours<avx2, Kernel, Texel>("box.avx2", size);
#endif
#if GNOMON_BENCH_OPENCV
    add_cv<Texel, 2 * Kernel::radius + 1>("boxcv", size, [](const cv::Mat& from, cv::Mat& to) {
        constexpr int taps = 2 * Kernel::radius + 1;
        cv::boxFilter(from, to, -1, {taps, taps}, {-1, -1}, true, cv::BORDER_CONSTANT);
    });
#endif
}

template <typename Texel> void add_format() {
    for (const int size : sizes) {
        add_floor<Texel>(size);
#if GNOMON_X86
        using namespace floors;
        constexpr bool floats = std::same_as<Texel, rg32f>;
        const auto add_avx2 = [size](const char* what) {
            add_work<avx2, Texel>(what, size, floats ? with_avx2::sums<avx2> : with_avx2::products<avx2>);
        };
        if (best_lanes() >= cpu_level::avx2) {
            add_avx2("work.avx2");
            if (best_lanes() >= cpu_level::avx512)
                add_work<avx512, Texel>("work", size, floats ? with_avx512::sums<avx512> : with_avx512::products<avx512>);
            else
                add_avx2("work");
        }
#endif
        add_all<gaussian<1>, Texel>(size);
        add_all<gaussian<2>, Texel>(size);
        add_all<gaussian<3>, Texel>(size);
        add_all<gaussian<4>, Texel>(size);
        add_all<gaussian<6>, Texel>(size);
        add_all<gaussian<16>, Texel>(size);
    }
}
} // namespace

int main(int count, char** words) {
    add_format<rg8>();
    add_format<rg16>();
    add_format<rg32f>();
    for (const int size : sizes) {
        add_box<box<1>, rg8>(size);
        add_box<box<4>, rg8>(size);
        add_box<box<8>, rg8>(size);
        add_box<box<32>, rg8>(size);
        add_box<box<8>, rg32f>(size);
        add_box<box<32>, rg32f>(size);
    }
    benchmark::Initialize(&count, words);
    if (benchmark::ReportUnrecognizedArguments(count, words)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
