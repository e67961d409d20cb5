// gnomon: soft shadow maps. Triangles onto a map: casters into it, receivers as their far bound.
#pragma once

#include <gnomon/geometry/footprint.hpp>
#include <gnomon/geometry/scan.hpp>
#include <gnomon/texel/image.hpp>
#include <gnomon/texel/texel.hpp>

namespace gnomon {

/// Indexed triangles. A triangle with an index off the positions, or a corner that is not finite, is left out; so are one or two
/// indices too many at the end.
struct triangle_mesh {
    strided_span<const glm::vec3> positions; ///< from std::vector, std::span, or a field of an interleaved vertex buffer
    strided_span<const std::uint32_t> indices;
    glm::dmat4 model{1.0}; ///< from positions to the world; in double, because that is where a large world loses its texels
};

/// Which triangles take part, by the side they turn to the light. Counter-clockwise from outside, in the mesh's own space: a
/// mirroring model matrix does not turn it inside out. A triangle seen exactly edge-on counts as turned away.
enum class faces { both, towards_light, away_from_light };

/// The region without a limit, and the test that skips nothing.
inline constexpr texel_rect everywhere{-detail::int_max, -detail::int_max, detail::int_max, detail::int_max};
struct touches_everything {
    [[nodiscard]] constexpr bool operator()(texel_rect) const noexcept { return true; }
};

namespace detail {
/// A triangle as the planes of its three projected corners (x W, y W, z, W).
struct projected_triangle {
    glm::dvec4 corner[3];
    double facing = 0.0; ///< the sign of its area on the map, as if seen whole; homogeneous, so a corner may be behind the light
};

/// The depth of a triangle at any texel centre. On the map depth is affine for a directional light; for a spot light 1/W is, and
/// depth is affine in W. So one affine function is kept, of either. It is that of the corners before clipping and snapping.
class depth_surface {
  public:
    depth_surface(const projected_triangle& t, const light_frame& light, const glm::dvec4& reference) noexcept
        : near_w_(light.near_w()), per_w_(1.0 / (light.far_w() - light.near_w())), inverse_(light.perspective()) {
        // q = a x + b y + c at every corner; times W: a X + b Y + c W = Q, with Q = 1 or z. Solved about a corner, where q is c.
        x_ = reference.x / reference.w, y_ = reference.y / reference.w;
        c_ = inverse_ ? 1.0 / reference.w : reference.z;
        glm::dvec3 u[3], rest;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec4& h = t.corner[i];
            u[i] = {h.x - x_ * h.w, h.y - y_ * h.w, h.w};
            rest[i] = (inverse_ ? 1.0 : h.z) - c_ * h.w;
            nearest_ = i ? lesser(nearest_, h.z) : h.z, farthest_ = i ? greater(farthest_, h.z) : h.z;
        }
        const glm::dvec3 u12 = glm::cross(u[1], u[2]), u20 = glm::cross(u[2], u[0]), u01 = glm::cross(u[0], u[1]);
        const double det = glm::dot(u[0], u12);
        if (!(std::abs(det) > 0.0)) { // edge-on: the texels that snapping gives it, if any, get its nearest depth
            farthest_ = nearest_;
            return;
        }
        const glm::dvec3 abc = (rest[0] * u12 + rest[1] * u20 + rest[2] * u01) / det;
        a_ = abc.x, b_ = abc.y, c_ += abc.z;
    }

    /// Not beyond the corners' depths, whatever the slope: so a sliver, whose centre may lie 1/362 texel outside it, stays sane.
    [[nodiscard]] float operator()(int x, int y) const noexcept {
        const double q = a_ * (x + 0.5 - x_) + (b_ * (y + 0.5 - y_) + c_);
        double z = q;
        if (inverse_) z = q > 0.0 ? (1.0 / q - near_w_) * per_w_ : farthest_;
        return static_cast<float>(z > nearest_ ? (z < farthest_ ? z : farthest_) : nearest_);
    }

  private:
    double a_ = 0.0, b_ = 0.0, c_ = 0.0, x_ = 0.0, y_ = 0.0;
    double nearest_ = 0.0, farthest_ = 0.0;
    double near_w_, per_w_;
    bool inverse_;
};
} // namespace detail
} // namespace gnomon
