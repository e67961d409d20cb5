// Triangles of any numbers under lights of any numbers. What a polygon covers is asked texel by texel, of exact integers.
#include "bytes.hpp"

#include <gnomon/geometry/directional_light.hpp>
#include <gnomon/geometry/footprint.hpp>
#include <gnomon/geometry/rasterize.hpp>
#include <gnomon/geometry/spot_light.hpp>
#include <gnomon/grid/tile_grid.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace gnomon;
using fuzz::demand;

namespace {

// --- scan: polygons in fixed point --------------------------------------------------------------------------------------------

std::int64_t fixed(fuzz::bytes& in) {
    constexpr std::int64_t reach = std::int64_t{1} << 28;
    switch (in.within(0, 4)) {
    case 0: return in.within(-1, 24) * 256 + 128 + in.within(-1, 1); // a centre, or beside it
    case 1: return in.one_of({-reach, reach, reach - 1, std::int64_t{0}});
    case 2: return in.within(-(1 << 28), 1 << 28);
    default: return in.within(-1024, 7168);
    }
}

/// In is what has an odd number of edges at or to the left of its centre, on the rows between the edge's ends.
bool covered(const detail::fixed_point* corners, int count, int x, int y) {
    const std::int64_t cx = std::int64_t{x} * 256 + 128, cy = std::int64_t{y} * 256 + 128;
    bool in = false;
    for (int i = 0; i < count; ++i) {
        detail::fixed_point a = corners[i], b = corners[(i + 1) % count];
        if (b.y < a.y) std::swap(a, b);
        if (cy < a.y || cy >= b.y) continue;
        if ((cx - a.x) * (b.y - a.y) - (cy - a.y) * (b.x - a.x) >= 0) in = !in; // below 2^60
    }
    return in;
}

void run_scan(fuzz::bytes& in) {
    constexpr int side = 28;
    detail::fixed_point corners[detail::most_corners];
    const int count = in.within(3, detail::most_corners);
    for (int i = 0; i < count; ++i) corners[i] = {fixed(in), fixed(in)};
    const int x = in.within(-2, 20), y = in.within(-2, 20);
    const texel_rect target{x, y, x + in.within(-1, 26), y + in.within(-1, 26)};
    std::vector<int> painted(side * side * 4);
    const auto at = [&painted](int i, int j) -> int& { return painted[static_cast<std::size_t>((j + 4) * 2 * side + i + 4)]; };
    int last_row = -100, last_column = -100;
    detail::scan(corners, count, target, [&](int row, int x0, int x1) {
        demand(row >= target.y0 && row < target.y1 && x0 >= target.x0 && x1 <= target.x1 && x0 < x1, "a run lies in the target");
        demand(row > last_row || (row == last_row && x0 >= last_column), "runs come in the order of rows and columns");
        last_row = row;
        last_column = x1;
        for (int i = x0; i < x1; ++i) ++at(i, row);
    });
    for (int j = target.y0; j < target.y1; ++j)
        for (int i = target.x0; i < target.x1; ++i)
            demand(at(i, j) == (covered(corners, count, i, j) ? 1 : 0), "a polygon owns exactly the texels whose centres it holds");
}

// --- lights ---------------------------------------------------------------------------------------------------------------------

/// A world coordinate: of a scene, or anything.
double coordinate(fuzz::bytes& in, bool sane) {
    if (sane || in.within(0, 7) > 0) return in.within(-64, 64) / 8.0;
    return static_cast<double>(in.any_float()) * (in.flip() ? 1.0 : 1e9);
}
glm::dvec3 point(fuzz::bytes& in, bool sane) {
    const double x = coordinate(in, sane), y = coordinate(in, sane);
    return {x, y, coordinate(in, sane)};
}

light_frame any_light(fuzz::bytes& in, bool sane) {
    const extent size{in.within(sane ? 1 : 0, 48), in.within(sane ? 1 : 0, 40)};
    const int margin = in.within(0, 3);
    const glm::dvec3 direction = point(in, sane);
    switch (in.within(0, sane ? 1 : 2)) {
    case 0: {
        directional_light sun(direction, point(in, sane));
        for (int n = in.within(1, 3); n > 0; --n) sun.add_caster(bounding_sphere{point(in, sane), std::abs(coordinate(in, sane))});
        if (in.flip()) {
            const glm::dvec3 corner = point(in, sane);
            sun.add_receiver(bounding_box{corner, corner + glm::abs(point(in, sane))});
        }
        return sun.frame(size, margin);
    }
    case 1: {
        const double near_plane = 0.25 * in.within(sane ? 1 : 0, 40);
        return spot_light{.position = point(in, sane),
                          .direction = direction,
                          .outer_angle = in.within(sane ? 8 : 0, sane ? 144 : 160) / 100.0,
                          .near_plane = near_plane,
                          .far_plane = near_plane + 0.25 * in.within(1, 200)}
            .frame(size, margin);
    }
    default: {
        glm::dmat4 m(0.0);
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < 4; ++k) m[i][k] = in.within(0, 3) == 0 ? in.any_double() : in.within(-16, 16) / 8.0;
        return light_frame::from_matrix(
            m, size, {in.one_of({clip_depth::zero_to_one, clip_depth::minus_one_to_one, clip_depth::one_to_zero}), in.flip()});
    }
    }
}

// --- triangles ------------------------------------------------------------------------------------------------------------------

struct triangles {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    glm::dmat4 model{1.0};

    explicit triangles(fuzz::bytes& in) {
        const bool sane = in.flip();
        for (int n = in.within(0, 8); n > 0; --n) {
            const glm::dvec3 p = point(in, sane);
            positions.push_back(sane || in.within(0, 15) > 0 ? glm::vec3(p)
                                                             : glm::vec3(in.any_float(), in.any_float(), in.any_float()));
        }
        for (int n = in.within(0, 20); n > 0; --n) indices.push_back(in.within(0, 15) == 0 ? in.word() : in.byte() % 9u);
        if (in.within(0, 3) == 0)
            for (int i = 0; i < 4; ++i)
                for (int k = 0; k < 3; ++k) model[i][k] = in.within(0, 15) == 0 ? in.any_double() : in.within(-16, 16) / 8.0;
    }
    [[nodiscard]] triangle_mesh mesh() const { return {positions, indices, model}; }
    [[nodiscard]] triangle_mesh one(std::size_t first) const { return {positions, {indices.data() + first, 3}, model}; }
    /// Could the triangle be drawn at all?
    [[nodiscard]] bool is_whole(std::size_t first) const {
        for (std::size_t i = first; i < first + 3; ++i) {
            if (indices[i] >= positions.size()) return false;
            const glm::vec3 p = positions[indices[i]];
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
        }
        return true;
    }
};

void check_rasterize(fuzz::bytes& in, const light_frame& light, const triangles& t) {
    const faces side = in.one_of({faces::both, faces::both, faces::lit_side, faces::dark_side});
    const int x = in.within(-4, 48), y = in.within(-4, 40);
    const texel_rect target = in.flip() ? everywhere : texel_rect{x, y, x + in.within(-1, 40), y + in.within(-1, 40)};
    const texel_rect allowed = clip(target, light.size());
    const auto texels =
        static_cast<std::size_t>(greater(light.size().width, 0)) * static_cast<std::size_t>(greater(light.size().height, 0));

    using Texel = rgb16;
    image<Texel> by_hand(light.size(), Texel::clear());
    light_footprint all;
    for (std::size_t first = 0; first + 2 < t.indices.size(); first += 3) {
        std::vector<bool> written(texels);
        texel_rect box;
        depth_interval depths;
        const light_footprint touched = rasterize(t.one(first), light, target, side, [&](int i, int j, float depth) {
            demand(allowed.contains(i, j), "a triangle is drawn on the map and in the target");
            const auto index =
                static_cast<std::size_t>(j) * static_cast<std::size_t>(light.size().width) + static_cast<std::size_t>(i);
            demand(!written[index], "a triangle is drawn once");
            written[index] = true;
            demand(depth <= depth, "a depth is a number");
            box = union_box(box, {i, j, i + 1, j + 1});
            depths.include({saturate(depth), saturate(depth)});
            by_hand(i, j).cast(Texel::caster(depth));
        });
        demand(touched.texels == box, "the texels that were touched are those that were written");
        demand(touched.depth == depths, "and so are their depths");
        demand(box.empty() || (light.valid() && t.is_whole(first)), "an invalid light and a broken triangle draw nothing");
        all.texels = union_box(all.texels, box);
        all.depth.include(depths);
    }

    // As a whole, in the other order, into a view of some pitch, and by tiles that were marked where it is.
    const auto reversed = [&t] {
        triangles r = t;
        r.indices.resize(r.indices.size() / 3 * 3);
        for (std::size_t i = 0; i + 3 < r.indices.size() - i; i += 3)
            std::swap_ranges(r.indices.begin() + static_cast<std::ptrdiff_t>(i),
                             r.indices.begin() + static_cast<std::ptrdiff_t>(i + 3),
                             r.indices.end() - static_cast<std::ptrdiff_t>(i + 3));
        return r;
    };
    if (target == everywhere) {
        image<Texel> whole_mesh(light.size(), Texel::clear()), other_order(light.size(), Texel::clear());
        demand(cast_triangles(whole_mesh.view(), t.mesh(), light, side) == all, "a mesh touches what its triangles touch");
        cast_triangles(other_order.view(), reversed().mesh(), light, side);
        tile_grid tiles(light.size(), in.within(1, 16));
        tiles.mark(all.texels);
        image<Texel> bounded = whole_mesh, bounded_by_tiles = whole_mesh;
        const triangles ground(in);
        bound_triangles(bounded.view(), ground.mesh(), light, side);
        tile_grid casters(light.size(), in.within(1, 16));
        casters.mark(all.texels);
        bound_triangles(bounded_by_tiles.view(), ground.mesh(), light, side, casters);
        for (int j = 0; j < light.size().height; ++j)
            for (int i = 0; i < light.size().width; ++i) {
                demand(whole_mesh(i, j) == by_hand(i, j), "casting is drawing into texels");
                demand(other_order(i, j) == by_hand(i, j), "the order of triangles does not show");
                demand(bounded(i, j) == bounded_by_tiles(i, j), "skipping where nothing casts changes nothing");
            }
    }
}

/// No point of a box or of a ball lies outside its footprint.
void check_footprint(fuzz::bytes& in, const light_frame& light) {
    const glm::dvec3 a = point(in, true), b = point(in, true);
    const bounding_box box{glm::min(a, b), glm::max(a, b)};
    const bounding_sphere ball{a, in.within(0, 64) / 8.0};
    const light_footprint of_box = footprint(box, light), of_ball = footprint(ball, light);
    const auto check = [&light](const glm::dvec3& p, const light_footprint& f) {
        const map_point q = light.to_map(p);
        if (!q.in_front() || (light.perspective() && q.depth < 0.0)) return;
        if (!(q.x >= 0.0 && q.x < light.size().width && q.y >= 0.0 && q.y < light.size().height)) return;
        demand(f.texels.contains(static_cast<int>(q.x), static_cast<int>(q.y)), "a footprint holds the texels of every point");
        const float depth = static_cast<float>(saturate(q.depth));
        demand(f.depth.nearest <= depth && depth <= f.depth.farthest, "a footprint holds the depth of every point");
    };
    for (int n = 0; n < 16; ++n) {
        const glm::dvec3 share(in.byte() / 255.0, in.byte() / 255.0, in.byte() / 255.0);
        check(box.lower + (box.upper - box.lower) * share, of_box);
        const glm::dvec3 away = share * 2.0 - 1.0;
        const double length = glm::length(away);
        if (length > 0.0) check(ball.centre + away * (ball.radius * (n % 2 == 0 ? 1.0 : share.x) / length), of_ball);
    }
}

/// Whatever a light and a volume are made of, a footprint is on the map and its depths are in [0, 1].
void check_hostile_footprint(fuzz::bytes& in, const light_frame& light) {
    const auto wild = [&in] { return glm::dvec3(in.any_double(), in.any_double(), in.any_double()); };
    const glm::dvec3 a = wild(), b = wild();
    for (const light_footprint& f : {footprint(bounding_box{a, b}, light), footprint(bounding_sphere{a, in.any_double()}, light)}) {
        demand(f.texels == clip(f.texels, light.size()), "a footprint lies on the map");
        demand(f.empty() || (f.depth.nearest >= 0.0f && f.depth.nearest <= f.depth.farthest && f.depth.farthest <= 1.0f),
               "the depths of a footprint lie in [0, 1]");
    }
    const map_point p = light.to_map(a);
    demand(light.valid() || !p.in_front(), "nothing is in front of an invalid light");
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::bytes in(data, size);
    switch (in.within(0, 3)) {
    case 0: run_scan(in); break;
    case 1: {
        const light_frame light = any_light(in, true);
        check_footprint(in, light);
        break;
    }
    case 2: {
        const light_frame light = any_light(in, false);
        check_hostile_footprint(in, light);
        break;
    }
    default: {
        const light_frame light = any_light(in, in.flip());
        const triangles t(in);
        check_rasterize(in, light, t);
    }
    }
    return 0;
}
