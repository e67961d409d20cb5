#include <gnomon/geometry/light_frame.hpp>

#include <gnomon/geometry/directional_light.hpp>
#include <gnomon/geometry/rasterize.hpp>
#include <gnomon/geometry/spot_light.hpp>

#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace gnomon;

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct dice {
    std::mt19937_64 bits;
    double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(bits); }
    glm::dvec3 vector(double reach) { return {(*this)(-reach, reach), (*this)(-reach, reach), (*this)(-reach, reach)}; }
};

double distance(const map_point& a, const map_point& b) {
    return greater(std::abs(a.x - b.x), greater(std::abs(a.y - b.y), std::abs(a.depth - b.depth)));
}

/// A clip space position on the map, by the definition of the viewport.
map_point viewport(const glm::dvec4& clip_position, extent size, clip_space clip) {
    const glm::dvec3 ndc = glm::dvec3(clip_position) / clip_position.w;
    const double y = clip.row_0_is_top ? 0.5 - 0.5 * ndc.y : 0.5 + 0.5 * ndc.y;
    const double z =
        clip.depth == clip_depth::zero_to_one ? ndc.z : (clip.depth == clip_depth::one_to_zero ? 1.0 - ndc.z : 0.5 + 0.5 * ndc.z);
    return {(0.5 + 0.5 * ndc.x) * size.width, y * size.height, z};
}

constexpr clip_depth all_depths[]{clip_depth::zero_to_one, clip_depth::minus_one_to_one, clip_depth::one_to_zero};
constexpr extent map_size{640, 480};
} // namespace

TEST_CASE("an engine's orthographic matrix is read as the engine means it, in every clip space") {
    dice roll{std::mt19937_64(1)};
    const glm::dmat4 view = glm::lookAtRH(glm::dvec3(3, 20, 5), glm::dvec3(0, 1, 0), glm::dvec3(0, 1, 0));
    for (const clip_depth depth : all_depths)
        for (const bool top : {false, true}) {
            const clip_space clip{depth, top};
            glm::dmat4 ortho = glm::orthoRH_ZO(-10.0, 12.0, -8.0, 9.0, 1.0, 40.0);
            if (depth == clip_depth::minus_one_to_one) ortho = glm::orthoRH_NO(-10.0, 12.0, -8.0, 9.0, 1.0, 40.0);
            if (depth == clip_depth::one_to_zero) ortho = glm::orthoRH_ZO(-10.0, 12.0, -8.0, 9.0, 40.0, 1.0);
            const light_frame light = light_frame::from_matrix(ortho * view, map_size, clip);
            REQUIRE(light.valid());
            CHECK_FALSE(light.perspective());
            double worst = 0.0;
            for (int i = 0; i < 1000; ++i) {
                const glm::dvec3 p = roll.vector(20.0);
                worst = greater(worst, distance(light.to_map(p), viewport(ortho * view * glm::dvec4(p, 1.0), map_size, clip)));
            }
            CHECK(worst < 1e-10);
        }
}

TEST_CASE("an engine's perspective matrix gives the same texels, and linear depth") {
    dice roll{std::mt19937_64(2)};
    const glm::dmat4 view = glm::lookAtRH(glm::dvec3(3, 20, 5), glm::dvec3(0, 1, 0), glm::dvec3(0, 1, 0));
    for (const clip_depth depth : all_depths)
        for (const bool top : {false, true}) {
            const clip_space clip{depth, top};
            glm::dmat4 perspective = glm::perspectiveRH_ZO(1.0, 640.0 / 480.0, 0.5, 80.0);
            if (depth == clip_depth::minus_one_to_one) perspective = glm::perspectiveRH_NO(1.0, 640.0 / 480.0, 0.5, 80.0);
            if (depth == clip_depth::one_to_zero) perspective = glm::perspectiveRH_ZO(1.0, 640.0 / 480.0, 80.0, 0.5);
            const light_frame light = light_frame::from_matrix(perspective * view, map_size, clip);
            REQUIRE(light.valid());
            CHECK(light.perspective());
            double worst = 0.0;
            for (int i = 0; i < 1000; ++i) {
                const glm::dvec3 p = roll.vector(20.0);
                const double distance_along_axis = -(view * glm::dvec4(p, 1.0)).z;
                if (distance_along_axis < 1.0) continue;
                map_point expected = viewport(perspective * view * glm::dvec4(p, 1.0), map_size, clip);
                expected.depth = (distance_along_axis - 0.5) / (80.0 - 0.5);
                worst = greater(worst, distance(light.to_map(p), expected));
            }
            CHECK(worst < 1e-9);
            // As floats, as engines have them, near and far are worse; the texels are not.
            const light_frame in_floats = light_frame::from_matrix(glm::dmat4(glm::mat4(perspective * view)), map_size, clip);
            const map_point a = light.to_map({1, 2, 3}), b = in_floats.to_map({1, 2, 3});
            CHECK(greater(std::abs(a.x - b.x), std::abs(a.y - b.y)) < 1e-3);
            CHECK(std::abs(a.depth - b.depth) < 1e-3);
        }
}

TEST_CASE("the clip matrix of a frame draws what the frame says, rebased in a world 1e6 m away") {
    dice roll{std::mt19937_64(3)};
    const glm::dvec3 origin(1e6, -2e6, 3e6);
    directional_light sun({1, -2, 0.5});
    sun.add_caster(bounding_sphere{origin, 20.0});
    const light_frame lamps[]{
        sun.frame(map_size, 3),
        spot_light{.position = origin + glm::dvec3(0, 30, 5), .direction = {0, -1, 0.1}, .near_plane = 1}.frame(map_size)};
    for (const light_frame& light : lamps)
        for (const clip_depth depth : all_depths)
            for (const bool top : {false, true}) {
                REQUIRE(light.valid());
                const glm::mat4 matrix = light.clip_matrix({depth, top}, origin);
                const glm::vec4 plane = light.depth_plane(origin);
                double worst = 0.0, worst_depth = 0.0;
                for (int i = 0; i < 1000; ++i) {
                    const glm::vec3 relative(roll.vector(10.0));
                    const map_point expected = light.to_map(origin + glm::dvec3(relative));
                    const map_point drawn = viewport(glm::dvec4(matrix * glm::vec4(relative, 1.0f)), map_size, {depth, top});
                    worst = greater(worst, greater(std::abs(drawn.x - expected.x), std::abs(drawn.y - expected.y)));
                    worst_depth = greater(
                        worst_depth, std::abs(static_cast<double>(glm::dot(plane, glm::vec4(relative, 1.0f))) - expected.depth));
                    if (!light.perspective()) worst_depth = greater(worst_depth, std::abs(drawn.depth - expected.depth));
                    if (light.perspective()) {
                        const double w = 1.0 + expected.depth * 99.0, hyperbolic = 100.0 * (w - 1.0) / (w * 99.0);
                        worst_depth = greater(worst_depth, std::abs(drawn.depth - hyperbolic));
                    }
                }
                CHECK(worst <= 1e-3);
                CHECK(worst_depth <= 1e-6);
            }
}

TEST_CASE("h17: at an offset of 1e6 m a world position is within 1e-6 texel of where it is at the origin, at 1e9 m within 1e-3") {
    dice roll{std::mt19937_64(4)};
    const extent size{2048, 2048};
    const glm::dvec3 direction(0.3, -1.0, 0.2);
    double float_error = 0.0;
    for (const double far_away : {0.0, 1e6, 1e9}) {
        const glm::dvec3 offset(far_away, far_away * 0.5, -far_away);
        directional_light sun(direction), sun_here(direction);
        sun.add_caster(bounding_sphere{offset, 93.0}); // a texel of 0.0917 m
        sun_here.add_caster(bounding_sphere{glm::dvec3(0), 93.0});
        const light_frame there = sun.frame(size), here = sun_here.frame(size);
        const spot_light lamp{
            .position = offset + glm::dvec3(0, 90, 0), .direction = direction, .near_plane = 1.0, .far_plane = 201.0};
        spot_light lamp_here = lamp;
        lamp_here.position = {0, 90, 0};
        const light_frame cone = lamp.frame(size), cone_here = lamp_here.frame(size);
        REQUIRE((there.valid() && here.valid() && cone.valid() && cone_here.valid()));

        double worst = 0.0;
        const map_point middle = there.to_map(offset), middle_here = here.to_map(glm::dvec3(0));
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec3 p = glm::round(roll.vector(50.0) * 1024.0) / 1024.0; // exact also when added to the offset
            const map_point a = there.to_map(offset + p), b = here.to_map(p);
            const map_point along_a{a.x - middle.x, a.y - middle.y, a.depth - middle.depth},
                along_b{b.x - middle_here.x, b.y - middle_here.y, b.depth - middle_here.depth};
            worst = greater(worst, distance(along_a, along_b)); // the directional map snaps to another texel there
            worst = greater(worst, distance(cone.to_map(offset + p), cone_here.to_map(p)));
            const glm::vec4 direct = there.clip_matrix({}) * glm::vec4(glm::vec3(offset + p), 1.0f); // what not to do
            if (std::abs(far_away - 1e6) < 1.0)
                float_error = greater(float_error, std::abs((0.5 + 0.5 * static_cast<double>(direct.x)) * 2048.0 - a.x));
        }
        CAPTURE(far_away);
        CHECK(worst <= (far_away > 1e8 ? 1e-3 : 1e-6));
    }
    CHECK(float_error > 0.1); // so the test would have noticed
}

TEST_CASE("h17: a mesh with a double model matrix is drawn at 1e6 m as it is at the origin") {
    const std::vector<glm::vec3> corners{{-31, 0.5f, -20}, {40, 1, -33}, {3, 7, 55}};
    const std::vector<std::uint32_t> indices{0, 1, 2};
    const auto draw = [&](const glm::dvec3& offset) {
        const light_frame light =
            spot_light{.position = offset + glm::dvec3(0, 90, 0), .direction = {0.1, -1, 0}, .near_plane = 1, .far_plane = 200}
                .frame({512, 512});
        std::vector<float> depths(512 * 512, 2.0f);
        rasterize({.positions = corners, .indices = indices, .model = glm::translate(glm::dmat4(1.0), offset)}, light, everywhere,
                  faces::both, [&](int x, int y, float z) { depths[static_cast<std::size_t>(y * 512 + x)] = z; });
        return depths;
    };
    const std::vector<float> here = draw(glm::dvec3(0)), there = draw({1e6, 2e6, -1e6});
    int covered = 0, different = 0;
    for (std::size_t i = 0; i < here.size(); ++i) {
        covered += here[i] < 2.0f;
        different += std::abs(here[i] - there[i]) > 1e-7f;
    }
    CHECK(covered > 10000);
    CHECK(different <= 1); // a centre on an edge may fall to the other side
}

TEST_CASE("h19: a degenerate light makes an invalid frame, before which nothing is anywhere") {
    std::vector<light_frame> frames{light_frame{}};
    const extent size{64, 64};
    const spot_light good{.position = {0, 5, 0}, .direction = {0, -1, 0}};
    REQUIRE(good.frame(size).valid());
    const auto spot = [&](auto&& change) {
        spot_light bad = good;
        change(bad);
        frames.push_back(bad.frame(size));
    };
    spot([](spot_light& s) { s.direction = glm::dvec3(0); });
    spot([](spot_light& s) { s.direction.x = not_a_number; });
    spot([](spot_light& s) { s.direction.x = infinity; });
    spot([](spot_light& s) { s.position.z = not_a_number; });
    spot([](spot_light& s) { s.position.z = infinity; });
    spot([](spot_light& s) { s.outer_angle = 0.0; });
    spot([](spot_light& s) { s.outer_angle = 1.6; });
    spot([](spot_light& s) { s.outer_angle = not_a_number; });
    spot([](spot_light& s) { s.near_plane = 0.0; });
    spot([](spot_light& s) { s.near_plane = s.far_plane; });
    spot([](spot_light& s) { s.near_plane = 200.0; });
    spot([](spot_light& s) { s.near_plane = not_a_number; });
    spot([](spot_light& s) { s.far_plane = infinity; });
    spot([](spot_light& s) { s.far_plane = not_a_number; });
    for (const extent bad : {extent{0, 64}, extent{64, -1}, extent{2000000, 64}}) frames.push_back(good.frame(bad));
    frames.push_back(good.frame(size, 32));

    const auto fit = [&](const glm::dvec3& direction, const bounding_box& box, extent s, int margin) {
        directional_light sun(direction);
        sun.add_caster(box);
        return sun.frame(s, margin);
    };
    const bounding_box box{glm::dvec3(-1), glm::dvec3(1)};
    REQUIRE(fit({0, -1, 0}, box, size, 31).valid());
    frames.push_back(fit({0, 0, 0}, box, size, 0));
    frames.push_back(fit({0, not_a_number, 0}, box, size, 0));
    frames.push_back(fit({0, infinity, 0}, box, size, 0));
    frames.push_back(fit({0, -1, 0}, {glm::dvec3(1), glm::dvec3(-1)}, size, 0));
    frames.push_back(fit({0, -1, 0}, {glm::dvec3(not_a_number), glm::dvec3(1)}, size, 0));
    frames.push_back(fit({0, -1, 0}, {glm::dvec3(-infinity), glm::dvec3(1)}, size, 0));
    frames.push_back(fit({0, -1, 0}, {glm::dvec3(1), glm::dvec3(1)}, size, 0));
    frames.push_back(fit({0, -1, 0}, box, {0, 0}, 0));
    frames.push_back(fit({0, -1, 0}, box, {1, 64}, 0));
    frames.push_back(fit({0, -1, 0}, box, size, 32));
    frames.push_back(fit({0, -1, 0}, box, size, std::numeric_limits<int>::max()));

    const auto matrix = [&](glm::dmat4 m) { frames.push_back(light_frame::from_matrix(m, size, {})); };
    REQUIRE(light_frame::from_matrix(glm::dmat4(1.0), size, {}).valid());
    matrix(glm::dmat4(0.0));
    matrix(glm::dmat4(not_a_number));
    matrix(glm::orthoRH_NO(-1.0, 1.0, -1.0, 1.0, 1.0, infinity));
    matrix(glm::dmat4(1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1));                          // singular
    matrix(glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1));                         // w = -1
    matrix(glm::perspectiveRH_NO(1.0, 1.0, 1.0, 1.0 + 1e-300));                                  // near == far: z is infinite
    matrix(glm::perspectiveRH_NO(1.0, 1.0, 5.0, 1.0));                                           // near beyond far
    matrix(glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, 0.5, 0, -1.1, -1, 0, 0, -1, 0) * glm::dmat4(1.0)); // fine in depth
    frames.pop_back();
    matrix(glm::dmat4(1, 0, 0.5, 0, 0, 1, 0, 0, 0, 0, -1.1, -1, 0, 0, -1, 0)); // an oblique near plane
    frames.push_back(light_frame(glm::dmat4(1.0), size, 0.0, 1.0));
    frames.push_back(light_frame(glm::dmat4(1.0), size, 2.0, 1.0));

    const std::vector<glm::vec3> corners{{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}};
    const std::vector<std::uint32_t> indices{0, 1, 2};
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const light_frame& light = frames[i];
        CAPTURE(i);
        CHECK_FALSE(light.valid());
        CHECK_FALSE(light.perspective());
        CHECK(light.size().empty());
        CHECK_FALSE(light.to_map({0.1, 0.2, 0.3}).in_front());
        CHECK(light.clip_matrix({}) == glm::mat4(0.0f));
        CHECK(footprint(box, light).empty());
        CHECK(footprint(bounding_sphere{glm::dvec3(0), 1.0}, light).empty());
        int drawn = 0;
        CHECK(rasterize({corners, indices}, light, everywhere, faces::both, [&](int, int, float) { ++drawn; }).empty());
        CHECK(drawn == 0);
    }
    CHECK(frames.size() == 40);
}

TEST_CASE("a map has 1 to 2^20 texels a side") {
    constexpr int most = 1 << 20;
    const glm::dmat4 any(1.0);
    for (const extent size : {extent{1, 1}, extent{most, 1}, extent{1, most}}) CHECK(light_frame(any, size, 1.0, 1.0).valid());
    for (const extent size : {extent{0, 1}, extent{1, 0}, extent{most + 1, 1}, extent{1, most + 1}})
        CHECK_FALSE(light_frame(any, size, 1.0, 1.0).valid());
}

TEST_CASE("h19: what is behind a spot light or beside it is nowhere, and no divide sees its w") {
    const light_frame light =
        spot_light{.position = {0, 5, 0}, .direction = {0, -1, 0}, .near_plane = 1.0, .far_plane = 10.0}.frame({64, 64});
    for (const double y : {5.0, 5.000001, 6.0, 1e6, 1e30, infinity, not_a_number}) {
        const map_point p = light.to_map({0.5, y, 0.25});
        CHECK_FALSE(p.in_front());
        CHECK((std::isnan(p.x) && std::isnan(p.y)));
    }
    const map_point before_near = light.to_map({0, 4.5, 0});
    CHECK(before_near.in_front());
    CHECK(before_near.depth < 0.0);
    CHECK(light.to_map({0, -6, 0}).depth > 1.0);
}
