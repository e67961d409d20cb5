#include <gnomon/geometry/footprint.hpp>

#include <gnomon/geometry/directional_light.hpp>
#include <gnomon/geometry/spot_light.hpp>

#include "../support/world_dice.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace gnomon;

namespace {
using dice = test::world_dice;

constexpr extent map_size{300, 260};

light_frame any_light(dice& roll, int i) {
    if (i % 3 == 0) {
        directional_light sun(roll.vector(1.0));
        sun.add_caster(bounding_sphere{glm::dvec3(0), 12.0});
        return sun.frame(map_size, 4);
    }
    if (i % 3 == 1)
        return spot_light{.position = roll.vector(i % 2 ? 15.0 : 5.0),
                          .direction = roll.vector(1.0),
                          .outer_angle = roll(0.2, 1.3),
                          .near_plane = roll(0.1, 3.0),
                          .far_plane = roll(5.0, 40.0)}
            .frame(map_size);
    glm::dmat4 sheared(0.0);
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) sheared[c][r] = roll(-0.07, 0.07);
    sheared[3] = {0.0, 0.0, 0.5, 1.0};
    return light_frame::from_matrix(sheared, map_size, {clip_depth::zero_to_one});
}

/// Somewhere; where a spot light can cut it, often near the near plane.
glm::dvec3 any_place(dice& roll, const light_frame& light, double reach) {
    glm::dvec3 p = roll.vector(reach);
    for (int k = 0; k < 20 && light.perspective() && !(std::abs(light.to_map(p).depth) < 0.05); ++k) p = roll.vector(reach);
    return p;
}

/// What the footprint has to hold, gathered from projected points: those that the light can see, wherever on the map.
struct seen {
    double x0 = 1e9, x1 = -1e9, y0 = 1e9, y1 = -1e9, z0 = 1e9, z1 = -1e9;
    int points = 0, outside = 0, hidden = 0;

    void add(const light_frame& light, const glm::dvec3& p, const light_footprint& f) {
        const map_point m = light.to_map(p);
        if (!m.in_front() || (light.perspective() && m.depth < 0.0)) {
            ++hidden;
            return;
        }
        x0 = lesser(x0, m.x);
        x1 = greater(x1, m.x);
        y0 = lesser(y0, m.y);
        y1 = greater(y1, m.y);
        const bool on_map = m.x >= 0.0 && m.y >= 0.0 && m.x < map_size.width && m.y < map_size.height;
        const auto z = saturate(static_cast<float>(m.depth));
        z0 = lesser(z0, static_cast<double>(z));
        z1 = greater(z1, static_cast<double>(z));
        if (!on_map) return;
        ++points;
        outside +=
            !f.texels.contains(static_cast<int>(m.x), static_cast<int>(m.y)) || !(f.depth.nearest <= z && z <= f.depth.farthest);
    }
    [[nodiscard]] bool whole() const { return hidden == 0 && x0 > 0.0 && y0 > 0.0 && x1 < map_size.width && y1 < map_size.height; }
    /// How far the farthest side of `f` is from the points, in texels.
    [[nodiscard]] double looseness(const light_footprint& f) const {
        return greater(greater(x0 - f.texels.x0, f.texels.x1 - x1), greater(y0 - f.texels.y0, f.texels.y1 - y1));
    }
    [[nodiscard]] double depth_looseness(const light_footprint& f) const {
        return greater(z0 - static_cast<double>(f.depth.nearest), static_cast<double>(f.depth.farthest) - z1);
    }
};
} // namespace

TEST_CASE("every point of a box that a light sees is in its footprint, and no side is a texel too far out") {
    dice roll{std::mt19937_64(1)};
    int points = 0, outside = 0, whole = 0, cut = 0;
    double loosest = 0.0, loosest_depth = 0.0;
    for (int i = 0; i < 6000; ++i) {
        const light_frame light = any_light(roll, i);
        REQUIRE(light.valid());
        const glm::dvec3 corner = i % 2 ? roll.vector(10.0) : any_place(roll, light, 10.0);
        const bounding_box box{corner, corner + glm::abs(roll.vector(i % 5 ? 3.0 : 0.02))};
        const light_footprint f = footprint(box, light);
        seen points_of_box;
        for (int k = 0; k < 8; ++k) points_of_box.add(light, box.corner(k), f);
        for (int k = 0; k < 60; ++k) {
            glm::dvec3 p = roll.inside(box);
            if (k % 2) p[k % 3] = k % 4 == 1 ? box.lower[k % 3] : box.upper[k % 3];
            points_of_box.add(light, p, f);
        }
        points += points_of_box.points;
        outside += points_of_box.outside;
        cut += points_of_box.hidden > 0 && points_of_box.points > 0;
        if (!points_of_box.whole()) continue;
        ++whole;
        loosest = greater(loosest, points_of_box.looseness(f));
        loosest_depth = greater(loosest_depth, points_of_box.depth_looseness(f));
    }
    CHECK(outside == 0);
    CHECK(points > 100000);
    CHECK(cut > 50);
    CHECK(whole > 1000);
    CHECK(loosest <= 1.0 + 1.0 / 1024.0);
    CHECK(loosest > 0.99);
    CHECK(loosest_depth < 4e-7);
}

TEST_CASE("every point of a ball that a light sees is in its footprint, and no side is a texel too far out") {
    dice roll{std::mt19937_64(2)};
    int points = 0, outside = 0, whole = 0, cut = 0;
    double loosest = 0.0, loosest_depth = 0.0;
    std::vector<glm::dvec3> directions; // a Fibonacci lattice: no point of the sphere is farther than .03 from one
    for (int k = 0; k < 8000; ++k) {
        const double z = 1.0 - (2.0 * k + 1.0) / 8000.0, turn = 2.399963229728653 * k, r = std::sqrt(1.0 - z * z);
        directions.push_back({r * std::cos(turn), r * std::sin(turn), z});
    }
    for (int i = 0; i < 900; ++i) {
        const light_frame light = any_light(roll, i);
        const bounding_sphere ball{i % 2 ? roll.vector(9.0) : any_place(roll, light, 9.0), i % 5 ? roll(0.0, 2.5) : 0.001};
        const light_footprint f = footprint(ball, light);
        seen points_of_ball;
        for (const glm::dvec3& d : directions) points_of_ball.add(light, ball.centre + d * ball.radius, f);
        points += points_of_ball.points;
        outside += points_of_ball.outside;
        cut += points_of_ball.hidden > 0 && points_of_ball.points > 0;
        if (!points_of_ball.whole()) continue;
        ++whole;
        // 1 texel of rounding, the slack, and what the lattice misses of the extremes: .03^2 / 2 of the radius
        const double radius = 0.5 * greater(points_of_ball.x1 - points_of_ball.x0, points_of_ball.y1 - points_of_ball.y0);
        loosest = greater(loosest, points_of_ball.looseness(f) - 0.002 * radius);
        if (points_of_ball.z0 > 0.0 && points_of_ball.z1 < 1.0)
            loosest_depth =
                greater(loosest_depth, points_of_ball.depth_looseness(f) - 0.0005 * (points_of_ball.z1 - points_of_ball.z0));
    }
    CHECK(outside == 0);
    CHECK(points > 1000000);
    CHECK(cut > 5);
    CHECK(whole > 150);
    CHECK(loosest <= 1.0 + 1.0 / 1024.0);
    CHECK(loosest > 0.9);
    CHECK(loosest_depth < 4e-7);
}

TEST_CASE("what a spot light's near plane hides has no footprint, and what it cuts is cut") {
    const light_frame light = spot_light{.position = {0, 10, 0},
                                         .direction = {0, -1, 0},
                                         .outer_angle = 0.7,
                                         .near_plane = 1.0,
                                         .far_plane = 11.0,
                                         .up = {0, 0, 1}}
                                  .frame({256, 256});
    const auto box = [&](double low, double high) { return footprint(bounding_box{{-0.5, low, -0.5}, {0.5, high, 0.5}}, light); };
    CHECK(box(9.01, 12.0).empty()); // before the near plane, and behind the light
    CHECK(box(10.5, 12.0).empty());
    CHECK_FALSE(box(9.0, 9.0).empty()); // on it
    CHECK(footprint(bounding_sphere{{0, 12, 0}, 1.9}, light).empty());
    CHECK(footprint(bounding_sphere{{0, 10, 0}, 0.99}, light).empty());
    CHECK(box(9.5, 12.0) == light_footprint{}); // and no depths
    CHECK(footprint(bounding_box{{99, 0, 0}, {100, 1, 1}}, light) == light_footprint{});

    const light_footprint cut = box(0.0, 20.0), flush = box(0.0, 9.0);
    CHECK(cut.texels == flush.texels);
    CHECK(cut.depth.nearest <= 0.0f);
    CHECK(std::abs(cut.depth.farthest - 0.9f) < 1e-6f);
    CHECK_FALSE(footprint(bounding_sphere{{0, 9, 0}, 3.0}, light).empty()); // holds the light
    CHECK(footprint(bounding_sphere{{0, 9, 0}, 30.0}, light).texels == whole({256, 256}));
    CHECK(footprint(bounding_sphere{{0, 9, 0}, 30.0}, light).depth == depth_interval{0.0f, 1.0f});
}

TEST_CASE("a ball that touches a spot light's near plane is not cut by it, and one that looks over it is boxed") {
    const light_frame light =
        spot_light{.direction = {0, 0, -1}, .outer_angle = 1.2, .near_plane = 1.0, .far_plane = 9.0}.frame({256, 256});
    const double rim = 128.0 / std::tan(1.2) * std::tan(std::asin(2.0 / 3.0)); // of the cone around it, in texels
    const auto tight = [rim](int side) { return side == static_cast<int>(std::floor(128.0 - rim)); };
    CHECK(tight(footprint(bounding_sphere{{0, 0, -3}, 2.0}, light).texels.x0));
    CHECK_FALSE(tight(footprint(bounding_sphere{{0, 0, -3}, 2.000001}, light).texels.x0));
}

TEST_CASE("a footprint is 1/1024 texel and 2^-22 of the depth range wider than what it holds") {
    const light_frame light(glm::dmat4(1.0), {64, 64}, 1.0, 1.0); // the world in texels and depths
    const light_footprint within = footprint(bounding_box{{10.0009, 11.0009, 0.25}, {19.9991, 20.9991, 0.5}}, light),
                          beyond = footprint(bounding_box{{10.001, 11.001, 0.25}, {19.999, 20.999, 0.5}}, light);
    CHECK(within == light_footprint{{9, 10, 21, 22}, {0.25f - 0x1p-22f, 0.5f + 0x1p-22f}});
    CHECK(beyond == light_footprint{{10, 11, 20, 21}, within.depth});
    const light_frame coarse(glm::dmat4(glm::dmat3(0x1p-6)), {64, 64}, 1.0, 1.0); // 64 m a texel
    CHECK(footprint(bounding_sphere{{640.0, 704.0, 32.0}, 32.0}, coarse).texels == texel_rect{9, 10, 11, 12});
}

TEST_CASE("a directional light keeps what is before its near plane at depth 0, and every light keeps what is beyond at depth 1") {
    directional_light sun({0, -1, 0});
    sun.add_caster(bounding_box{{-5, 0, -5}, {5, 4, 5}});
    const light_frame light = sun.frame({128, 128}, 2);
    const light_footprint above = footprint(bounding_box{{-1, 50, -1}, {1, 60, 1}}, light);
    CHECK_FALSE(above.empty());
    CHECK(above.depth == depth_interval{0.0f, 0.0f});
    CHECK(footprint(bounding_box{{-1, -60, -1}, {1, -50, 1}}, light).depth == depth_interval{1.0f, 1.0f});
    CHECK(footprint(bounding_sphere{{0, 55, 0}, 1.0}, light) == light_footprint{above.texels, {0.0f, 0.0f}});
}

TEST_CASE("empty, absent and infinite bounds") {
    constexpr double infinity = std::numeric_limits<double>::infinity(), not_a_number = std::numeric_limits<double>::quiet_NaN();
    dice roll{std::mt19937_64(3)};
    for (int i = 0; i < 30; ++i) {
        const light_frame light = any_light(roll, i);
        CHECK(footprint(bounding_box{{1, 1, 1}, {0, 2, 2}}, light).empty());
        for (int axis = 0; axis < 3; ++axis)
            for (const double bad : {3.0, not_a_number}) {
                bounding_box box{{0, 0, 0}, {1, 2, 2}};
                box.lower[axis] = bad;
                CHECK(footprint(box, light).empty());
                bounding_sphere ball{{0, 0, 0}, 1.0};
                ball.centre[axis] = not_a_number;
                CHECK(footprint(ball, light).empty());
                CHECK((box.empty() && ball.empty() && box_around(ball).empty()));
            }
        CHECK(box_around(bounding_sphere{glm::dvec3(1e300), -1.0}).empty()); // where one more or less is the same
        CHECK(footprint(bounding_sphere{{0, 0, 0}, -1.0}, light).empty());
        CHECK(footprint(bounding_sphere{{0, 0, 0}, not_a_number}, light).empty());
        CHECK(footprint(bounding_box{glm::dvec3(-infinity), glm::dvec3(infinity)}, light) ==
              light_footprint{whole(map_size), {0.0f, 1.0f}});
        CHECK(footprint(bounding_sphere{{0, 0, 0}, infinity}, light) == light_footprint{whole(map_size), {0.0f, 1.0f}});
        CHECK(footprint(bounding_box{glm::dvec3(1e300), glm::dvec3(infinity)}, light).empty() ==
              footprint(bounding_box{glm::dvec3(1e30), glm::dvec3(1e30)}, light).empty());
    }
}

TEST_CASE("every point of a box without end that a spot light sees is in its footprint, and one that is wholly behind it is not on "
          "the map") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    dice roll{std::mt19937_64(4)};
    int points = 0, outside = 0, part = 0, empty = 0;
    for (int i = 0; i < 6000; ++i) {
        const light_frame light =
            spot_light{.position = roll.vector(5.0), .direction = roll.vector(1.0), .near_plane = 1.0}.frame(map_size);
        const double end = i % 3 == 0 ? std::exp(roll(3.0, 69.0)) : infinity; // to 1e30
        bounding_box box{roll.vector(5.0), {}};
        box.upper = box.lower + glm::abs(roll.vector(5.0));
        for (int axis = 0; axis < 3; ++axis) {
            if (roll(0.0, 2.0) < 1.0) box.lower[axis] = -end;
            if (roll(0.0, 2.0) < 1.0) box.upper[axis] = end;
        }
        const light_footprint f = footprint(box, light);
        part += !f.empty() && f.texels != whole(map_size);
        empty += f.empty();
        const bounding_box around{(glm::max)(box.lower, glm::dvec3(-20.0)), (glm::min)(box.upper, glm::dvec3(20.0))};
        seen points_of_box;
        for (int k = 0; k < 100; ++k) points_of_box.add(light, roll.inside(around), f);
        points += points_of_box.points;
        outside += points_of_box.outside;
    }
    CHECK(outside == 0);
    CHECK(points > 20000);
    CHECK(part > 200);
    CHECK(empty > 200);
}

TEST_CASE("a box has a footprint of its own while no edge that is cut ends 2^40 texels away") {
    const glm::dmat4 rows{glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(0, 0, 1.0 / 6.0, 1),
                          glm::dvec4(0, 0, -1.0 / 3.0, 0)};
    const light_frame light(rows, {8, 8}, 2.0, 8.0); // looks along z from 0: a texel on its near plane is 2 wide
    for (const int axis : {0, 1}) {
        bounding_box box{{0, 0, 1}, {1.0, 1.0, 3.0}};
        const auto touched = [&](double end) {
            box.upper[axis] = end;
            return footprint(box, light).texels;
        };
        CHECK(touched(0x1p41 - 0x1p9) == (axis == 0 ? texel_rect{0, 0, 8, 1} : texel_rect{0, 0, 1, 8}));
        CHECK(touched(0x1p41) == whole({8, 8}));
    }
}

TEST_CASE("a ball without end touches the whole map, wherever its centre is") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    dice roll{std::mt19937_64(5)};
    for (int i = 0; i < 30; ++i)
        for (const double x : {-infinity, -1e300, 0.0, 1e300, infinity})
            CHECK(footprint(bounding_sphere{{x, 10.0, 0.5}, infinity}, any_light(roll, i)) ==
                  light_footprint{whole(map_size), {0.0f, 1.0f}});
}

TEST_CASE("bounds that nobody has set are a point: the origin of the world") {
    CHECK((bounding_sphere{}.centre == glm::dvec3(0.0) && !(bounding_sphere{}.radius > 0.0) && !bounding_sphere{}.empty()));
    CHECK((bounding_box{}.lower == glm::dvec3(0.0) && bounding_box{}.upper == glm::dvec3(0.0)));
}

TEST_CASE("footprints are equal if and only if texels and depths are") {
    const light_footprint one{{1, 2, 3, 4}, {0.25f, 0.5f}};
    CHECK(one == light_footprint{{1, 2, 3, 4}, {0.25f, 0.5f}});
    CHECK(one != light_footprint{{1, 2, 3, 5}, {0.25f, 0.5f}});
    CHECK(one != light_footprint{{1, 2, 3, 4}, {0.25f, 0.75f}});
}

TEST_CASE("before an invalid light nothing has a footprint and before a valid one neither has an empty box or ball") {
    const light_frame nowhere, light = spot_light{.position = {0, 5, 0}, .direction = {0, -1, 0}}.frame({64, 64});
    const bounding_box box{{-1, -1, -1}, {1, 1, 1}}, no_box{{1, 1, 1}, {-1, -1, -1}};
    const bounding_sphere ball{{0, 0, 0}, 1.0}, no_ball{{0, 0, 0}, -1.0};
    CHECK(!footprint(box, light).empty());
    CHECK(!footprint(ball, light).empty());
    CHECK(footprint(box, nowhere).empty());
    CHECK(footprint(ball, nowhere).empty());
    CHECK(footprint(no_box, light).empty());
    CHECK(footprint(no_ball, light).empty());
    CHECK(footprint(bounding_sphere{{0, 0, 0}, -1e-9}, light).empty()); // though the slack is more than that
}
