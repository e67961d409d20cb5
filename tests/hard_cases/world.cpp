// Hard cases of the world: far from its origin, deep, or without any sense.
#include <gnomon/geometry/directional_light.hpp>
#include <gnomon/geometry/footprint.hpp>
#include <gnomon/geometry/rasterize.hpp>
#include <gnomon/geometry/rebase.hpp>
#include <gnomon/geometry/spot_light.hpp>
#include <gnomon/soft_shadow_map.hpp>

#include "hard_cases.hpp"

#include "../support/world_dice.hpp"

#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace gnomon;

namespace {
using dice = test::world_dice;

constexpr double infinity = test::infinity<double>;
constexpr double not_a_number = test::nan<double>;

double distance(const map_point& a, const map_point& b) {
    return greater(std::abs(a.x - b.x), greater(std::abs(a.y - b.y), std::abs(a.depth - b.depth)));
}

/// A map of 2048 texels over a cube of 200 m around `middle`.
constexpr extent large_map{2048, 2048};
light_frame two_hundred_metres(const glm::dvec3& direction, const glm::dvec3& middle) {
    const detail::light_axes axes(direction, {0.0, 1.0, 0.0});
    const auto row = [&](const glm::dvec3& axis, double size) {
        return glm::dvec4(axis * (size / 200.0), 0.5 * size - glm::dot(axis, middle) * (size / 200.0));
    };
    return {detail::from_rows(row(axes.right, 2048.0), row(axes.upward, 2048.0), row(axes.forward, 1.0), {0.0, 0.0, 0.0, 1.0}),
            large_map, 1.0, 1.0};
}

/// How far floats are from doubles, at most, over the whole of a frame: in texels, and in shares of the range.
struct float_error {
    double texels = 0.0;
    double depth = 0.0;

    void add(const map_point& exact, double x, double y, double z) {
        texels = greater(texels, greater(std::abs(x - exact.x), std::abs(y - exact.y)));
        depth = greater(depth, std::abs(z - exact.depth));
    }
};

/// Somewhere on the map and in its range: of the cube of 200 m, or of a spot light at `middle` that reaches from 1 m to 201 m.
glm::dvec3 anywhere(dice& roll, const light_frame& light, const glm::dvec3& direction, const glm::dvec3& middle) {
    const detail::light_axes axes(direction, {0.0, 1.0, 0.0});
    const double along = light.perspective() ? 1.0 + 200.0 * roll(0.0, 1.0) * roll(0.0, 1.0) : roll(-100.0, 100.0);
    const double reach = light.perspective() ? std::tan(spot_light{}.outer_angle) * along : 100.0;
    return middle + axes.forward * along + (axes.right * roll(-1.0, 1.0) + axes.upward * roll(-1.0, 1.0)) * reach;
}
} // namespace

// --- h17: subtract an origin near by, in double, before anything is a float -------------------------------------------------------

TEST_CASE("h17_huge_world_offset: in double a world position at 1e6 m is within 1e-6 texel of where it is at the origin and at 1e9 "
          "m within 1e-3") {
    dice roll{std::mt19937_64(4)};
    const extent size{2048, 2048};
    const glm::dvec3 direction(0.3, -1.0, 0.2);
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
        }
        CAPTURE(far_away);
        CHECK(worst <= (far_away > 1e8 ? 1e-3 : 1e-6));
    }
}

TEST_CASE("h17_huge_world_offset: rebased floats are within 1e-3 texel and 1e-6 of the range at every offset") {
    dice roll{std::mt19937_64(17)};
    for (const double far_away : {0.0, 1e6, 1e7, 1e8}) {
        CAPTURE(far_away);
        float_error sun, lamp;
        for (int i = 0; i < 100; ++i) {
            const glm::dvec3 middle = glm::normalize(roll.vector(1.0)) * far_away, direction = roll.vector(1.0);
            const light_frame frames[]{
                two_hundred_metres(direction, middle),
                spot_light{.position = middle, .direction = direction, .near_plane = 1.0, .far_plane = 201.0}.frame(large_map)};
            for (const light_frame& light : frames) {
                const rebased_frame near_by(light);
                for (int k = 0; k < 500; ++k) {
                    const glm::dvec3 p = anywhere(roll, light, direction, middle);
                    const rebased_point found = near_by.to_map(rebase(p, near_by.origin()));
                    (light.perspective() ? lamp : sun)
                        .add(light.to_map(p), static_cast<double>(found.x), static_cast<double>(found.y),
                             static_cast<double>(found.depth));
                }
            }
        }
        CHECK(sun.texels <= 1e-3);
        CHECK(sun.depth <= 1e-6);
        CHECK(lamp.texels <= 1e-3);
        CHECK(lamp.depth <= 1e-6);
        CHECK(sun.texels > 2e-4); // floats have no more to give
        CHECK(sun.depth > 8e-8);
    }
}

TEST_CASE("h17_huge_world_offset: a float matrix on float positions is off by a texel at 1e6 m and by ten at 1e7") {
    dice roll{std::mt19937_64(18)};
    const auto direct = [&](double far_away) { // what not to do
        const glm::dvec3 direction(0.5, -1.0, 0.3), middle(far_away, 0.0, 0.0);
        const light_frame light = two_hundred_metres(direction, middle);
        const glm::mat4 matrix(light.matrix());
        float_error worst;
        for (int i = 0; i < 20000; ++i) {
            const glm::dvec3 p = anywhere(roll, light, direction, middle);
            const glm::vec4 h = matrix * glm::vec4(glm::vec3(p), 1.0f);
            worst.add(light.to_map(p), static_cast<double>(h.x), static_cast<double>(h.y), static_cast<double>(h.z));
        }
        return worst;
    };
    const float_error at_1e6 = direct(1e6), at_1e7 = direct(1e7);
    CHECK(at_1e6.texels > 0.5); // .85 for one direction, 1.2 for another
    CHECK(at_1e6.texels < 2.0);
    CHECK(at_1e6.depth * 200.0 > 0.05); // in metres: .09 here, .16 elsewhere
    CHECK(at_1e6.depth * 200.0 < 0.3);
    CHECK(at_1e7.texels > 5.0);
    CHECK(at_1e7.depth * 200.0 > 0.5);
}

// --- h18: depth is linear in distance -------------------------------------------------------------------------------------------

TEST_CASE("h18_extreme_near_far: between 0.1 and 100 m 8 bits tell 0.40 m apart at half of the range and 16 bits 1.6 mm") {
    const light_frame light = spot_light{.direction = {0, 0, -1}, .near_plane = 0.1, .far_plane = 100.0}.frame({64, 64});
    const auto at = [&](double distance) { return light.to_map({0, 0, -distance}).depth; };
    for (double distance = 45.0; distance < 55.0; distance += 0.37) {
        CHECK(unorm8::encode(at(distance)) != unorm8::encode(at(distance + 0.40)));
        CHECK(unorm16::encode(at(distance)) != unorm16::encode(at(distance + 0.0016)));
    }
}

TEST_CASE("h18_extreme_near_far: the z of a projection matrix spends its codes on the first metre and 8 bits step by 98 m there") {
    constexpr double near_plane = 0.1, far_plane = 100.0, half_way = 50.05;
    const auto hyperbolic = [](double distance) { return far_plane / (far_plane - near_plane) * (1.0 - near_plane / distance); };
    const double slope = hyperbolic(half_way + 0.5) - hyperbolic(half_way - 0.5); // of depth a metre
    CHECK(1.0 / 255.0 / slope > 97.0);
    CHECK(1.0 / 255.0 / slope < 99.0);
    CHECK(1.0 / 65535.0 / slope > 0.37);
    CHECK(1.0 / 65535.0 / slope < 0.39);
    CHECK(unorm8::encode(hyperbolic(40.0)) == unorm8::encode(hyperbolic(100.0))); // one code for the last 60 m
    CHECK(unorm8::encode(hyperbolic(1.0)) >= 229);                                // nine in ten of them for the first metre
}

// --- h19: near == far, w <= 0, a singular matrix, no size: nothing is anywhere, and all is lit ---------------------------------------

TEST_CASE(
    "h19_degenerate_matrix_and_w: a degenerate light makes an invalid frame before which nothing is anywhere and all is lit") {
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
    frames.push_back(fit({0, -1, 0}, {glm::dvec3(0), {1e-321, 0, 0}}, size, 0)); // a depth cell is no double any more
    frames.push_back(fit({0, -1, 0}, box, {0, 0}, 0));
    frames.push_back(fit({0, -1, 0}, box, {1, 64}, 0));
    frames.push_back(fit({0, -1, 0}, box, {64, 2}, 1));
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
    matrix(glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.1, -1, 0, 0, 1, 0));    // a near plane behind the light
    frames.push_back(light_frame(glm::dmat4(1.0), size, 0.0, 1.0));
    frames.push_back(light_frame(glm::dmat4(1.0), size, 2.0, 1.0));

    const std::vector<glm::vec3> corners{{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}};
    const std::vector<std::uint32_t> indices{0, 1, 2};
    soft_shadow_map<rg16, tent<0>> dark({.width = 8, .height = 8});
    dark.cast(whole(dark.size()), 0.0f);
    dark.filter();
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const light_frame& light = frames[i];
        CAPTURE(i);
        CHECK_FALSE(light.valid());
        CHECK_FALSE(light.perspective());
        CHECK(light.size().empty());
        for (const glm::dvec3& p : {glm::dvec3(0.1, 0.2, 0.3), glm::dvec3(0), glm::dvec3(1e300), glm::dvec3(not_a_number)}) {
            CHECK_FALSE(light.to_map(p).in_front());
            CHECK(test::same_bits(dark.shadow_at(light.to_map(p)), 0.0f));
            const rebased_frame in_floats(light);
            CHECK_FALSE(in_floats.to_map(rebase(p, in_floats.origin())).in_front());
            CHECK(test::same_bits(dark.shadow_at(in_floats.to_map(rebase(p, in_floats.origin()))), 0.0f));
        }
        CHECK(light.clip_matrix({}) == glm::mat4(0.0f));
        CHECK(footprint(box, light).empty());
        CHECK(footprint(bounding_sphere{glm::dvec3(0), 1.0}, light).empty());
        int drawn = 0;
        CHECK(rasterize({corners, indices}, light, everywhere, faces::both, [&](int, int, float) { ++drawn; }).empty());
        CHECK(drawn == 0);
    }
    CHECK(frames.size() == 43);
}

TEST_CASE("h19_degenerate_matrix_and_w: what is behind a spot light or beside it is nowhere and no divide sees its w") {
    const light_frame light =
        spot_light{.position = {0, 5, 0}, .direction = {0, -1, 0}, .near_plane = 1.0, .far_plane = 10.0}.frame({64, 64});
    for (const double y : {5.0, 5.000001, 6.0, 1e6, 1e30, infinity, not_a_number}) {
        const map_point p = light.to_map({0.5, y, 0.25});
        CHECK_FALSE(p.in_front());
        CHECK((std::isnan(p.x) && std::isnan(p.y)));
        const rebased_frame in_floats(light, {0, 5, 0});
        const rebased_point q = in_floats.to_map(rebase({0.5, y, 0.25}, in_floats.origin()));
        CHECK_FALSE(q.in_front());
        CHECK((std::isnan(q.x) && std::isnan(q.y)));
    }
    const map_point before_near = light.to_map({0, 4.5, 0});
    CHECK(before_near.in_front());
    CHECK(before_near.depth < 0.0);
    CHECK(light.to_map({0, -6, 0}).depth > 1.0);
}

TEST_CASE_TEMPLATE("h19_degenerate_matrix_and_w: what comes out of it is lit at NaN and -inf and behind everything at +inf", Texel,
                   EVERY_TEXEL) {
    // The matrix path refuses w <= 0 before a depth exists; whatever still comes through has these answers.
    for (const float s : {0.0f, 0.5f, 1.0f})
        for (const rule& r : test::every_rule) {
            CHECK(test::lit(Texel::caster(s), test::nan<float>, r));
            CHECK(test::lit(Texel::caster(s), -test::infinity<float>, r));
            CHECK(test::in_full_shadow(Texel::caster(s), test::infinity<float>, r));
        }
}
