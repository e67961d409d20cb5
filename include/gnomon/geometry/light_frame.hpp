// gnomon: soft shadow maps. How a light sees the world: from a world position to a texel and a unit depth.
//
// A frame is one 4x4 matrix in double. It takes (p, 1) to (x W, y W, z, W): x and y in texels after the divide by W, and z
// already the unit depth. The depth is never divided: it is affine in p for a spot light too, which is what makes it linear in
// distance (an 8-bit step at half of a 0.1 m ... 100 m range is 0.39 m, against 98 m for the z / w of a projection matrix).
// A directional light has W = 1 everywhere; for a spot light W is the distance along its axis.
#pragma once

#include <gnomon/rect.hpp>
#include <gnomon/texel/depth_shear.hpp>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <initializer_list>
#include <limits>

namespace gnomon::inline GNOMON_BUILD {

/// Where the clip space of a graphics API has its near and far plane, after the divide by w.
enum class clip_depth {
    zero_to_one,      ///< Direct3D, Vulkan, Metal; OpenGL after glClipControl
    minus_one_to_one, ///< OpenGL
    one_to_zero,      ///< any of the first with reversed depth
};

/// What a projection matrix means. x and y run from -1 to 1 in all of them; they differ in depth and in which end row 0 is.
struct clip_space {
    clip_depth depth = clip_depth::minus_one_to_one;
    bool row_0_is_top = false; ///< false: row 0 of the map is at y = -1 (OpenGL, Vulkan); true: at y = +1 (Direct3D, Metal)
};

/// A world position as a light sees it. Behind a spot light, seen by an invalid frame, or NaN: all three are NaN. That composes:
/// a receiver at a NaN depth is lit, and a rectangle with NaN sides is empty.
struct map_point {
    double x = std::numeric_limits<double>::quiet_NaN();     ///< in texels; texel i covers [i, i+1)
    double y = std::numeric_limits<double>::quiet_NaN();     ///< in texels
    double depth = std::numeric_limits<double>::quiet_NaN(); ///< 0 at the near plane, 1 at the far plane, linear; not clamped

    [[nodiscard]] bool in_front() const noexcept { return !std::isnan(depth); }
};

namespace detail {
[[nodiscard]] inline glm::dvec4 row(const glm::dmat4& m, int i) noexcept { return {m[0][i], m[1][i], m[2][i], m[3][i]}; }

[[nodiscard]] inline glm::dmat4 from_rows(const glm::dvec4& a, const glm::dvec4& b, const glm::dvec4& c,
                                          const glm::dvec4& d) noexcept {
    return {a.x, b.x, c.x, d.x, a.y, b.y, c.y, d.y, a.z, b.z, c.z, d.z, a.w, b.w, c.w, d.w};
}

/// a * b, each summed in GLM's order. GLM's own are too long for compilers to inline, and their names would not tell a file's flags, as
/// <gnomon/build.hpp> wants it.
[[nodiscard]] inline glm::dvec4 product(const glm::dmat4& a, const glm::dvec4& b) noexcept {
    return (a[0] * b.x + a[1] * b.y) + (a[2] * b.z + a[3] * b.w);
}
[[nodiscard]] inline glm::dmat4 product(const glm::dmat4& a, const glm::dmat4& b) noexcept {
    const auto column = [&a](const glm::dvec4& v) { return a[0] * v.x + a[1] * v.y + a[2] * v.z + a[3] * v.w; };
    return {column(b[0]), column(b[1]), column(b[2]), column(b[3])};
}

/// Volume that the upper left 3x3 gives to the unit cube. Negative where x, y, z of the result are left-handed.
[[nodiscard]] inline double volume(const glm::dmat4& m) noexcept {
    return glm::dot(glm::cross(glm::dvec3(row(m, 0)), glm::dvec3(row(m, 1))), glm::dvec3(row(m, 2)));
}
} // namespace detail

/// How a light sees the world. Made by `directional_light`, by `spot_light`, or from an engine's own matrix.
///
/// Everything is computed in double, so a world 1e6 m from its origin is as good as any: below 1e-6 texel there (float would be off
/// by .85 texel), below 1e-3 texel at 1e9 m, in a map of 2048 texels over 200 m.
///
/// A degenerate light (no direction, no size, near plane not before far plane, NaN, a singular matrix, more than `largest_side`
/// texels) makes an invalid frame. Its matrix is all zero, so that W is 0 everywhere, and the one test for W > 0 that guards every
/// divide answers "behind the light": no map_point, empty footprints, nothing rasterised, everything lit.
class light_frame {
  public:
    static constexpr int largest_side = 1 << 20;

    light_frame() = default;

    /// From the matrix described on top of this header. `near_w` and `far_w` are W on the planes of depth 0 and 1: both 1 if
    /// affine.
    light_frame(const glm::dmat4& world_to_map, extent size, double near_w, double far_w) noexcept {
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < 4; ++k)
                if (!std::isfinite(world_to_map[i][k])) return;
        const bool planes = near_w > 0.0 && near_w <= far_w && std::isfinite(far_w);
        const bool sized = !size.empty() && size.width <= largest_side && size.height <= largest_side;
        if (!planes || !sized || !(std::abs(detail::volume(world_to_map)) > 0.0)) return;
        matrix_ = world_to_map;
        size_ = size;
        near_w_ = near_w;
        far_w_ = far_w;
    }

    /// From the matrix with which an engine draws its own shadow map, orthographic or perspective; see `clip_space`.
    ///
    /// The depth of a perspective matrix is made linear again. Its near and far plane are recovered from the matrix, and are as
    /// good as that is: with floats and far/near = 1e4 about 1e-3 of the range. Casters and receivers share whatever they come
    /// to. Invalid for a far plane at infinity, for oblique near planes, and for sheared or mirrored w.
    [[nodiscard]] static light_frame from_matrix(const glm::dmat4& world_to_clip, extent size, clip_space clip) noexcept;

    /// The same light with its depth range cut to where casters are, for both casters and receivers; see depth_shear, which does the
    /// same to depths. The interval is widened by 2^-23 on each side, because a rounded depth of the casters must not cut them off. An
    /// empty interval changes nothing; one that begins behind a spot light makes an invalid frame.
    [[nodiscard]] light_frame sheared(depth_interval casters) const noexcept;

    [[nodiscard]] bool valid() const noexcept { return far_w_ > 0.0; }
    [[nodiscard]] bool perspective() const noexcept { return near_w_ < far_w_; }
    [[nodiscard]] extent size() const noexcept { return size_; }
    /// From world (p, 1) to (x W, y W, depth, W).
    [[nodiscard]] const glm::dmat4& matrix() const noexcept { return matrix_; }
    /// W at depth 0 and at depth 1; equal to 1 for an affine frame, 0 for an invalid one.
    [[nodiscard]] double near_w() const noexcept { return near_w_; }
    [[nodiscard]] double far_w() const noexcept { return far_w_; }

    /// Where a world position falls on the map. Not clipped: the result may be off the map, nearer than 0 or beyond 1.
    [[nodiscard]] map_point to_map(const glm::dvec3& world) const noexcept {
        const glm::dvec4 h = detail::product(matrix_, glm::dvec4(world, 1.0));
        if (!(h.w > 0.0)) return {};
        return {h.x / h.w, h.y / h.w, h.z};
    }

    /// The matrix for a GPU: (p - origin, 1) to clip space. Pick `origin` near the casters and subtract it in double.
    ///
    /// For a spot light the clip depth is the usual hyperbolic one, good for the depth test; write `depth_plane` to the map.
    [[nodiscard]] glm::mat4 clip_matrix(clip_space clip, const glm::dvec3& origin = glm::dvec3(0.0)) const noexcept;

    /// The unit depth for a shader: dot(depth_plane, vec4(p - origin, 1)), for every kind of light.
    [[nodiscard]] glm::vec4 depth_plane(const glm::dvec3& origin = glm::dvec3(0.0)) const noexcept {
        return glm::vec4(rebased(2, origin));
    }

  private:
    [[nodiscard]] glm::dvec4 rebased(int i, const glm::dvec3& origin) const noexcept {
        const glm::dvec4 r = detail::row(matrix_, i);
        return {glm::dvec3(r), glm::dot(r, glm::dvec4(origin, 1.0))};
    }

    glm::dmat4 matrix_{0.0};
    extent size_{};
    double near_w_ = 0.0;
    double far_w_ = 0.0;
};

inline light_frame light_frame::sheared(depth_interval casters) const noexcept {
    if (casters.empty()) return *this;
    const float in_range = lesser(casters.nearest, 0.0f); // the light's own near plane stays where it is
    const depth_shear shear{{greater(casters.nearest - 0x1p-23f, in_range), casters.farthest + 0x1p-23f}};
    const double first = static_cast<double>(shear.nearest()), span = static_cast<double>(shear.span());
    const glm::dvec4 depth = (detail::row(matrix_, 2) - glm::dvec4(0.0, 0.0, 0.0, first)) / span;
    const double w_per_depth = far_w_ - near_w_;
    return {detail::from_rows(detail::row(matrix_, 0), detail::row(matrix_, 1), depth, detail::row(matrix_, 3)), size_,
            near_w_ + first * w_per_depth, near_w_ + (first + span) * w_per_depth};
}

inline glm::mat4 light_frame::clip_matrix(clip_space clip, const glm::dvec3& origin) const noexcept {
    if (!valid()) return glm::mat4(0.0f);
    const glm::dvec4 w = rebased(3, origin);
    const glm::dvec4 x = rebased(0, origin) * (2.0 / size_.width) - w;
    const glm::dvec4 y = rebased(1, origin) * (2.0 / size_.height) - w;
    const glm::dvec4 z = rebased(2, origin) * far_w_; // f (W - n) / (f - n): 0 on the near plane, W on the far plane
    const bool symmetric = clip.depth == clip_depth::minus_one_to_one, reversed = clip.depth == clip_depth::one_to_zero;
    return glm::mat4(detail::from_rows(x, clip.row_0_is_top ? -y : y, symmetric ? z * 2.0 - w : (reversed ? w - z : z), w));
}

inline light_frame light_frame::from_matrix(const glm::dmat4& world_to_clip, extent size, clip_space clip) noexcept {
    glm::dvec4 w = detail::row(world_to_clip, 3), z = detail::row(world_to_clip, 2);
    if (clip.depth == clip_depth::minus_one_to_one) z = (z + w) * 0.5;
    if (clip.depth == clip_depth::one_to_zero) z = w - z;
    glm::dvec4 x = (w + detail::row(world_to_clip, 0)) * (0.5 * size.width);
    const glm::dvec4 row_y = detail::row(world_to_clip, 1);
    glm::dvec4 y = (clip.row_0_is_top ? w - row_y : w + row_y) * (0.5 * size.height);

    const glm::dvec3 axis(w);
    if (!(glm::dot(axis, axis) > 0.0)) {
        if (!(w.w > 0.0)) return {};
        return {detail::from_rows(x / w.w, y / w.w, z / w.w, {0.0, 0.0, 0.0, 1.0}), size, 1.0, 1.0};
    }
    // z = a W + b, if the depth planes stand across the axis: then z is 0 where W = -b / a, and W where W = b / (1 - a). Both are
    // before the eye and in this order iff b < 0 and a > 1, and at a = 1 the far plane is at infinity, which is none for a frame.
    const double a = glm::dot(glm::dvec3(z), axis) / glm::dot(axis, axis), b = z.w - a * w.w;
    const glm::dvec3 oblique = glm::dvec3(z) - a * axis;
    if (!(glm::dot(oblique, oblique) <= 1e-10 * glm::dot(axis, axis))) return {};
    if (!(b < 0.0 && a > 1.0)) return {};
    const double near_w = -b / a, far_w = b / (1.0 - a);
    return {detail::from_rows(x, y, (w - glm::dvec4(0.0, 0.0, 0.0, near_w)) / (far_w - near_w), w), size, near_w, far_w};
}

namespace detail {
/// The right, the upward and the forward direction of a light: orthonormal, and a function of the direction alone, so that a map
/// does not turn while it moves. All zero if the direction is; NaN if that has one.
struct light_axes {
    glm::dvec3 right, upward, forward;

    [[nodiscard]] static glm::dvec3 unit(const glm::dvec3& v) noexcept {
        const double length = std::hypot(v.x, v.y, v.z);
        return length > 0.0 ? v / length : glm::dvec3(0.0);
    }
    /// `up` is a hint: where it is within 0.06 degrees of the direction, zero or NaN, world z takes its place, or else world x.
    light_axes(const glm::dvec3& direction, const glm::dvec3& up) noexcept : forward(unit(direction)) {
        for (const glm::dvec3& hint : {unit(up), glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(1.0, 0.0, 0.0)}) {
            right = glm::cross(forward, hint);
            if (glm::dot(right, right) > 1e-6) break;
        }
        right = unit(right);
        upward = glm::cross(right, forward);
    }
};
} // namespace detail

} // namespace gnomon::inline GNOMON_BUILD
