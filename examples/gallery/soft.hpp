// gallery: gnomon at work: cast, bound, filter, receive, in every storage format; and what that costs.
#pragma once

#include "view.hpp"

#include <gnomon/filter/kernel.hpp>

namespace gallery {

/// One map and one kernel for all scenes. With 8 texels to each side the penumbra is wide enough to be looked at.
using soft_kernel = gnomon::gaussian<8>;
inline constexpr const char* kernel_name = "gaussian<8>";
inline constexpr gnomon::extent map_extent{512, 512};
inline constexpr int tile_size = 16;

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
