#include "soft.hpp"

#include "truth.hpp"

#include <gnomon/geometry/rasterize.hpp>
#include <gnomon/gnomon.hpp>

#include <algorithm>
#include <chrono>

namespace gallery {

namespace {

template <typename F> double median_nanoseconds(const F& f) {
    std::vector<double> times;
    for (int i = 0; i < 5; ++i) {
        const auto start = std::chrono::steady_clock::now();
        f();
        times.push_back(std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count());
    }
    std::nth_element(times.begin(), times.begin() + 2, times.end());
    return times[2];
}

/// The frame of a game, in full: this is all there is to it.
template <gnomon::texel_format Texel>
answer answer_in(const std::string& format, const std::string& bits, const scene& s, const variant& how, const mesh& m,
                 const gnomon::light_frame& frame, const receivers& points) {
    gnomon::soft_shadow_map<Texel, soft_kernel> map({.width = map_extent.width, .height = map_extent.height, .tile = tile_size});
    map.decision = gnomon::rule{.caster = {.towards = how.towards}};

    for (const caster& c : s.casters)
        map.cast([&](auto texels) {
            if constexpr (Texel::effects.translucency)
                return cast_triangles(texels, triangles(m, c), frame, c.opacity);
            else
                return cast_triangles(texels, triangles(m, c), frame);
        });
    if constexpr (Texel::effects.far_bound)
        map.bound([&](auto texels) {
            bound_triangles(texels, static_triangles(s).view(), frame, gnomon::faces::dark_side, map.tiles());
        });

    answer result{.format = format,
                  .bits = bits,
                  .bytes_per_texel = sizeof(Texel),
                  .tiles = map.tiles().tiles().count(),
                  .intensity = std::vector<float>(points.size())};
    const double texels = (std::max)(1.0, 1.0 * result.tiles * tile_size * tile_size),
                 receiving = (std::max)(1.0, static_cast<double>(points.size()));
    result.ns_per_texel = median_nanoseconds([&] { map.filter(); }) / texels;
    result.ns_per_receiver = median_nanoseconds([&] { map.receive(points.x, points.y, points.z, result.intensity); }) / receiving;
    return result;
}

template <gnomon::effects Effects>
std::vector<answer> in_all_formats(const std::string& channels, const scene& s, const variant& how, const mesh& m,
                                   const gnomon::light_frame& frame, const receivers& points) {
    using gnomon::depth_mask;
    return {answer_in<gnomon::texel<gnomon::unorm8, depth_mask, Effects>>(channels + "8", "8 bit", s, how, m, frame, points),
            answer_in<gnomon::texel<gnomon::unorm16, depth_mask, Effects>>(channels + "16", "16 bit", s, how, m, frame, points),
            answer_in<gnomon::texel<gnomon::half16, depth_mask, Effects>>(channels + "16f", "half", s, how, m, frame, points),
            answer_in<gnomon::texel<gnomon::float32, depth_mask, Effects>>(channels + "32f", "32 bit", s, how, m, frame, points)};
}

} // namespace

std::vector<answer> answers_of(const scene& s, const variant& how, const mesh& m, const gnomon::light_frame& frame,
                               const receivers& points) {
    using gnomon::effects;
    if (s.translucent) return in_all_formats<effects{.translucency = true}>("rga", s, how, m, frame, points);
    if (how.far_bound) return in_all_formats<effects{.far_bound = true}>("rgb", s, how, m, frame, points);
    return in_all_formats<effects{}>("rg", s, how, m, frame, points);
}

} // namespace gallery
