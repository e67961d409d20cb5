// gnomon: soft shadow maps. Triangles onto a map, in lanes: the texels of geometry/rasterize.hpp, bit for bit.
#pragma once

#include <gnomon/backend/simd.hpp>
#include <gnomon/geometry/raster_job.hpp>

#define GNOMON_ON on_any
#include <gnomon/geometry/rasterize_rows.hpp>
#undef GNOMON_ON
#if GNOMON_X86
GNOMON_TARGET_BEGIN(GNOMON_AVX2)
#define GNOMON_ON on_avx2
#include <gnomon/geometry/rasterize_rows.hpp>
#undef GNOMON_ON
GNOMON_TARGET_END
GNOMON_TARGET_BEGIN(GNOMON_AVX512)
#define GNOMON_ON on_avx512
#include <gnomon/geometry/rasterize_rows.hpp>
#undef GNOMON_ON
GNOMON_TARGET_END
#endif

namespace gnomon {

namespace detail {

/// Each target's code goes by its own name.
template <typename Isa> struct raster_on {
    using triangles = on_any::rasterizer<Isa>;
    template <typename Texel> using row = on_any::row_of_texels<Isa, Texel>;
};
#if GNOMON_X86
template <> struct raster_on<avx2> {
    using triangles = on_avx2::rasterizer<avx2>;
    template <typename Texel> using row = on_avx2::row_of_texels<avx2, Texel>;
};
template <> struct raster_on<avx512> {
    using triangles = on_avx512::rasterizer<avx512>;
    template <typename Texel> using row = on_avx512::row_of_texels<avx512, Texel>;
};
#endif

/// f.template operator()<Lanes>() for the lanes that Isa names.
template <typename Isa, typename F> auto for_lanes(F&& f) noexcept {
    if constexpr (std::same_as<Isa, best_isa>)
        return with_lanes(best_lanes(), f);
    else
        return f.template operator()<Isa>();
}

/// Are these texels encoded in lanes?
template <typename Isa, typename Texel>
inline constexpr bool cast_in_lanes = has_lanes<Isa> && channel_of_lanes<typename Texel::channel_type> &&
                                      std::same_as<typename Texel::representation_type, depth_mask>;

inline void draw_cut(const raster_job& job, int first, light_footprint& touched) {
    draw_triangle(*job.mesh, first, job.to_map, job.handedness, *job.light, job.target, job.side, job,
                  [&](const triangle_depth& depth, int y, int x0, int x1) { job.run(job, depth, y, x0, x1, touched); });
}

/// `row` is called with `rows` for every piece of a row.
template <typename Isa, typename Where>
light_footprint rasterize_rows(const triangle_mesh& mesh, const light_frame& light, texel_rect target, faces side,
                               void (*row)(void*, int, int, int, const float*), void* rows, const Where& where) {
    target = clip(target, light.size());
    if (target.empty()) return {};
    const glm::dmat4 to_map = light.matrix() * mesh.model;
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
                   .cut = draw_cut,
                   .run = nullptr};
    if constexpr (!std::same_as<Where, touches_everything>)
        job.touches = [](const void* marks, texel_rect r) { return touches(*static_cast<const Where*>(marks), r); };
    const auto draw = for_lanes<Isa>([&job]<typename Lanes>() {
        job.run = raster_on<Lanes>::triangles::draw_run;
        return &raster_on<Lanes>::triangles::run;
    });
    return draw(job);
}

} // namespace detail

/// rasterize of geometry/rasterize.hpp in lanes: the same texels at the same depths in the same order, bit for bit.
template <typename Isa, typename Sink, marked_texels Where = touches_everything>
    requires requires(Sink& sink, int i, float depth) { sink(i, i, depth); }
light_footprint rasterize(simd<Isa>, const triangle_mesh& mesh, const light_frame& light, texel_rect target, faces side,
                          Sink&& sink, const Where& where = {}) {
    if constexpr (detail::has_lanes<Isa>) {
        using sink_type = std::remove_reference_t<Sink>;
        const auto row = [](void* object, int y, int x0, int x1, const float* z) {
            for (int x = x0; x < x1; ++x) (**static_cast<sink_type**>(object))(x, y, z[x - x0]);
        };
        sink_type* object = &sink;
        return detail::rasterize_rows<Isa>(mesh, light, target, side, row, &object, where);
    } else {
        return rasterize(mesh, light, target, side, sink, where);
    }
}

/// cast_triangles of geometry/rasterize.hpp in lanes, bit for bit: cast_triangles(simd<>{}, texels, mesh, light).
template <typename Isa, texel_format Texel>
light_footprint cast_triangles(simd<Isa> run, image_view<Texel> texels, const triangle_mesh& mesh, const light_frame& light,
                               faces side = faces::both) {
    if constexpr (detail::cast_in_lanes<Isa, Texel>) {
        detail::texel_target<Texel> target{texels, Texel::caster(0.0f)};
        const auto row = detail::for_lanes<Isa>([]<typename Lanes>() { return &detail::raster_on<Lanes>::template row<Texel>::cast; });
        return detail::rasterize_rows<Isa>(mesh, light, whole(texels.size()), side, row, &target, touches_everything{});
    } else {
        return rasterize(run, mesh, light, whole(texels.size()), side,
                         [&](int x, int y, float s) { texels(x, y).cast(Texel::caster(s)); });
    }
}

/// The same for casters that let 1 - `opacity` of the light through.
template <typename Isa, texel_format Texel>
    requires(Texel::effects.translucency)
light_footprint cast_triangles(simd<Isa> run, image_view<Texel> texels, const triangle_mesh& mesh, const light_frame& light,
                               float opacity, faces side = faces::both) {
    if constexpr (detail::cast_in_lanes<Isa, Texel>) {
        detail::texel_target<Texel> target{texels, Texel::caster(0.0f, opacity)};
        const auto row = detail::for_lanes<Isa>([]<typename Lanes>() { return &detail::raster_on<Lanes>::template row<Texel>::cast; });
        return detail::rasterize_rows<Isa>(mesh, light, whole(texels.size()), side, row, &target, touches_everything{});
    } else {
        return rasterize(run, mesh, light, whole(texels.size()), side,
                         [&](int x, int y, float s) { texels(x, y).cast(Texel::caster(s, opacity)); });
    }
}

/// bound_triangles of geometry/rasterize.hpp in lanes, bit for bit.
template <typename Isa, texel_format Texel, marked_texels Where = touches_everything>
    requires(Texel::effects.far_bound)
light_footprint bound_triangles(simd<Isa> run, image_view<Texel> texels, const triangle_mesh& mesh, const light_frame& light,
                                faces side = faces::both, const Where& where = {}, texel_rect region = everywhere) {
    if constexpr (detail::cast_in_lanes<Isa, Texel>) {
        detail::texel_target<Texel> target{texels, Texel::clear()};
        const auto row = detail::for_lanes<Isa>([]<typename Lanes>() { return &detail::raster_on<Lanes>::template row<Texel>::bound; });
        return detail::rasterize_rows<Isa>(mesh, light, clip(region, texels.size()), side, row, &target, where);
    } else {
        const auto bound = [&](int x, int y, float z) {
            if (z >= 0.0f) texels(x, y).bound(z);
        };
        return rasterize(run, mesh, light, clip(region, texels.size()), side, bound, where);
    }
}

} // namespace gnomon
