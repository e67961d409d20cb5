#include "truth.hpp"

#include "parallel.hpp"
#include <array>
#include <cmath>

namespace gallery {

namespace {

/// Where a receiver reads along one axis: the first of its taps, and their weights; positions as gnomon::sample takes them. The kernel is
/// spread over two neighbouring centres: tap i of the left one is tap i - 1 of the right one. Whole numbers, so exact.
struct axis_taps {
    int first, count;
    std::array<double, 34> weight{};

    axis_taps(float position, kernel_weights kernel) : count(kernel.size() + 1) {
        const int steps = static_cast<int>(std::floor((static_cast<double>(position) - 0.5) * 256.0 + 0.5));
        first = (steps >> 8) - kernel.size() / 2;
        for (int i = 0; i < kernel.size(); ++i) {
            weight[static_cast<std::size_t>(i)] += kernel[i] * (256.0 - (steps & 255));
            weight[static_cast<std::size_t>(i + 1)] += kernel[i] * 1.0 * (steps & 255);
        }
    }
};

/// Slack of a caster that receives, for the plane is not the surface, in depth.
constexpr double plane_slack = 0.004;

double filtered_shadow(const exact_map& map, const receivers& points, std::size_t i, gnomon::texel_rect occupied,
                       kernel_weights weights) {
    const axis_taps across(points.x[i], weights), down(points.y[i], weights);
    const gnomon::texel_rect read =
        intersection({across.first, down.first, across.first + across.count, down.first + down.count}, occupied);
    const double z = static_cast<double>(points.z[i]), x = static_cast<double>(points.x[i]), y = static_cast<double>(points.y[i]);
    const double slope_x = static_cast<double>(points.slope_x[i]), slope_y = static_cast<double>(points.slope_y[i]);
    const double slack = std::abs(slope_x) + std::abs(slope_y) > 0.0 ? plane_slack : 0.0;
    double sum = 0.0;
    for (int row = read.y0; row < read.y1; ++row) {
        double row_sum = 0.0;
        for (int column = read.x0; column < read.x1; ++column) {
            const double plane = z + slope_x * (column + 0.5 - x) + slope_y * (row + 0.5 - y) - slack;
            row_sum += across.weight[static_cast<std::size_t>(column - across.first)] * map(column, row).shadow(plane);
        }
        sum += row_sum * down.weight[static_cast<std::size_t>(row - down.first)];
    }
    double whole = 0.0;
    for (const double w : across.weight) whole += w;
    return sum / (whole * whole);
}

gnomon::texel_rect occupied_part(const exact_map& map) {
    gnomon::texel_rect part;
    for (int y = 0; y < map.size().height; ++y)
        for (int x = 0; x < map.size().width; ++x)
            if (map(x, y).opacity > 0.0f) part = union_box(part, {x, y, x + 1, y + 1});
    return part;
}

} // namespace

gnomon::triangle_mesh triangles(const mesh& m, const caster& at) { return {m.positions, m.indices, at.model}; }

static_triangles::static_triangles(const scene& s) {
    for (const quad& q : s.surfaces) {
        const auto i = static_cast<std::uint32_t>(positions.size());
        positions.insert(positions.end(), {q.corner, q.corner + q.u, q.corner + q.u + q.v, q.corner + q.v});
        indices.insert(indices.end(), {i, i + 1, i + 2, i, i + 2, i + 3});
    }
}

exact_map exact_map_of(const scene& s, const mesh& m, const gnomon::light_frame& frame) {
    exact_map map(frame.size());
    const auto everywhere = whole(frame.size());
    for (const caster& c : s.casters)
        rasterize(triangles(m, c), frame, everywhere, gnomon::faces::both, [&](int x, int y, float depth) {
            exact_texel& t = map(x, y);
            if (depth < t.s) t = {depth, c.opacity};
        });
    if (s.bounded)
        rasterize(static_triangles(s).view(), frame, everywhere, gnomon::faces::dark_side, [&](int x, int y, float depth) {
            exact_texel& t = map(x, y);
            if (depth >= t.s) t.far_bound = (std::min)(t.far_bound, depth);
        });
    return map;
}

std::vector<float> hard_shadow(const exact_map& map, const receivers& points) {
    std::vector<float> intensity(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        intensity[i] = static_cast<float>(
            map(static_cast<int>(points.x[i]), static_cast<int>(points.y[i])).shadow(static_cast<double>(points.z[i])));
    return intensity;
}

std::vector<float> exact_shadow(const exact_map& map, const receivers& points, kernel_weights weights) {
    constexpr std::size_t strip = 4096;
    std::vector<float> intensity(points.size());
    const gnomon::texel_rect occupied = occupied_part(map);
    for_each_row(static_cast<int>((points.size() + strip - 1) / strip), [&](int row) {
        const std::size_t begin = static_cast<std::size_t>(row) * strip, end = (std::min)(begin + strip, points.size());
        for (std::size_t i = begin; i < end; ++i)
            intensity[i] = static_cast<float>(filtered_shadow(map, points, i, occupied, weights));
    });
    return intensity;
}

} // namespace gallery
