// gnomon: soft shadow maps. A world far from its origin, in float: positions and frames relative to a point near by.
#pragma once

#include <gnomon/geometry/light_frame.hpp>
#include <gnomon/texel/image.hpp>

namespace gnomon::inline GNOMON_BUILD {

/// A world position relative to `origin`: subtracted in double, then rounded to float once.
[[nodiscard]] inline glm::vec3 rebase(const glm::dvec3& world, const glm::dvec3& origin) noexcept {
    return glm::vec3(world - origin);
}

/// Many of them: local[i] = rebase(world[i], origin). The shortest span counts; nothing is allocated.
inline void rebase(strided_span<const glm::dvec3> world, const glm::dvec3& origin, strided_span<glm::vec3> local) noexcept {
    const int count = lesser(world.size(), local.size());
    for (int i = 0; i < count; ++i) local[i] = rebase(world[i], origin);
}

/// The matrix of an object whose vertices are already floats about its own middle: its result is relative to `origin`.
/// \pre affine: the last row is 0 0 0 1
[[nodiscard]] inline glm::mat4 rebase(glm::dmat4 model, const glm::dvec3& origin) noexcept {
    model[3] -= glm::dvec4(origin, 0.0);
    return glm::mat4(model);
}

namespace detail {
/// The world position that the first three rows of a frame take to `target`. Not finite where they take none there.
[[nodiscard]] inline glm::dvec3 unproject(const glm::dmat4& m, const glm::dvec3& target) noexcept {
    const glm::dvec3 a(row(m, 0)), b(row(m, 1)), c(row(m, 2)), left = target - glm::dvec3(m[3]);
    return (glm::cross(b, c) * left.x + glm::cross(c, a) * left.y + glm::cross(a, b) * left.z) / volume(m);
}
} // namespace detail

/// The best origin for a light: the middle of what the map covers, or the place of a spot light, whose floats then are finest
/// where the cone is narrowest.
///
/// It lies on a grid whose cell is a power of two, so it stands still for most frames of a moving light, and then jumps by a cell:
/// compare it with the last one before keeping what was rebased. The cell is 1/8 to 1/4 of the way from the middle to a corner,
/// or to a spot light's near plane.
/// The world's origin for an invalid frame.
[[nodiscard]] inline glm::dvec3 rebase_origin(const light_frame& light) noexcept {
    if (!light.valid()) return glm::dvec3(0.0);
    const glm::dmat4& m = light.matrix();
    const double range = light.far_w() - light.near_w();
    const glm::dvec3 corner(light.size().width, light.size().height, 1.0);
    const glm::dvec3 middle =
        detail::unproject(m, light.perspective() ? glm::dvec3(0.0, 0.0, -light.near_w() / range) : corner * 0.5);
    double reach = 0.0; // to the farthest corner of the box; to the near plane of a cone
    for (int i = 0; i < 4 && !light.perspective(); ++i) {
        const glm::dvec3 other(corner.x, i & 1 ? 0.0 : corner.y, i & 2 ? 0.0 : corner.z);
        reach = greater(reach, glm::length(detail::unproject(m, other) - middle));
    }
    if (light.perspective()) reach = light.near_w() / glm::length(glm::dvec3(detail::row(m, 3)));
    const double cell = std::exp2(std::floor(std::log2(reach)) - 2.0);
    const glm::dvec3 snapped(std::round(middle.x / cell) * cell, std::round(middle.y / cell) * cell,
                             std::round(middle.z / cell) * cell);
    const bool finite = std::isfinite(glm::dot(snapped, glm::dvec3(0.0)));
    return finite ? snapped : glm::dvec3(0.0);
}

/// Where a rebased position falls on the map; NaN as in map_point, and for the same reason.
struct rebased_point {
    float x = std::numeric_limits<float>::quiet_NaN();
    float y = std::numeric_limits<float>::quiet_NaN();
    float depth = std::numeric_limits<float>::quiet_NaN();

    [[nodiscard]] bool in_front() const noexcept { return !std::isnan(depth); }
};

/// The share of its terms by which a row of a rebased_frame may be off: each is rounded as a coefficient, as a position, as a
/// product, and in two sums. Beside it stands what light_frame rounds in double.
inline constexpr float rebase_error = 5.0f * 0x1.000002p-24f;

/// A light_frame for floats, on a CPU or as a matrix for a GPU, about an origin near the casters.
///
///     const rebased_frame near_by(sun.frame({2048, 2048}, gaussian<4>::radius));
///     std::vector<glm::vec3> local(positions.size());
///     rebase(positions, near_by.origin(), local);                      // doubles in, floats out
///     for (const glm::vec3& p : local) dark += map.shadow_at(near_by.to_map(p));
///
/// The error does not know how far from the world's origin this is. Each of x W, y W, depth and W is a row (a b c | d) times
/// (p, 1), and is off by at most rebase_error (|a p.x| + |b p.y| + |c p.z| + |d|): so it grows with the size of the map in
/// texels and with the distance from the origin. In a map of 2048 texels over 200 m, everywhere in a range of 200 m, that is 1e-3
/// texel and 1e-6 of the range, where a float matrix on float positions is off by .85 texel at 1e6 m. A spot light's x and y
/// are quotients of two such rows.
class rebased_frame {
  public:
    rebased_frame() = default;
    explicit rebased_frame(const light_frame& light) noexcept : rebased_frame(light, rebase_origin(light)) {}
    /// About an origin of your own, such as the one that a whole scene was rebased to.
    rebased_frame(const light_frame& light, const glm::dvec3& origin) noexcept : origin_(origin) {
        glm::dmat4 m = light.matrix();
        m[3] = detail::product(m, glm::dvec4(origin, 1.0));
        matrix_ = glm::mat4(m);
    }

    [[nodiscard]] const glm::dvec3& origin() const noexcept { return origin_; }
    /// From (p - origin, 1) to (x W, y W, depth, W). All zero for an invalid frame. To draw the map, see light_frame::clip_matrix.
    [[nodiscard]] const glm::mat4& matrix() const noexcept { return matrix_; }

    /// Where a rebased position falls on the map; behind a spot light, in an invalid frame or at NaN: nowhere, which is lit.
    [[nodiscard]] rebased_point to_map(const glm::vec3& local) const noexcept {
        const glm::vec4 h = (matrix_[0] * local.x + matrix_[1] * local.y) + (matrix_[2] * local.z + matrix_[3]);
        if (!(h.w > 0.0f)) return {};
        return {h.x / h.w, h.y / h.w, h.z};
    }

  private:
    glm::dvec3 origin_{0.0};
    glm::mat4 matrix_{0.0f};
};

} // namespace gnomon::inline GNOMON_BUILD
