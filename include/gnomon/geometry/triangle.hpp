// gnomon: soft shadow maps. One triangle on its way to texels: its corners on the map, what is cut off them, and its plane of depths.
#pragma once

#include <gnomon/geometry/light_frame.hpp>
#include <gnomon/geometry/scan.hpp>
#include <gnomon/simd/region.hpp>
#include <gnomon/texel/channel.hpp>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <limits>

namespace gnomon::inline GNOMON_BUILD::detail {

/// A convex polygon of projected corners (x W, y W, z, W).
struct projected_polygon {
    glm::dvec4 corner[most_corners];
    int count = 0;

    [[nodiscard]] const glm::dvec4* begin() const noexcept { return corner; }
    [[nodiscard]] const glm::dvec4* end() const noexcept { return corner + count; }

    void add(const glm::dvec4& h) noexcept { corner[count++] = h; }

    /// Cuts off what is below `plane`. A cut edge is always computed from its kept end, so both its triangles get the same corner.
    void keep_above(const glm::dvec4& plane) noexcept {
        double height[most_corners]{};
        int seen = 0;
        bool whole = true;
        for (const glm::dvec4& h : *this) whole = (height[seen++] = glm::dot(plane, h)) >= 0.0 && whole;
        if (whole) return;
        const projected_polygon uncut = *this;
        count = 0;
        for (int i = 0; i < uncut.count; ++i) {
            const int next = i + 1 < uncut.count ? i + 1 : 0;
            const bool here = height[i] >= 0.0, there = height[next] >= 0.0;
            if (here) add(uncut.corner[i]);
            if (here == there) continue;
            const int in = here ? i : next, out = here ? next : i;
            add(uncut.corner[in] + (uncut.corner[out] - uncut.corner[in]) * (height[in] / (height[in] - height[out])));
        }
    }

    /// Its corners on the map, snapped. False if nothing is left to draw, or if a corner was not finite: such a one is above no
    /// plane, so it has been cut off, and the cut has left NaN in W.
    [[nodiscard]] bool snap(fixed_point* snapped) const noexcept {
        for (const glm::dvec4& h : *this) {
            if (!(h.w > 0.0)) return false;
            *snapped++ = fixed_point::nearest(h.x / h.w, h.y / h.w);
        }
        return count >= 3;
    }

    /// Cuts off what a spot light's near plane hides, and what is farther off the map than fixed_point can say.
    void keep_drawable(bool near_plane_cuts) noexcept {
        constexpr double reach = fixed_point::reach;
        bool uncut = true; // and that most are, the half of this octahedron tells sooner
        for (const glm::dvec4& h : *this)
            uncut = reach * h.w - std::abs(h.x) - (std::abs(h.y) + h.z * 0.0) > 0.0 && (!near_plane_cuts || h.z > 0.0) && uncut;
        if (uncut) return;
        if (near_plane_cuts) keep_above({0.0, 0.0, 1.0, 0.0});
        keep_above({1.0, 0.0, 0.0, reach});
        keep_above({-1.0, 0.0, 0.0, reach});
        keep_above({0.0, 1.0, 0.0, reach});
        keep_above({0.0, -1.0, 0.0, reach});
    }
};

/// The depth of a triangle at any texel centre. On the map depth is affine for a directional light; for a spot light 1/W is, and
/// depth is affine in W. So one affine function is kept, of either: q = a (x - x_0) + b (y - y_0) + c.
struct triangle_depth {
    bool inverse;
    double near_w, per_w;
    double x, y; ///< (x_0, y_0)
    double a, b, c;
    double nearest, farthest; ///< of the corners

    /// Never outside the corners' depths: so a steep triangle, whose texel may lie 1/362 texel outside it, does not shoot off.
    [[nodiscard]] float operator()(int column, int row) const noexcept {
        const double q = a * (column + 0.5 - x) + (b * (row + 0.5 - y) + c);
        const double z = !inverse ? q : (q > 0.0 ? (1.0 / q - near_w) * per_w : farthest);
        return float32::store(z > nearest ? (z < farthest ? z : farthest) : nearest);
    }
};

/// The plane of a triangle, from its corners as they were before clipping and snapping.
class depth_surface {
  public:
    /// `corner` are the three corners; `reference` is any visible point of the triangle, about which it is solved.
    depth_surface(const glm::dvec4* corner, const glm::dvec4& reference, const light_frame& light) noexcept
        : depth_{.inverse = light.perspective(),
                 .near_w = light.near_w(),
                 .per_w = per_w(light),
                 .x = reference.x / reference.w,
                 .y = reference.y / reference.w,
                 .a = 0.0,
                 .b = 0.0,
                 .c = light.perspective() ? 1.0 / reference.w : reference.z,
                 .nearest = std::numeric_limits<double>::infinity(),
                 .farthest = -std::numeric_limits<double>::infinity()} {
        // q = a x + b y + c at every corner; times W: a X + b Y + c W = Q, where Q is 1 or z. (Olano and Greer, "Triangle scan
        // conversion using 2D homogeneous coordinates", 1997; a corner behind the light needs no care.)
        glm::dvec3 u[3], rest;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec4& h = corner[i];
            u[i] = {h.x - depth_.x * h.w, h.y - depth_.y * h.w, h.w};
            rest[i] = (depth_.inverse ? 1.0 : h.z) - depth_.c * h.w;
            depth_.nearest = lesser(depth_.nearest, h.z);
            depth_.farthest = greater(depth_.farthest, h.z);
        }
        const glm::dvec3 u01 = glm::cross(u[0], u[1]), u12 = glm::cross(u[1], u[2]), u20 = glm::cross(u[2], u[0]);
        area_ = glm::dot(u[0], u12);
        if (!(std::abs(area_) > 0.0)) return; // edge-on: a texel that snapping still gives it has the depth of the reference
        const glm::dvec3 abc = (rest[0] * u12 + rest[1] * u20 + rest[2] * u01) / area_;
        depth_.a = abc.x;
        depth_.b = abc.y;
        depth_.c += abc.z;
    }

    /// Depth per W of a spot light, 0 of a directional one.
    [[nodiscard]] static double per_w(const light_frame& light) noexcept {
        return light.perspective() ? 1.0 / (light.far_w() - light.near_w()) : 0.0;
    }
    /// Positive for corners that turn from x to y on the map.
    [[nodiscard]] double area() const noexcept { return area_; }
    [[nodiscard]] const triangle_depth& depth() const noexcept { return depth_; }

  private:
    triangle_depth depth_;
    double area_{};
};

/// A corner on the map. Each product is rounded before it is added, for a compiler that fuses the two: the lanes, which never do, have
/// the same corner then, and edges that they share with what is drawn here leave no gap.
[[nodiscard]] inline glm::dvec4 project(const glm::dmat4& to_map, const glm::dvec3& p) noexcept {
    const auto times = [](double a, double b) {
        double product = a * b;
        GNOMON_SETTLE(product);
        return product;
    };
    glm::dvec4 corner;
    for (int r = 0; r < 4; ++r)
        corner[r] = (times(to_map[0][r], p.x) + times(to_map[1][r], p.y)) + (times(to_map[2][r], p.z) + to_map[3][r]);
    return corner;
}

} // namespace gnomon::inline GNOMON_BUILD::detail
