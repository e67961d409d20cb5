// GNOMON_TEST_FUNCTION: casts, filters and receives, by plain loops and in the lanes of the processor, rectangles and triangles under a
// sun and a lamp; returns a hash of it all.
#include "flags.hpp"

#include <gnomon/backend/simd.hpp>
#include <gnomon/geometry/directional_light.hpp>
#include <gnomon/geometry/footprint.hpp>
#include <gnomon/geometry/rasterize_lanes.hpp>
#include <gnomon/geometry/rebase.hpp>
#include <gnomon/geometry/spot_light.hpp>
#include <gnomon/soft_shadow_map.hpp>

#include <bit>
#include <vector>

namespace {

constexpr glm::vec3 corners[] = {{-1, 1, -1}, {1, 1.25f, -1}, {1, 1, 1}, {-1, 1.5f, 1}};
constexpr std::uint32_t triangles[] = {0, 2, 1, 0, 3, 2};

std::uint32_t more(std::uint32_t hash, float number) { return (hash ^ std::bit_cast<std::uint32_t>(number)) * 16777619u; }

template <typename Backend> std::uint32_t triangles_under(const gnomon::light_frame& light) {
    gnomon::soft_shadow_map<gnomon::rg16, gnomon::binomial<3>, Backend> map({.width = 64, .height = 64});
    const gnomon::triangle_mesh mesh{.positions = corners, .indices = triangles, .model = glm::dmat4(1.25)};
    map.cast([&](auto texels) { return gnomon::cast_triangles(Backend{}, texels, mesh, light); });
    map.filter();
    std::uint32_t hash = 2166136261u;
    for (int i = 0; i < 64; ++i) hash = more(hash, map.shadow(i, 63 - i, 0.9f));
    const auto ball = gnomon::footprint(gnomon::bounding_sphere{{0.5, 1.0, 0.5}, 0.25}, light);
    const gnomon::rebased_frame near_by(light);
    return more(more(hash, ball.depth.nearest), near_by.matrix()[3][2]);
}

template <typename Backend> std::uint32_t triangles_in_light() {
    const gnomon::spot_light lamp{
        .position = {0, 4, 0}, .direction = {0, -1, 0}, .outer_angle = 0.7, .near_plane = 1, .far_plane = 9};
    gnomon::directional_light sun({0.25, -1.0, 0.5});
    sun.add_caster(gnomon::bounding_box{{-1, 1, -1}, {1, 2, 1}});
    sun.add_receiver(gnomon::bounding_box{{-5, 0, -5}, {5, 0, 5}});
    return 31 * triangles_under<Backend>(lamp.frame({64, 64}, 3)) + triangles_under<Backend>(sun.frame({64, 64}, 3));
}

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
            for (const float shadow : intensity) hash = more(hash, shadow);
        }
    }
    return hash;
}

} // namespace

std::uint32_t GNOMON_TEST_FUNCTION() {
    std::uint32_t hash = 0;
    for (const std::uint32_t one :
         {picture<gnomon::rg8, gnomon::simd<>>(), picture<gnomon::rg8, gnomon::scalar>(), picture<gnomon::rg16, gnomon::simd<>>(),
          picture<gnomon::rg32f, gnomon::scalar>(), picture<gnomon::rgba16f, gnomon::scalar>(),
          triangles_in_light<gnomon::simd<>>(), triangles_in_light<gnomon::scalar>()})
        hash = hash * 31 + one;
    return hash;
}
