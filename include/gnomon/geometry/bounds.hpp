// gnomon: soft shadow maps. Bounding volumes in world space, in double so that a world far from its origin keeps its texels.
//
// Nothing that computes with GLM is constexpr here: it is not in GLM either, once a host has configured GLM for SIMD.
#pragma once

#include <glm/vec3.hpp>

namespace gnomon::inline GNOMON_BUILD {

/// A ball. A negative or NaN radius, or a NaN centre, is an empty one: it has no footprint and no fit includes it.
struct bounding_sphere {
    glm::dvec3 centre{0.0};
    double radius = 0.0;

    [[nodiscard]] bool empty() const noexcept {
        return !(radius >= 0.0 && centre.x <= centre.x && centre.y <= centre.y && centre.z <= centre.z);
    }
};

/// An axis-aligned box, corners included. Inverted or NaN corners are an empty one; equal corners are a point, a line or a sheet.
struct bounding_box {
    glm::dvec3 lower{0.0};
    glm::dvec3 upper{0.0};

    [[nodiscard]] bool empty() const noexcept { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
    /// Corner `i` of 8: bit 0, 1, 2 of `i` picks upper x, y, z.
    [[nodiscard]] glm::dvec3 corner(int i) const noexcept {
        return {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z};
    }
};

/// The smallest box around a ball; of an empty ball, an empty box.
[[nodiscard]] inline bounding_box box_around(const bounding_sphere& ball) noexcept {
    if (ball.empty()) return {glm::dvec3(1.0), glm::dvec3(0.0)};
    return {ball.centre - glm::dvec3(ball.radius), ball.centre + glm::dvec3(ball.radius)};
}

} // namespace gnomon::inline GNOMON_BUILD
