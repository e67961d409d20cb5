// A rebased frame against the same frame in double. h17 in ../hard_cases says what this is for.
#include <gnomon/geometry/rebase.hpp>

#include <gnomon/geometry/directional_light.hpp>
#include <gnomon/geometry/spot_light.hpp>
#include <gnomon/soft_shadow_map.hpp>

#include "../support/bits.hpp"
#include "../support/world_dice.hpp"

#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cmath>
#include <random>
#include <vector>

using namespace gnomon;

namespace {
using dice = test::world_dice;

/// Row `i` of a rebased frame: what it may be off by at `p`, as rebase.hpp states it.
double stated_error(const rebased_frame& frame, int i, const glm::vec3& p) {
    const glm::mat4& m = frame.matrix();
    const float terms = std::abs(m[0][i] * p.x) + std::abs(m[1][i] * p.y) + std::abs(m[2][i] * p.z) + std::abs(m[3][i]);
    return static_cast<double>(terms * rebase_error) * (1.0 + 1e-6); // the terms themselves are floats here
}

struct ratios {
    double worst = 0.0;
    void add(float found, double exact, double stated) {
        worst = greater(worst, std::abs(static_cast<double>(found) - exact) / stated);
    }
};

/// A map of 2048 texels over a cube of 200 m.
light_frame two_hundred_metres(const detail::light_axes& axes, const glm::dvec3& middle) {
    const auto row = [&](const glm::dvec3& axis, double size) {
        return glm::dvec4(axis * (size / 200.0), 0.5 * size - glm::dot(axis, middle) * (size / 200.0));
    };
    return {detail::from_rows(row(axes.right, 2048.0), row(axes.upward, 2048.0), row(axes.forward, 1.0), {0.0, 0.0, 0.0, 1.0}),
            {2048, 2048},
            1.0,
            1.0};
}

bool same_bits(const glm::vec3& a, const glm::vec3& b) {
    return test::same_bits(a.x, b.x) && test::same_bits(a.y, b.y) && test::same_bits(a.z, b.z);
}
} // namespace

TEST_CASE("floats get the shadow that doubles get at the world's origin and 1e6 m away from it") {
    const auto shadows = [](const glm::dvec3& place) {
        directional_light sun({0.3, -1.0, 0.2});
        sun.add_caster(bounding_box{place + glm::dvec3(-4, 3, -4), place + glm::dvec3(4, 5, 4)});
        sun.add_receiver(bounding_box{place + glm::dvec3(-16, -1, -16), place + glm::dvec3(16, 1, 16)});
        soft_shadow_map<rg16, gaussian<6>> map({.width = 256, .height = 256});
        const light_frame light = sun.frame(map.size(), gaussian<6>::radius);
        const rebased_frame near_by(light);
        const map_point middle = light.to_map(place + glm::dvec3(0, 4, 0));
        const int x = static_cast<int>(middle.x), y = static_cast<int>(middle.y);
        map.cast({x - 40, y - 40, x + 40, y + 40}, static_cast<float>(middle.depth));
        map.filter();

        std::vector<glm::dvec3> ground;
        for (int i = 0; i < 64; ++i) ground.emplace_back(place + glm::dvec3(-8.0 + i * 0.25, 0.0, 0.5));
        std::vector<glm::vec3> local(ground.size());
        rebase(ground, near_by.origin(), local);
        std::vector<float> dark;
        for (const glm::vec3& p : local) dark.push_back(map.shadow_at(near_by.to_map(p)));
        for (std::size_t i = 0; i < ground.size(); ++i) // and it is that of doubles
            CHECK(std::abs(dark[i] - map.shadow_at(light.to_map(ground[i]))) < 0.01f);
        return dark;
    };
    for (const glm::dvec3& place : {glm::dvec3(0), glm::dvec3(1e6, 0.0, -1e6)}) {
        int lit = 0, umbra = 0, penumbra = 0;
        for (const float v : shadows(place)) ++(v > 0.0f ? (v < 1.0f ? penumbra : umbra) : lit);
        CHECK(lit > 5);
        CHECK(umbra > 5);
        CHECK(penumbra > 2);
    }
}

TEST_CASE("every row of a rebased frame keeps the stated error and comes near to it") {
    dice roll{std::mt19937_64(1)};
    ratios any, worst_made;
    for (int i = 0; i < 20000; ++i) {
        const light_frame light = two_hundred_metres({roll.vector(1.0), roll.vector(1.0)}, roll.vector(1e6));
        const rebased_frame near_by(light);
        const glm::dvec3 p = near_by.origin() + roll.vector(i % 2 == 0 ? 150.0 : 5.0);
        const glm::vec3 local = rebase(p, near_by.origin());
        const map_point exact = light.to_map(p);
        const rebased_point found = near_by.to_map(local);
        any.add(found.x, exact.x, stated_error(near_by, 0, local) + 1e-7); // what doubles round at 1e6 m
        any.add(found.y, exact.y, stated_error(near_by, 1, local) + 1e-7);
        any.add(found.depth, exact.depth, stated_error(near_by, 2, local) + 1e-11);
    }
    CHECK(any.worst <= 1.0);
    CHECK(any.worst > 0.4);
    // Where all terms are alike and just above a power of two, roundings are largest and may agree.
    for (int i = 0; i < 200000; ++i) {
        const auto term = [&roll] { return roll(1.0, 1.06); };
        const light_frame light({term(), 0, 0, 0, term(), 1, 0, 0, term(), 0, 1, 0, term(), 0, 0, 1}, {64, 64}, 1.0, 1.0);
        const rebased_frame here(light, glm::dvec3(0));
        const glm::dvec3 p(term(), term(), term());
        const glm::vec3 local = rebase(p, here.origin());
        worst_made.add(here.to_map(local).x, light.to_map(p).x, stated_error(here, 0, local));
    }
    CHECK(worst_made.worst <= 1.0);
    CHECK(worst_made.worst > 0.55);
}

TEST_CASE("over a cube of 200 m in 2048 texels the stated error is below 1e-3 texel and 1e-6 of the range and nearly that") {
    dice roll{std::mt19937_64(2)};
    double texels = 0.0, depth = 0.0;
    for (int i = 0; i < 3000; ++i) {
        const detail::light_axes axes(roll.vector(1.0), roll.vector(1.0));
        const glm::dvec3 middle = roll.vector(1e6);
        const rebased_frame near_by(two_hundred_metres(axes, middle));
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 p = middle + axes.right * (corner & 1 ? 100.0 : -100.0) + axes.upward * (corner & 2 ? 100.0 : -100.0) +
                                 axes.forward * (corner & 4 ? 100.0 : -100.0);
            const glm::vec3 local = rebase(p, near_by.origin());
            texels = greater(texels, greater(stated_error(near_by, 0, local), stated_error(near_by, 1, local)));
            depth = greater(depth, stated_error(near_by, 2, local));
        }
    }
    CHECK(texels <= 1e-3);
    CHECK(texels > 0.9e-3);
    CHECK(depth <= 1e-6);
    CHECK(depth > 0.4e-6);
}

TEST_CASE("the error grows with the map and with the distance from the origin and not with the distance from the world's") {
    const auto worst = [](double world, double from_origin, int texels) {
        dice roll{std::mt19937_64(3)};
        double error = 0.0;
        for (int i = 0; i < 5000; ++i) {
            const glm::dvec3 middle = roll.vector(world);
            directional_light sun(roll.vector(1.0));
            sun.add_caster(bounding_sphere{middle, 50.0});
            const light_frame light = sun.frame({texels, texels});
            const glm::dvec3 origin = middle + glm::normalize(roll.vector(1.0)) * from_origin, p = middle + roll.vector(25.0);
            const rebased_point found = rebased_frame(light, origin).to_map(rebase(p, origin));
            error = greater(error, std::abs(static_cast<double>(found.x) - light.to_map(p).x));
        }
        return error;
    };
    const double usual = worst(0.0, 0.0, 1024);
    CHECK(worst(1e7, 0.0, 1024) < usual * 1.5);
    CHECK(worst(0.0, 0.0, 4096) > usual * 3.0);
    CHECK(worst(0.0, 0.0, 4096) < usual * 5.0);
    CHECK(worst(0.0, 10000.0, 1024) > usual * 20.0);
}

TEST_CASE(
    "the origin of a directional light is the middle of its box to a quarter of the way to a corner and lies on a coarse grid") {
    dice roll{std::mt19937_64(4)};
    double farthest = 0.0;
    for (int i = 0; i < 5000; ++i) {
        const double scale = std::exp2(roll(-10.0, 20.0));
        const glm::dvec3 middle = roll.vector(i % 2 == 0 ? 1e6 : 100.0 * scale);
        glm::dmat4 m(0.0); // sheared, mirrored, of any proportions
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r) m[c][r] = roll(-1.0, 1.0) / scale;
        if (std::abs(glm::determinant(glm::dmat3(m)) * scale * scale * scale) < 0.05) continue;
        m[3] = glm::dvec4(glm::dvec3(50.0, 40.0, 0.5) - glm::dvec3(m * glm::dvec4(middle, 0.0)), 1.0);
        const light_frame light(m, {100, 80}, 1.0, 1.0);
        REQUIRE(light.valid());
        const glm::dvec3 origin = rebase_origin(light);
        double reach = 0.0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 to((corner & 1) * 50.0, (corner & 2) * 20.0,
                                (corner & 4) * 0.125); // from the middle, as they are lines
            const glm::dvec3 half(to.x > 0 ? 50.0 : -50.0, to.y > 0 ? 40.0 : -40.0, to.z > 0 ? 0.5 : -0.5);
            reach = greater(reach, glm::length(glm::inverse(glm::dmat3(m)) * half));
        }
        const double cell = std::exp2(std::floor(std::log2(reach)) - 2.0);
        const glm::dvec3 off = glm::abs(origin - middle) / cell;
        farthest = greater(farthest, greater(off.x, greater(off.y, off.z)));
        for (int k = 0; k < 3; ++k) CHECK(test::equal(origin[k] / cell, std::round(origin[k] / cell)));
        CHECK(test::same_bits(rebase(origin, origin).x, 0.0f));
    }
    CHECK(farthest < 0.501);
    CHECK(farthest > 0.49);
}

TEST_CASE("the origin stands still while casters wander within a cell and while a spot light only turns") {
    int moved = 0;
    glm::dvec3 before(0.0);
    for (int i = 0; i <= 1000; ++i) { // 100 m, in steps of .1 m
        directional_light sun({0.3, -1.0, 0.2});
        sun.add_caster(bounding_sphere{{1e6 + i * 0.1, 0.0, -1e6}, 50.0});
        const glm::dvec3 origin = rebase_origin(sun.frame({1024, 1024}));
        moved += i > 0 && origin != before;
        before = origin;
    }
    CHECK(moved >= 1);
    CHECK(moved <= 100 / 8);

    spot_light lamp{.position = {1e6, 20.0, 1e6}, .direction = {0, -1, 0}, .near_plane = 1.0, .far_plane = 50.0};
    const glm::dvec3 origin = rebase_origin(lamp.frame({512, 512}));
    CHECK(glm::length(origin - lamp.position) <= 0.25);
    lamp.direction = {0.5, -0.7, 0.1};
    lamp.outer_angle = 1.0;
    lamp.far_plane = 5000.0;
    CHECK(rebase_origin(lamp.frame({2048, 2048})) == origin);
}

TEST_CASE("the origin of a spot light is its place to an eighth of the distance to its near plane, whatever a matrix calls that") {
    const glm::dvec3 place(3.3, -2.7, 1.1), ahead(0.36, -0.48, 0.8);
    const struct {
        double near_plane, far_plane, cell; // 1/8 to 1/4 of the first
    } lamps[] = {{0.01, 80.0, 0x1p-9}, {0.6, 1.2, 0x1p-3}};
    for (const auto& lamp : lamps)
        for (const double scale : {0x1p-6, 1.0, 0x1p6}) {
            const glm::dmat4 matrix = glm::perspectiveRH_ZO(1.0, 1.0, lamp.near_plane, lamp.far_plane) *
                                      glm::lookAtRH(place, place + ahead, glm::dvec3(0, 1, 0));
            const light_frame light = light_frame::from_matrix(matrix * scale, {4, 4}, {clip_depth::zero_to_one});
            REQUIRE(light.valid());
            const glm::dvec3 origin = rebase_origin(light), off = glm::abs(origin - place);
            CHECK(greater(off.x, greater(off.y, off.z)) <= 0.5 * lamp.cell * 1.001);
            for (int k = 0; k < 3; ++k) CHECK(test::equal(origin[k] / lamp.cell, std::round(origin[k] / lamp.cell)));
        }
}

TEST_CASE("a spot light keeps its precision right to its near plane because its origin is its own place") {
    dice roll{std::mt19937_64(5)};
    const auto worst_near = [&roll](double forward) {
        double error = 0.0;
        for (int i = 0; i < 5000; ++i) {
            const glm::dvec3 position = roll.vector(1e6), axis = glm::normalize(roll.vector(1.0));
            const light_frame light =
                spot_light{.position = position, .direction = axis, .near_plane = 0.25, .far_plane = 500.0}.frame({1024, 1024});
            const rebased_frame frame = forward > 0.0 ? rebased_frame(light, position + axis * forward) : rebased_frame(light);
            const glm::dvec3 p = position + axis * 0.25 + roll.vector(0.05);
            error = greater(error, std::abs(static_cast<double>(frame.to_map(rebase(p, frame.origin())).x) - light.to_map(p).x));
        }
        return error;
    };
    CHECK(worst_near(0.0) < 1e-3);
    CHECK(worst_near(250.0) > 1e-2); // the middle of its range would be a bad one
}

TEST_CASE("rebasing many positions is rebasing each from any stride and the shorter span counts") {
    dice roll{std::mt19937_64(6)};
    struct vertex {
        glm::dvec3 position;
        double weight;
    };
    std::vector<vertex> vertices;
    for (int i = 0; i < 50; ++i) vertices.push_back({roll.vector(1e7), 1.0});
    const glm::dvec3 origin = roll.vector(1e7);
    const strided_span<const glm::dvec3> positions(&vertices[0].position, 50, sizeof(vertex));
    std::array<glm::vec3, 60> local{};
    local.fill(glm::vec3(7.0f));
    rebase(positions, origin, local);
    for (std::size_t i = 0; i < local.size(); ++i)
        CHECK(same_bits(local[i], i < 50 ? rebase(vertices[i].position, origin) : glm::vec3(7.0f)));
    std::array<glm::vec3, 3> few{};
    rebase(positions, origin, few);
    CHECK(same_bits(few[2], local[2]));
    rebase(strided_span<const glm::dvec3>(), origin, few);
    rebase(positions, origin, strided_span<glm::vec3>());

    // Once rounded, and not before: at 1e6 m a millimetre is what it is.
    const glm::vec3 millimetre = rebase({1e6 + 0.001, 0.0, 0.0}, {1e6, 0.0, 0.0});
    CHECK(std::abs(static_cast<double>(millimetre.x) - 0.001) < 2e-10);
}

TEST_CASE("an object's matrix rebased puts its vertices where their doubles are") {
    dice roll{std::mt19937_64(7)};
    double worst = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 place = roll.vector(1e6), origin = place + roll.vector(50.0);
        const glm::dmat4 model =
            glm::rotate(glm::translate(glm::dmat4(1.0), place), roll(0.0, 6.0), glm::normalize(roll.vector(1.0)));
        const glm::vec3 vertex(roll.vector(2.0));
        const glm::vec3 found(rebase(model, origin) * glm::vec4(vertex, 1.0f));
        const glm::dvec3 exact = glm::dvec3(model * glm::dvec4(glm::dvec3(vertex), 1.0)) - origin;
        worst = greater(worst, glm::length(glm::dvec3(found) - exact));
    }
    CHECK(rebase(glm::dmat4(1.0), {1, 2, 3}) == glm::translate(glm::mat4(1.0f), glm::vec3(-1, -2, -3))); // the last row too
    CHECK(worst < 1e-5); // of 50 m; a float matrix at 1e6 m is off by .03
    CHECK(worst > 1e-6);
}

TEST_CASE("the depth of a rebased frame is the depth plane that a shader gets") {
    const light_frame light = spot_light{.position = {1e6, 3.0, 7.0}}.frame({64, 64});
    const rebased_frame near_by(light);
    const glm::vec4 plane = light.depth_plane(near_by.origin());
    for (int i = 0; i < 4; ++i) CHECK(std::abs(near_by.matrix()[i][2] - plane[i]) <= 1e-9f);
}

TEST_CASE("what is nowhere in doubles is nowhere in floats and no origin makes it somewhere") {
    constexpr float none = test::nan<float>, far_off = test::infinity<float>;
    const light_frame lamp = spot_light{.position = {0, 5, 0}, .direction = {0, -1, 0}}.frame({64, 64});
    directional_light sun({0, -1, 0});
    sun.add_caster(bounding_sphere{{0, 0, 0}, 1.0});
    const light_frame flat = sun.frame({64, 64});
    CHECK(rebased_frame().to_map({1, 2, 3}).in_front() == false);
    for (const double y : {4.95, 1.0}) // before the near plane, too, it is somewhere
        CHECK(rebased_frame(lamp, {0, 5, 0}).to_map(rebase(glm::dvec3(0, y, 0), glm::dvec3(0, 5, 0))).in_front());
    CHECK(rebase_origin(light_frame()) == glm::dvec3(0.0));
    CHECK(rebased_frame().origin() == glm::dvec3(0.0));
    CHECK(rebased_frame(light_frame()).matrix() == glm::mat4(0.0f));
    for (const glm::vec3& p : {glm::vec3(0), glm::vec3(none, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, far_off, 0)})
        CHECK_FALSE(rebased_frame(lamp, {0, 5, 0}).to_map(p).in_front());
    for (const double odd : {test::nan<double>, test::infinity<double>, -test::infinity<double>})
        for (const light_frame& light : {lamp, flat}) {
            CHECK_FALSE(rebased_frame(light, {odd, 0, 0}).to_map({0, 0, 0}).in_front());
            CHECK_FALSE(rebased_frame(light, {0, 0, odd}).to_map({1, -1, 1}).in_front());
        }
    for (const glm::vec3& p : {glm::vec3(none, 0, 0), glm::vec3(0, none, 0), glm::vec3(0, 0, none), glm::vec3(0, far_off, 0)}) {
        const rebased_point q = rebased_frame(flat).to_map(p);
        CHECK((!q.in_front() || q.depth < 0.0f || q.depth > 1.0f));
    }
    // A frame whose middle is no number, or whose floats overflow, still answers.
    const light_frame tiny(glm::dmat4(1e-200, 0, 0, 0, 0, 1e-100, 0, 0, 0, 0, 1e-10, 0, 0, 0, 0, 1), {64, 64}, 1.0, 1.0);
    CHECK(std::isfinite(rebase_origin(tiny).x));
    for (int axis = 0; axis < 3; ++axis) { // a lamp so far along one axis that a double cannot say where
        glm::dmat4 m(1.0);
        m[axis][axis] = 1e-10;
        m[3][axis] = 1e300;
        m[2][3] = 99.0 * m[2][2]; // W is 1 at depth 0 and 100 at depth 1
        m[3][3] = 99.0 * m[3][2] + 1.0;
        const light_frame lamp_far_off(m, {64, 64}, 1.0, 100.0);
        REQUIRE(lamp_far_off.valid());
        CHECK(rebase_origin(lamp_far_off) == glm::dvec3(0.0));
    }
    // Finite though no sum of its coordinates is.
    const light_frame outermost(glm::dmat4(1e-50, 0, 0, 0, 0, 1e-50, 0, 0, 0, 0, 1e-150, 0, -1.2e258, -1.2e258, 0, 1), {64, 64},
                                1.0, 1.0);
    const glm::dvec3 origin = rebase_origin(outermost);
    CHECK(std::abs(origin.x / 1.2e308 - 1.0) < 1e-9);
    CHECK(std::abs(origin.y / 1.2e308 - 1.0) < 1e-9);
    const light_frame huge(glm::dmat4(1e90, 0, 0, 0, 0, 1e90, 0, 0, 0, 0, 1e90, 0, 0, 0, 0, 1), {64, 64}, 1.0, 1.0);
    CHECK_FALSE(rebased_frame(huge).to_map({0, 0, 0}).depth > 1.0f);
}
