// gnomon: soft shadow maps. Triangles onto a map: casters into it, receivers as their far bound.
#pragma once

#include <gnomon/geometry/footprint.hpp>
#include <gnomon/geometry/scan.hpp>
#include <gnomon/geometry/triangle.hpp>
#include <gnomon/texel/image.hpp>
#include <gnomon/texel/texel.hpp>

#include <concepts>
#include <cstdint>
#include <limits>

namespace gnomon::inline GNOMON_BUILD {

/// Indexed triangles. A triangle with an index off the positions, or a corner that is not finite, is left out; so are one or two
/// indices too many at the end.
struct triangle_mesh {
    strided_span<const glm::vec3> positions; ///< from std::vector, std::span, or a field of an interleaved vertex buffer
    strided_span<const std::uint32_t> indices;
    glm::dmat4 model{1.0}; ///< from positions to the world; in double, because that is where a large world loses its texels
};

/// Which triangles take part, by the side they turn to the light. Counter-clockwise from outside, in the mesh's own space: a
/// mirroring model matrix does not turn it inside out. A triangle seen exactly edge-on counts as turned away, and so does all that
/// the model matrix flattens.
enum class faces { both, lit_side, dark_side };

/// What rounding a depth in [0, 1] to float costs at most: 2^-25.
inline constexpr double raster_depth_error = 1.0 / 33554432.0;

/// Knows where something may be: a tile_grid, a depth_tiles, or any callable that answers for a texel_rect.
template <typename T>
concept marked_texels =
    requires(const T& where, texel_rect r) { where.touches(r); } || requires(const T& where, texel_rect r) { where(r); };

/// Is told of each triangle that covered something: the texels, and the depths in [0, 1]. A grid's mark, above all.
template <typename T>
concept takes_marks = requires(T& marks, texel_rect r, depth_interval depth) { marks(r, depth); };
struct marks_nothing {
    constexpr void operator()(texel_rect, depth_interval) const noexcept {}
};

/// The region without a limit, which is the largest map there is, and the test that skips nothing.
inline constexpr texel_rect everywhere = whole({light_frame::largest_side, light_frame::largest_side});
struct touches_everything {
    [[nodiscard]] constexpr bool operator()(texel_rect) const noexcept { return true; }
};

namespace detail {
/// The three corners of triangle `first / 3`, projected. Empty if an index is off the positions.
[[nodiscard]] inline projected_polygon project(const triangle_mesh& mesh, int first, const glm::dmat4& to_map) noexcept {
    projected_polygon triangle;
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t index = mesh.indices[first + i];
        if (index >= static_cast<std::uint32_t>(mesh.positions.size())) {
            triangle.count = 0; // of two corners a cut would make three
            break;
        }
        triangle.add(project(to_map, glm::dvec3(mesh.positions[static_cast<int>(index)])));
    }
    return triangle;
}

/// Does a triangle whose area has this sign turn the side to the light that is asked for?
[[nodiscard]] constexpr bool shows(double area, double handedness, faces side) noexcept {
    const bool towards = area * handedness < 0.0; // x, y, depth of a map are left-handed
    return side == faces::both || towards == (side == faces::lit_side);
}

/// The box around runs of texels, and around the depths at their ends: along a row depth is monotone.
struct touched_texels {
    texel_rect box{int_max, int_max, -int_max, -int_max};
    float nearest = std::numeric_limits<float>::infinity(), farthest = -nearest;

    constexpr void add(int y, int x0, int x1, float first, float last) noexcept {
        box = {lesser(box.x0, x0), lesser(box.y0, y), greater(box.x1, x1), greater(box.y1, y + 1)};
        nearest = lesser(nearest, lesser(first, last));
        farthest = greater(farthest, greater(first, last));
    }
    constexpr void add(const touched_texels& other) noexcept {
        box = {lesser(box.x0, other.box.x0), lesser(box.y0, other.box.y0), greater(box.x1, other.box.x1),
               greater(box.y1, other.box.y1)};
        nearest = lesser(nearest, other.nearest);
        farthest = greater(farthest, other.farthest);
    }
    [[nodiscard]] constexpr light_footprint footprint() const noexcept {
        if (box.empty()) return {};
        return {box, {saturate(nearest), saturate(farthest)}};
    }
};

template <marked_texels Where> [[nodiscard]] constexpr bool touches(const Where& where, texel_rect r) { return where(r); }
template <marked_texels Where>
    requires requires(const Where& where, texel_rect r) { where.touches(r); }
[[nodiscard]] constexpr bool touches(const Where& where, texel_rect r) {
    return where.touches(r);
}

/// A run of texels is looked up in pieces of so many, where something says where to look.
inline constexpr int looked_up = 64;

/// Calls run(depth, y, x0, x1) for every run of texels of `target` that a triangle covers.
template <marked_texels Where, typename Run>
void draw_triangle(const triangle_mesh& mesh, int first, const glm::dmat4& to_map, double handedness, const light_frame& light,
                   texel_rect target, faces side, const Where& where, Run&& run) {
    const projected_polygon triangle = project(mesh, first, to_map);
    projected_polygon visible = triangle;
    visible.keep_drawable(light.perspective());
    fixed_point corners[most_corners];
    if (!visible.snap(corners)) return;
    const texel_rect around = intersection(target, centres_in(corners, visible.count));
    if (around.empty() || !touches(where, around)) return;
    const depth_surface surface(triangle.corner, visible.corner[0], light);
    if (!shows(surface.area(), handedness, side)) return;
    scan(corners, visible.count, around, [&](int y, int x0, int x1) { run(surface.depth(), y, x0, x1); });
}

/// rasterize, which says what each triangle touched.
template <typename Sink, marked_texels Where, takes_marks Marks>
light_footprint rasterize_and_mark(const triangle_mesh& mesh, const light_frame& light, texel_rect target, faces side, Sink& sink,
                                   const Where& where, Marks& marks) {
    target = clip(target, light.size());
    if (target.empty()) return {}; // so is an invalid frame's
    const glm::dmat4 to_map = product(light.matrix(), mesh.model);
    const double handedness = volume(to_map);

    touched_texels touched;
    for (int first = 0; mesh.indices.size() - first > 2; first += 3) {
        touched_texels here;
        const auto piece = [&](const triangle_depth& depth, int y, int x0, int x1) {
            const float begin = depth(x0, y);
            float end = begin;
            sink(x0, y, begin);
            for (int x = x0 + 1; x < x1; ++x) sink(x, y, end = depth(x, y));
            here.add(y, x0, x1, begin, end);
        };
        const auto run = [&](const triangle_depth& depth, int y, int x0, int x1) {
            if constexpr (std::same_as<Where, touches_everything>)
                return piece(depth, y, x0, x1);
            else
                for (int x = x0, end; x < x1; x = end) {
                    end = lesser(x1, x + looked_up);
                    if (touches(where, {x, y, end, y + 1})) piece(depth, y, x, end);
                }
        };
        draw_triangle(mesh, first, to_map, handedness, light, target, side, where, run);
        if (here.box.empty()) continue;
        const light_footprint covered = here.footprint();
        marks(covered.texels, covered.depth);
        touched.add(here);
    }
    return touched.footprint();
}
} // namespace detail

/// Calls `sink(x, y, depth)` once per triangle for every texel of `target`, a part of the map, whose centre the triangle covers.
///
/// *Coverage.* Corners are snapped to 1/256 texel, the rest is exact: see scan.hpp. Triangles that share an edge share no texel and
/// leave none out. Farther than 2^20 texels off the map triangles are cut, along shared edges in the same way. Corners may be up to
/// 1e12 away; beyond, doubles no longer say where a cut is, and a texel may be missed or drawn twice.
///
/// *Depth* is that of the triangle's plane at the texel centre, in float, linear, and within `raster_depth_error` of the plane in
/// [0, 1]: rounding to float is all of it. It is limited to the depths of the triangle's corners, but not to [0, 1]: a directional
/// light's near plane cuts nothing off, so that casters before it keep their silhouette. A spot light's does. No far plane does.
///
/// `where` may skip a triangle by the box around it, and up to 64 texels of a row of it. Returns what was touched: the texels, and the
/// depths in [0, 1].
/// The order is that of the indices, then rows, then columns. Nothing is allocated. Nothing is drawn by an invalid frame.
template <typename Sink, marked_texels Where = touches_everything>
    requires requires(Sink& sink, int i, float depth) { sink(i, i, depth); }
light_footprint rasterize(const triangle_mesh& mesh, const light_frame& light, texel_rect target, faces side, Sink&& sink,
                          const Where& where = {}) {
    marks_nothing nothing;
    return detail::rasterize_and_mark(mesh, light, target, side, sink, where, nothing);
}

/// Casts triangles into a map: `tiles.mark(cast_triangles(texels, mesh, light).texels, guard)`. Texel (0, 0) is that of the map.
///
/// Depths are clamped to [0, 1]. The order of meshes and triangles does not show: see texel::cast. Returns what was touched, in one box;
/// `marks` is told triangle by triangle, for meshes of many things that lie apart.
template <texel_format Texel, takes_marks Marks = marks_nothing>
light_footprint cast_triangles(image_view<Texel> texels, const triangle_mesh& mesh, const light_frame& light,
                               faces side = faces::both, Marks&& marks = {}) {
    const auto cast = [&](int x, int y, float s) { texels(x, y).cast(Texel::caster(s)); };
    return detail::rasterize_and_mark(mesh, light, whole(texels.size()), side, cast, touches_everything{}, marks);
}

/// The same for casters that let 1 - `opacity` of the light through.
template <texel_format Texel, takes_marks Marks = marks_nothing>
    requires(Texel::effects.translucency)
light_footprint cast_triangles(image_view<Texel> texels, const triangle_mesh& mesh, const light_frame& light, float opacity,
                               faces side = faces::both, Marks&& marks = {}) {
    const auto cast = [&](int x, int y, float s) { texels(x, y).cast(Texel::caster(s, opacity)); };
    return detail::rasterize_and_mark(mesh, light, whole(texels.size()), side, cast, touches_everything{}, marks);
}

/// Ends the shadows in a map at the first receiver behind each caster. Call it when all casters are in: see texel::bound.
///
/// `where` may skip what lies where nothing casts: bound_triangles(texels, ground, light, faces::both, tiles). `region` limits the work
/// too. Receivers before the near plane end nothing. Returns what was touched, caster or not.
template <texel_format Texel, marked_texels Where = touches_everything>
    requires(Texel::effects.far_bound)
light_footprint bound_triangles(image_view<Texel> texels, const triangle_mesh& mesh, const light_frame& light,
                                faces side = faces::both, const Where& where = {}, texel_rect region = everywhere) {
    const auto bound = [&](int x, int y, float z) {
        if (z >= 0.0f) texels(x, y).bound(z);
    };
    return rasterize(mesh, light, clip(region, texels.size()), side, bound, where);
}

} // namespace gnomon::inline GNOMON_BUILD
