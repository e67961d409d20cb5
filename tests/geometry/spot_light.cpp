#include <gnomon/geometry/spot_light.hpp>

#include "../support/bits.hpp"
#include "../support/world_dice.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace gnomon;

namespace {
using dice = test::world_dice;
} // namespace

TEST_CASE("depth is linear in the distance along the axis, wherever beside it") {
    dice roll{std::mt19937_64(1)};
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 axis = glm::normalize(roll.vector(1.0)), position = roll.vector(50.0);
        const double near_plane = roll(0.01, 5.0), far_plane = near_plane + roll(0.1, 1000.0);
        const light_frame light =
            spot_light{.position = position, .direction = axis * 3.0, .near_plane = near_plane, .far_plane = far_plane}.frame(
                {128, 128});
        const double distance = roll(0.001, 1200.0);
        const glm::dvec3 beside = glm::cross(axis, roll.vector(1.0)) * distance;
        const double expected = (distance - near_plane) / (far_plane - near_plane);
        worst = greater(worst,
                        std::abs(light.to_map(position + axis * distance + beside).depth - expected) / (1.0 + std::abs(expected)));
    }
    CHECK(worst < 1e-11);
}

TEST_CASE("the rim of the cone keeps the margin, and touches it") {
    dice roll{std::mt19937_64(2)};
    for (int i = 0; i < 300; ++i) {
        const double angle = roll(0.01, 1.5);
        const glm::dvec3 axis = glm::normalize(roll.vector(1.0)), position = roll.vector(9.0);
        const extent size{50 + i % 40, 50 + i % 30};
        const int margin = i % 7;
        const light_frame light =
            spot_light{.position = position, .direction = axis, .outer_angle = angle, .up = roll.vector(1.0)}.frame(size, margin);
        REQUIRE(light.valid());
        const glm::dvec3 side = glm::normalize(glm::cross(axis, roll.vector(1.0))), other = glm::cross(axis, side);
        const double radius = 0.5 * lesser(size.width, size.height) - margin;
        double worst = 0.0;
        for (double turn = 0.0; turn < 6.28; turn += 0.01) {
            const glm::dvec3 rim = axis * std::cos(angle) + (side * std::cos(turn) + other * std::sin(turn)) * std::sin(angle);
            const map_point m = light.to_map(position + rim * roll(0.1, 60.0));
            worst = greater(worst, std::abs(std::hypot(m.x - 0.5 * size.width, m.y - 0.5 * size.height) - radius));
        }
        CHECK(worst < 1e-8);
    }
}

TEST_CASE("looking along a light with up above, right is right") {
    const light_frame light = spot_light{.position = {0, 0, 5}, .direction = {0, 0, -1}, .up = {0, 1, 0}}.frame({64, 64});
    CHECK(light.to_map({1, 0, 0}).x > 32.5);
    CHECK(std::abs(light.to_map({1, 0, 0}).y - 32.0) < 1e-9);
    CHECK(light.to_map({0, 1, 0}).y > 32.5);
    CHECK(std::abs(light.to_map({0, 1, 0}).x - 32.0) < 1e-9);
}

TEST_CASE("a lamp that nobody has set stands at the origin and lights half a radian about -z, from 0.1 to 100") {
    const light_frame light = spot_light{}.frame({64, 64});
    const double rim = 10.0 * std::tan(0.5);
    const map_point right = light.to_map({rim, 0, -10}), above = light.to_map({0, rim, -10});
    CHECK(std::abs(right.x - 64.0) + std::abs(right.y - 32.0) < 1e-9);
    CHECK(std::abs(above.x - 32.0) + std::abs(above.y - 64.0) < 1e-9);
    CHECK(std::abs(light.to_map({0, 0, -0.1}).depth) < 1e-12);
    CHECK(std::abs(light.to_map({0, 0, -100}).depth - 1.0) < 1e-12);
    const map_point above_x = spot_light{.direction = {1, 0, 0}}.frame({64, 64}).to_map({10, 1, 0}); // up is y however it is turned
    CHECK(std::abs(above_x.x - 32.0) < 1e-9);
    CHECK(above_x.y > 32.5);
    CHECK(spot_light{}.frame({2, 2}).valid()); // without a margin, unless one is asked for
}

TEST_CASE("a lamp out of its ranges has no frame") {
    const auto valid = [](const spot_light& lamp, extent size = {64, 64}, int margin = 0) {
        return lamp.frame(size, margin).valid();
    };
    constexpr double right_angle = 1.5707963267948966, nan = test::nan<double>, infinity = test::infinity<double>;
    for (const double angle : {1e-9, 1.0, test::down(right_angle)}) CHECK(valid({.outer_angle = angle}));
    for (const double angle : {0.0, -1.0, right_angle, 2.0, 3.0, nan}) CHECK_FALSE(valid({.outer_angle = angle}));
    CHECK(valid({.near_plane = 1.0, .far_plane = test::up(1.0)}));
    for (const double distance : {0.0, -1.0, 100.0, 101.0, nan, infinity}) CHECK_FALSE(valid({.near_plane = distance}));
    for (const double distance : {0.1, 0.0, -1.0, nan, infinity}) CHECK_FALSE(valid({.far_plane = distance}));
    for (const double odd : {nan, infinity}) CHECK_FALSE(valid({.position = {0, odd, 0}}));
    CHECK_FALSE(valid({.direction = {0, 0, 0}}));
    CHECK(valid({}, {9, 64}, 4));
    for (const int margin : {5, 6, 40}) CHECK_FALSE(valid({}, {10, 64}, margin)); // the margins leave nothing
    for (const double x : {0.1, 0.3, 0.7, 1.0})                                   // nor does rounding leave a volume
        CHECK_FALSE(valid({.position = {x, 1.0, 2.0}, .direction = {x, -0.5, 0.2}, .outer_angle = 0.4 + x}, {8, 14}, 4));
    CHECK(spot_light{}.frame({10, 10}, -3).matrix() == spot_light{}.frame({10, 10}).matrix());
}
