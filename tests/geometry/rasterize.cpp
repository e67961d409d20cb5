// The oracles here are rays: from the light through a texel centre, met with the triangle in the world (Moeller and Trumbore, 1997).
// They know of no projection, no clipping, no fixed point and no depth plane.
#include <gnomon/geometry/rasterize.hpp>

#include <gnomon/geometry/directional_light.hpp>
#include <gnomon/geometry/spot_light.hpp>
#include <gnomon/grid/tile_grid.hpp>

#include "../support/world_dice.hpp"

#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

using namespace gnomon;

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr extent map_size{96, 80};

using dice = test::world_dice;

struct mesh_data {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    std::uint32_t add(const glm::dvec3& p) {
        positions.emplace_back(p);
        return static_cast<std::uint32_t>(positions.size() - 1);
    }
    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) { indices.insert(indices.end(), {a, b, c}); }
    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const std::uint32_t i = add(a), j = add(b), k = add(c);
        add(i, j, k);
    }
    /// A quad, counter-clockwise.
    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
        add(a, b, c);
        add(a, c, d);
    }
    /// A box, counter-clockwise from outside.
    void add(const bounding_box& box) {
        static constexpr int faces_of_box[6][4]{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
        for (const auto& f : faces_of_box) add(box.corner(f[0]), box.corner(f[1]), box.corner(f[2]), box.corner(f[3]));
    }
    [[nodiscard]] triangle_mesh mesh(const glm::dmat4& model = glm::dmat4(1.0)) const {
        return {.positions = positions, .indices = indices, .model = model};
    }
};

/// Everything that was drawn: how often, the last, the nearest and the farthest depth.
struct canvas {
    extent size;
    int outside = 0;
    std::vector<int> count;
    std::vector<float> last, nearest, farthest;

    explicit canvas(extent s)
        : size(s), count(static_cast<std::size_t>(s.width * s.height)), last(count.size()), nearest(count.size(), 1e9f),
          farthest(count.size(), -1e9f) {}
    [[nodiscard]] std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * size.width + x); }
    void operator()(int x, int y, float z) {
        if (!whole(size).contains(x, y)) {
            ++outside;
            return;
        }
        ++count[at(x, y)];
        last[at(x, y)] = z;
        nearest[at(x, y)] = lesser(nearest[at(x, y)], z);
        farthest[at(x, y)] = greater(farthest[at(x, y)], z);
    }
    [[nodiscard]] int texels() const {
        int n = 0;
        for (int c : count) n += c > 0;
        return n;
    }
    [[nodiscard]] int not_once() const {
        int n = 0;
        for (int c : count) n += c != 1;
        return n;
    }
};

canvas draw(const triangle_mesh& mesh, const light_frame& light, faces side = faces::both) {
    canvas c(light.size());
    rasterize(mesh, light, everywhere, side, c);
    CHECK(c.outside == 0);
    return c;
}

/// A light that also knows its rays: depth is `start_depth` at `start`, and grows by `rate` per `direction`.
struct ray_light {
    light_frame frame;
    spot_light spot;
    bool perspective = false;

    struct ray {
        glm::dvec3 start, direction;
        double start_depth, rate;
    };
    [[nodiscard]] ray through(double x, double y) const {
        if (!perspective) {
            const glm::dmat3 linear(frame.matrix());
            const glm::dvec3 zero(frame.matrix()[3]);
            return {glm::inverse(linear) * (glm::dvec3(x, y, 0.0) - zero), glm::inverse(linear) * glm::dvec3(0, 0, 1), 0.0, 1.0};
        }
        const glm::dvec3 forward = glm::normalize(spot.direction), right = glm::normalize(glm::cross(forward, spot.up)),
                         up = glm::cross(right, forward);
        const double focal = 0.5 * lesser(map_size.width, map_size.height) / std::tan(spot.outer_angle),
                     range = spot.far_plane - spot.near_plane;
        return {spot.position, forward + right * ((x - 0.5 * map_size.width) / focal) + up * ((y - 0.5 * map_size.height) / focal),
                -spot.near_plane / range, 1.0 / range};
    }
    /// The depth at which the ray meets the triangle; NaN if it does not.
    [[nodiscard]] double depth_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double x, double y) const {
        const ray r = through(x, y);
        const glm::dvec3 ab = b - a, ac = c - a, p = glm::cross(r.direction, ac), from_a = r.start - a, q = glm::cross(from_a, ab);
        const double det = glm::dot(ab, p), u = glm::dot(from_a, p) / det, v = glm::dot(r.direction, q) / det,
                     t = glm::dot(ac, q) / det;
        const double z = r.start_depth + t * r.rate;
        const bool hit = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && (!perspective || z >= 0.0);
        return hit ? z : std::nan("");
    }
};

ray_light any_light(dice& roll, int i) {
    if (i % 2 == 0) {
        directional_light sun(roll.vector(1.0));
        sun.add_caster(bounding_sphere{glm::dvec3(0), 6.0});
        return {sun.frame(map_size, 2), {}, false};
    }
    const spot_light spot{.position = roll.vector(4.0),
                          .direction = roll.vector(1.0),
                          .outer_angle = roll(0.3, 1.2),
                          .near_plane = roll(0.2, 2.0),
                          .far_plane = roll(6.0, 20.0)};
    return {spot.frame(map_size), spot, true};
}

/// A jittered grid over [-1, 1]^2 as heights over a plane, every inner corner moved at random. Its rim is straight.
mesh_data jittered_sheet(dice& roll, int cells, double height) {
    mesh_data m;
    for (int v = 0; v <= cells; ++v)
        for (int u = 0; u <= cells; ++u) {
            const bool rim_u = u == 0 || u == cells, rim_v = v == 0 || v == cells;
            m.add(glm::dvec3(2.0 * (u + (rim_u ? 0.0 : roll(-0.24, 0.24))) / cells - 1.0, roll(-height, height),
                             2.0 * (v + (rim_v ? 0.0 : roll(-0.24, 0.24))) / cells - 1.0));
        }
    for (int v = 0; v < cells; ++v)
        for (int u = 0; u < cells; ++u) {
            const auto corner = [&](int du, int dv) { return static_cast<std::uint32_t>((v + dv) * (cells + 1) + u + du); };
            m.add(corner(0, 0), corner(1, 0), corner(1, 1));
            m.add(corner(0, 0), corner(1, 1), corner(0, 1));
        }
    return m;
}
} // namespace

TEST_CASE("a tessellated sheet that hides the whole map is drawn exactly once in every texel, by both kinds of light") {
    dice roll{std::mt19937_64(1)};
    for (int i = 0; i < 60; ++i) {
        const int cells = 1 + i % 30;
        const mesh_data sheet = jittered_sheet(roll, cells, 0.1 / cells);
        const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), roll(-3.0, 3.0), glm::dvec3(0, 1, 0)) *
                                glm::scale(glm::dmat4(1.0), glm::dvec3(30.0, 1.0, 30.0));
        directional_light sun({0.01, -1, 0.02});
        sun.add_caster(bounding_sphere{glm::dvec3(0), 9.0});
        const light_frame lights[]{
            sun.frame(map_size),
            spot_light{
                .position = {0.3, 9, 0.2}, .direction = {0.01, -1, 0.02}, .outer_angle = 0.8, .near_plane = 1.0, .far_plane = 12.0}
                .frame(map_size)};
        for (const light_frame& light : lights) {
            CAPTURE(i);
            CHECK(draw(sheet.mesh(turn), light).not_once() == 0);
        }
    }
}

TEST_CASE("no gap and no double write where corners are a million maps away, or where the near plane cuts") {
    dice roll{std::mt19937_64(2)};
    for (int i = 0; i < 200; ++i) {
        const double reach = std::exp(roll(3.0, 27.0)); // to 5e11
        mesh_data fan;                                  // around a hub on the map, its rim far out
        const auto hub = fan.add(glm::dvec3(roll(-5.0, 5.0), 0.0, roll(-5.0, 5.0)));
        const int spokes = 5 + i % 9;
        for (int k = 0; k < spokes; ++k) {
            const double turn = (k + roll(-0.3, 0.3)) * 6.283185307179586 / spokes;
            fan.add(glm::dvec3(reach * std::cos(turn), 0.0, reach * std::sin(turn)));
        }
        for (int k = 0; k < spokes; ++k)
            fan.add(hub, static_cast<std::uint32_t>(1 + k), static_cast<std::uint32_t>(1 + (k + 1) % spokes));
        directional_light sun({0.2, -1, -0.1});
        sun.add_caster(bounding_sphere{glm::dvec3(0), 9.0});
        CAPTURE(reach);
        CHECK(draw(fan.mesh(), sun.frame(map_size)).not_once() == 0);
        // The horizon is in the picture: the near plane and the plane through the light cut most triangles.
        const light_frame lamp =
            spot_light{.position = {0, 3, 0}, .direction = {0.3, -0.5, 1}, .outer_angle = 0.9, .near_plane = 2.5, .far_plane = 9.0}
                .frame(map_size);
        const canvas c = draw(fan.mesh(), lamp);
        int twice = 0, ground = 0, missing = 0;
        for (int y = 0; y < map_size.height; ++y)
            for (int x = 0; x < map_size.width; ++x) {
                const glm::dvec3 forward = glm::normalize(glm::dvec3(0.3, -0.5, 1)),
                                 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
                const double focal = 40.0 / std::tan(0.9);
                const glm::dvec3 d =
                    forward + right * ((x + 0.5 - 48.0) / focal) + glm::cross(right, forward) * ((y + 0.5 - 40.0) / focal);
                const double t = d.y < 0.0 ? -3.0 / d.y : infinity; // where the ray meets y = 0
                twice += c.count[c.at(x, y)] > 1;
                if (t < 2.51 || t > reach * 0.2) continue;
                ++ground;
                missing += c.count[c.at(x, y)] != 1;
            }
        CHECK(twice == 0);
        CHECK(missing == 0);
        CHECK(ground > 500);
    }
}

TEST_CASE(
    "triangles anywhere, behind the light and across its near plane too, cover what rays meet, at the depth where rays meet it") {
    dice roll{std::mt19937_64(3)};
    int wrong = 0, checked = 0, cut = 0;
    double worst = 0.0;
    for (int i = 0; i < 600; ++i) {
        const ray_light light = any_light(roll, i);
        REQUIRE(light.frame.valid());
        mesh_data m;
        const bool enormous = i % 5 == 4; // also of 1e9 m, where the guard band cuts; its depths are checked less strictly
        m.add(roll.vector(7.0), roll.vector(7.0), roll.vector(7.0) * (enormous ? std::exp(roll(0.0, 20.0)) : 1.0));
        const glm::dvec3 a(m.positions[0]), b(m.positions[1]), c(m.positions[2]);
        const canvas drawn = draw(m.mesh(), light.frame);
        bool crosses = false;
        for (const glm::dvec3& p : {a, b, c}) crosses = crosses || (light.perspective && !(light.frame.to_map(p).depth > 0.0));
        cut += crosses && drawn.texels() > 0;
        for (int y = 0; y < map_size.height; ++y)
            for (int x = 0; x < map_size.width; ++x) {
                const bool covered = drawn.count[drawn.at(x, y)] == 1;
                const double z = light.depth_of(a, b, c, x + 0.5, y + 0.5);
                int hits = 0; // a centre this near an edge may go either way: corners are snapped to 1/256
                for (const double dx : {-0.004, 0.004})
                    for (const double dy : {-0.004, 0.004})
                        hits += !std::isnan(light.depth_of(a, b, c, x + 0.5 + dx, y + 0.5 + dy));
                if (hits % 4 != 0) continue;
                ++checked;
                wrong += covered != !std::isnan(z) || covered != (hits == 4);
                if (!covered || std::isnan(z) || std::abs(z) > 1.0) continue;
                const double error = std::abs(static_cast<double>(drawn.last[drawn.at(x, y)]) - z);
                wrong += enormous && error > 1e-6;
                if (!enormous) worst = greater(worst, error);
            }
    }
    CHECK(wrong == 0);
    CHECK(checked > 4000000);
    CHECK(cut > 60);
    CHECK(worst <= raster_depth_error * 1.001);
    CHECK(worst > raster_depth_error * 0.99);
}

TEST_CASE("a directional light keeps casters before its near plane at depth 0 and beyond its far plane at depth 1") {
    directional_light sun({0, -1, 0});
    sun.add_caster(bounding_box{{-1, -1, -1}, {1, 1, 1}});
    const light_frame light = sun.frame(map_size);
    mesh_data above, below;
    above.add(glm::dvec3(-1, 50, -1), glm::dvec3(-1, 50, 1), glm::dvec3(1, 50, 1), glm::dvec3(1, 50, -1));
    below.add(glm::dvec3(-1, -50, -1), glm::dvec3(-1, -50, 1), glm::dvec3(1, -50, 1), glm::dvec3(1, -50, -1));
    image<rg32f> texels(map_size, rg32f::clear());
    const light_footprint touched = cast_triangles(texels.view(), above.mesh(), light);
    CHECK(touched.depth == depth_interval{0.0f, 0.0f});
    CHECK(touched.texels.width() > 60);
    CHECK(texels(48, 40) == rg32f::caster(0.0f));
    texels.view().fill(whole(map_size), rg32f::clear());
    CHECK(cast_triangles(texels.view(), below.mesh(), light) == light_footprint{touched.texels, {1.0f, 1.0f}});
    CHECK(texels(48, 40) == rg32f::caster(1.0f));
    CHECK(draw(above.mesh(), light).last[40 * 96 + 48] < -1.0f); // the core does not clamp
}

TEST_CASE("triangles that cannot be drawn are left out, and their neighbours are not") {
    directional_light sun({0, -1, 0});
    sun.add_caster(bounding_sphere{glm::dvec3(0), 5.0});
    const light_frame light = sun.frame(map_size);
    mesh_data good;
    good.add(glm::dvec3(-3, 0, -3), glm::dvec3(0, 0, 3), glm::dvec3(3, 0, -3));
    const canvas expected = draw(good.mesh(), light);
    REQUIRE(expected.texels() > 500);

    mesh_data m;
    for (const double bad : {std::nan(""), infinity, -infinity})
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 p(1, 0, 1);
            p[axis] = bad;
            const glm::dvec3 a(-3, 0, -3), b(3, 0, -3);
            m.add(a, p, b);
            m.add(p, b, a);
            m.add(b, a, p);
            m.add(p, p, p);
        }
    m.add(good.positions[0], good.positions[1], good.positions[2]);
    const auto last = static_cast<std::uint32_t>(m.positions.size());
    m.add(0, 1, last); // one past the end
    m.add(4294967295u, last - 1, last - 2);
    m.add(last - 3, last - 3, last - 2); // no area
    m.add(last - 3, last - 3, last - 3);
    m.indices.insert(m.indices.end(), {last - 3, last - 2}); // not a triangle
    CHECK(draw(m.mesh(), light).count == expected.count);

    mesh_data two; // of which a cut would make three
    two.add(two.add(good.positions[0]), two.add({1e9, 0.0, 1e8}), 2);
    int asked = 0;
    rasterize(two.mesh(), light, everywhere, faces::both, [](int, int, float) {}, [&](texel_rect) { return ++asked > 0; });
    CHECK(asked == 0);
    CHECK(draw({.positions = good.positions, .indices = {good.indices.data(), 2}}, light).texels() == 0);
    CHECK(draw({.positions = {good.positions.data(), 2}, .indices = good.indices}, light).texels() == 0);
    CHECK(rasterize(mesh_data().mesh(), light, everywhere, faces::both, [](int, int, float) {}) == light_footprint{});
    CHECK(draw({.positions = m.positions, .indices = {}}, light).texels() == 0);
    CHECK(draw({.positions = {}, .indices = m.indices}, light).texels() == 0);
    CHECK(draw(good.mesh(glm::dmat4(std::nan(""))), light).texels() == 0);
    CHECK(draw(good.mesh(glm::dmat4(0.0)), light).texels() == 0);
    CHECK(draw(good.mesh(glm::scale(glm::dmat4(1.0), glm::dvec3(1e300))), light).texels() > 0); // large, and finite
}

TEST_CASE("random garbage is drawn without a fault, and never off the target") {
    dice roll{std::mt19937_64(4)};
    constexpr float specials[]{0.0f,
                               -0.0f,
                               1e-45f,
                               1e-30f,
                               1.0f,
                               3e38f,
                               -3e38f,
                               1e20f,
                               std::numeric_limits<float>::infinity(),
                               std::numeric_limits<float>::quiet_NaN()};
    int drawn = 0;
    for (int i = 0; i < 3000; ++i) {
        const ray_light light = any_light(roll, i);
        mesh_data m;
        for (int k = 0; k < 9; ++k) {
            glm::vec3 p(roll.vector(std::exp(roll(-3.0, 80.0))));
            if (k % 3 == 0) p[k / 3] = specials[static_cast<std::size_t>(roll(0.0, 9.999))];
            m.positions.push_back(p);
        }
        for (int k = 0; k < 30; ++k) m.indices.push_back(static_cast<std::uint32_t>(roll(0.0, 9.2)));
        const texel_rect target{static_cast<int>(roll(-20, 90)), static_cast<int>(roll(-20, 90)), static_cast<int>(roll(0, 120)),
                                static_cast<int>(roll(0, 120))};
        int outside = 0;
        const light_footprint touched = rasterize(m.mesh(), light.frame, target, faces::both, [&](int x, int y, float z) {
            ++drawn;
            outside += !clip(target, map_size).contains(x, y) || std::isnan(z);
        });
        CHECK(outside == 0);
        CHECK(clip(touched.texels, map_size) == touched.texels);
        if (!touched.empty()) CHECK((touched.depth.nearest >= 0.0f && touched.depth.farthest <= 1.0f && !touched.depth.empty()));
    }
    CHECK(drawn > 100000);
}

TEST_CASE("a steep sliver never leaves the depths of its corners") {
    dice roll{std::mt19937_64(5)};
    int drawn = 0, outside = 0;
    for (int i = 0; i < 20000; ++i) {
        const ray_light light = any_light(roll, i % 2);
        mesh_data m;
        const glm::dvec3 a = roll.vector(4.0), along(detail::row(light.frame.matrix(), 2)),
                         across = glm::cross(along, roll.vector(40.0));
        m.add(a, a + across,
              a + across * roll(0.0, 1.0) + along * roll(0.0, 20.0) + roll.vector(i % 3 ? 0.01 : 1e-7)); // nearly edge-on
        double lowest = infinity, highest = -infinity;
        for (const glm::vec3& p : m.positions) {
            const double z =
                detail::row(light.frame.matrix(), 2).w + glm::dot(glm::dvec3(detail::row(light.frame.matrix(), 2)), glm::dvec3(p));
            lowest = lesser(lowest, z);
            highest = greater(highest, z);
        }
        rasterize(m.mesh(), light.frame, everywhere, faces::both, [&](int, int, float z) {
            ++drawn;
            outside += !(static_cast<double>(z) >= lowest - 1e-7 && static_cast<double>(z) <= highest + 1e-7);
        });
    }
    CHECK(outside == 0);
    CHECK(drawn > 1000);
}

TEST_CASE("a solid turns one side to the light and one away, also when its model matrix mirrors it") {
    dice roll{std::mt19937_64(6)};
    for (int i = 0; i < 400; ++i) {
        const ray_light light = any_light(roll, i);
        mesh_data m;
        m.add(bounding_box{glm::dvec3(-1.0, -0.7, -0.5), glm::dvec3(0.5, 1.0, 0.9)});
        glm::dmat4 model =
            glm::rotate(glm::translate(glm::dmat4(1.0), roll.vector(2.0)), roll(-3.0, 3.0), glm::normalize(roll.vector(1.0)));
        if (i % 4 >= 2) model = glm::scale(model, glm::dvec3(1.0, -1.0, 2.0));
        bool before_light = true; // wholly, so that it has two sides
        for (const glm::vec3& p : m.positions)
            before_light = before_light && light.frame.to_map(glm::dvec3(model * glm::dvec4(glm::dvec3(p), 1.0))).depth > 0.0;
        if (!before_light) continue;
        const canvas all = draw(m.mesh(model), light.frame), lit = draw(m.mesh(model), light.frame, faces::lit_side),
                     dark = draw(m.mesh(model), light.frame, faces::dark_side);
        int wrong = 0;
        for (std::size_t k = 0; k < all.count.size(); ++k) {
            wrong += all.count[k] != lit.count[k] + dark.count[k];
            if (lit.count[k] == 1 && dark.count[k] == 1) wrong += lit.last[k] > dark.last[k] + 1e-3f;
            wrong += lit.count[k] > 1 || dark.count[k] > 1;
        }
        CAPTURE(i);
        CHECK(wrong <= 2); // silhouettes are thinner than the snapping
        if (all.texels() > 300) CHECK((lit.texels() > all.texels() * 9 / 10 && dark.texels() > all.texels() * 9 / 10));
    }
}

TEST_CASE("a solid that its model matrix flattens has no outside, and no side of it is turned to the light") {
    directional_light sun({0, -1, 0});
    sun.add_caster(bounding_sphere{glm::dvec3(0), 5.0});
    const light_frame light = sun.frame(map_size);
    mesh_data m;
    m.add(bounding_box{glm::dvec3(-2.0), glm::dvec3(2.0)});
    const triangle_mesh flat = m.mesh(glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 0.0, 1.0)));
    const canvas all = draw(flat, light);
    CHECK(all.texels() > 500);
    CHECK(draw(flat, light, faces::lit_side).texels() == 0);
    CHECK(draw(flat, light, faces::dark_side).count == all.count);
}

TEST_CASE("casting tells exactly what it touched, and the order of triangles does not show") {
    dice roll{std::mt19937_64(7)};
    for (int i = 0; i < 200; ++i) {
        const ray_light light = any_light(roll, i);
        mesh_data m, reversed;
        for (int k = 0; k < 6; ++k) m.add(roll.vector(5.0), roll.vector(5.0), roll.vector(5.0));
        reversed.positions = m.positions;
        for (std::size_t k = 0; k < m.indices.size(); k += 3) reversed.add(m.indices[15 - k], m.indices[17 - k], m.indices[16 - k]);
        image<rg16> texels(map_size, rg16::clear()), backwards(map_size, rg16::clear());
        const light_footprint touched = cast_triangles(texels.view(), m.mesh(), light.frame);
        CHECK(cast_triangles(backwards.view(), reversed.mesh(), light.frame).texels == touched.texels);

        const canvas oracle = draw(m.mesh(), light.frame);
        texel_rect box;
        depth_interval depth;
        int wrong = 0;
        for (int y = 0; y < map_size.height; ++y)
            for (int x = 0; x < map_size.width; ++x) {
                const std::size_t k = oracle.at(x, y);
                wrong += texels(x, y) != (oracle.count[k] ? rg16::caster(oracle.nearest[k]) : rg16::clear());
                wrong += texels(x, y) != backwards(x, y);
                if (!oracle.count[k]) continue;
                box = union_box(box, {x, y, x + 1, y + 1});
                depth.include({saturate(oracle.nearest[k]), saturate(oracle.farthest[k])});
            }
        CHECK(wrong == 0);
        CHECK(touched.texels == box);
        CHECK((touched.depth == depth || (box.empty() && touched.depth.empty())));
        // What bounds promise, the triangles keep.
        glm::dvec3 lower(infinity), upper(-infinity);
        for (const glm::vec3& p : m.positions) {
            lower = (glm::min)(lower, glm::dvec3(p));
            upper = (glm::max)(upper, glm::dvec3(p));
        }
        const light_footprint bounds = footprint(bounding_box{lower, upper}, light.frame);
        CHECK(union_box(bounds.texels, touched.texels) == bounds.texels);
        if (!box.empty()) CHECK((bounds.depth.nearest <= depth.nearest && bounds.depth.farthest >= depth.farthest));
    }
}

TEST_CASE("far bound: the shadow of every caster ends at the nearest receiver that is not before it") {
    dice roll{std::mt19937_64(8)};
    int bounded = 0, unbounded = 0, skipped = 0;
    for (int i = 0; i < 200; ++i) {
        const ray_light light = any_light(roll, i);
        mesh_data casters, receivers;
        for (int k = 0; k < 3; ++k) casters.add(roll.vector(4.0), roll.vector(4.0), roll.vector(4.0));
        for (int k = 0; k < 12; ++k) {
            const glm::dvec3 at = roll.vector(6.0);
            receivers.add(at, at + roll.vector(3.0), at + roll.vector(3.0));
        }
        image<rgb16> texels(map_size, rgb16::clear());
        const texel_rect occupied = cast_triangles(texels.view(), casters.mesh(), light.frame).texels;
        image<rgb16> skipping = texels, by_tiles = texels;
        tile_grid tiles(texels.size(), 8);
        tiles.mark(occupied);
        bound_triangles(texels.view(), receivers.mesh(), light.frame);
        bound_triangles(skipping.view(), receivers.mesh(), light.frame, faces::both, [&](texel_rect r) {
            const bool touches = !intersection(r, occupied).empty();
            skipped += !touches;
            return touches;
        });

        bound_triangles(by_tiles.view(), receivers.mesh(), light.frame, faces::both, tiles);

        // The oracle reads codes: of depth reversed, so the larger is the nearer.
        std::vector<int> nearest(96 * 80, 0), far_bound(96 * 80, 0);
        const auto code = [](float z) { return static_cast<int>(rgb16::caster(z).stored[0]); };
        rasterize(casters.mesh(), light.frame, everywhere, faces::both, [&](int x, int y, float z) {
            int& n = nearest[static_cast<std::size_t>(y * 96 + x)];
            n = greater(n, code(z) + 1); // 0 is no caster
        });
        rasterize(receivers.mesh(), light.frame, everywhere, faces::both, [&](int x, int y, float z) {
            const auto k = static_cast<std::size_t>(y * 96 + x);
            if (z >= 0.0f && code(z) <= nearest[k] - 1) far_bound[k] = greater(far_bound[k], code(z));
        });
        int wrong = 0;
        for (int y = 0; y < 80; ++y)
            for (int x = 0; x < 96; ++x) {
                const auto k = static_cast<std::size_t>(y * 96 + x);
                const rgb16 t = texels(x, y);
                wrong += static_cast<int>(t.stored[0]) != greater(nearest[k] - 1, 0) || t.occupied() != (nearest[k] > 0);
                wrong += static_cast<int>(t.stored[rgb16::far_index]) != far_bound[k];
                wrong += t != skipping(x, y) || t != by_tiles(x, y);
                bounded += t.occupied() && far_bound[k] > 0;
                unbounded += t.occupied() && far_bound[k] == 0;
            }
        CAPTURE(i);
        CHECK(wrong == 0);
    }
    CHECK(bounded > 4000);
    CHECK(unbounded > 10000);
    CHECK(skipped > 100);
}

TEST_CASE("far bound: nothing outside the region is bounded, and a receiver before the near plane ends nothing") {
    directional_light sun({0, -1, 0});
    sun.add_caster(bounding_box{{-1, -1, -1}, {1, 1, 1}});
    const light_frame light = sun.frame(map_size);
    const auto sheet = [](double y) {
        mesh_data m;
        m.add(glm::dvec3(-9, y, -9), glm::dvec3(-9, y, 9), glm::dvec3(9, y, 9), glm::dvec3(9, y, -9));
        return m;
    };
    const mesh_data caster = sheet(0.9), receiver = sheet(-0.5), above = sheet(5.0);
    image<rgb32f> texels(map_size, rgb32f::clear());
    cast_triangles(texels.view(), caster.mesh(), light);
    const image<rgb32f> unbounded = texels;
    bound_triangles(texels.view(), above.mesh(), light);
    CHECK(texels(9, 9) == unbounded(9, 9));
    image<rgb32f> at_zero(map_size, rgb32f::clear()); // a caster before the near plane too, but behind that receiver
    cast_triangles(at_zero.view(), sheet(4.0).mesh(), light);
    bound_triangles(at_zero.view(), above.mesh(), light);
    CHECK(at_zero(9, 9) == rgb32f::caster(0.0f));
    const texel_rect region{10, 20, 30, 40};
    CHECK(bound_triangles(texels.view(), receiver.mesh(), light, faces::lit_side, touches_everything{}, region).texels == region);
    int wrong = 0;
    for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 96; ++x) wrong += region.contains(x, y) == (texels(x, y) == unbounded(x, y));
    CHECK(wrong == 0);
    CHECK(bound_triangles(texels.view(), receiver.mesh(), light, faces::dark_side).empty());
}

TEST_CASE("a caster may be translucent, if its texels can say so") {
    directional_light sun({0, -1, 0});
    sun.add_caster(bounding_sphere{glm::dvec3(0), 5.0});
    const light_frame light = sun.frame(map_size);
    mesh_data m;
    m.add(glm::dvec3(-9, 0, -9), glm::dvec3(-9, 0, 9), glm::dvec3(9, 0, 9), glm::dvec3(9, 0, -9));
    image<rga16> texels(map_size, rga16::clear());
    const light_footprint touched = cast_triangles(texels.view(), m.mesh(), light, 0.25f);
    CHECK(touched.texels == whole(map_size));
    CHECK(texels(3, 4) == rga16::caster(touched.depth.nearest, 0.25f));
}

TEST_CASE("positions may lie in an interleaved vertex buffer") {
    struct vertex {
        glm::vec3 position;
        float u, v;
    };
    const std::vector<vertex> vertices{{{-3, 0, -3}, 0, 0}, {{0, 1, 3}, 0, 1}, {{3, 2, -3}, 1, 0}};
    const std::vector<std::uint32_t> indices{0, 1, 2};
    mesh_data plain;
    for (const vertex& v : vertices) plain.positions.push_back(v.position);
    plain.indices = indices;
    directional_light sun({0, -1, 0});
    sun.add_caster(bounding_sphere{glm::dvec3(0), 5.0});
    const light_frame light = sun.frame(map_size);
    const canvas interleaved = draw({.positions = {&vertices[0].position, 3, sizeof(vertex)}, .indices = indices}, light);
    CHECK(interleaved.last == draw(plain.mesh(), light).last);
    CHECK(interleaved.texels() > 500);
}

TEST_CASE("a view that is smaller than the map is its upper left part, and a part of the map may be drawn alone") {
    dice roll{std::mt19937_64(9)};
    const ray_light light = any_light(roll, 0);
    mesh_data m;
    for (int k = 0; k < 6; ++k) m.add(roll.vector(5.0), roll.vector(5.0), roll.vector(5.0));
    image<rg16> texels(map_size, rg16::clear()), part({50, 30}, rg16::clear()), larger({200, 200}, rg16::clear());
    cast_triangles(texels.view(), m.mesh(), light.frame);
    cast_triangles(part.view(), m.mesh(), light.frame);
    CHECK(clip(cast_triangles(larger.view(), m.mesh(), light.frame).texels, map_size).empty() == false);
    int wrong = 0;
    for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 96; ++x) {
            if (x < 50 && y < 30) wrong += part(x, y) != texels(x, y);
            wrong += larger(x, y) != texels(x, y);
        }
    CHECK(wrong == 0);
    CHECK_FALSE(larger(100, 50).occupied());
}

TEST_CASE("a polygon has room for whatever five planes make of a triangle, every other corner below them") {
    int most = 3;
    for (int plane = 0; plane < 5; ++plane) most += most / 2;
    CHECK(detail::most_corners == most);

    detail::projected_polygon polygon; // 13 corners, six of them below the last plane
    for (int i = 0; i < 13; ++i) polygon.add(glm::dvec4(i, 0.0, i % 2 == 0 ? 1.0 : -1.0, 1.0));
    polygon.keep_above({0.0, 0.0, 1.0, 0.0});
    REQUIRE(polygon.count == most);
    for (int i = 0; i < most; ++i) { // a corner that is kept, then the cuts of the two edges behind it
        const double x = i % 3 == 0 ? i / 3 * 2 : i / 3 * 2 + (i % 3 == 1 ? 0.5 : 1.5);
        CHECK(polygon.corner[i] == glm::dvec4(x, 0.0, i % 3 == 0 ? 1.0 : 0.0, 1.0));
    }
}

TEST_CASE("a triangle of which rounding makes more corners than planes can cut keeps them all") {
    const auto corners_left = [](std::initializer_list<glm::dvec4> corners) {
        detail::projected_polygon polygon;
        for (const glm::dvec4& h : corners) polygon.add(h);
        polygon.keep_drawable(true);
        return polygon.count;
    };
    // Found by chance. Exactly cut they would have no more than 8.
    CHECK(corners_left({{0x1.f7ebe461d6f94p+23, 0x1.2d20dafdfc93ep+14, -0x1.882d27c98601fp-2, 0x1.e150ed19b49bep+66},
                        {-0x1.b0b962d2d7fe4p+25, -0x1.bdcf085d89465p+4, 0x1.8655ac4fbadacp+20, -0x1.bdcf085d89464p+4},
                        {0x1.f7ebe461d6f94p+23, 0x1.770c675fa87b5p+23, 0x1.5c120d0097ae8p+52, 0x1.e359c465d28edp+3}}) > 8);
    CHECK(corners_left({{-0x1.eeafe97255221p+23, -0x1.d580e41467683p-1016, 0x1.3a50e5e4fd09cp-57, -0x1.03a9f72d5651fp+35},
                        {0.0, 0x0.0000000000007p-1022, -0x0.00000000002dep-1022, -0x1.dc7b8ec7fa097p-1017},
                        {0x0.000000000172cp-1022, 0x0.000000000016cp-1022, 0x0.0000000000038p-1022, 0x0.000987c7179e4p-1022}}) >
          10);
}

TEST_CASE("no texel is drawn twice where an edge begins on the near plane itself and ends a billion texels away") {
    glm::dmat4 m(0.0); // x W = 63.1... X + c Z + t, where c + t is half a 256th beyond a texel's middle
    constexpr double beside = 100.5 + 0.5 / 256.0, slant = -0x1.904cccccccccdp+8;
    m[0] = {63.123456789, 0.0, 0.0, 0.0};
    m[1] = {0.0, 63.123456789, 0.0, 0.0};
    m[2] = {slant, 100.25, 1.0 / 1024.0, 1.0};
    m[3] = {beside - slant, 0.0, -1.0 / 1024.0, 0.0};
    const light_frame light(m, {256, 256}, 1.0, 1025.0);
    const glm::dvec3 on_plane(0.0, 0.0, 1.0);
    const glm::dvec3 others[][3]{{{-0x1.038e04p+24, 0x1.a3f3a2p+23, 0x1.2339a8p+1},
                                  {-0x1.320b68p-4, 0x1.928f4p-3, 0.5},
                                  {-0x1.038e0cp+24, 0x1.a3f392p+23, 0x1.249f1p+1}},
                                 {{-0x1.038e08p+24, 0x1.6ab196p+22, 0x1.a1b7fcp+0},
                                  {0x1.2c577p-2, 0x1.2ebfap-2, 0.5},
                                  {-0x1.038e12p+24, 0x1.6ab178p+22, 0x1.102ff6p+1}},
                                 {{-0x1.038e02p+24, 0x1.2ddb48p+24, 0x1.3e8d08p+1},
                                  {0x1.3469e8p-2, -0x1.c790dcp-3, 0.5},
                                  {-0x1.038e06p+24, 0x1.2ddb44p+24, 0x1.7bebb8p+1}}};
    for (const auto& [end, one_side, other_side] : others) {
        mesh_data pair;
        pair.add(end, on_plane, one_side);
        pair.add(on_plane, end, other_side);
        const canvas drawn = draw(pair.mesh(), light);
        CHECK(drawn.texels() > 0);
        CHECK(*std::ranges::max_element(drawn.count) == 1);
    }
}

TEST_CASE("a triangle seen edge-on has the depth of its first corner wherever snapping lets it cover a texel") {
    dice roll{std::mt19937_64(11)};
    const light_frame light(
        glm::dmat4(glm::dmat3(glm::dvec3(1.0 / 256.0, 0.0, 0.0), glm::dvec3(0.0, 1.0 / 256.0, 0.0), glm::dvec3(0.0, 0.0, 1.0))),
        {1024, 1024}, 1.0, 1.0);
    int covered = 0, wrong = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto quarters = [&roll] { return std::floor(roll(-100000.0, 100000.0)) + 0.25; };
        const glm::dvec3 first(130000.0, 130000.0, roll(0.0, 1.0)), along(quarters(), quarters(), roll(-1.0, 1.0));
        mesh_data line;
        line.add(first, first + along, first + along * 0.5);
        rasterize(line.mesh(), light, everywhere, faces::both, [&](int, int, float z) {
            ++covered;
            wrong += std::bit_cast<std::uint32_t>(z) != std::bit_cast<std::uint32_t>(line.positions[0].z);
        });
    }
    CHECK(wrong == 0);
    CHECK(covered > 100);
}

TEST_CASE("far bound: a receiver on the near plane itself ends the shadow of what is before it") {
    const light_frame light(glm::dmat4(1.0), {8, 8}, 1.0, 1.0); // the world in texels and depths
    mesh_data sheet;
    sheet.add(glm::dvec3(-9, -9, 0), glm::dvec3(99, -9, 0), glm::dvec3(-9, 99, 0));
    image<rgb32f> texels({8, 8}, rgb32f::caster(0.0f));
    bound_triangles(texels.view(), sheet.mesh(), light);
    CHECK(texels(3, 4) != rgb32f::caster(0.0f));
}

TEST_CASE("a polygon is cut where a spot light's near plane and the reach of fixed_point are, and left alone within them") {
    dice roll{std::mt19937_64(10)};
    constexpr double reach = detail::fixed_point::reach;
    int beyond = 0, changed = 0, lost = 0, whole_ones = 0, cut_ones = 0;
    for (int i = 0; i < 40000; ++i) {
        const bool near_plane_cuts = i % 2 == 0;
        detail::projected_polygon polygon;
        double most = 1.0;
        for (int k = 0; k < 3; ++k) {
            const double any_z = roll(-0.3, 1.0) * std::exp(roll(-3.0, i % 3 == 0 ? 30.0 : 3.0)); // W too, of a spot light
            const double z = i % 5 == 0 && k == 1 ? 0.0 : any_z;                                  // on the plane itself
            const double w = near_plane_cuts ? 1.0 + 3.0 * z : std::exp(roll(-7.0, 7.0)), side = i % 4 < 2 ? 1.0 : 1.5;
            polygon.add({reach * w * roll(-side, side), reach * w * roll(-side, side), z, w});
            most = greater(most, greater(std::abs(z), std::abs(w)));
        }
        const auto drawable = [&](const glm::dvec4& h, double slack) { // what a cut may be off by: a share of the largest corner
            return greater(std::abs(h.x), std::abs(h.y)) <= reach * (h.w + slack * most) &&
                   (!near_plane_cuts || h.z >= -slack * most);
        };
        const detail::projected_polygon before = polygon;
        polygon.keep_drawable(near_plane_cuts);
        int within = 0;
        for (int k = 0; k < 3; ++k) {
            if (!drawable(before.corner[k], 0.0)) continue;
            ++within;
            bool kept = false;
            for (int n = 0; n < polygon.count; ++n) kept = kept || polygon.corner[n] == before.corner[k];
            lost += !kept;
        }
        for (int k = 0; k < polygon.count; ++k) beyond += !drawable(polygon.corner[k], 1e-12);
        changed += within == 3 && polygon.count != 3;
        whole_ones += within == 3;
        cut_ones += within < 3 && polygon.count >= 3;
    }
    CHECK(beyond == 0);
    CHECK(changed == 0);
    CHECK(lost == 0);
    CHECK(whole_ones > 4000);
    CHECK(cut_ones > 4000);
}

TEST_CASE("no polygon is snapped that has a corner without a place, or two corners") {
    detail::fixed_point snapped[detail::most_corners];
    detail::projected_polygon good;
    for (const glm::dvec4& h : {glm::dvec4(1, 1, 0.5, 1), glm::dvec4(5, 1, 0.5, 1), glm::dvec4(1, 5, 0.5, 1)}) {
        CHECK_FALSE(good.snap(snapped));
        good.add(h);
    }
    CHECK(good.snap(snapped));
    for (const bool near_plane_cuts : {false, true})
        for (int i = 0; i < 12; ++i)
            for (const double odd : {std::nan(""), infinity, -infinity}) {
                detail::projected_polygon polygon = good;
                polygon.corner[i / 4][i % 4] = odd;
                if (polygon.corner[i / 4].w > 1.0) continue; // at W infinite all has its place: in the corner of the map
                polygon.keep_drawable(near_plane_cuts);
                CHECK_FALSE(polygon.snap(snapped));
            }
    good.corner[1].w = 0.0;
    CHECK_FALSE(good.snap(snapped));
}

TEST_CASE("a triangle's depth is solved about its reference, which edge-on is all that it has") {
    const light_frame affine(glm::dmat4(1.0), map_size, 1.0, 1.0), lamp(glm::dmat4(1.0), map_size, 1.0, 5.0);
    const glm::dvec4 flat[]{{0, 3, 0.25, 1}, {10, 3, 0.75, 1}, {5, 3, 0.5, 1}}, // on a line, the last in its middle
        deep[]{{0, 6, 0.25, 2}, {30, 12, 0.75, 4}, {15, 9, 0.5, 3}};
    const detail::depth_surface surfaces[]{{flat, flat[2], affine}, {deep, deep[2], lamp}};
    for (const detail::depth_surface& surface : surfaces) {
        CHECK(std::abs(surface.area()) <= 0.0);
        CHECK((surface.depth().nearest == doctest::Approx(0.25) && surface.depth().farthest == doctest::Approx(0.75)));
        CHECK((surface.depth().x == doctest::Approx(5.0) && surface.depth().y == doctest::Approx(3.0)));
        for (int x = 0; x < 10; ++x) CHECK(surface.depth()(x, 7 - x) == doctest::Approx(0.5));
    }
    const glm::dvec4 small[]{{0.25, 0.25, 0.25, 1}, {0.75, 0.25, 0.75, 1}, {0.25, 0.75, 0.25, 1}}; // in texel (0, 0)
    CHECK(detail::depth_surface(small, small[0], affine).depth()(0, 0) == doctest::Approx(0.5));
    CHECK(std::abs(detail::depth_surface::per_w(affine)) <= 0.0);
    const detail::triangle_depth past_horizon{.inverse = true,
                                              .near_w = 1.0,
                                              .per_w = 0.5,
                                              .x = 0.0,
                                              .y = 0.0,
                                              .a = 0.0,
                                              .b = 0.0,
                                              .c = -1.0,
                                              .nearest = 0.25,
                                              .farthest = 0.75};
    CHECK(past_horizon(0, 0) == doctest::Approx(0.75));
}

namespace {
template <typename Texel>
concept casts_translucent =
    requires(image_view<Texel> texels, triangle_mesh mesh, light_frame light) { cast_triangles(texels, mesh, light, 0.5f); };
template <typename Texel>
concept takes_bounds =
    requires(image_view<Texel> texels, triangle_mesh mesh, light_frame light) { bound_triangles(texels, mesh, light); };
static_assert(casts_translucent<rga16> && !casts_translucent<rg16>);
static_assert(takes_bounds<rgb16> && !takes_bounds<rg16>);
static_assert(marked_texels<tile_grid> && !marked_texels<int>);
} // namespace
