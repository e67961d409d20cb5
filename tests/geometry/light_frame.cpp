#include <gnomon/geometry/light_frame.hpp>

#include <gnomon/geometry/directional_light.hpp>
#include <gnomon/geometry/rasterize.hpp>
#include <gnomon/geometry/spot_light.hpp>

#include "../support/bits.hpp"

#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <random>
#include <vector>

using namespace gnomon;

namespace {

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
            const light_frame scaled = light_frame::from_matrix(ortho * view * 4.0, map_size, clip); // clip space is homogeneous
            REQUIRE((light.valid() && scaled.valid()));
            CHECK_FALSE(light.perspective());
            double worst = 0.0;
            for (int i = 0; i < 1000; ++i) {
                const glm::dvec3 p = roll.vector(20.0);
                const map_point expected = viewport(ortho * view * glm::dvec4(p, 1.0), map_size, clip);
                worst = greater(worst, greater(distance(light.to_map(p), expected), distance(scaled.to_map(p), expected)));
            }
            CHECK(worst < 1e-10);
        }
}

TEST_CASE("an orthographic matrix that puts everything behind the eye, or nowhere, makes an invalid frame") {
    const glm::dmat4 ortho = glm::orthoRH_ZO(-10.0, 12.0, -8.0, 9.0, 1.0, 40.0);
    CHECK(light_frame::from_matrix(ortho * 2.0, map_size, {clip_depth::zero_to_one}).valid());
    for (const double w : {-1.0, 0.0, std::nan("")}) {
        CHECK_FALSE(light_frame::from_matrix(ortho * w, map_size, {clip_depth::zero_to_one}).valid());
        glm::dmat4 other_w = ortho;
        other_w[3][3] = w;
        CHECK_FALSE(light_frame::from_matrix(other_w, map_size, {clip_depth::zero_to_one}).valid());
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
            const light_frame scaled =
                light_frame::from_matrix(perspective * view * 0.25, map_size, clip); // clip space is homogeneous
            REQUIRE((light.valid() && scaled.valid()));
            CHECK(light.perspective());
            double worst = 0.0;
            for (int i = 0; i < 1000; ++i) {
                const glm::dvec3 p = roll.vector(20.0);
                const double distance_along_axis = -(view * glm::dvec4(p, 1.0)).z;
                if (distance_along_axis < 1.0) continue;
                map_point expected = viewport(perspective * view * glm::dvec4(p, 1.0), map_size, clip);
                expected.depth = (distance_along_axis - 0.5) / (80.0 - 0.5);
                worst = greater(worst, greater(distance(light.to_map(p), expected), distance(scaled.to_map(p), expected)));
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

TEST_CASE("a sheared frame sees every point where the frame does, at the sheared depth, and so does its clip matrix") {
    dice roll{std::mt19937_64(6)};
    const spot_light lamp{
        .position = {1, 9, 2}, .direction = {0.1, -1, 0}, .outer_angle = 0.7, .near_plane = 0.5, .far_plane = 20.0};
    directional_light sun({0.3, -1.0, 0.2});
    sun.add_caster(bounding_box{{-3, -1, -3}, {3, 4, 3}});
    for (const light_frame& light : {lamp.frame(map_size, 4), sun.frame(map_size, 4)}) {
        REQUIRE(light.valid());
        for (int i = 0; i < 300; ++i) {
            const auto a = static_cast<float>(roll(0.0, 1.0)), b = static_cast<float>(roll(0.0, 1.0));
            const depth_shear shear{{lesser(a, b), greater(a, b)}};
            if (shear.span() < 0.01f) continue;
            const light_frame sheared = light.sheared(shear.casters);
            REQUIRE(sheared.valid());
            CHECK(sheared.perspective() == light.perspective());
            const glm::dvec3 p = roll.vector(6.0);
            const map_point before = light.to_map(p), after = sheared.to_map(p);
            if (!before.in_front()) continue;
            const double span = static_cast<double>(shear.span());
            const double expected = (before.depth - static_cast<double>(shear.casters.nearest)) / span;
            CHECK(distance(after, {before.x, before.y, after.depth}) < 1e-9);
            CHECK(std::abs(after.depth - expected) <= (1.0 + 2.0 * std::abs(expected)) * 0x1p-22 / span); // widened a little
            if (light.perspective() && !(expected > 0.01)) continue; // no GPU draws what lies before its near plane
            const glm::vec4 local(glm::vec3(p), 1.0f);
            const map_point drawn = viewport(glm::dvec4(sheared.clip_matrix({}) * local), map_size, {});
            CHECK(std::abs(drawn.x - before.x) + std::abs(drawn.y - before.y) < 0.05);
            CHECK(std::abs(static_cast<double>(glm::dot(sheared.depth_plane(), local)) - expected) < 1e-3);
        }
    }
    const light_frame light = lamp.frame(map_size, 4);
    CHECK(light.sheared({}).matrix() == light.matrix());
    CHECK(light.sheared({0.25f + 0x1p-25f, 0.25f}).matrix() == light.matrix());     // no depths, however nearly
    CHECK(std::abs(light.sheared({0.0f, 0.5f}).near_w() - light.near_w()) < 1e-12); // its own near plane stays
    CHECK_FALSE(light.sheared({-1.0f, 0.5f}).valid());                              // begins behind the lamp
    CHECK_FALSE(light_frame().sheared({0.25f, 0.5f}).valid());
}

TEST_CASE("a sheared frame is 2^-23 wider than the casters on both sides") {
    const light_frame sheared = light_frame(glm::dmat4(1.0), map_size, 1.0, 1.0).sheared({0.25f, 0.5f});
    CHECK(std::abs(sheared.to_map({0, 0, 0.25 - 0x1p-23}).depth) < 1e-12);
    CHECK(std::abs(sheared.to_map({0, 0, 0.5 + 0x1p-23}).depth - 1.0) < 1e-12);
}

TEST_CASE("a frame that is sheared to the depths which a mesh was drawn in draws all of its texels again") {
    dice roll{std::mt19937_64(7)};
    const std::vector<std::uint32_t> indices{0, 2, 1, 0, 3, 2};
    const spot_light lamp{.position = {0, 5, 0}, .direction = {0, -1, 0}, .outer_angle = 0.5, .near_plane = 0.1, .far_plane = 10.0};
    const light_frame light = lamp.frame({64, 64}, 3);
    const auto texels_of = [&](const light_frame& frame, const triangle_mesh& mesh, light_footprint& touched) {
        int texels = 0;
        touched = rasterize(mesh, frame, whole(frame.size()), faces::both, [&](int, int, float) { ++texels; });
        return texels;
    };
    for (int i = 0; i < 400; ++i) {
        const auto y = static_cast<float>(roll(0.5, 4.0)); // flat: all of it lies in one depth
        const std::vector<glm::vec3> corners{{-0.5f, y, -0.5f}, {0.5f, y, -0.5f}, {0.5f, y, 0.5f}, {-0.5f, y, 0.5f}};
        light_footprint touched, again;
        const int texels = texels_of(light, {corners, indices}, touched);
        CHECK(texels > 0);
        CHECK(texels_of(light.sheared(touched.depth), {corners, indices}, again) == texels);
    }
}

TEST_CASE("a mesh with a double model matrix is drawn at 1e6 m as it is at the origin") {
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

TEST_CASE("a map has 1 to 2^20 texels a side") {
    constexpr int most = 1 << 20;
    const glm::dmat4 any(1.0);
    for (const extent size : {extent{1, 1}, extent{most, 1}, extent{1, most}}) CHECK(light_frame(any, size, 1.0, 1.0).valid());
    for (const extent size : {extent{0, 1}, extent{1, 0}, extent{most + 1, 1}, extent{1, most + 1}})
        CHECK_FALSE(light_frame(any, size, 1.0, 1.0).valid());
}

TEST_CASE("a frame is invalid if one number of its matrix is not finite, and if it flattens the world") {
    dice roll{std::mt19937_64(8)};
    int wrong = 0;
    for (int i = 0; i < 50; ++i) {
        glm::dmat4 m;
        for (int k = 0; k < 16; ++k) m[k / 4][k % 4] = roll(-1.0, 1.0);
        CHECK(light_frame(m, map_size, 1.0, 1.0).valid());
        for (int k = 0; k < 16; ++k)
            for (const double odd : {test::nan<double>, test::infinity<double>, -test::infinity<double>}) {
                glm::dmat4 broken = m;
                broken[k / 4][k % 4] = odd;
                wrong += light_frame(broken, map_size, 1.0, 1.0).valid();
            }
        for (int k = 0; k < 3; ++k) {
            glm::dmat4 flat = m;
            for (int c = 0; c < 3; ++c) flat[c][k] = 0.0;
            wrong += light_frame(flat, map_size, 1.0, 1.0).valid();
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("the planes of a frame stand before the light, in order, and at a distance") {
    constexpr double nan = test::nan<double>, infinity = test::infinity<double>;
    const auto valid = [](double near_w, double far_w) { return light_frame(glm::dmat4(1.0), map_size, near_w, far_w).valid(); };
    CHECK((valid(0.1, 100.0) && valid(1e-9, 1e9) && valid(1.0, 1.0)));
    CHECK_FALSE((valid(0.0, 1.0) || valid(-1.0, 1.0) || valid(2.0, 1.0) || valid(1.0, infinity) || valid(infinity, infinity)));
    CHECK_FALSE((valid(nan, 1.0) || valid(1.0, nan)));
}

TEST_CASE("what no light can see is nowhere, and what is before a near plane is somewhere") {
    const light_frame lamp = spot_light{.position = {0, 5, 0}, .direction = {0, -1, 0}, .near_plane = 0.1}.frame(map_size);
    const auto nowhere = [](const light_frame& light, const glm::dvec3& p) {
        const map_point m = light.to_map(p);
        return std::isnan(m.x) && std::isnan(m.y) && std::isnan(m.depth) && !m.in_front();
    };
    CHECK(nowhere(lamp, {0, 6, 0.5}));
    CHECK(nowhere(lamp, {1, 5, 2})); // beside it
    CHECK(nowhere(lamp, {0, 5, 0}));
    CHECK(nowhere(lamp, {0, test::nan<double>, 0}));
    CHECK(nowhere(light_frame(), {1, 2, 3}));
    CHECK(lamp.to_map({0, 4.95, 0}).in_front());
    CHECK(lamp.to_map({0, 4.95, 0}).depth < 0.0);
    CHECK(light_frame().clip_matrix({}) == glm::mat4(0.0f));
    CHECK((light_frame().near_w() <= 0.0 && light_frame().far_w() <= 0.0));
}

TEST_CASE("a perspective matrix without two planes that stand across its axis makes an invalid frame, at any scale") {
    const glm::dmat4 good = glm::perspectiveRH_ZO(1.0, 640.0 / 480.0, 0.5, 80.0);
    const auto valid = [](const glm::dmat4& m) { return light_frame::from_matrix(m, map_size, {clip_depth::zero_to_one}).valid(); };
    const auto with_depth = [&good](double x, double z, double w) { // the row that makes z
        glm::dmat4 m = good;
        m[0][2] = x;
        m[2][2] = z;
        m[3][2] = w;
        return m;
    };
    for (const double scale : {1e-3, 1.0, 1e3}) {
        CHECK(valid(good * scale));
        CHECK(valid(glm::dmat4(glm::mat4(good * glm::lookAtRH(glm::dvec3(3, 20, 5), glm::dvec3(0), glm::dvec3(0, 1, 0)))) * scale));
        CHECK_FALSE(valid(with_depth(0.01, good[2][2], good[3][2]) * scale)); // oblique
        CHECK_FALSE(valid(good * -scale));
        for (const double z : {-1.0, -0.75, 0.0, 0.75, 1.0}) // -1: the far plane is at infinity
            for (const double w : {-0.5, 0.5}) CHECK_FALSE(valid(with_depth(0.0, z, w) * scale));
        for (const double w : {0.0, 0.5}) CHECK_FALSE(valid(with_depth(0.0, good[2][2], w) * scale));
    }
}

TEST_CASE("a light turns by its up hint or by world z or by world x, the first that is 0.06 degrees off its direction") {
    const auto turns_by = [](const glm::dvec3& hint, const glm::dvec3& direction, const glm::dvec3& up) {
        const detail::light_axes axes(direction, up);
        return std::abs(glm::dot(axes.right, hint)) < 1e-9 && glm::dot(axes.upward, hint) > 0.0;
    };
    const glm::dvec3 x(1, 0, 0), z(0, 0, 1);
    for (const double scale : {1e-3, 1.0, 1e3}) {
        const auto up = [scale](double angle) { return glm::dvec3(std::cos(angle), std::sin(angle), 0.0) * scale; };
        CHECK(turns_by(up(0.0011), x, up(0.0011)));
        CHECK(turns_by(z, x, up(0.0009)));
        const glm::dvec3 off_z(0.0, std::sin(0.0011), std::cos(0.0011)), at_z(0.0, std::sin(0.0009), std::cos(0.0009));
        CHECK(turns_by(z, off_z, off_z * scale));
        CHECK(turns_by(x, at_z, at_z * scale));
    }
    const detail::light_axes none(glm::dvec3(0), glm::dvec3(0, 1, 0));
    CHECK((none.right == glm::dvec3(0) && none.upward == glm::dvec3(0) && none.forward == glm::dvec3(0)));
}

TEST_CASE("a clip space that nobody has set is that of OpenGL") {
    CHECK(clip_space{}.depth == clip_depth::minus_one_to_one);
    CHECK_FALSE(clip_space{}.row_0_is_top);
}

TEST_CASE("a matrix so short that a ten thousand millionth of its square is 0 makes a frame as at any length") {
    const glm::dmat4 matrix(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -2, -1, 0, 0, -2, 0); // looks along -z, from 1 to 2
    for (const double length : {1.0, 0x1p-522}) {
        const light_frame light = light_frame::from_matrix(matrix * length, {64, 64}, {clip_depth::zero_to_one});
        REQUIRE(light.valid());
        CHECK(light.near_w() / length == doctest::Approx(1.0));
        CHECK(light.far_w() / length == doctest::Approx(2.0));
    }
}
