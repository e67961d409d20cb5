// gallery: gnomon at work: cast, bound, filter, receive, in every storage format; and what that costs.
#pragma once

#include "truth.hpp"

#include <gnomon/soft_shadow_map.hpp>

namespace gallery {

/// One map and one kernel for all scenes. With 8 texels to each side the penumbra is wide enough to be looked at.
using soft_kernel = gnomon::gaussian<8>;
inline constexpr const char* kernel_name = "gaussian<8>";
inline constexpr gnomon::extent map_extent{512, 512};
inline constexpr int tile_size = 16;

/// Casts a scene into a map, and bounds it where the map can be bounded.
template <gnomon::texel_format Texel, gnomon::kernel Kernel, typename Backend>
void cast_scene(gnomon::soft_shadow_map<Texel, Kernel, Backend>& map, const scene& s, const mesh& m,
                const gnomon::light_frame& frame) {
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
}

/// What gnomon answered in one storage format, and what it cost.
struct answer {
    std::string format;
    std::string bits; ///< for captions: "8 bit"
    int bytes_per_texel = 0;
    int tiles = 0;
    double ns_per_texel = 0.0;    ///< clear and filter, over the texels of the touched tiles; median of five
    double ns_per_receiver = 0.0; ///< decision with its blended sample; median of five
    std::vector<float> intensity; ///< one a receiver
};

/// In 8, 16, half and 32 bits, with the channels that scene and variant call for and no other.
[[nodiscard]] std::vector<answer> answers_of(const scene& s, const variant& how, const mesh& m, const gnomon::light_frame& frame,
                                             const receivers& points);

} // namespace gallery
