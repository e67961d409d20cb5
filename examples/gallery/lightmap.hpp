// gallery: precomputed light of the static world: key light with soft shadows, sky, torch; the casters have no part in it.
#pragma once

#include "ray_world.hpp"

namespace gallery {

/// The light on one quad, a texel about every 1/24 unit.
struct lightmap {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> light;

    /// Blended from four at (a, b) in [0, 1]^2.
    [[nodiscard]] glm::vec3 at(float a, float b) const noexcept;
};

/// What comes from the key light alone, shadowed by the static world, on a point with a normal. `turned` turns the sample pattern.
[[nodiscard]] glm::vec3 key_light_on(const scene& s, const ray_world& world, const glm::vec3& point, const glm::vec3& normal,
                                     int samples, float turned = 0.0f);

/// One lightmap for each quad of the scene.
[[nodiscard]] std::vector<lightmap> bake(const scene& s, const ray_world& world);

} // namespace gallery
