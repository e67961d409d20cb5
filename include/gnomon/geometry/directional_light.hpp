// gnomon: soft shadow maps. A light without a position: a map fitted to casters and receivers, and held still while they move.
#pragma once

#include <gnomon/geometry/bounds.hpp>
#include <gnomon/geometry/light_frame.hpp>

#include <cmath>

namespace gnomon::inline GNOMON_BUILD {

/// Gathers what a directional light has to cover, and fits a frame to it.
///
///     directional_light sun({0.3, -1.0, 0.2});
///     for (const auto& c : casters) sun.add_caster(c.bounds);
///     sun.add_receiver(ground);
///     const light_frame light = sun.frame({1024, 1024}, gaussian<4>::radius);
///
/// The fit is *stable*. Texels are square and lie on a grid that is fixed in the world; their size is a power of 2^(1/8), so it
/// changes only when the casters grow by 9 %. When casters move, the same world point keeps its place within its texel (below
/// 1e-6 texel at 1e6 m), and nothing shimmers. Depth lies on such a grid too, of 255 cells: stored 8- and 16-bit depths shift by
/// whole codes. The price is at most 9 % of the resolution, one texel and one depth cell. Camera-driven fits should pass one
/// sphere: its size does not change when the camera turns.
class directional_light {
  public:
    /// `direction` is the way the light travels, of any length. `up` appears as +y on the map; see detail::light_axes for when it
    /// cannot.
    explicit directional_light(const glm::dvec3& direction, const glm::dvec3& up = glm::dvec3(0.0, 1.0, 0.0)) noexcept
        : axes_(direction, up) {}

    /// Covered by the map and by its depth range. Empty bounds are ignored, infinite ones make the frame invalid.
    void add_caster(const bounding_sphere& ball) noexcept {
        if (ball.empty()) return;
        x_.include(glm::dot(ball.centre, axes_.right), ball.radius);
        y_.include(glm::dot(ball.centre, axes_.upward), ball.radius);
        add_receiver(ball);
    }
    void add_caster(const bounding_box& box) noexcept {
        if (box.empty()) return;
        include(x_, box, axes_.right);
        include(y_, box, axes_.upward);
        add_receiver(box);
    }

    /// Covered by the depth range alone: off the map there is no shadow, but a receiver beyond the far plane would be in all of
    /// them.
    void add_receiver(const bounding_sphere& ball) noexcept {
        if (!ball.empty()) z_.include(glm::dot(ball.centre, axes_.forward), ball.radius);
    }
    void add_receiver(const bounding_box& box) noexcept {
        if (!box.empty()) include(z_, box, axes_.forward);
    }

    /// The fit, with at least `margin` free texels on every side of the casters: the kernel's radius, so that soft edges stay on
    /// the map. Invalid without casters, with casters that are all one point, and if the margins leave less than two texels.
    [[nodiscard]] light_frame frame(extent size, int margin = 0) const noexcept {
        const double width = size.width, height = size.height, margins = 2.0 * greater(margin, 0);
        if (!(width - margins >= 2.0) || !(height - margins >= 2.0)) return {};
        const double texel = stable(greater(x_.length() / (width - margins - 1.0), y_.length() / (height - margins - 1.0)));
        const double cell = stable(greater(z_.length() / (depth_cells - 1.0), texel / depth_cells));
        if (!(texel > 0.0 && cell > 0.0)) return {};
        return {detail::from_rows(on_grid(axes_.right, x_, texel, width), on_grid(axes_.upward, y_, texel, height),
                                  on_grid(axes_.forward, z_, cell, depth_cells) / depth_cells, {0.0, 0.0, 0.0, 1.0}),
                size, 1.0, 1.0};
    }

  private:
    static constexpr double depth_cells = 255.0;

    struct range {
        double lower = std::numeric_limits<double>::infinity();
        double upper = -std::numeric_limits<double>::infinity();

        void include(double middle, double reach) noexcept {
            lower = lesser(lower, middle - reach);
            upper = greater(upper, middle + reach);
        }
        [[nodiscard]] double length() const noexcept { return upper - lower; }
    };

    static void include(range& r, const bounding_box& box, const glm::dvec3& axis) noexcept {
        const glm::dvec3 along(std::abs(axis.x), std::abs(axis.y), std::abs(axis.z));
        r.include(glm::dot((box.lower + box.upper) * 0.5, axis), glm::dot((box.upper - box.lower) * 0.5, along));
    }

    /// `size` rounded up to a power of 2^(1/8). The millionth keeps round numbers off the steps, where rounding would toggle them. 0
    /// where there is none.
    [[nodiscard]] static double stable(double size) noexcept {
        return size > 0.0 ? std::exp2(std::ceil(std::log2(size * 1.000001) * 8.0) / 8.0) : 0.0;
    }

    /// Cells along an axis, shifted by a whole number so that `r` is in the middle of 0...cells, to half a cell.
    [[nodiscard]] static glm::dvec4 on_grid(const glm::dvec3& axis, const range& r, double cell, double cells) noexcept {
        return {axis / cell, -std::round((r.lower + r.upper) * 0.5 / cell - cells * 0.5)};
    }

    detail::light_axes axes_;
    range x_, y_, z_;
};

} // namespace gnomon::inline GNOMON_BUILD
