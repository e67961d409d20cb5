// The scene of bench/gl: surfaces under a sun, what a camera sees of them, and the exact shadow on that.
//
// Light space: x and y in [0, 1] over the map, depth 0 at the light. A tilted ground receives; platforms that face the light cast
// and receive; leaves in all directions and a fence cast, over ground and platforms, and the camera looks through beneath them.
#pragma once

#include <gnomon/filter/kernel.hpp>
#include <gnomon/rect.hpp>
#include <gnomon/texel/image.hpp>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace bench_gl {

/// A parallelogram, or the ellipse in it: centre + a u + b v with a and b in [-1, 1].
struct surface {
    glm::vec3 centre, u, v;
    bool round;

    [[nodiscard]] bool holds(float a, float b) const {
        return round ? a * a + b * b <= 1.0f : std::abs(a) <= 1.0f && std::abs(b) <= 1.0f;
    }
    /// Of the map, in shares of it.
    [[nodiscard]] glm::vec3 reach() const { return glm::abs(u) + glm::abs(v); }
    [[nodiscard]] gnomon::texel_rect texels(int side) const {
        const glm::vec3 low = (centre - reach()) * static_cast<float>(side), high = (centre + reach()) * static_cast<float>(side);
        return gnomon::clip({static_cast<int>(std::floor(low.x)), static_cast<int>(std::floor(low.y)),
                             static_cast<int>(std::ceil(high.x)), static_cast<int>(std::ceil(high.y))},
                            {side, side});
    }
};

struct scene {
    surface ground{{0.5f, 0.5f, 0.8f}, {1.5f, 0.0f, 0.06f}, {0.0f, 1.5f, -0.04f}, false};
    std::vector<surface> platforms = {};
    std::vector<surface> above = {}; ///< leaves and the fence

    scene() {
        for (const float at : {0.2f, 0.45f, 0.75f})
            platforms.push_back({{at, 0.3f + 0.5f * at, 0.5f + 0.1f * at}, {0.09f, 0.02f, 0.0f}, {-0.02f, 0.07f, 0.0f}, at < 0.4f});
        std::mt19937 dice(7);
        const auto roll = [&dice](float low, float high) {
            return low + (high - low) * static_cast<float>(dice() % 65536u) / 65536.0f;
        };
        for (const glm::vec3 crown : {glm::vec3(0.22f, 0.44f, 0.2f), {0.6f, 0.6f, 0.3f}, {0.8f, 0.25f, 0.15f}})
            for (int leaf = 0; leaf < 24; ++leaf) {
                const float size = roll(0.006f, 0.024f), turn = roll(0.0f, 6.28f);
                const glm::vec3 u(size * std::cos(turn), size * std::sin(turn), size * roll(-1.0f, 1.0f));
                const glm::vec3 v(-0.5f * u.y, 0.5f * u.x, size * roll(-1.0f, 1.0f));
                above.push_back({crown + glm::vec3(roll(-0.11f, 0.11f), roll(-0.11f, 0.11f), roll(-0.08f, 0.08f)), u, v, true});
            }
        for (int rail = 0; rail < 16; ++rail)
            above.push_back(
                {{0.3f + 0.025f * static_cast<float>(rail), 0.15f, 0.6f}, {0.004f, 0.0f, 0.0f}, {0.0f, 0.05f, 0.0f}, false});
    }
    template <typename F> void for_each_caster(F&& f) const {
        for (const surface& s : platforms) f(s);
        for (const surface& s : above) f(s);
    }
};

/// Corners of triangles, three each: the casters', then the ground's.
[[nodiscard]] inline std::vector<glm::vec3> triangles(const scene& of, std::size_t& casters) {
    std::vector<glm::vec3> corners;
    const auto add = [&corners](const surface& s) {
        const int sides = s.round ? 64 : 4;
        const auto rim = [&](int side) {
            const float angle = 6.2831853f * (static_cast<float>(side) + 0.5f) / static_cast<float>(sides),
                        out = s.round ? 1.0f : 1.41421356f;
            return s.centre + out * std::cos(angle) * s.u + out * std::sin(angle) * s.v;
        };
        for (int side = 0; side < sides; ++side) corners.insert(corners.end(), {s.centre, rim(side), rim(side + 1)});
    };
    of.for_each_caster(add);
    casters = corners.size();
    add(of.ground);
    return corners;
}

/// A receiver as the shaders read it: texels x and y, and depth; the last number says what it is on.
struct receiver {
    float x, y, z, what;
    static constexpr float nothing = 0.0f, ground = 1.0f, platform = 2.0f;
    [[nodiscard]] bool is_on(float surface) const { return std::abs(what - surface) < 0.5f; }
};

/// What a camera sees on a screen as large as the map, one receiver for every pixel. Nothing, off the map too, is lit everywhere.
[[nodiscard]] inline std::vector<receiver> seen(const scene& of, int side) {
    const glm::vec3 eye(0.5f, 0.15f, -0.35f), ahead = glm::normalize(glm::vec3(0.5f, 0.5f, 0.8f) - eye);
    const glm::vec3 right(1.0f, 0.0f, 0.0f), up = glm::cross(ahead, right);
    const float wide = 0.4f;
    std::vector<receiver> receivers;
    receivers.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const auto across = [&](int pixel) {
                return wide * (2.0f * (static_cast<float>(pixel) + 0.5f) / static_cast<float>(side) - 1.0f);
            };
            const glm::vec3 ray = ahead + across(i) * right - across(j) * up;
            receiver found{-8.0f, -8.0f, 0.0f, receiver::nothing};
            float nearest = 1e9f;
            const auto meet = [&](const surface& s, float what) {
                const glm::vec3 normal = glm::cross(s.u, s.v);
                const float along = glm::dot(s.centre - eye, normal) / glm::dot(ray, normal);
                const glm::vec3 at = eye + along * ray, from = at - s.centre;
                const float a = glm::dot(glm::cross(from, s.v), normal) / glm::dot(normal, normal);
                const float b = glm::dot(glm::cross(s.u, from), normal) / glm::dot(normal, normal);
                const bool on_map = at.x > 0.0f && at.x < 1.0f && at.y > 0.0f && at.y < 1.0f;
                if (!(along > 0.0f && along < nearest && s.holds(a, b) && on_map)) return;
                nearest = along;
                found = {at.x * static_cast<float>(side), at.y * static_cast<float>(side), at.z, what};
            };
            meet(of.ground, receiver::ground);
            for (const surface& s : of.platforms) meet(s, receiver::platform);
            receivers.push_back(found);
        }
    return receivers;
}

/// The exact shadow, to compare with: nearest casters at 4 x 4 points in every texel, from the surfaces themselves.
class exact_shadow {
  public:
    static constexpr int fine = 4;

    exact_shadow(const scene& of, int side) : nearest_({fine * side, fine * side}, 1.0f) {
        of.for_each_caster([&](const surface& s) {
            const gnomon::texel_rect box = s.texels(fine * side);
            const float turned = s.u.x * s.v.y - s.u.y * s.v.x; // of both, seen from the light
            for (int y = box.y0; y < box.y1; ++y)
                for (int x = box.x0; x < box.x1; ++x) {
                    const float dx = at(x, side) - s.centre.x, dy = at(y, side) - s.centre.y;
                    const float a = (dx * s.v.y - dy * s.v.x) / turned, b = (s.u.x * dy - s.u.y * dx) / turned;
                    if (s.holds(a, b)) nearest_(x, y) = (std::min)(nearest_(x, y), s.centre.z + a * s.u.z + b * s.v.z);
                }
        });
    }

    /// The share of a footprint that is in shadow at the receiver's depth: of the kernel's taps, one texel apart and each a tent as
    /// wide as bilinear sampling, for that is what every method here blurs with. Between 0 and 1; off the map there is light.
    template <gnomon::kernel Kernel> [[nodiscard]] double of(const receiver& r) const {
        constexpr int most = fine * (2 * Kernel::radius + 4);
        std::array<double, std::size_t{most}> across{}, down{};
        double sum = 0.0;
        const int x0 = weights<Kernel>(r.x, across), y0 = weights<Kernel>(r.y, down);
        for (int j = 0; j < most; ++j)
            for (int i = 0; i < most; ++i)
                if (gnomon::whole(nearest_.size()).contains(x0 + i, y0 + j) && nearest_(x0 + i, y0 + j) < r.z - 1e-4f)
                    sum += across[static_cast<std::size_t>(i)] * down[static_cast<std::size_t>(j)];
        return sum;
    }

  private:
    [[nodiscard]] static float at(int point, int side) {
        return (static_cast<float>(point) + 0.5f) / static_cast<float>(fine * side);
    }
    /// Weights of points around a position in texels, which sum to one; returns the first point.
    template <gnomon::kernel Kernel, std::size_t Most> static int weights(float position, std::array<double, Most>& weight) {
        const int first = static_cast<int>(std::floor(fine * (position - Kernel::radius - 1.5f)));
        double sum = 0.0;
        for (std::size_t i = 0; i < Most; ++i) {
            const double away = (first + static_cast<int>(i) + 0.5) / fine - static_cast<double>(position);
            weight[i] = 0.0;
            for (int tap = -Kernel::radius; tap <= Kernel::radius; ++tap)
                weight[i] +=
                    Kernel::weights[static_cast<std::size_t>(tap + Kernel::radius)] * (std::max)(0.0, 1.0 - std::abs(away - tap));
            sum += weight[i];
        }
        for (double& w : weight) w /= sum;
        return first;
    }

    gnomon::image<float> nearest_;
};

} // namespace bench_gl
