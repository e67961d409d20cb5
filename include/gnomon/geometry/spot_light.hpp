// gnomon: soft shadow maps. A light with a position and a cone.
#pragma once

#include <gnomon/geometry/light_frame.hpp>

namespace gnomon::inline GNOMON_BUILD {

/// A cone of light. Its depth is the distance along the axis, linear: (distance - near_plane) / (far_plane - near_plane).
struct spot_light {
    glm::dvec3 position{0.0};
    glm::dvec3 direction{0.0, 0.0, -1.0}; ///< of any length but zero
    double outer_angle = 0.5;             ///< from the axis to the edge of the cone, in radians, in (0, pi/2)
    double near_plane = 0.1;              ///< distance along the axis, above 0; casters nearer than this are cut off
    double far_plane = 100.0;             ///< above near_plane; casters beyond count as on it
    glm::dvec3 up{0.0, 1.0, 0.0};         ///< appears as +y on the map; see detail::light_axes for when it cannot

    /// The frame that holds the whole cone, and `margin` texels around it for the kernel. Square texels: on a map that is not
    /// square the cone spans the shorter side. Invalid where a field is outside its range.
    [[nodiscard]] light_frame frame(extent size, int margin = 0) const noexcept {
        constexpr double right_angle = 1.5707963267948966;
        const double radius = 0.5 * lesser(size.width, size.height) - greater(margin, 0);
        const bool cone = outer_angle > 0.0 && outer_angle < right_angle;
        if (!cone || !(radius > 0.0)) return {};
        const detail::light_axes axes(direction, up);
        const double focal = radius / std::tan(outer_angle);
        const glm::dvec4 w = through_position(axes.forward), at_near(0.0, 0.0, 0.0, near_plane);
        return {detail::from_rows(through_position(axes.right) * focal + w * (0.5 * size.width),
                                  through_position(axes.upward) * focal + w * (0.5 * size.height),
                                  (w - at_near) / (far_plane - near_plane), w),
                size, near_plane, far_plane};
    }

  private:
    /// The plane through the light across `axis`.
    [[nodiscard]] glm::dvec4 through_position(const glm::dvec3& axis) const noexcept { return {axis, -glm::dot(axis, position)}; }
};

} // namespace gnomon::inline GNOMON_BUILD
