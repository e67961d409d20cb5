// How long a decision takes: lanes against the scalar loop, against what memory allows, and against OpenCV's operations on arrays.
//
// Names are WHAT/FORMAT/SIZE, SIZE the side of the map, FORMAT the texel and the depth: u8x2.z16 is pairs of bytes, depths of 16 bits
// and intensities of 8. All run in one process.
//     scalar, simd, simd.avx2, simd.sse2     one receiver a texel, in rows
//     fields, fields.avx2, fields.scalar     the same as fields of structures, 12 bytes apart
//     copy                                   the floor: memcpy that moves as many bytes
//     points, points.avx2, points.scalar     one receiver a texel at positions of its own, side by side but turned a little
//     gather, gather.avx2                    the floor of these on bytes: two gathers of 32 bits and a store
//     vsm, pcf3, pcf5, pcf7 and .avx2        what other techniques ask in rows of floats, in our lanes: see ladder.inl
//     opencv.copied, opencv.multiplied       operations on planes in one thread, if CMake found OpenCV, of which the quicker counts
//     remap                                  cv::remap at the positions of points: it blends, and decides nothing
#include "floors.hpp"

#include <gnomon/backend/simd.hpp>

#include <benchmark/benchmark.h>

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <utility>
#include <vector>
#if GNOMON_X86
#include <immintrin.h>
#endif
#if GNOMON_BENCH_OPENCV
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#endif

#if GNOMON_X86
GNOMON_TARGET_BEGIN(GNOMON_AVX2)
#define LADDER_ON with_avx2
#include "ladder.inl"
#undef LADDER_ON
GNOMON_TARGET_END
GNOMON_TARGET_BEGIN(GNOMON_AVX512)
#define LADDER_ON with_avx512
#include "ladder.inl"
#undef LADDER_ON
GNOMON_TARGET_END
#endif

namespace {
using namespace gnomon;

template <typename F> void add(const std::string& what, const char* format, int size, std::size_t bytes, F&& work) {
    const std::string name = what + "/" + format + "/" + std::to_string(size);
    benchmark::RegisterBenchmark(name.c_str(), [work, bytes](benchmark::State& state) {
        work(state);
        state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
    });
}

std::size_t square(int size) { return static_cast<std::size_t>(size) * static_cast<std::size_t>(size); }

/// An image of so many squared in one row, which begins on a boundary of 64 bytes, as engines' buffers do; and all of such a row.
template <typename T> image<T> make_row(int size) { return image<T>({size * size, 1}); }
template <typename T> strided_span<T> row_of(image<T>& memory) { return memory.view().row_span(0); }
template <typename T> strided_span<const T> row_of(const image<T>& memory) { return memory.view().row_span(0); }

/// Penumbrae and receivers without any order, so that a branch cannot learn who is in shadow.
template <typename Texel, typename Depth> struct scene {
    image<Texel> texels;
    image<Depth> z;

    explicit scene(extent size) : texels(size), z({size.width * size.height, 1}) {
        std::mt19937 dice(1);
        const auto unit = [&dice] { return static_cast<double>(dice()) * 0x1p-32; };
        int next = 0;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x, ++next) {
                const double mask = unit();
                texels(x, y).stored[Texel::mask_index] = Texel::channel_type::encode(mask);
                texels(x, y).stored[Texel::depth_index] = Texel::channel_type::encode(mask * unit());
                if constexpr (Texel::effects.far_bound) {
                    const auto caster = static_cast<double>(Texel::channel_type::decode(texels(x, y).stored[Texel::depth_index]));
                    texels(x, y).stored[Texel::far_index] = Texel::channel_type::encode(caster * unit());
                }
                if constexpr (Texel::effects.translucency)
                    texels(x, y).stored[Texel::contribution_index] = Texel::channel_type::encode(mask * unit());
                const double depth = unit();
                if constexpr (std::same_as<Depth, float>)
                    z(next, 0) = static_cast<float>(depth);
                else
                    z(next, 0) = unorm16::encode(depth);
            }
    }
};

template <typename Texel, typename Depth, typename Intensity>
constexpr std::size_t bytes_of = sizeof(Texel) + sizeof(Depth) + sizeof(Intensity);

template <typename Backend, typename Texel, typename Depth, typename Intensity>
void add_ours(const char* what, const char* format, int size) {
    add(what, format, size, square(size) * bytes_of<Texel, Depth, Intensity>, [size](benchmark::State& state) {
        const scene<Texel, Depth> from({size * size, 1});
        auto intensity = make_row<Intensity>(size);
        floors::measure(state, [&] { receive(Backend{}, row_of(from.texels), row_of(from.z), row_of(intensity)); });
    });
}

template <typename Backend> void add_fields(const std::string& what, int size) {
    struct receiver {
        rg8 texel;
        std::uint16_t other;
        float z, intensity;
    };
    add(what, "u8x2.f32", size, square(size) * sizeof(receiver), [size](benchmark::State& state) {
        const scene<rg8, float> from({size * size, 1});
        std::vector<receiver> all(square(size));
        for (int i = 0; i < size * size; ++i) all[static_cast<std::size_t>(i)] = {from.texels(i, 0), 0, from.z(i, 0), 0.0f};
        const auto field = [&all](auto& first) { return strided_span(&first, static_cast<int>(all.size()), sizeof(receiver)); };
        floors::measure(state, [&] { receive(Backend{}, field(all[0].texel), field(all[0].z), field(all[0].intensity)); });
    });
}

template <typename Texel, typename Depth, typename Intensity>
void add_format(const char* format, std::initializer_list<int> sizes = {128, 1024, 4096}) {
    for (const int size : sizes) {
        add_ours<scalar, Texel, Depth, Intensity>("scalar", format, size);
        add_ours<simd<>, Texel, Depth, Intensity>("simd", format, size);
#if GNOMON_X86
        add_ours<simd<sse2>, Texel, Depth, Intensity>("simd.sse2", format, size);
        if (best_lanes() >= cpu_level::avx2) add_ours<simd<avx2>, Texel, Depth, Intensity>("simd.avx2", format, size);
#endif
        const auto half = square(size) * bytes_of<Texel, Depth, Intensity> / 2;
        add("copy", format, size, 2 * half, [half](benchmark::State& state) { floors::copy(state, half); });
    }
}

/// Positions as a camera sees them: neighbours are neighbours, a texel or so apart, and no row of them is a row of the map.
struct turned {
    image<float> x, y;
    explicit turned(int size) : x(make_row<float>(size)), y(make_row<float>(size)) {
        const float middle = static_cast<float>(size) / 2.0f;
        for (int j = 0; j < size; ++j)
            for (int i = 0; i < size; ++i) {
                const float right = static_cast<float>(i) - middle, down = static_cast<float>(j) - middle;
                x(j * size + i, 0) = middle + 0.6f * right - 0.3f * down;
                y(j * size + i, 0) = middle + 0.3f * right + 0.6f * down;
            }
    }
};

template <typename Backend, typename Texel> void add_points(const std::string& what, const char* format, int size) {
    add(what, format, size, square(size) * 16, [size](benchmark::State& state) {
        const scene<Texel, float> from({size, size});
        const turned at(size);
        auto intensity = make_row<float>(size);
        floors::measure(
            state, [&] { receive(Backend{}, from.texels.view(), row_of(at.x), row_of(at.y), row_of(from.z), row_of(intensity)); });
    });
}

/// Where gathers find what receivers need, in bytes; what else receivers read is only added up, and what they compute left out.
struct offsets {
    image<int> at, other, more;
    explicit offsets(int size) : at(make_row<int>(size)), other(make_row<int>(size)), more(make_row<int>(size)) {
        const turned p(size);
        const image<rg8> map({size, size});
        for (int i = 0; i < size * size; ++i)
            at(i, 0) =
                static_cast<int>(map.view().stride()) * static_cast<int>(p.y(i, 0) - 0.5f) + 2 * static_cast<int>(p.x(i, 0) - 0.5f);
    }
};

template <typename F> void add_gathers(const char* what, int size, F&& gather_twice) {
    add(what, "u8x2.f32", size, square(size) * 16, [size, gather_twice](benchmark::State& state) {
        const scene<rg8, float> from({size, size});
        const offsets where(size);
        auto found = make_row<int>(size);
        const auto* map = reinterpret_cast<const char*>(&from.texels(0, 0));
        floors::measure(state, [&] { gather_twice(map, from.texels.view().stride(), where, &found(0, 0), size * size); });
    });
}

#if GNOMON_X86
GNOMON_TARGET_BEGIN(GNOMON_AVX2)
void gather_twice_avx2(const char* map, std::ptrdiff_t row, const offsets& where, int* to, int count) {
    const int *at = &where.at(0, 0), *other = &where.other(0, 0), *more = &where.more(0, 0);
    const __m256i none = _mm256_setzero_si256(), all = _mm256_cmpeq_epi32(none, none);
    for (int i = 0; i < count; i += 8) {
        const __m256i offset = avx2::load(at + i);
        const __m256i above = _mm256_mask_i32gather_epi32(none, reinterpret_cast<const int*>(map), offset, all, 1);
        const __m256i below = _mm256_mask_i32gather_epi32(none, reinterpret_cast<const int*>(map + row), offset, all, 1);
        avx2::store(to + i, avx2::add32(avx2::add32(above, below), avx2::add32(avx2::load(other + i), avx2::load(more + i))));
    }
}
GNOMON_TARGET_END
GNOMON_TARGET_BEGIN(GNOMON_AVX512)
void gather_twice_avx512(const char* map, std::ptrdiff_t row, const offsets& where, int* to, int count) {
    const int *at = &where.at(0, 0), *other = &where.other(0, 0), *more = &where.more(0, 0);
    for (int i = 0; i < count; i += 16) {
        const __m512i offset = avx512::load(at + i), none = _mm512_setzero_si512();
        const __m512i above = _mm512_mask_i32gather_epi32(none, 0xFFFF, offset, map, 1);
        const __m512i below = _mm512_mask_i32gather_epi32(none, 0xFFFF, offset, map + row, 1);
        avx512::store(to + i,
                      avx512::add32(avx512::add32(above, below), avx512::add32(avx512::load(other + i), avx512::load(more + i))));
    }
}
GNOMON_TARGET_END
#endif

/// What is measured in the scalar loop, in the best lanes and in those of AVX2.
void add_all_places(int size) {
    const auto add_each = [size]<typename Backend>(Backend, const std::string& suffix) {
        add_fields<Backend>("fields" + suffix, size);
        add_points<Backend, rg8>("points" + suffix, "u8x2.f32", size);
        add_points<Backend, rg32f>("points" + suffix, "f32x2.f32", size);
        if (size != 1024) return;
        add_points<Backend, tm8>("points" + suffix, "tm8.f32", size);
        add_points<Backend, rgba8>("points" + suffix, "rgba8.f32", size);
        add_points<Backend, rgba16f>("points" + suffix, "rgba16f.f32", size);
    };
    add_each(scalar{}, ".scalar");
    add_each(simd<>{}, "");
#if GNOMON_X86
    if (best_lanes() >= cpu_level::avx2) add_each(simd<avx2>{}, ".avx2");
#endif
}

void add_all_gathers([[maybe_unused]] int size) {
#if GNOMON_X86
    if (best_lanes() < cpu_level::avx2) return;
    add_gathers("gather.avx2", size, gather_twice_avx2);
    if (best_lanes() >= cpu_level::avx512)
        add_gathers("gather", size, gather_twice_avx512);
    else
        add_gathers("gather", size, gather_twice_avx2);
#endif
}

#if GNOMON_X86
template <typename Vsm> void add_vsm(const std::string& suffix, int size, Vsm vsm) {
    add("vsm" + suffix, "f32x2.f32", size, square(size) * bytes_of<rg32f, float, float>, [size, vsm](benchmark::State& state) {
        const scene<rg32f, float> from({size * size, 1});
        auto intensity = make_row<float>(size);
        floors::measure(state, [&] { vsm(from.texels(0, 0).stored, &from.z(0, 0), &intensity(0, 0), size * size); });
    });
}
/// On one plane, with a border for the taps.
template <typename Pcf> void add_pcf(const std::string& suffix, int taps, int size, Pcf pcf) {
    add("pcf" + std::to_string(taps) + suffix, "f32x2.f32", size, square(size) * 3 * sizeof(float),
        [size, taps, pcf](benchmark::State& state) {
            const scene<rg32f, float> from({size, size});
            image<float> map({size + taps - 1, size + taps - 1}, 1.0f);
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) map(x + taps / 2, y + taps / 2) = caster_depth(from.texels(x, y));
            auto intensity = make_row<float>(size);
            const int stride = static_cast<int>(map.view().stride() / static_cast<std::ptrdiff_t>(sizeof(float)));
            floors::measure(state, [&] {
                for (int y = 0; y < size; ++y) pcf(&map(0, y), stride, &from.z(y * size, 0), &intensity(y * size, 0), size);
            });
        });
}
#endif
void add_ladder([[maybe_unused]] int size) {
#if GNOMON_X86
    if (best_lanes() < cpu_level::avx2) return;
    const auto add_with = [size](const std::string& suffix, auto vsm, auto pcf3, auto pcf5, auto pcf7) {
        add_vsm(suffix, size, vsm);
        add_pcf(suffix, 3, size, pcf3);
        add_pcf(suffix, 5, size, pcf5);
        add_pcf(suffix, 7, size, pcf7);
    };
    namespace two = ladder::with_avx2;
    namespace five = ladder::with_avx512;
    add_with(".avx2", two::vsm<avx2>, two::pcf<avx2, 3>, two::pcf<avx2, 5>, two::pcf<avx2, 7>);
    if (best_lanes() >= cpu_level::avx512)
        add_with("", five::vsm<avx512>, five::pcf<avx512, 3>, five::pcf<avx512, 5>, five::pcf<avx512, 7>);
    else
        add_with("", two::vsm<avx2>, two::pcf<avx2, 3>, two::pcf<avx2, 5>, two::pcf<avx2, 7>);
#endif
}

/// Planes, which is how OpenCV likes them best.
#if GNOMON_BENCH_OPENCV
struct planes {
    cv::Mat e, m, z, s, shadowed, intensity;
    explicit planes(int size)
        : e(size, size, CV_32F), m(size, size, CV_32F), z(size, size, CV_32F), s(size, size, CV_32F), shadowed(size, size, CV_8U),
          intensity(size, size, CV_32F) {
        const scene<rg32f, float> from({size, size});
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                e.at<float>(y, x) = from.texels(x, y).stored[0];
                m.at<float>(y, x) = from.texels(x, y).stored[1];
                z.at<float>(y, x) = from.z(y * size + x, 0);
            }
    }
    /// s = 1 - e/m, and where z > s there is the mask. As many branches as texels.
    void copied() {
        cv::divide(e, m, s);
        cv::subtract(1.0, s, s);
        cv::compare(z, s, shadowed, cv::CMP_GT);
        intensity.setTo(0.0);
        m.copyTo(intensity, shadowed);
    }
    /// The mask times 1 where e/m + z > 1, else times 0. No branch.
    void multiplied() {
        cv::divide(e, m, s);
        cv::add(s, z, s);
        cv::threshold(s, s, 1.0, 1.0, cv::THRESH_BINARY);
        cv::multiply(s, m, intensity);
    }
};

void add_opencv(int size) {
    for (const auto& [name, work] : {std::pair{"opencv.copied", &planes::copied}, {"opencv.multiplied", &planes::multiplied}})
        add(name, "f32x2.f32", size, square(size) * bytes_of<rg32f, float, float>, [size, work = work](benchmark::State& state) {
            cv::setNumThreads(1);
            planes all(size);
            floors::measure(state, [&] { (all.*work)(); });
        });
    add("remap", "u8x2.f32", size, square(size) * 16, [size](benchmark::State& state) {
        cv::setNumThreads(1);
        const scene<rg8, float> from({size, size});
        turned at(size);
        const auto row_bytes = static_cast<std::size_t>(from.texels.view().stride());
        const cv::Mat map(size, size, CV_8UC2, const_cast<rg8*>(&from.texels(0, 0)), row_bytes);
        const cv::Mat x(size, size, CV_32F, &at.x(0, 0)), y(size, size, CV_32F, &at.y(0, 0));
        cv::Mat blended(size, size, CV_8UC2);
        floors::measure(state, [&] { cv::remap(map, blended, x, y, cv::INTER_LINEAR, cv::BORDER_CONSTANT); });
    });
}
#else
void add_opencv(int) {}
#endif
} // namespace

int main(int count, char** words) {
    add_format<rg8, std::uint16_t, std::uint8_t>("u8x2.z16");
    add_format<rg8, float, float>("u8x2.f32");
    add_format<rga8, float, float>("u8x3.f32");
    add_format<rg16, std::uint16_t, std::uint16_t>("u16x2.z16");
    add_format<rg16, float, float>("u16x2.f32");
    add_format<rg32f, float, float>("f32x2.f32");
    add_format<rgb8, std::uint16_t, std::uint8_t>("rgb8.z16", {128, 1024});
    add_format<tm8, std::uint16_t, std::uint8_t>("tm8.z16", {128, 1024});
    add_format<rgba16f, float, float>("rgba16f.f32", {128, 1024});
    add_ladder(128);
    for (const int size : {128, 1024, 4096}) {
        add_all_places(size);
        add_all_gathers(size);
        add_opencv(size);
    }
    benchmark::Initialize(&count, words);
    if (benchmark::ReportUnrecognizedArguments(count, words)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
