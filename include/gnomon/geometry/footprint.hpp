// gnomon: soft shadow maps. The texels and the depths that a bounding volume can touch on a light's map.
#pragma once

#include <gnomon/geometry/bounds.hpp>
#include <gnomon/geometry/light_frame.hpp>

#include <glm/common.hpp>

namespace gnomon::inline GNOMON_BUILD {

/// Where something is on a map: texels, clipped to the map, and unit depths, clamped to [0, 1].
struct light_footprint {
    texel_rect texels;
    depth_interval depth;

    [[nodiscard]] constexpr bool empty() const noexcept { return texels.empty(); }
    friend constexpr bool operator==(light_footprint, light_footprint) = default;
};

namespace detail {
/// What a footprint is widened by on every side: in texels, and in unit depth. It covers the rounding of a float map.
inline constexpr double texel_slack = 1.0 / 1024.0;
inline constexpr double depth_slack = 1.0 / 4194304.0;

/// Real bounds of what was projected so far.
struct map_bounds {
    double x0 = std::numeric_limits<double>::infinity(), y0 = x0, z0 = x0;
    double x1 = -x0, y1 = -x0, z1 = -x0;

    void include(const glm::dvec4& h) noexcept {
        const double x = h.x / h.w, y = h.y / h.w;
        x0 = lesser(x0, x);
        y0 = lesser(y0, y);
        z0 = lesser(z0, h.z);
        x1 = greater(x1, x);
        y1 = greater(y1, y);
        z1 = greater(z1, h.z);
    }

    [[nodiscard]] light_footprint rounded(extent size) const noexcept {
        const texel_rect texels =
            clip(enclosing_texels(x0 - texel_slack, y0 - texel_slack, x1 + texel_slack, y1 + texel_slack), size);
        if (texels.empty()) return {};
        return {texels, {static_cast<float>(saturate(z0 - depth_slack)), static_cast<float>(saturate(z1 + depth_slack))}};
    }
};

/// Infinite bounds become merely enormous, where arithmetic makes no NaN of them.
inline constexpr double enormous = 1e30;
[[nodiscard]] constexpr double finite(double v) noexcept { return lesser(greater(v, -enormous), enormous); }
[[nodiscard]] inline glm::dvec3 finite(const glm::dvec3& v) noexcept { return {finite(v.x), finite(v.y), finite(v.z)}; }

/// What bounds can touch of which nothing better is known.
[[nodiscard]] constexpr light_footprint all_of(extent size) noexcept { return {whole(size), {0.0f, 1.0f}}; }
} // namespace detail

/// What of the map a box can touch, as a caster or as a receiver: every point of it lies in, and no side is more than 1 + 1/1024
/// texel too far out.
///
/// A directional light's near plane cuts nothing off, since casters before it are kept at depth 0. A spot light's does: the box is
/// clipped exactly, and one wholly before the near plane or behind the light is empty; if an edge that is cut ends more than 2^40
/// texels away, as they are on the near plane, or never, doubles do not tell where it is cut, and the footprint is the whole map.
/// Beyond the far plane the depth is 1. Empty for empty bounds, invalid frames, and off the map. Costs 8 projections, and up to 12
/// more where a spot's near plane cuts.
[[nodiscard]] inline light_footprint footprint(const bounding_box& box, const light_frame& light) noexcept {
    if (box.empty() || !light.valid()) return {};
    const bounding_box solid{detail::finite(box.lower), detail::finite(box.upper)};
    glm::dvec4 corners[8];
    for (int i = 0; i < 8; ++i) corners[i] = detail::product(light.matrix(), glm::dvec4(solid.corner(i), 1.0));

    const auto visible = [&light](const glm::dvec4& h) { return !light.perspective() || h.z >= 0.0; };
    const auto cut = [&light](const glm::dvec4& in, const glm::dvec4& out) {
        const glm::dvec4 h = glm::mix(in, out, in.z / (in.z - out.z));
        return glm::dvec4(h.x, h.y, 0.0, light.near_w()); // depth and W are known there, and no rounding may spoil the divide
    };
    const auto close = [&light](const glm::dvec4& h) { return glm::length(h) < 0x1p40 * light.near_w(); };
    detail::map_bounds bounds;
    for (int i = 0; i < 8; ++i) {
        if (!visible(corners[i])) continue;
        bounds.include(corners[i]);
        for (const int axis : {1, 2, 4}) {
            const glm::dvec4& other = corners[i ^ axis];
            if (visible(other)) continue;
            if (!close(corners[i]) || !close(other)) return detail::all_of(light.size());
            bounds.include(cut(corners[i], other));
        }
    }
    return bounds.rounded(light.size());
}

/// The same of a ball: bounded by the planes through the light that touch it, so no side is farther out either.
///
/// Where a spot light's near plane cuts the ball, it is the footprint of the box around it: conservative, and looser. A ball without
/// end touches the whole map, wherever its centre is.
[[nodiscard]] inline light_footprint footprint(const bounding_sphere& ball, const light_frame& light) noexcept {
    if (ball.empty() || !light.valid()) return {};
    if (ball.radius > detail::enormous) return detail::all_of(light.size());
    const double r = ball.radius;
    const glm::dvec4 centre(detail::finite(ball.centre), 1.0), h = detail::product(light.matrix(), centre);
    const glm::dvec3 x(detail::row(light.matrix(), 0)), y(detail::row(light.matrix(), 1)), z(detail::row(light.matrix(), 2)),
        w(detail::row(light.matrix(), 3));
    const double reach = r * glm::length(z);
    if (light.perspective() && !(h.z - reach >= 0.0)) return footprint(box_around(ball), light);

    // The plane x = k is (X - k W)(p) = 0, and touches the ball where (X_c - k W_c)^2 = r^2 |X - k W|^2: two roots k. If W is 1,
    // they are X_c -+ r |X|.
    const auto touching = [&](const glm::dvec3& row, double at_centre, double& k0, double& k1) {
        const double square = h.w * h.w - r * r * glm::dot(w, w);
        const double middle = at_centre * h.w - r * r * glm::dot(row, w);
        const glm::dvec3 across = row * h.w - w * at_centre, twist = glm::cross(row, w) * r;
        const double root = r * std::sqrt(greater(0.0, glm::dot(across, across) - glm::dot(twist, twist)));
        k0 = (middle - root) / square;
        k1 = (middle + root) / square;
    };
    detail::map_bounds bounds;
    touching(x, h.x, bounds.x0, bounds.x1);
    touching(y, h.y, bounds.y0, bounds.y1);
    bounds.z0 = h.z - reach;
    bounds.z1 = h.z + reach;
    return bounds.rounded(light.size());
}

} // namespace gnomon::inline GNOMON_BUILD
