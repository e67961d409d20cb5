// gl_headless: the same scene by the CPU and by GL, and what differs between them, stage by stage.
#pragma once

#include "gpu_scene.hpp"

#include <gallery/formats.hpp>
#include <gallery/failure.hpp>
#include <gallery/soft.hpp>

#include <algorithm>
#include <cmath>

namespace gl_headless {

/// How many numbers of a list differ, and by how much at most.
struct differing {
    long long count = 0;
    double largest = 0.0;

    void add(double a, double b) noexcept {
        count += a < b || b < a ? 1 : 0;
        largest = (std::max)(largest, std::abs(a - b));
    }
};

/// What became of one scene in one format. Texels are compared by all their codes, depths and intensities on their scale of 0 to 1.
struct comparison {
    gallery::format_name name;
    std::string missing = {}; ///< why this context has no such map; then all else is empty
    long long casters = 0;
    long long edge_texels = 0;             ///< that one rasteriser covers and the other does not
    differing depths = {}, bounds = {};    ///< of texels that both cover
    long long filtered = 0;                ///< texels of the soft maps that differ, since their casters do
    long long filtered_alike = 0;          ///< the same, where GL was given the CPU's casters
    differing received = {};               ///< intensities, since the soft maps differ
    differing received_alike = {};         ///< the same, where GL was given the CPU's soft map
    long long decided_otherwise = 0;       ///< of these: shadowed on one side, and lit on the other
    std::vector<float> cpu = {}, gpu = {}; ///< intensities, one a receiver
};

template <gnomon::texel_format Texel>
void compare_casters(gnomon::image_view<const Texel> cpu, gnomon::image_view<const Texel> gpu, comparison& to) {
    constexpr double scale = gnomon::filtered<Texel>::scale;
    const auto channel = [](const Texel& t, int i) { return t.template linear<double>(i) / scale; };
    for (int y = 0; y < cpu.height(); ++y)
        for (int x = 0; x < cpu.width(); ++x) {
            const Texel &a = cpu(x, y), &b = gpu(x, y);
            const double mask_a = channel(a, Texel::mask_index), mask_b = channel(b, Texel::mask_index);
            to.casters += mask_a > 0.0 ? 1 : 0;
            if (std::abs(mask_a - mask_b) > 0.0) {
                ++to.edge_texels;
                continue;
            }
            const auto add = [&](differing& by, int i) { by.add(channel(a, i), channel(b, i)); };
            add(to.depths, Texel::depth_index);
            if constexpr (Texel::effects.far_bound) add(to.bounds, Texel::far_index);
        }
}

template <gnomon::texel_format Texel>
[[nodiscard]] long long texels_differing(gnomon::image_view<const Texel> a, gnomon::image_view<const Texel> b) {
    long long count = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) count += a(x, y) == b(x, y) ? 0 : 1;
    return count;
}

[[nodiscard]] inline differing intensities_differing(const std::vector<float>& a, const std::vector<float>& b) {
    differing all;
    for (std::size_t i = 0; i < a.size(); ++i) all.add(static_cast<double>(a[i]), static_cast<double>(b[i]));
    return all;
}

inline void need(const gl::problem& none) {
    if (none) throw gallery::failure(none.sentence);
}

/// Draws a scene on both sides and compares. The CPU filters as GL does: floats and halves in single precision (gl::kernel_in_gl).
template <gnomon::texel_format Texel>
comparison compare(const gallery::format_name& name, const gl::backend& run, const gpu_scene& on_gpu, const gallery::scene& s,
                   const gallery::variant& how, const gallery::mesh& m, const gnomon::light_frame& frame,
                   const gallery::receivers& points) {
    using kernel = gallery::soft_kernel;
    using kernel_here = gl::kernel_in_gl<Texel, kernel>;
    constexpr gnomon::map_size size{
        .width = gallery::map_extent.width, .height = gallery::map_extent.height, .tile = gallery::tile_size};
    comparison result{.name = name};
    gnomon::soft_shadow_map<Texel, kernel, gl::backend> there(size, run);
    if (there.problem()) {
        result.missing = there.problem().sentence;
        return result;
    }
    gnomon::soft_shadow_map<Texel, kernel_here, gnomon::scalar> here(size);
    here.decision.caster.towards = there.decision.caster.towards = how.towards;

    cast_scene(here, s, m, frame);
    on_gpu.cast_into(there, caster_programs<Texel>(run.context()));
    gnomon::image<Texel> read(here.size());
    gl::texel_reader<Texel> reader(here.size());
    {
        const unsigned casters = there.caster_framebuffer();
        const gl::state_guard guard(run.context());
        reader.read(run.context(), casters, read.view(), whole(here.size()));
    }
    compare_casters<Texel>(gnomon::image_view<const Texel>(here.casters()), std::as_const(read).view(), result);

    here.filter();
    there.filter();
    result.filtered = texels_differing(here.soft(), there.soft());
    gnomon::image<Texel> alike(here.size(), Texel::clear());
    gnomon::filter_scratch<Texel, kernel> unused(here.size().width);
    filter(run, here.casters(), alike.view(), here.tiles(), unused);
    result.filtered_alike = texels_differing(here.soft(), std::as_const(alike).view());

    need(run.problem());
    const auto receive_by = [&](const auto& by, gnomon::image_view<const Texel> soft) {
        std::vector<float> intensity(points.size());
        receive(by, soft, points.x, points.y, gnomon::strided_span<const float>(points.z), gnomon::strided_span<float>(intensity),
                here.decision);
        return intensity;
    };
    result.cpu = receive_by(gnomon::scalar{}, here.soft());
    result.gpu = receive_by(run, there.soft());
    const std::vector<float> same_soft = receive_by(run, here.soft());
    need(run.problem());
    result.received = intensities_differing(result.cpu, result.gpu);
    result.received_alike = intensities_differing(result.cpu, same_soft);
    for (std::size_t i = 0; i < points.size(); ++i)
        result.decided_otherwise += (result.cpu[i] > 0.0f) != (same_soft[i] > 0.0f) ? 1 : 0;
    return result;
}

} // namespace gl_headless
