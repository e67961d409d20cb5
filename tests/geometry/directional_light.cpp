#include <gnomon/geometry/directional_light.hpp>

#include <gnomon/geometry/footprint.hpp>

#include "../support/world_dice.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace gnomon;

namespace {
using dice = test::world_dice;

double from_whole(double v) { return std::abs(v - std::round(v)); }
double texel_size(const light_frame& light) { return 1.0 / glm::length(glm::dvec3(detail::row(light.matrix(), 0))); }
} // namespace

TEST_CASE("when casters move, a world point keeps its place within its texel, and its depth moves by whole 8-bit codes") {
    dice roll{std::mt19937_64(1)};
    for (int scene = 0; scene < 50; ++scene) {
        const glm::dvec3 direction = roll.vector(1.0), a = roll.vector(30.0), b = roll.vector(30.0);
        const auto fit = [&](const glm::dvec3& moved) {
            directional_light sun(direction);
            sun.add_caster(bounding_sphere{a + moved, 7.0});
            sun.add_caster(bounding_box{b + moved - glm::dvec3(3, 1, 2), b + moved + glm::dvec3(3, 1, 2)});
            sun.add_receiver(bounding_sphere{b + moved, 50.0});
            return sun.frame({300 + scene, 257}, 5);
        };
        const light_frame still = fit(glm::dvec3(0));
        REQUIRE(still.valid());
        double worst = 0.0, most_moved = 0.0;
        for (int i = 0; i < 200; ++i) {
            const light_frame moved = fit(roll.vector(i < 100 ? 3.0 : 1e5));
            const glm::dvec3 p = roll.vector(20.0);
            const map_point here = still.to_map(p), there = moved.to_map(p);
            worst = greater(worst, greater(from_whole(there.x - here.x), from_whole(there.y - here.y)));
            worst = greater(worst, from_whole((there.depth - here.depth) * 255.0));
            most_moved = greater(most_moved, std::abs(there.x - here.x));
        }
        CAPTURE(scene);
        CHECK(worst < 1e-6);
        CHECK(most_moved > 1.0);
    }
}

TEST_CASE("casters keep the margin free on every side, and the map is not larger than the texel ladder makes it") {
    dice roll{std::mt19937_64(2)};
    double tightest = 1e9;
    for (int i = 0; i < 3000; ++i) {
        directional_light sun(roll.vector(1.0), roll.vector(1.0));
        const int margin = i % 9;
        const extent size{40 + i % 200, 40 + i % 170};
        double x0 = 1e9, x1 = -1e9, y0 = 1e9, y1 = -1e9, z0 = 1e9, z1 = -1e9;
        bounding_sphere ball{roll.vector(100.0), roll(0.0, 50.0)};
        glm::dvec3 corner = roll.vector(100.0);
        bounding_box box{corner, corner + glm::dvec3(roll(0, 30), roll(0, 30), roll(0, 30))},
            ground{glm::dvec3(-200, 0, -90), glm::dvec3(100, 0, 400)};
        sun.add_caster(ball);
        if (i % 2) sun.add_caster(box);
        if (i % 3 == 0) sun.add_receiver(ground);
        const light_frame light = sun.frame(size, margin);
        REQUIRE(light.valid());

        const auto include = [&](const glm::dvec3& p, bool caster) {
            const map_point m = light.to_map(p);
            z0 = lesser(z0, m.depth);
            z1 = greater(z1, m.depth);
            if (!caster) return;
            x0 = lesser(x0, m.x);
            x1 = greater(x1, m.x);
            y0 = lesser(y0, m.y);
            y1 = greater(y1, m.y);
        };
        for (int axis = 0; axis < 3; ++axis) { // the ball's extremes on the map are along the rows of the matrix
            const glm::dvec3 row(detail::row(light.matrix(), axis));
            for (const double side : {-1.0, 1.0}) include(ball.centre + row * (side * ball.radius / glm::length(row)), true);
        }
        for (int k = 0; k < 8; ++k) {
            if (i % 2) include(box.corner(k), true);
            if (i % 3 == 0) include(ground.corner(k), false);
        }
        CAPTURE(i);
        CHECK(x0 >= margin);
        CHECK(y0 >= margin);
        CHECK(x1 <= size.width - margin);
        CHECK(y1 <= size.height - margin);
        CHECK(z0 >= 0.0);
        CHECK(z1 <= 1.0);
        const double fill = greater((x1 - x0) / (size.width - 2 * margin - 1), (y1 - y0) / (size.height - 2 * margin - 1));
        CHECK(fill > 0.9169); // 2^(-1/8) = .91700
        CHECK(z1 - z0 > 0.9169 * 254.0 / 255.0);
        tightest = lesser(tightest, lesser(lesser(x0, y0), lesser(size.width - x1, size.height - y1)) - margin);
    }
    CHECK(tightest < 0.1); // the margin is what was asked for, not more
}

TEST_CASE("a sun without casters, with one point for all of them or with infinite ones has no frame") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto frame_of = [](const auto&... casters) {
        directional_light sun({0.3, -1.0, 0.2});
        sun.add_receiver(bounding_sphere{glm::dvec3(1), 5.0});
        (sun.add_caster(casters), ...);
        return sun.frame({64, 64});
    };
    const bounding_sphere ball{glm::dvec3(1), 1.0}, point{glm::dvec3(1), 0.0};
    CHECK(frame_of(ball).valid());
    CHECK_FALSE(directional_light({0.3, -1.0, 0.2}).frame({64, 64}).valid());
    CHECK_FALSE(frame_of().valid());
    CHECK_FALSE(frame_of(point).valid());
    CHECK_FALSE(frame_of(bounding_box{glm::dvec3(1), glm::dvec3(1)}, point).valid());
    CHECK_FALSE(frame_of(bounding_sphere{glm::dvec3(1), infinity}).valid());
    CHECK_FALSE(frame_of(bounding_sphere{glm::dvec3(infinity), 1.0}, ball).valid());
    CHECK_FALSE(frame_of(bounding_box{glm::dvec3(-infinity), glm::dvec3(infinity)}).valid());
}

TEST_CASE("on the largest map too, a caster just above a step of the texel's size keeps on it") {
    constexpr int texels = light_frame::largest_side;
    directional_light sun({0, 0, -1});
    sun.add_caster(bounding_sphere{{0.49, 0.49, 0.0}, 0.5 * (texels - 1) * (1.0 + 0.9e-6)}); // texels of 1 would be .9e-6 too small
    const light_frame light = sun.frame({texels, texels});
    CHECK(texel_size(light) > 1.09);
    CHECK(texel_size(light) < 1.091);
}

TEST_CASE("margins must leave two texels of either side") {
    directional_light sun({0.3, -1.0, 0.2});
    sun.add_caster(bounding_sphere{{1.0, 2.0, 3.0}, 4.0});
    for (const extent size : {extent{6, 600}, extent{600, 6}, extent{6, 6}}) CHECK(sun.frame(size, 2).valid());
    for (const extent size : {extent{5, 600}, extent{600, 5}, extent{4, 600}, extent{600, 4}, extent{0, 600}, extent{600, 0}})
        CHECK_FALSE(sun.frame(size, 2).valid());
    directional_light line({0, -1, 0}); // of casters, as high as nothing on the map
    line.add_caster(bounding_box{{-1, 0, 0}, {1, 0, 0}});
    CHECK(line.frame({600, 6}, 2).valid());
    CHECK_FALSE(line.frame({600, 5}, 2).valid());
    CHECK(sun.frame({2, 2}).valid()); // without a margin, unless one is asked for
}

TEST_CASE("a sphere that wanders never changes the size of a texel") {
    dice roll{std::mt19937_64(3)};
    for (const double radius : {0.5, 1.0, 10.0, 33.3, 64.0, 507.5, 1000.0}) { // 1015 texels are left: 507.5 is a step
        const glm::dvec3 direction = roll.vector(1.0);
        double smallest = 1e300, largest = 0.0;
        for (int i = 0; i < 2000; ++i) {
            directional_light sun(direction);
            sun.add_caster(bounding_sphere{roll.vector(1e5), radius});
            const double texel = texel_size(sun.frame({1024, 1024}, 4));
            smallest = lesser(smallest, texel);
            largest = greater(largest, texel);
        }
        CAPTURE(radius);
        CHECK_FALSE(largest > smallest);
    }
}

TEST_CASE("every direction has a frame, also along the up hint, and up is up") {
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                for (const glm::dvec3 up : {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0),
                                            glm::dvec3(1, 1, 1), glm::dvec3(std::nan(""))}) {
                    const glm::dvec3 direction(x, y, z);
                    directional_light sun(direction * 1e-9, up);
                    sun.add_caster(bounding_sphere{glm::dvec3(0), 1.0});
                    const light_frame light = sun.frame({64, 64});
                    CHECK(light.valid() == (direction != glm::dvec3(0)));
                    if (!light.valid()) continue;
                    const map_point origin = light.to_map(glm::dvec3(0)), ahead = light.to_map(direction), above = light.to_map(up);
                    CHECK(std::abs(ahead.x - origin.x) < 1e-9);
                    CHECK(std::abs(ahead.y - origin.y) < 1e-9);
                    CHECK(ahead.depth > origin.depth);
                    if (!(glm::length(glm::cross(direction, up)) > 1e-3)) continue;
                    CHECK(above.y > origin.y);
                    CHECK(std::abs(above.x - origin.x) < 1e-9);
                }
}

TEST_CASE("up is the world's y unless another is asked for") {
    directional_light sun({0.3, -1.0, 0.2});
    sun.add_caster(bounding_sphere{glm::dvec3(0), 1.0});
    const light_frame light = sun.frame({64, 64});
    const map_point origin = light.to_map({0, 0, 0}), above = light.to_map({0, 1, 0});
    CHECK(std::abs(above.x - origin.x) < 1e-9);
    CHECK(above.y > origin.y);
}

TEST_CASE("empty bounds change nothing") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    directional_light sun({0.1, -1, 0.3}), plain({0.1, -1, 0.3});
    for (directional_light* light : {&sun, &plain}) light->add_caster(bounding_sphere{{1, 2, 3}, 4.0});
    sun.add_caster(bounding_sphere{{100, 0, 0}, -1.0});
    sun.add_caster(bounding_sphere{{100, 0, 0}, nan});
    sun.add_caster(bounding_sphere{{100, nan, 0}, 1.0});
    sun.add_caster(bounding_box{{100, 0, 0}, {99, 1, 1}});
    sun.add_receiver(bounding_box{{100, 0, nan}, {101, 1, 1}});
    sun.add_receiver(bounding_sphere{{0, 1000, 0}, nan});
    sun.add_receiver(bounding_sphere{{0, 1000, 0}, -1.0});
    sun.add_receiver(bounding_box{{0, 1000, 0}, {-1, 1000, 0}});
    CHECK(sun.frame({64, 64}).matrix() == plain.frame({64, 64}).matrix());
    plain.add_receiver(bounding_sphere{{0, 1000, 0}, 0.0}); // a point is not empty
    CHECK(sun.frame({64, 64}).matrix() != plain.frame({64, 64}).matrix());
}

TEST_CASE("a flat caster across the light still has a depth range") {
    directional_light sun({0, -1, 0});
    sun.add_caster(bounding_box{{-1, 3, -1}, {1, 3, 1}});
    const light_frame light = sun.frame({64, 64});
    REQUIRE(light.valid());
    const double z = light.to_map({0, 3, 0}).depth;
    CHECK((z >= 0.0 && z <= 1.0));
}
