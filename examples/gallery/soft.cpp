#include "soft.hpp"

#include "formats.hpp"

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
answer answer_in(const format_name& name, const scene& s, const variant& how, const mesh& m, const gnomon::light_frame& frame,
                 const receivers& points) {
    gnomon::soft_shadow_map<Texel, soft_kernel> map({.width = map_extent.width, .height = map_extent.height, .tile = tile_size});
    map.decision = gnomon::rule{.caster = {.towards = how.towards}};

    cast_scene(map, s, m, frame);

    answer result{.format = name.texel,
                  .bits = name.bits,
                  .bytes_per_texel = sizeof(Texel),
                  .tiles = map.tiles().tiles().count(),
                  .intensity = std::vector<float>(points.size())};
    const double texels = (std::max)(1.0, 1.0 * result.tiles * tile_size * tile_size),
                 receiving = (std::max)(1.0, static_cast<double>(points.size()));
    result.ns_per_texel = median_nanoseconds([&] { map.filter(); }) / texels;
    result.ns_per_receiver = median_nanoseconds([&] { map.receive(points.x, points.y, points.z, result.intensity); }) / receiving;
    return result;
}

} // namespace

std::vector<answer> answers_of(const scene& s, const variant& how, const mesh& m, const gnomon::light_frame& frame,
                               const receivers& points) {
    std::vector<answer> answers;
    for_each_format(s, how, [&]<typename Texel>(const format_name& name) {
        answers.push_back(answer_in<Texel>(name, s, how, m, frame, points));
    });
    return answers;
}

} // namespace gallery
