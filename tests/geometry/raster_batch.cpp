// What the rasteriser sets up in lanes, before it draws: the numbers of the scalar one, bit for bit. That the texels are the same is asked
// in rasterize_lanes.cpp; but a triangle that lanes wrongly left to the scalar code would have these texels too.
#include <gnomon/geometry/rasterize_lanes.hpp>

#include "../support/any_light.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

using namespace gnomon;

namespace {
constexpr extent map_size{600, 80}; // so that triangles have a row of a piece more or less, and a row more or less than few
using setup = on_any::triangle_setup<emulated<48>>;
using dice = test::world_dice;

/// Which triangles were seen: each kind must have been.
struct tally {
    int cut = 0, off = 0, slivers = 0, large = 0, wide = 0, tall = 0, few = 0;
};

/// Triangle `first / 3` of a mesh against lane k.
void check_one(const setup::batch& b, int k, const detail::raster_job& job, int first, tally& seen) {
    const auto bit = [k](std::uint32_t bits) { return (bits >> k & 1) != 0; };
    const detail::projected_polygon triangle = detail::project(*job.mesh, first, job.to_map);
    REQUIRE(bit(b.here));
    bool uncut = true;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec4& h = triangle.corner[i];
        uncut = uncut && std::abs(h.x) + std::abs(h.y) < detail::fixed_point::reach * h.w && (!job.perspective || h.z > 0.0);
    }
    if (!uncut) {
        ++seen.cut;
        CHECK(bit(b.drawn));
        CHECK_FALSE(bit(b.plain));
        return;
    }
    detail::fixed_point corner[detail::most_corners];
    REQUIRE(triangle.snap(corner));
    const texel_rect box = detail::centres_in(corner, 3), around = intersection(job.target, box);
    if (around.empty()) {
        ++seen.off;
        CHECK_FALSE(bit(b.drawn));
        return;
    }
    CHECK(setup::box_of(b, k) == around);
    if (box.width() >= 4096 || box.height() >= 4096) {
        ++seen.large;
        CHECK(bit(b.drawn));
        CHECK_FALSE(bit(b.plain));
        return;
    }
    const std::int64_t turn =
        (corner[1].x - corner[0].x) * (corner[2].y - corner[0].y) - (corner[1].y - corner[0].y) * (corner[2].x - corner[0].x);
    CHECK(bit(b.drawn) == (turn != 0));
    if (turn == 0) {
        ++seen.slivers;
        return;
    }
    const detail::depth_surface surface(triangle.corner, triangle.corner[0], *job.light);
    const detail::triangle_depth expected = surface.depth(), made = setup::depth_of(b, job, k);
    CHECK(bit(b.plain) == (std::abs(surface.area()) > 0.0));
    CHECK(b.area.lane[k] == surface.area());
    CHECK(made.inverse == expected.inverse);
    const double expected_numbers[] = {expected.near_w, expected.per_w, expected.x,       expected.y,       expected.a,
                                       expected.b,      expected.c,     expected.nearest, expected.farthest};
    const double made_numbers[] = {made.near_w, made.per_w, made.x, made.y, made.a, made.b, made.c, made.nearest, made.farthest};
    CHECK(std::ranges::equal(made_numbers, expected_numbers));

    seen.wide += around.width() > 256;
    seen.tall += around.height() > 32;
    CHECK(bit(b.few) == (around.width() <= 256 && around.height() <= 32));
    if (!bit(b.few)) return;
    ++seen.few;
    std::vector<std::pair<int, int>> runs(static_cast<std::size_t>(around.height()), {0, 0});
    detail::scan(corner, 3, around, [&](int y, int x0, int x1) { runs[static_cast<std::size_t>(y - around.y0)] = {x0, x1}; });
    for (int row = 0; row < around.height(); ++row) {
        const auto [x0, x1] = runs[static_cast<std::size_t>(row)];
        const double begin = b.begin[row].lane[k], end = b.end[row].lane[k];
        if (x0 == x1) {
            CHECK(begin >= end);
        } else {
            CHECK(begin == x0 - around.x0);
            CHECK(end == x1 - around.x0);
        }
        CHECK(b.on_row[row].lane[k] == expected.b * (around.y0 + row + 0.5 - expected.y) + expected.c);
    }
}
} // namespace

TEST_CASE("lanes set up what the scalar rasteriser computes, and leave to it only what is cut, large or edge-on") {
    dice roll{std::mt19937_64(2024)};
    tally seen;
    for (int i = 0; i < 600; ++i) {
        const light_frame light = test::any_light(roll, i, map_size);
        std::vector<glm::vec3> positions;
        std::vector<std::uint32_t> indices;
        const double size = i % 7 == 0 ? std::exp(roll(0.0, 30.0)) : std::exp(roll(-6.0, 3.0));
        for (int k = 0; k < 2 * setup::lanes; ++k) {
            const glm::dvec3 at = i % 7 == 3 ? roll.vector(3e5) : roll.vector(5.0);
            const glm::dvec3 corners[] = {at + roll.vector(size), at + roll.vector(size), at + roll.vector(size)};
            for (int c = 0; c < 3; ++c) {
                indices.push_back(static_cast<std::uint32_t>(positions.size()));
                positions.emplace_back(corners[k % 8 == 5 ? c / 2 : c]);
            }
        }
        const triangle_mesh mesh{.positions = positions, .indices = indices};
        detail::raster_job job{};
        job.mesh = &mesh;
        job.light = &light;
        job.to_map = light.matrix();
        job.perspective = light.perspective();
        job.divides = light.perspective();
        job.near_w = light.near_w();
        job.per_w = detail::depth_surface::per_w(light);
        job.target =
            i % 3 == 0 ? texel_rect{100, 10, 356 + i % 2, 42 + i / 3 % 2} : whole(map_size); // a piece or few rows, or one more
        for (int first = 0; first < static_cast<int>(indices.size()); first += 3 * setup::lanes) {
            setup::batch b;
            setup::fill(b, mesh, first);
            setup::set_up(b, job);
            for (int k = 0; k < setup::lanes; ++k) check_one(b, k, job, first + 3 * k, seen);
        }
    }
    for (const int each : {seen.cut, seen.off, seen.slivers, seen.large, seen.wide, seen.tall, seen.few}) CHECK(each > 20);
}
