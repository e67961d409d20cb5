// gnomon: soft shadow maps. A dynamic shadow on light that was precomputed (Salzman 2007, "Integrating with Single-pass
// Lightmaps").
#pragma once

#include <gnomon/texel/image.hpp>

#include <limits>

namespace gnomon::inline GNOMON_BUILD {

/// What a shadow leaves of a lightmap's light: light - shadow * max(light - ambient, 0).
///
/// Never brighter than `light`, never below `ambient` unless the light already was: a place the lightmap shows dark is not darkened
/// twice. `shadow` is limited to [0, 1], NaN is no shadow; a NaN light or floor gives the light itself, and
/// so does an infinite one. Within 1 ulp of the formula.
[[nodiscard]] constexpr float mask_light(float light, float shadow, float ambient) noexcept {
    if (!(light > ambient && ambient >= std::numeric_limits<float>::lowest())) return light;
    const double l = static_cast<double>(light), share = static_cast<double>(saturate(shadow));
    const double left = l - share * l + share * static_cast<double>(ambient); // exact products, so fusing them changes nothing
    return greater(ambient, lesser(light, static_cast<float>(left)));
}

/// One colour channel of a lightmap, in place or not: result[i] = mask_light(light[i], shadow[i], ambient). The shortest span
/// counts.
inline void mask_light(strided_span<const float> light, strided_span<const float> shadow, float ambient,
                       strided_span<float> result) noexcept {
    const int count = lesser(light.size(), lesser(shadow.size(), result.size()));
    for (int i = 0; i < count; ++i) result[i] = mask_light(light[i], shadow[i], ambient);
}

} // namespace gnomon::inline GNOMON_BUILD
