// gallery: the storage formats that a variant of a scene is drawn in.
#pragma once

#include "scene.hpp"

#include <gnomon/texel/texel.hpp>

#include <string>

namespace gallery {

/// How a format is called: "rg16f", and "half" in captions.
struct format_name {
    std::string texel, bits;
};

/// Calls f.operator()<Texel>(format_name) with texels of 8, 16, half and 32 bits.
template <gnomon::effects Effects, typename F> void in_all_formats(const std::string& channels, const F& f) {
    using gnomon::depth_mask;
    f.template operator()<gnomon::texel<gnomon::unorm8, depth_mask, Effects>>({channels + "8", "8 bit"});
    f.template operator()<gnomon::texel<gnomon::unorm16, depth_mask, Effects>>({channels + "16", "16 bit"});
    f.template operator()<gnomon::texel<gnomon::half16, depth_mask, Effects>>({channels + "16f", "half"});
    f.template operator()<gnomon::texel<gnomon::float32, depth_mask, Effects>>({channels + "32f", "32 bit"});
}

/// The same with the channels that scene and variant call for, and no other.
template <typename F> void for_each_format(const scene& s, const variant& how, const F& f) {
    using gnomon::effects;
    if (s.translucent) return in_all_formats<effects{.translucency = true}>("rga", f);
    if (how.far_bound) return in_all_formats<effects{.far_bound = true}>("rgb", f);
    in_all_formats<effects{}>("rg", f);
}

} // namespace gallery
