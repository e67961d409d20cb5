// gallery: what shadows ought to be: exact percentage-closer filtering of the unfiltered map, in double precision.
#pragma once

#include "view.hpp"

#include <gnomon/geometry/rasterize.hpp>

#include <limits>

namespace gallery {

/// Unfiltered: the nearest caster of a texel, and the surface immediately behind it.
struct exact_texel {
    float s = std::numeric_limits<float>::infinity();
    float opacity = 0.0f;
    float far_bound = std::numeric_limits<float>::infinity();

    /// How dark a receiver at depth `z` is, by this texel alone (seed 000: behind the caster, and not behind what is behind it).
    [[nodiscard]] double shadow(double z) const noexcept {
        return static_cast<double>(s) < z && z <= static_cast<double>(far_bound) ? static_cast<double>(opacity) : 0.0;
    }
};

using exact_map = gnomon::image<exact_texel>;

/// The mesh at the place of a caster, and the static world, as gnomon takes triangles.
[[nodiscard]] gnomon::triangle_mesh triangles(const mesh& m, const caster& at);
struct static_triangles {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    explicit static_triangles(const scene& s);
    [[nodiscard]] gnomon::triangle_mesh view() const noexcept { return {positions, indices}; }
};

[[nodiscard]] exact_map exact_map_of(const scene& s, const mesh& m, const gnomon::light_frame& frame);

/// The depth test of old, at the nearest texel, without filter or bias.
[[nodiscard]] std::vector<float> hard_shadow(const exact_map& map, const receivers& points);

/// The weights of a kernel, at most 33 of them.
using kernel_weights = gnomon::strided_span<const int>;

/// Exact percentage-closer filtering with these weights, at the four texels around the receiver, blended like
/// gnomon::sample blends them (positions to 1/256 texel): so what differs from gnomon is method and storage, and nothing else.
/// Every tap is compared with the receiver's own depth; on a caster, with the depth of the receiver's plane at that tap, since
/// with one depth percentage-closer filtering shadows its own slopes, and would be no truth.
[[nodiscard]] std::vector<float> exact_shadow(const exact_map& map, const receivers& points, kernel_weights weights);

} // namespace gallery
