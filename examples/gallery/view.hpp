// gallery: what the camera sees, and where each of its samples lies on the shadow map.
#pragma once

#include "lightmap.hpp"
#include "picture.hpp"

namespace gallery {

/// Points that receive, side by side: the layout in which gnomon takes them.
struct receivers {
    std::vector<float> x, y; ///< on the map, in texels
    std::vector<float> z;    ///< unit depth
    /// How the receiver's own surface goes on, in depth a texel, for casters that receive; 0 for the static world. The truth needs it.
    std::vector<float> slope_x, slope_y;

    [[nodiscard]] std::size_t size() const noexcept { return x.size(); }
};

/// One camera sample, ready to be lit: veil + through * colour * (what the shadow leaves of `light`).
struct sample {
    glm::vec3 colour{0.0f};
    glm::vec3 light{0.0f};
    glm::vec3 veil{0.0f}; ///< glass and distance in front
    float through = 1.0f; ///< how much they let through
    int receiver = -1;    ///< which receiver, or -1
};

inline constexpr int samples_per_pixel = 4;

struct view {
    int width = 0;
    int height = 0;
    std::vector<sample> samples; ///< samples_per_pixel a pixel, row by row
    receivers points;
};

/// Looks at a scene. Receivers are the samples on the map whose surface is turned to the light.
[[nodiscard]] view look(const scene& s, const ray_world& world, const std::vector<lightmap>& light,
                        const gnomon::light_frame& frame, int width);

/// The picture, with `intensity[i]` as the shadow on receiver i, taken off the precomputed light by gnomon::mask_light.
[[nodiscard]] picture shade(const view& v, const scene& s, const std::vector<float>& intensity);

/// Where the shadow differs from the truth, `factor` times too strong: blue too light, red too dark, over the scene in pale grey.
[[nodiscard]] picture shade_difference(const view& v, const scene& s, const std::vector<float>& intensity,
                                       const std::vector<float>& truth, float factor);

} // namespace gallery
