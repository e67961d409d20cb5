// GNOMON_TEST_FUNCTION: casts, filters and receives, by plain loops and in the lanes of the processor; returns a hash of it all.
#include "flags.hpp"

#include <gnomon/backend/simd.hpp>
#include <gnomon/soft_shadow_map.hpp>

#include <bit>
#include <vector>

namespace {

template <typename Texel, typename Backend> std::uint32_t picture() {
    gnomon::soft_shadow_map<Texel, gnomon::binomial<3>, Backend> map({.width = 211, .height = 100, .tile = 16});
    std::uint32_t hash = 2166136261u;
    for (int frame = 0; frame < 3; ++frame) {
        map.clear();
        for (int i = 0; i < 9; ++i)
            map.cast({.x0 = 20 * i, .y0 = 11 * i + frame, .x1 = 30 * i + 7, .y1 = 12 * i + 9}, 0.1f * static_cast<float>(i));
        map.filter();
        std::vector<float> z(211), intensity(211);
        for (int y = 0; y < 100; ++y) {
            for (std::size_t x = 0; x < z.size(); ++x)
                z[x] = static_cast<float>((x * 37 + static_cast<std::size_t>(y) * 11) % 101) * 0.01f;
            map.receive_row(y, z, intensity);
            for (const float shadow : intensity) hash = (hash ^ std::bit_cast<std::uint32_t>(shadow)) * 16777619u;
        }
    }
    return hash;
}

} // namespace

std::uint32_t GNOMON_TEST_FUNCTION() {
    std::uint32_t hash = 0;
    for (const std::uint32_t one :
         {picture<gnomon::rg8, gnomon::simd<>>(), picture<gnomon::rg8, gnomon::scalar>(), picture<gnomon::rg16, gnomon::simd<>>(),
          picture<gnomon::rg32f, gnomon::scalar>(), picture<gnomon::rgba16f, gnomon::scalar>()})
        hash = hash * 31 + one;
    return hash;
}
