// GNOMON_BENCH_BUILD: the name of the build, o2_plain or o3_native.
#include "kernels.hpp"

#include <gnomon/backend/simd.hpp>

#include <random>

namespace {
using namespace gnomon;

constexpr extent size{1024, 1024};

/// Penumbrae and receivers without any order.
template <typename Texel> struct scene {
    image<Texel> map{size}, soft{size};
    image<float> x{size}, y{size}, z{size}, intensity{size};
    image<std::uint16_t> z16{size};
    image<std::uint8_t> intensity8{size};

    scene() {
        std::mt19937 dice(1);
        const auto unit = [&dice] { return static_cast<double>(dice()) * 0x1p-32; };
        for (int row = 0; row < size.height; ++row)
            for (int column = 0; column < size.width; ++column) {
                const double mask = unit();
                map(column, row).stored[Texel::mask_index] = Texel::channel_type::encode(mask);
                map(column, row).stored[Texel::depth_index] = Texel::channel_type::encode(mask * unit());
                x(column, row) = static_cast<float>(column + unit());
                y(column, row) = static_cast<float>(row + unit());
                z(column, row) = static_cast<float>(unit());
                z16(column, row) = unorm16::encode(unit());
            }
    }
};
template <typename Texel> scene<Texel>& scene_of() {
    static scene<Texel> one;
    return one;
}

template <typename Isa, typename Texel, kernel Kernel> void blur() {
    static filter_scratch<Texel, Kernel> scratch(size.width);
    scene<Texel>& s = scene_of<Texel>();
    simd<Isa>{}.filter_region(s.map.view(), s.soft.view(), whole(size), scratch);
}
/// Row by row.
template <typename Isa, typename... Images> void receive_rows(Images&... images) {
    for (int y = 0; y < size.height; ++y) receive(simd<Isa>{}, images.view().row_span(y)...);
}
template <typename Isa, typename Texel> void decide() {
    scene<Texel>& s = scene_of<Texel>();
    receive_rows<Isa>(s.map, s.z, s.intensity);
}
template <typename Isa> void decide_codes() {
    scene<rg8>& s = scene_of<rg8>();
    receive_rows<Isa>(s.map, s.z16, s.intensity8);
}
template <typename Isa> void decide_at_points() {
    scene<rg8>& s = scene_of<rg8>();
    for (int y = 0; y < size.height; ++y)
        receive(simd<Isa>{}, s.map.view(), s.x.view().row_span(y), s.y.view().row_span(y), s.z.view().row_span(y),
                s.intensity.view().row_span(y));
}

template <typename Isa>
constexpr flags::kernel kernels[] = {
    {"filter.u8x2.k5", blur<Isa, rg8, fast<gaussian<2>>>},
    {"filter.u8x2.k9", blur<Isa, rg8, fast<gaussian<4>>>},
    {"filter.u8x2.k9.exact", blur<Isa, rg8, gaussian<4>>},
    {"filter.u8x2.k33", blur<Isa, rg8, fast<gaussian<16>>>},
    {"filter.box.u8x2.r32", blur<Isa, rg8, box<32>>},
    {"filter.u16x2.k9", blur<Isa, rg16, fast<gaussian<4>>>},
    {"filter.u16x2.k9.exact", blur<Isa, rg16, gaussian<4>>},
    {"filter.f32x2.k9", blur<Isa, rg32f, fast<gaussian<4>>>},
    {"receive.u8x2.f32", decide<Isa, rg8>},
    {"receive.u16x2.f32", decide<Isa, rg16>},
    {"receive.u8x2.z16", decide_codes<Isa>},
    {"receive.bilinear.u8x2", decide_at_points<Isa>},
};

} // namespace

std::span<const flags::kernel> flags::GNOMON_BENCH_BUILD([[maybe_unused]] lanes which) {
#if GNOMON_X86
    if (which == lanes::avx2) return kernels<avx2>;
#endif
    return kernels<best_isa>;
}
