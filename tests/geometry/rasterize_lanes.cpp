// The rasteriser in lanes against the scalar one, bit for bit: texels, depths, their order, and what is said to be touched. What the
// scalar one owes is asked in rasterize.cpp and scan.cpp; that a sheet has no gap is asked here again, of the lanes alone.
#include <gnomon/geometry/rasterize_lanes.hpp>

#include <gnomon/geometry/directional_light.hpp>
#include <gnomon/geometry/spot_light.hpp>
#include <gnomon/grid/depth_range.hpp>

#include "../support/any_light.hpp"
#include "../support/formats.hpp"
#include "../support/images.hpp"
#include "../support/lanes.hpp"

#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

using namespace gnomon;

namespace {
constexpr extent map_size{96, 80};
using test::for_each_isa;
using dice = test::world_dice;

static_assert(sizeof(on_any::triangle_setup<emulated<256>>) > 0); // a bit for each of 32 lanes: there is room for no more

template <typename Texel>
concept casts_translucent = requires(image_view<Texel> texels, triangle_mesh mesh, light_frame light) {
    cast_triangles(simd<>{}, texels, mesh, light, 0.5f);
};
template <typename Texel>
concept takes_bounds =
    requires(image_view<Texel> texels, triangle_mesh mesh, light_frame light) { bound_triangles(simd<>{}, texels, mesh, light); };
static_assert(casts_translucent<rga16> && !casts_translucent<rg16>);
static_assert(takes_bounds<rgb16> && !takes_bounds<rg16>);

struct mesh_data {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        for (const glm::dvec3& p : {a, b, c}) {
            indices.push_back(static_cast<std::uint32_t>(positions.size()));
            positions.emplace_back(p);
        }
    }
    [[nodiscard]] triangle_mesh mesh(const glm::dmat4& model = glm::dmat4(1.0)) const {
        return {.positions = positions, .indices = indices, .model = model};
    }
};

/// What a sink was told: place and bits of the depth, in order.
struct drawn_texel {
    int x, y;
    std::uint32_t depth;
    friend bool operator==(const drawn_texel&, const drawn_texel&) = default;
};
struct record {
    std::vector<drawn_texel> texels;
    light_footprint touched;
    friend bool operator==(const record& a, const record& b) {
        return a.texels == b.texels && a.touched.texels == b.touched.texels && a.touched.depth == b.touched.depth;
    }
};
template <typename... Where>
record draw(auto run, const triangle_mesh& mesh, const light_frame& light, texel_rect target, faces side, const Where&... where) {
    record r;
    const auto sink = [&r](int x, int y, float z) { r.texels.push_back({x, y, std::bit_cast<std::uint32_t>(z)}); };
    r.touched = rasterize(run, mesh, light, target, side, sink, where...);
    return r;
}

/// Up to 40 triangles of one size, from a hundredth of a texel to the horizon; some cannot be drawn.
mesh_data any_mesh(dice& roll, int i) {
    mesh_data m;
    const double size = i % 7 == 0 ? std::exp(roll(0.0, 60.0)) : std::exp(roll(-6.0, 3.0));
    const int count = static_cast<int>(roll(0.0, 40.0));
    for (int k = 0; k < count; ++k) {
        const glm::dvec3 at = roll.vector(5.0);
        m.add(at + roll.vector(size), at + roll.vector(size), at + roll.vector(size));
    }
    constexpr float odd[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity(), 3e38f, -0.0f};
    if (i % 5 == 0 && count > 0)
        for (int k = 0; k < 3; ++k) {
            const auto which = static_cast<std::size_t>(roll(0.0, 3.0 * count));
            m.positions[which][static_cast<int>(roll(0.0, 3.0))] = odd[static_cast<std::size_t>(roll(0.0, 5.0))];
            m.indices[static_cast<std::size_t>(roll(0.0, 3.0 * count))] = static_cast<std::uint32_t>(roll(0.0, 3.2 * count));
        }
    if (i % 3 == 0) m.indices.resize(m.indices.size() - static_cast<std::size_t>(roll(0.0, 3.0)) % (m.indices.size() + 1));
    return m;
}

glm::dmat4 any_model(dice& roll, int i) {
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), roll(-3.0, 3.0), glm::dvec3(0.6, 0.0, 0.8));
    if (i % 6 == 0) return glm::scale(turned, glm::dvec3(1.0, -1.0, 0.5));       // mirrors
    if (i % 6 == 1) return glm::scale(turned, glm::dvec3(1.0, i % 4 == 0, 1.0)); // flattens, now and then
    if (i % 6 == 2) return glm::perspective(1.0, 1.0, 0.5, 20.0) * turned;       // W is not 1 even under a sun
    return turned;
}

/// A light whose map is the x and the y of the world in 1/256 texel, exactly, and whose depth is z.
light_frame plain_frame(extent size) {
    return {glm::dmat4(glm::dvec4(1.0 / 256.0, 0.0, 0.0, 0.0), glm::dvec4(0.0, 1.0 / 256.0, 0.0, 0.0),
                       glm::dvec4(0.0, 0.0, 1.0, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0)),
            size, 1.0, 1.0};
}

/// n times it is 1 modulo `modulus`; 0 if there is none. (Euclid.)
std::int64_t inverse_of(std::int64_t n, std::int64_t modulus) {
    std::int64_t a = modulus, b = n % modulus, of_a = 0, of_b = 1;
    while (b > 1) {
        const std::int64_t q = a / b, rest = a - q * b, of_rest = of_a - q * of_b;
        a = b;
        b = rest;
        of_a = of_b;
        of_b = of_rest;
    }
    return b == 1 ? (of_b % modulus + modulus) % modulus : 0;
}
} // namespace

TEST_CASE("lanes draw what the scalar rasteriser draws, in its order and to the bit: any size, any light, any model, and garbage") {
    dice roll{std::mt19937_64(31)};
    std::size_t texels = 0, spot = 0, partly = 0;
    for (int i = 0; i < 3000; ++i) {
        const light_frame light = test::any_light(roll, i, map_size);
        const mesh_data m = any_mesh(roll, i);
        const triangle_mesh mesh = m.mesh(any_model(roll, i));
        const faces side = i % 3 == 0 ? faces::both : i % 3 == 1 ? faces::lit_side : faces::dark_side;
        texel_rect target = everywhere;
        if (i % 4 == 3)
            target = {static_cast<int>(roll(-20.0, 90.0)), static_cast<int>(roll(-20.0, 70.0)), static_cast<int>(roll(0.0, 120.0)),
                      static_cast<int>(roll(0.0, 100.0))};
        const record expected = draw(scalar{}, mesh, light, target, side);
        texels += expected.texels.size();
        spot += light.perspective() ? expected.texels.size() : 0;
        partly += i % 4 == 3 && !expected.texels.empty();
        CAPTURE(i);
        for_each_isa([&]<typename Isa>() { CHECK(draw(simd<Isa>{}, mesh, light, target, side) == expected); });
    }
    CHECK(texels > 2000000);
    CHECK(spot > 500000);
    CHECK(partly > 80);
}

#if defined(NDEBUG) && GNOMON_X86
TEST_CASE_TEMPLATE("without asserts, triangles for lanes that the processor has not are drawn all the same", Isa, avx2, avx512,
                   test::lanes_to_come) {
    dice roll{std::mt19937_64(39)};
    std::size_t texels = 0;
    for (int i = 0; i < 20; ++i) {
        const light_frame light = test::any_light(roll, i, map_size);
        const mesh_data m = any_mesh(roll, i);
        const record expected = draw(scalar{}, m.mesh(), light, everywhere, faces::both);
        CHECK(draw(simd<Isa>{}, m.mesh(), light, everywhere, faces::both) == expected);
        texels += expected.texels.size();
    }
    CHECK(texels > 1000);
    CHECK(test::lanes_to_come::loads == 0);
}
#endif

TEST_CASE("triangles are drawn in the lanes that are named") {
    mesh_data m;
    m.add({-1.0, 0.0, -1.0}, {1.0, 0.0, -1.0}, {0.0, 0.0, 1.0});
    directional_light sun({0.0, -1.0, 0.0});
    sun.add_caster(bounding_box{{-1, 0, -1}, {1, 0, 1}});
    test::counted_lanes::forget();
    CHECK(draw(simd<test::counted_lanes>{}, m.mesh(), sun.frame(map_size, 1), everywhere, faces::both).texels.size() > 1000);
    CHECK(test::counted_lanes::loads > 0);
}

TEST_CASE("lanes skip the triangles that a place for them does not touch, as the scalar rasteriser does") {
    dice roll{std::mt19937_64(32)};
    std::size_t skipped = 0;
    for (int i = 0; i < 200; ++i) {
        const light_frame light = test::any_light(roll, i, map_size);
        const mesh_data m = any_mesh(roll, i);
        depth_tiles tiles(map_size, 8);
        tiles.mark({10, 20, 40, 50}, {0.0f, 1.0f});
        const auto upper_half = [](texel_rect r) { return r.y0 < 40; };
        const record expected = draw(scalar{}, m.mesh(), light, everywhere, faces::both, tiles),
                     upper = draw(scalar{}, m.mesh(), light, everywhere, faces::both, upper_half);
        skipped += draw(scalar{}, m.mesh(), light, everywhere, faces::both).texels.size() - expected.texels.size();
        for_each_isa([&]<typename Isa>() {
            CHECK(draw(simd<Isa>{}, m.mesh(), light, everywhere, faces::both, tiles) == expected);
            CHECK(draw(simd<Isa>{}, m.mesh(), light, everywhere, faces::both, upper_half) == upper);
        });
    }
    CHECK(skipped > 5000);
}

TEST_CASE("of a triangle wider than what is looked up at once, only pieces are drawn that a place for them touches") {
    mesh_data m;
    m.add({-3.0, 0.0, -1.0}, {3.0, 0.0, -1.0}, {0.0, 0.0, 2.0});
    constexpr extent wide{1024, 512};
    directional_light sun({0.0, -1.0, 0.0});
    sun.add_caster(bounding_box{{-3, 0, -1}, {3, 0, 2}});
    const light_frame light = sun.frame(wide, 1);
    depth_tiles tiles(wide, 32);
    tiles.mark({480, 128, 512, 160}, {0.0f, 1.0f}, 0);
    const record all = draw(scalar{}, m.mesh(), light, everywhere, faces::both),
                 some = draw(scalar{}, m.mesh(), light, everywhere, faces::both, tiles);
    CHECK(all.texels.size() > 100000);
    CHECK((some.texels.size() >= 32 * 32 && some.texels.size() <= 32 * (32 + 2 * 63)));
    for_each_isa([&]<typename Isa>() { CHECK(draw(simd<Isa>{}, m.mesh(), light, everywhere, faces::both, tiles) == some); });
}

TEST_CASE_TEMPLATE(
    "marks are told of each triangle that covers something, in its order and in lanes as plainly, and hold all it covers", Texel,
    rg16, rga8, tm8) {
    struct told {
        texel_rect texels;
        depth_interval depth;
        bool operator==(const told&) const = default;
    };
    dice roll{std::mt19937_64(40)};
    int marks = 0, empty = 0;
    for (int i = 0; i < 100; ++i) {
        const light_frame light = test::any_light(roll, i, map_size);
        const mesh_data m = any_mesh(roll, i);
        const auto triangles = static_cast<int>(m.indices.size() / 3);
        const auto cast = [&](auto run, auto&&... more) {
            image<Texel> map(map_size, Texel::clear());
            std::vector<told> all;
            const auto mark = [&all](texel_rect r, depth_interval depth) { all.push_back({r, depth}); };
            const light_footprint touched = cast_triangles(run, map.view(), m.mesh(), light, more..., faces::both, mark);
            CHECK(touched == cast_triangles(run, map.view(), m.mesh(), light, more...));
            return all;
        };
        const std::vector<told> expected = cast(scalar{});
        std::vector<told> one_by_one; // each triangle as a mesh
        for (int k = 0; k < triangles; ++k) {
            mesh_data single{m.positions, {}};
            for (std::size_t c = 0; c < 3; ++c) single.indices.push_back(m.indices[3 * static_cast<std::size_t>(k) + c]);
            image<Texel> map(map_size, Texel::clear());
            const light_footprint f = cast_triangles(map.view(), single.mesh(), light);
            if (f.texels.empty())
                ++empty;
            else
                one_by_one.push_back({f.texels, f.depth});
        }
        CHECK(expected == one_by_one);
        marks += static_cast<int>(expected.size());
        for_each_isa([&]<typename Isa>() { CHECK(cast(simd<Isa>{}) == expected); });
        if constexpr (Texel::effects.translucency) CHECK(cast(simd<>{}, 0.5f) == cast(scalar{}, 0.5f));
    }
    CHECK((marks > 300 && empty > 100));
}

TEST_CASE_TEMPLATE("lanes cast and bound as the scalar rasteriser does, whatever is in the map, and write nothing beside it", Texel,
                   rg8, rg16, rg16f, rg32f, tm8, test::paper8, rga8, rgb16, rgba8, rgba32f, test::ratio_rgba16) {
    dice roll{std::mt19937_64(33)};
    test::dice bits(33);
    constexpr extent around{map_size.width + 9, map_size.height + 2};
    constexpr texel_rect inner{3, 1, 3 + map_size.width, 1 + map_size.height};
    int changed = 0;
    for (int i = 0; i < 60; ++i) {
        const light_frame light = test::any_light(roll, i, map_size);
        const mesh_data m = any_mesh(roll, i), ground = any_mesh(roll, i + 1);
        image<Texel> from(around, Texel::clear());
        if (i % 3 == 0) test::fill_with_bits(bits, from.view());
        if (i % 3 == 1) from = test::noise<Texel>(bits, around, 2);
        const faces side = i % 2 == 0 ? faces::both : faces::lit_side;
        const auto cast = [&](auto run, image<Texel>& map) {
            const image_view<Texel> view = map.view().part(inner);
            light_footprint touched = cast_triangles(run, view, m.mesh(), light, side);
            if constexpr (Texel::effects.translucency) cast_triangles(run, view, ground.mesh(), light, 0.25f, side);
            if constexpr (Texel::effects.far_bound) {
                touched = bound_triangles(run, view, ground.mesh(), light, side);
                bound_triangles(run, view, m.mesh(), light, faces::both, touches_everything{}, texel_rect{20, 10, 60, 50});
            }
            return touched;
        };
        image<Texel> expected = from;
        const light_footprint touched = cast(scalar{}, expected);
        changed += test::differences(expected, from);
        CAPTURE(i);
        for_each_isa([&]<typename Isa>() {
            image<Texel> made = from;
            CHECK(cast(simd<Isa>{}, made) == touched);
            CHECK(test::differences(made, expected) == 0);
        });
    }
    CHECK(changed > 10000);
}

TEST_CASE_TEMPLATE("lanes cast and bound rows of several pieces as the scalar rasteriser does, and write nothing beside them",
                   Texel, rg8, rg16f, tm8, rgb16, rgba32f) {
    dice roll{std::mt19937_64(40)};
    constexpr extent wide{3 * detail::row_piece, 7}, around{wide.width + 40, wide.height + 2};
    const light_frame light = plain_frame(wide);
    int changed = 0;
    for (int i = 0; i < 40; ++i) {
        mesh_data near, far;
        const double at = roll(-20.0, 20.0), across = roll(230.0, 600.0);
        for (const auto& [mesh, depth] : {std::pair{&near, 0.1}, std::pair{&far, 0.6}}) {
            const auto corner = [&, behind = depth](double x, double y) {
                return glm::dvec3(256 * x, 256 * y, behind + roll(0.0, 0.2));
            };
            mesh->add(corner(at, -1), corner(at + across, roll(-1.0, 3.0)), corner(at + roll(-9.0, 9.0), 9));
            mesh->add(corner(at + across, 2), corner(at + across, 7), corner(at + roll(0.0, 300.0), 4));
            if (i == 0) { // one whole piece in few rows, and rows of a triangle that is cut
                mesh->add(corner(10, 0), corner(10 + detail::row_piece, 0), corner(10, 2000));
                mesh->add(corner(0, 3), corner(1e7, 5), corner(0, 9));
            }
        }
        image<Texel> expected(around, Texel::clear());
        const auto cast = [&](auto run, image<Texel>& map) {
            const image_view<Texel> view = map.view().part({20, 1, 20 + wide.width, 1 + wide.height});
            cast_triangles(run, view, near.mesh(), light, faces::both);
            if constexpr (Texel::effects.far_bound) bound_triangles(run, view, far.mesh(), light, faces::both);
        };
        cast(scalar{}, expected);
        changed += test::differences(expected, image<Texel>(around, Texel::clear()));
        for_each_isa([&]<typename Isa>() {
            image<Texel> made(around, Texel::clear());
            cast(simd<Isa>{}, made);
            CHECK(test::differences(made, expected) == 0);
        });
    }
    CHECK(changed > 40 * 600);
}

TEST_CASE_TEMPLATE("in lanes too a receiver on the near plane ends the shadow of a caster there, and one before it ends none",
                   Texel, rgb8, rgb32f, test::ratio_rgba16) {
    for (const double depth : {0.0, -0.25}) {
        mesh_data sheet;
        sheet.add({-256, -256, depth}, {80000, -256, depth}, {-256, 80000, depth});
        for_each_isa([&]<typename Isa>() {
            image<Texel> map(map_size, Texel::caster(0.0f));
            bound_triangles(simd<Isa>{}, map.view(), sheet.mesh(), plain_frame(map_size), faces::both);
            CHECK(map(40, 20).stored[Texel::far_index] ==
                  (depth < 0.0 ? typename Texel::storage{0} : Texel::caster(0.0f).stored[0]));
        });
    }
}

TEST_CASE(
    "in lanes too a tessellated sheet is drawn exactly once in every texel, of slivers and of triangles smaller than texels") {
    dice roll{std::mt19937_64(34)};
    for (int i = 0; i < 24; ++i) {
        const int columns = 1 + (i * i * 5) % 150, rows = 1 + (i * 29) % 100; // the more unequal, the thinner
        const auto corner_at = [columns](int u, int v) { return static_cast<std::uint32_t>(v * (columns + 1) + u); };
        mesh_data sheet;
        for (int v = 0; v <= rows; ++v)
            for (int u = 0; u <= columns; ++u) {
                const double du = u % columns == 0 ? 0.0 : roll(-0.24, 0.24), dv = v % rows == 0 ? 0.0 : roll(-0.24, 0.24);
                sheet.positions.emplace_back(40.0 * (u + du) / columns - 20.0, 0.001 * roll(-1.0, 1.0),
                                             40.0 * (v + dv) / rows - 20.0);
            }
        for (int v = 0; v < rows; ++v)
            for (int u = 0; u < columns; ++u)
                for (const std::uint32_t index : {corner_at(u, v), corner_at(u + 1, v), corner_at(u + 1, v + 1), corner_at(u, v),
                                                  corner_at(u + 1, v + 1), corner_at(u, v + 1)})
                    sheet.indices.push_back(index);
        directional_light sun({0.01, -1, 0.02});
        sun.add_caster(bounding_sphere{glm::dvec3(0), 9.0});
        const spot_light lamp{
            .position = {0.3, 9, 0.2}, .direction = {0.01, -1, 0.02}, .outer_angle = 0.8, .near_plane = 1.0, .far_plane = 12.0};
        for (const light_frame& light : {sun.frame(map_size), lamp.frame(map_size)})
            for_each_isa([&]<typename Isa>() {
                image<std::uint8_t> count(map_size);
                rasterize(simd<Isa>{}, sheet.mesh(), light, everywhere, faces::both, [&](int x, int y, float) { ++count(x, y); });
                int not_once = 0;
                test::for_each_texel(whole(map_size), [&](int x, int y) { not_once += count(x, y) != 1; });
                CAPTURE(i);
                CHECK(not_once == 0);
            });
    }
}

TEST_CASE("lanes divide by W under every lamp that looks along an axis, and by a W that is the same everywhere") {
    dice roll{std::mt19937_64(44)};
    mesh_data m;
    for (int i = 0; i < 200; ++i) m.add(roll.vector(3.0), roll.vector(3.0), roll.vector(3.0));
    const auto check = [&m](const light_frame& light, const glm::dmat4& model) {
        const triangle_mesh mesh{m.positions, m.indices, model};
        const record drawn = draw(scalar{}, mesh, light, everywhere, faces::both);
        CHECK(drawn.texels.size() > 20);
        for_each_isa([&]<typename Isa>() { CHECK(draw(simd<Isa>{}, mesh, light, everywhere, faces::both) == drawn); });
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            glm::dvec3 along(0.0);
            along[axis] = sign;
            for (const double away : {0.0, 1.0, 4.0})
                check(spot_light{.position = -away * along, .direction = along, .up = {along.y, along.z, along.x}}.frame({64, 64}),
                      glm::dmat4(1.0));
        }
    for (const double w : {0.5, 2.0}) {
        glm::dmat4 model(1.0);
        model[3][3] = w;
        check(plain_frame({64, 64}), glm::scale(model, glm::dvec3(3000.0, 3000.0, 0.3)));
        model[3][2] = 1.0; // flattened onto the plane where z is 1, before it is divided
        check(plain_frame({64, 64}), glm::scale(model, glm::dvec3(3000.0, 3000.0, 0.0)));
    }
}

TEST_CASE("lanes cover the centres that edges run through as the scalar rasteriser does") {
    dice roll{std::mt19937_64(35)};
    const auto number = [&roll](int low, int high) { return static_cast<double>(static_cast<int>(roll(low, high + 0.999))); };
    mesh_data on_centres;
    for (int i = 0; i < 3000; ++i) { // every other corner is a centre or the corner of a texel
        const auto corner = [&] { return glm::dvec3(number(-10, 90) * 128.0, number(-10, 90) * 128.0, roll(0.0, 1.0)); };
        on_centres.add(corner(), corner(), corner());
    }
    const record through = draw(scalar{}, on_centres.mesh(), plain_frame({64, 64}), everywhere, faces::both);
    CHECK(through.texels.size() > 100000);
    for_each_isa([&]<typename Isa>() {
        CHECK(draw(simd<Isa>{}, on_centres.mesh(), plain_frame({64, 64}), everywhere, faces::both) == through);
    });
}

TEST_CASE("an edge that runs through centres thousands of columns away is on the side where it is, in lanes too") {
    dice roll{std::mt19937_64(41)};
    const auto number = [&roll](int low, int high) { return static_cast<double>(static_cast<int>(roll(low, high + 0.999))); };
    mesh_data slivers;
    for (int i = 0; i < 150; ++i) { // two edges lead from centre to centre and meet more in between
        const double between = number(10, 40), columns = between * number(60, static_cast<int>(4090.0 / between)),
                     rows = between * number(1, static_cast<int>(2000.0 / between)), wide = number(1, 3);
        const auto centre = [](double x, double y) { return glm::dvec3(256.0 * x + 128.0, 256.0 * y + 128.0, 0.5); };
        if (i % 2 == 0)
            slivers.add(centre(0, 0), centre(wide, 0), centre(columns, rows));
        else
            slivers.add(centre(columns, 0), centre(columns - wide, 0), centre(0, rows));
    }
    const light_frame light = plain_frame({4096, 2048});
    const record through = draw(scalar{}, slivers.mesh(), light, everywhere, faces::both);
    CHECK(through.texels.size() > 50000);
    for_each_isa([&]<typename Isa>() { CHECK(draw(simd<Isa>{}, slivers.mesh(), light, everywhere, faces::both) == through); });
}

TEST_CASE(
    "an edge that passes a centre by as closely as can be, over 4000 rows and columns, is on the side where it is, in lanes too") {
    dice roll{std::mt19937_64(36)};
    int tried = 0, differ = 0;
    for (int i = 0; i < 400; ++i) {
        // From (x, 0) to (x + dx, dy). On the row with centre y it is 1/dy of 1/256 texel beside a centre if dx y = +-1 modulo dy.
        const std::int64_t dy = (1 << 20) - 1 - 2 * static_cast<std::int64_t>(roll(0.0, 1000.0));
        const int row = static_cast<int>(roll(1.0, 4000.0)), column = 4100;
        const std::int64_t y = 256 * row + 128, inverse = inverse_of(y, dy);
        if (inverse == 0) continue;
        ++tried;
        std::size_t covered[3] = {};
        for (const int beside : {-1, 0, 1}) {
            const std::int64_t dx = beside < 0 ? dy - inverse : inverse, met = dx * y / dy + (beside < 0 ? 1 : 0);
            const auto x = static_cast<double>(256 * column + 128 - met), width = static_cast<double>(dx),
                       height = static_cast<double>(dy);
            mesh_data m;
            m.add(glm::dvec3(x, beside == 0 ? -1.0 : 0.0, 0.0), glm::dvec3(x + width, height, 1.0),
                  i % 2 == 0 ? glm::dvec3(x + width, 0.0, 0.5) : glm::dvec3(x, height, 0.5));
            const light_frame light = plain_frame({8300, 4100});
            const texel_rect target{column - 9, row - 1, column + 8, row + 3};
            const record expected = draw(scalar{}, m.mesh(), light, target, faces::both);
            covered[beside + 1] = expected.texels.size();
            for_each_isa([&]<typename Isa>() { CHECK(draw(simd<Isa>{}, m.mesh(), light, target, faces::both) == expected); });
        }
        differ += covered[0] != covered[2];
    }
    CHECK(tried > 200);
    CHECK(differ > 100);
}

TEST_CASE("a triangle that is a line until its corners are snapped has one depth where it covers a centre, in lanes too") {
    dice roll{std::mt19937_64(37)};
    const light_frame light = plain_frame({1024, 1024});
    mesh_data m;
    for (int i = 0; i < 2000; ++i) {
        const auto quarters = [&roll] { return static_cast<double>(static_cast<int>(roll(-100000.0, 100000.0))) + 0.25; };
        const glm::dvec3 from(130000.0, 130000.0, roll(0.0, 1.0)), along(quarters(), quarters(), roll(-1.0, 1.0));
        m.add(from, from + along, from + along * 0.5);
    }
    const record expected = draw(scalar{}, m.mesh(), light, everywhere, faces::both);
    CHECK(expected.texels.size() > 100);
    for_each_isa([&]<typename Isa>() { CHECK(draw(simd<Isa>{}, m.mesh(), light, everywhere, faces::both) == expected); });
}

TEST_CASE("a sliver over half a million texels, of an area that doubles do not tell from none, covers the centre on its edge in "
          "lanes too") {
    dice roll{std::mt19937_64(38)};
    const light_frame light = plain_frame({64, 64});
    std::size_t covered = 0;
    for (int i = 0; i < 200; ++i) {
        // Its edge from a to b has a centre in its middle, and (b - a) / 2 = (p, q) and c - a span the least area there is.
        const auto p = static_cast<std::int64_t>(roll(0x1p26, 0x1p27)), q = static_cast<std::int64_t>(roll(0x1p26, 0x1p27));
        const std::int64_t inverse = inverse_of(p, q), c_y = q - inverse; // p c_y - q c_x = -1: to the right
        if (inverse == 0) continue;
        const glm::dvec3 middle(128.0 + 256.0 * 20, 128.0 + 256.0 * 30, 0.5), half(p, q, 0.0);
        const glm::dvec3 a = middle - half, b = middle + half, c = a + glm::dvec3((p * c_y + 1) / q, c_y, 0.0);
        mesh_data m;
        m.add(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1));
        m.add(glm::dvec3(0, 0, 0), glm::dvec3(0.5, 0.5, 0), glm::dvec3(0.5, 0.5, 0x1p-16)); // a small one beside it
        const glm::dmat4 corners(glm::dvec4(a, 0.0), glm::dvec4(b, 0.0), glm::dvec4(c, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0));
        const record expected = draw(scalar{}, m.mesh(corners), light, everywhere, faces::both);
        covered += expected.texels.size();
        for_each_isa(
            [&]<typename Isa>() { CHECK(draw(simd<Isa>{}, m.mesh(corners), light, everywhere, faces::both) == expected); });
    }
    CHECK(covered > 20);
}

TEST_CASE("corners a hair below a tie are snapped in lanes as the scalar rasteriser snaps them") {
    mesh_data half; // of a square: its longest edge runs through centres, if its corners are snapped upwards
    half.add({0, 0, 0.5}, {0, 10, 0.5}, {10, 0, 0.5});
    for (const int axis : {0, 1}) {
        std::size_t fewest = 100, most = 0;
        for (const double hair : {0.2, 0.4, 0.6, 0.8, 1.1, 1.6, 2.2}) {
            glm::dmat4 at_tie(1.0);
            at_tie[3][axis] = (128.5 - hair * 0x1p-23) / 256.0;
            at_tie[3][1 - axis] = 0.25;
            const light_frame light(at_tie, {16, 16}, 1.0, 1.0);
            const record expected = draw(scalar{}, half.mesh(), light, everywhere, faces::both);
            fewest = lesser(fewest, expected.texels.size());
            most = greater(most, expected.texels.size());
            CAPTURE(hair);
            for_each_isa(
                [&]<typename Isa>() { CHECK(draw(simd<Isa>{}, half.mesh(), light, everywhere, faces::both) == expected); });
        }
        CHECK(fewest < most);
    }
}

TEST_CASE("lanes as wide as can be, 32 doubles, cast rows that end with a register, before it and behind it") {
    test::for_isa<emulated<256>>([]<typename Isa>() {
        for (const int columns : {31, 32, 33, 64}) {
            mesh_data sheet;
            sheet.add({-256, -256, 0.25}, {80000, -256, 0.25}, {-256, 80000, 0.25});
            const extent around{columns + 40, 3};
            image<rg8> expected(around, rg8::clear()), made(around, rg8::clear());
            const texel_rect inner{3, 1, 3 + columns, 2};
            cast_triangles(expected.view().part(inner), sheet.mesh(), plain_frame({columns, 1}));
            cast_triangles(simd<Isa>{}, made.view().part(inner), sheet.mesh(), plain_frame({columns, 1}));
            CAPTURE(columns);
            CHECK(test::differences(expected, image<rg8>(around, rg8::clear())) == columns);
            CHECK(test::differences(made, expected) == 0);
        }
    });
}

TEST_CASE("a triangle whose depth is infinite at a corner is left out, in lanes too") {
    const light_frame plain = plain_frame({64, 64});
    glm::dmat4 deep = plain.matrix();
    deep[2][2] = 1e300;
    const light_frame light(deep, {64, 64}, 1.0, 1.0);
    mesh_data m;
    m.add(glm::dvec3(0.0, 0.0, 1e20), glm::dvec3(9000.0, 100.0, 0.0), glm::dvec3(100.0, 9000.0, 0.0));
    CHECK(draw(scalar{}, m.mesh(), plain, everywhere, faces::both).texels.size() > 500);
    CHECK(draw(scalar{}, m.mesh(), light, everywhere, faces::both).texels.empty());
    for_each_isa([&]<typename Isa>() { CHECK(draw(simd<Isa>{}, m.mesh(), light, everywhere, faces::both).texels.empty()); });
}
