// gnomon: soft shadow maps. Triangles onto a map, in lanes: the texels of geometry/rasterize.hpp, bit for bit.
#pragma once

#include <gnomon/backend/simd.hpp>
#include <gnomon/geometry/raster_job.hpp>

#define GNOMON_ON on_any
#include <gnomon/geometry/raster_batch.hpp>
#include <gnomon/geometry/raster_rows.hpp>
#undef GNOMON_ON
#if GNOMON_X86
GNOMON_TARGET_BEGIN(GNOMON_AVX2)
#define GNOMON_ON on_avx2
#include <gnomon/geometry/raster_batch.hpp>
#include <gnomon/geometry/raster_rows.hpp>
#undef GNOMON_ON
GNOMON_TARGET_END
GNOMON_TARGET_BEGIN(GNOMON_AVX512)
#define GNOMON_ON on_avx512
#include <gnomon/geometry/raster_batch.hpp>
#include <gnomon/geometry/raster_rows.hpp>
#undef GNOMON_ON
GNOMON_TARGET_END
#endif

namespace gnomon::inline GNOMON_BUILD {

namespace detail {

/// Each target's code goes by its own name.
template <typename Isa> struct raster_on {
    using triangles = on_any::rasterizer<Isa>;
    using called = on_any::called_row<Isa>;
    template <typename Texel> using cast = on_any::cast_row<Isa, Texel>;
    template <typename Texel> using bound = on_any::bound_row<Isa, Texel>;
};
#if GNOMON_X86
template <> struct raster_on<avx2> {
    using triangles = on_avx2::rasterizer<avx2>;
    using called = on_avx2::called_row<avx2>;
    template <typename Texel> using cast = on_avx2::cast_row<avx2, Texel>;
    template <typename Texel> using bound = on_avx2::bound_row<avx2, Texel>;
};
template <> struct raster_on<avx512> {
    using triangles = on_avx512::rasterizer<avx512>;
    using called = on_avx512::called_row<avx512>;
    template <typename Texel> using cast = on_avx512::cast_row<avx512, Texel>;
    template <typename Texel> using bound = on_avx512::bound_row<avx512, Texel>;
};
#endif

/// The kinds of rows that triangles become, by their lanes.
struct calls {
    template <typename Lanes> using row = typename raster_on<Lanes>::called;
};
template <typename Texel> struct casts {
    template <typename Lanes> using row = typename raster_on<Lanes>::template cast<Texel>;
};
template <typename Texel> struct bounds {
    template <typename Lanes> using row = typename raster_on<Lanes>::template bound<Texel>;
};

/// f.template operator()<Lanes>() for the lanes that Isa names, or those of every such processor where this one lacks them.
template <typename Isa, typename F> auto for_lanes(F&& f) noexcept {
    if constexpr (std::same_as<Isa, best_isa>)
        return with_lanes(best_lanes(), f);
    else if constexpr (level_needed<Isa> == cpu_level::portable)
        return f.template operator()<Isa>();
    else
        return lanes_are_there<Isa>() ? f.template operator()<Isa>() : with_lanes(cpu_level::portable, f);
}

/// Are these texels encoded in lanes?
template <typename Isa, typename Texel>
inline constexpr bool cast_in_lanes = has_lanes<Isa> && channel_of_lanes<typename Texel::channel_type> &&
                                      std::same_as<typename Texel::representation_type, depth_mask>;

inline void draw_cut(const raster_job& job, int first, touched_texels& touched) {
    draw_triangle(*job.mesh, first, job.to_map, job.handedness, *job.light, job.target, job.side, job,
                  [&](const triangle_depth& depth, int y, int x0, int x1) { job.run(job, depth, y, x0, x1, touched); });
}

/// One mark, by the address of who takes it; null for nobody.
template <typename Marks> void (*mark_of())(void*, texel_rect, depth_interval) {
    if constexpr (std::same_as<std::remove_const_t<Marks>, marks_nothing>)
        return nullptr;
    else
        return [](void* marks, texel_rect r, depth_interval depth) { (*static_cast<Marks*>(marks))(r, depth); };
}

/// `Kind` of rows find in `rows` what they need; `row` is what they call, if they do.
template <typename Isa, typename Kind, typename Where, typename Marks>
light_footprint rasterize_rows(const triangle_mesh& mesh, const light_frame& light, texel_rect target, faces side,
                               const Where& where, Marks& marks, void* rows,
                               void (*row)(void*, int, int, int, const float*) = nullptr) {
    target = clip(target, light.size());
    if (target.empty()) return {};
    const glm::dmat4 to_map = product(light.matrix(), mesh.model);
    raster_job job{.mesh = &mesh,
                   .light = &light,
                   .to_map = to_map,
                   .handedness = volume(to_map),
                   .perspective = light.perspective(),
                   .divides = detail::row(to_map, 3) != glm::dvec4(0.0, 0.0, 0.0, 1.0),
                   .near_w = light.near_w(),
                   .per_w = depth_surface::per_w(light),
                   .target = target,
                   .side = side,
                   .row = row,
                   .rows = rows,
                   .touches = nullptr,
                   .where = &where,
                   .mark = mark_of<Marks>(),
                   .marks = const_cast<std::remove_const_t<Marks>*>(&marks), // as const as it was when it is called
                   .cut = draw_cut,
                   .run = nullptr};
    if constexpr (!std::same_as<Where, touches_everything>)
        job.touches = [](const void* place, texel_rect r) { return touches(*static_cast<const Where*>(place), r); };
    const auto draw = for_lanes<Isa>([&job]<typename Lanes>() {
        using triangles = typename raster_on<Lanes>::triangles;
        using row_kind = typename Kind::template row<Lanes>;
        job.run = triangles::template draw_run<row_kind>;
        return &triangles::template run<row_kind>;
    });
    return draw(job);
}

/// Calls `sink` texel by texel.
template <typename Isa, typename Sink, typename Where, typename Marks>
light_footprint rasterize_on(const triangle_mesh& mesh, const light_frame& light, texel_rect target, faces side, Sink& sink,
                             const Where& where, Marks& marks) {
    if constexpr (has_lanes<Isa>) {
        const auto row = [](void* object, int y, int x0, int x1, const float* z) {
            for (int x = x0; x < x1; ++x) (**static_cast<Sink**>(object))(x, y, z[x - x0]);
        };
        Sink* object = &sink;
        return rasterize_rows<Isa, calls>(mesh, light, target, side, where, marks, &object, row);
    } else {
        return rasterize_and_mark(mesh, light, target, side, sink, where, marks);
    }
}

} // namespace detail

/// rasterize of geometry/rasterize.hpp in lanes: the same texels at the same depths in the same order, bit for bit where
/// multiply-adds are not fused, as geometry/ asks for everywhere. `sink` is called texel by texel, so for speed it has to be light.
///
/// Triangles are set up, a lane for each, and cut into runs of texels; depths are computed, a lane for each column. What planes cut, is
/// seen edge-on, or is longer than 4096 texels is set up by the scalar code. Nothing is allocated; 12 kB of the stack are used.
template <typename Isa, typename Sink, marked_texels Where = touches_everything>
    requires requires(Sink& sink, int i, float depth) { sink(i, i, depth); }
light_footprint rasterize(simd<Isa>, const triangle_mesh& mesh, const light_frame& light, texel_rect target, faces side,
                          Sink&& sink, const Where& where = {}) {
    marks_nothing nothing;
    return detail::rasterize_on<Isa>(mesh, light, target, side, sink, where, nothing);
}

namespace detail {
/// Casts copies of `caster` at the depths of the triangles.
template <typename Isa, texel_format Texel, typename Marks>
light_footprint cast_copies(image_view<Texel> texels, const triangle_mesh& mesh, const light_frame& light, faces side, Texel caster,
                            Marks& marks) {
    if constexpr (cast_in_lanes<Isa, Texel>) {
        texel_target<Texel> target{texels, caster};
        return rasterize_rows<Isa, casts<Texel>>(mesh, light, whole(texels.size()), side, touches_everything{}, marks, &target);
    } else {
        const auto cast = [texels, caster](int x, int y, float s) {
            Texel here = caster;
            here.stored[Texel::depth_index] = Texel::caster(s).stored[Texel::depth_index];
            texels(x, y).cast(here);
        };
        return rasterize_on<Isa>(mesh, light, whole(texels.size()), side, cast, touches_everything{}, marks);
    }
}
} // namespace detail

/// cast_triangles of geometry/rasterize.hpp in lanes, bit for bit: cast_triangles(simd<>{}, texels, mesh, light).
template <typename Isa, texel_format Texel, takes_marks Marks = marks_nothing>
light_footprint cast_triangles(simd<Isa>, image_view<Texel> texels, const triangle_mesh& mesh, const light_frame& light,
                               faces side = faces::both, Marks&& marks = {}) {
    return detail::cast_copies<Isa>(texels, mesh, light, side, Texel::caster(0.0f), marks);
}

/// The same for casters that let 1 - `opacity` of the light through.
template <typename Isa, texel_format Texel, takes_marks Marks = marks_nothing>
    requires(Texel::effects.translucency)
light_footprint cast_triangles(simd<Isa>, image_view<Texel> texels, const triangle_mesh& mesh, const light_frame& light,
                               float opacity, faces side = faces::both, Marks&& marks = {}) {
    return detail::cast_copies<Isa>(texels, mesh, light, side, Texel::caster(0.0f, opacity), marks);
}

/// bound_triangles of geometry/rasterize.hpp in lanes, bit for bit.
template <typename Isa, texel_format Texel, marked_texels Where = touches_everything>
    requires(Texel::effects.far_bound)
light_footprint bound_triangles(simd<Isa> run, image_view<Texel> texels, const triangle_mesh& mesh, const light_frame& light,
                                faces side = faces::both, const Where& where = {}, texel_rect region = everywhere) {
    if constexpr (detail::cast_in_lanes<Isa, Texel>) {
        detail::texel_target<Texel> target{texels, Texel::clear()};
        marks_nothing nothing;
        return detail::rasterize_rows<Isa, detail::bounds<Texel>>(mesh, light, clip(region, texels.size()), side, where, nothing,
                                                                  &target);
    } else {
        const auto bound = [&](int x, int y, float z) {
            if (z >= 0.0f) texels(x, y).bound(z);
        };
        return rasterize(run, mesh, light, clip(region, texels.size()), side, bound, where);
    }
}

/// @name The plain loops, for code that is given a backend: cast_triangles(scalar{}, texels, mesh, light).
/// @{
template <typename Sink, marked_texels Where = touches_everything>
    requires requires(Sink& sink, int i, float depth) { sink(i, i, depth); }
light_footprint rasterize(scalar, const triangle_mesh& mesh, const light_frame& light, texel_rect target, faces side, Sink&& sink,
                          const Where& where = {}) {
    return rasterize(mesh, light, target, side, sink, where);
}
template <texel_format Texel, takes_marks Marks = marks_nothing>
light_footprint cast_triangles(scalar, image_view<Texel> texels, const triangle_mesh& mesh, const light_frame& light,
                               faces side = faces::both, Marks&& marks = {}) {
    return cast_triangles(texels, mesh, light, side, marks);
}
template <texel_format Texel, takes_marks Marks = marks_nothing>
    requires(Texel::effects.translucency)
light_footprint cast_triangles(scalar, image_view<Texel> texels, const triangle_mesh& mesh, const light_frame& light, float opacity,
                               faces side = faces::both, Marks&& marks = {}) {
    return cast_triangles(texels, mesh, light, opacity, side, marks);
}
template <texel_format Texel, marked_texels Where = touches_everything>
    requires(Texel::effects.far_bound)
light_footprint bound_triangles(scalar, image_view<Texel> texels, const triangle_mesh& mesh, const light_frame& light,
                                faces side = faces::both, const Where& where = {}, texel_rect region = everywhere) {
    return bound_triangles(texels, mesh, light, side, where, region);
}
/// @}

} // namespace gnomon::inline GNOMON_BUILD
