#include "lightmap.hpp"

#include "parallel.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <cmath>
#include <limits>

namespace gallery {

namespace {

constexpr float texels_per_unit = 24.0f;
constexpr int key_samples = 16, sky_samples = 24, torch_samples = 8, parts = 4;
constexpr float lift = 1e-3f; ///< off the surface, so that it does not hide itself

/// Point `i` of `n` on the unit disc, evenly: a sunflower (Vogel 1979). The same for every texel, so the light has no grain.
glm::vec2 on_disc(int i, int n, float turned = 0.0f) {
    const float r = std::sqrt((static_cast<float>(i) + 0.5f) / static_cast<float>(n)),
                turn = 2.3999632f * static_cast<float>(i) + turned;
    return {r * std::cos(turn), r * std::sin(turn)};
}

struct basis {
    glm::vec3 a, b;

    explicit basis(const glm::vec3& n)
        : a(glm::normalize(glm::cross(n, std::abs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)))), b(glm::cross(n, a)) {}
};

/// Of the sky above: cosine-weighted, and only what is above the horizon.
glm::vec3 sky_on(const scene& s, const ray_world& world, const glm::vec3& point, const glm::vec3& normal, float turned) {
    const basis around(normal);
    float open = 0.0f;
    for (int i = 0; i < sky_samples; ++i) {
        const glm::vec2 p = on_disc(i, sky_samples, turned);
        const glm::vec3 d = around.a * p.x + around.b * p.y + normal * std::sqrt((std::max)(0.0f, 1.0f - glm::dot(p, p)));
        if (!world.blocked(point, d, 3.0f)) open += 0.65f + 0.35f * d.y;
    }
    return s.sky * (open / static_cast<float>(sky_samples));
}

glm::vec3 torch_on(const torch& fire, const ray_world& world, const glm::vec3& point, const glm::vec3& normal) {
    const glm::vec3 way = fire.position - point;
    const float square = glm::dot(way, way), cosine = glm::dot(way, normal) / std::sqrt(square);
    if (!(cosine > 0.0f)) return glm::vec3(0.0f);
    const basis around(glm::normalize(way));
    int seen = 0;
    for (int i = 0; i < torch_samples; ++i) {
        const glm::vec2 p = on_disc(i, torch_samples) * 0.07f;
        const glm::vec3 to = way + around.a * p.x + around.b * p.y;
        if (!world.blocked(point, to, 0.95f)) ++seen;
    }
    return fire.colour * (cosine / (0.35f + square) * static_cast<float>(seen) / static_cast<float>(torch_samples));
}

} // namespace

glm::vec3 key_light_on(const scene& s, const ray_world& world, const glm::vec3& point, const glm::vec3& normal, int samples,
                       float turned) {
    glm::vec3 to_light = -glm::normalize(s.key.direction);
    float distance = 20.0f, strength = 1.0f;
    if (const auto& lamp = s.key.cone) {
        const glm::vec3 way = lamp->position - point;
        distance = glm::length(way);
        const float off_axis = std::acos(glm::clamp(glm::dot(way / distance, to_light), -1.0f, 1.0f));
        to_light = way / distance;
        strength =
            (1.0f - glm::smoothstep(0.45f * lamp->outer_angle, 1.05f * lamp->outer_angle, off_axis)) * 8.0f / (distance * distance);
    }
    const float cosine = glm::dot(normal, to_light);
    if (!(cosine > 0.0f && strength > 0.0f)) return glm::vec3(0.0f);
    const basis around(to_light);
    int seen = 0;
    for (int i = 0; i < samples; ++i) {
        const glm::vec2 p = on_disc(i, samples, turned) * s.key.softness;
        if (!world.blocked(point, to_light + around.a * p.x + around.b * p.y, distance)) ++seen;
    }
    return s.key.colour * (cosine * strength * static_cast<float>(seen) / static_cast<float>(samples));
}

std::vector<lightmap> bake(const scene& s, const ray_world& world) {
    std::vector<lightmap> maps;
    for (const quad& q : s.surfaces) {
        const auto texels = [](const glm::vec3& side) {
            return (std::max)(2, static_cast<int>(glm::length(side) * texels_per_unit));
        };
        lightmap& map = maps.emplace_back(lightmap{texels(q.u), texels(q.v), {}});
        map.light.resize(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
        const glm::vec3 normal = q.normal();
        for_each_row(map.height, [&](int row) {
            for (int column = 0; column < map.width; ++column) {
                const auto at = [&](float x, float y) {
                    return q.corner + q.u * ((static_cast<float>(column) + x) / static_cast<float>(map.width)) +
                           q.v * ((static_cast<float>(row) + y) / static_cast<float>(map.height)) + normal * lift;
                };
                glm::vec3 light(0.0f);
                for (int part = 0; part < parts; ++part) { // over its area, or shadows would show the texels' edges
                    const glm::vec3 point = at(part % 2 ? 0.75f : 0.25f, part / 2 ? 0.75f : 0.25f);
                    const float turned = 0.7f * static_cast<float>(part);
                    light += key_light_on(s, world, point, normal, key_samples, turned) + sky_on(s, world, point, normal, turned);
                    if (s.fire) light += torch_on(*s.fire, world, point, normal);
                }
                light /= static_cast<float>(parts);
                map.light[static_cast<std::size_t>(row * map.width + column)] = light;
            }
        });
    }
    return maps;
}

glm::vec3 lightmap::at(float a, float b) const noexcept {
    const auto split = [](float v, int size, int& i) {
        const float p = glm::clamp(v * static_cast<float>(size) - 0.5f, 0.0f, static_cast<float>(size - 1));
        i = (std::min)(static_cast<int>(p), size - 2);
        return p - static_cast<float>(i);
    };
    int column = 0, row = 0;
    const float right = split(a, width, column), up = split(b, height, row);
    const glm::vec3* corner = light.data() + row * width + column;
    return glm::mix(glm::mix(corner[0], corner[1], right), glm::mix(corner[width], corner[width + 1], right), up);
}

} // namespace gallery
