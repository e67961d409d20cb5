#include "view.hpp"

#include "parallel.hpp"

#include <gnomon/receive/lightmap.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gallery {

namespace {

constexpr glm::vec3 backdrop_below{0.56f, 0.58f, 0.59f}, backdrop_above{0.36f, 0.43f, 0.52f};
constexpr float veiled = 1e-3f; ///< beyond this nothing more is seen

/// A point that receives, before the receivers are put side by side.
struct map_place {
    float x = 0, y = 0, z = 0, slope_x = 0, slope_y = 0;
};

/// Depth a texel along the map's x and y on the plane through a point: what the map's linear part makes of two tangents.
glm::dvec2 slope_of(const gnomon::light_frame& frame, const glm::vec3& point, const glm::vec3& normal) {
    const glm::dvec3 n(normal), p(point),
        a = glm::normalize(glm::cross(n, std::abs(n.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0))), b = glm::cross(n, a);
    const auto step = [&](const glm::dvec3& t) {
        const gnomon::map_point here = frame.to_map(p), there = frame.to_map(p + t * 1e-3);
        return glm::dvec3(there.x - here.x, there.y - here.y, there.depth - here.depth);
    };
    const glm::dvec3 da = step(a), db = step(b);
    const double area = da.x * db.y - da.y * db.x;
    return {(da.z * db.y - db.z * da.y) / area, (db.z * da.x - da.z * db.x) / area};
}

class observer {
  public:
    observer(const scene& s, const ray_world& world, const std::vector<lightmap>& light, const gnomon::light_frame& frame)
        : scene_(s), world_(world), light_(light), frame_(frame) {}

    /// Follows a ray through glass to the first solid thing.
    sample follow(const glm::vec3& from, const glm::vec3& direction, float height, map_place& place) const {
        const glm::vec3 backdrop = glm::mix(backdrop_below, backdrop_above, glm::smoothstep(0.0f, 1.0f, height));
        sample seen;
        float travelled = 0.0f;
        for (int layer = 0; layer < 32 && seen.through > veiled; ++layer) {
            const ray_hit hit = world_.first(from, direction, travelled);
            if (hit.caster < 0 && hit.surface < 0) break;
            travelled = hit.distance + 1e-4f;
            const glm::vec3 point = from + direction * hit.distance;
            if (hit.surface >= 0) return on_surface(seen, hit, point, backdrop, place);
            const caster& c = scene_.casters[static_cast<std::size_t>(hit.caster)];
            if (c.opacity >= 1.0f) return on_caster(seen, c, hit, point, place);
            add_glass(seen, c, hit, point, direction);
        }
        seen.veil += backdrop * seen.through;
        seen.through = 0.0f;
        return seen;
    }

  private:
    sample on_surface(sample seen, const ray_hit& hit, const glm::vec3& point, const glm::vec3& backdrop, map_place& place) const {
        const auto index = static_cast<std::size_t>(hit.surface);
        const quad& q = scene_.surfaces[index];
        seen.colour = q.colour;
        if (q.glows)
            seen.light = glm::vec3(1.0f);
        else {
            const glm::vec3 in = point - q.corner;
            seen.light = light_[index].at(glm::dot(in, q.u) / glm::dot(q.u, q.u), glm::dot(in, q.v) / glm::dot(q.v, q.v));
            receive(seen, point, q.normal(), false, place);
        }
        const glm::vec3 off = point - scene_.focus;
        const float fade =
            glm::smoothstep(0.45f * scene_.edge_of_world, 0.97f * scene_.edge_of_world, std::sqrt(off.x * off.x + off.z * off.z));
        seen.veil += backdrop * (seen.through * fade);
        seen.through *= 1.0f - fade;
        return seen;
    }

    [[nodiscard]] glm::vec3 ambient_on(const glm::vec3& normal) const { return scene_.sky * (0.72f + 0.28f * normal.y); }

    sample on_caster(sample seen, const caster& c, const ray_hit& hit, const glm::vec3& point, map_place& place) const {
        seen.colour = c.colour;
        seen.light = ambient_on(hit.smooth) + key_light_on(scene_, world_, point + hit.normal * 1e-3f, hit.smooth, 6);
        if (scene_.casters_receive) receive(seen, point, hit.normal, true, place);
        return seen;
    }

    /// Half of the opacity on the way in, half on the way out, and a gleam at the rim.
    void add_glass(sample& seen, const caster& c, const ray_hit& hit, const glm::vec3& point, const glm::vec3& direction) const {
        const float rim = std::pow(1.0f - std::abs(glm::dot(hit.smooth, direction)), 3.0f);
        const float taken = glm::mix(1.0f - std::sqrt(1.0f - c.opacity), 0.75f, rim);
        const glm::vec3 light = ambient_on(hit.smooth) + key_light_on(scene_, world_, point + hit.normal * 1e-3f, hit.smooth, 6);
        seen.veil += c.colour * light * (seen.through * taken);
        seen.through *= 1.0f - taken;
    }

    void receive(sample& seen, const glm::vec3& point, const glm::vec3& normal, bool is_caster, map_place& place) const {
        const auto& lamp = scene_.key.cone;
        const glm::vec3 to_light = lamp ? glm::normalize(lamp->position - point) : -glm::normalize(scene_.key.direction);
        if (!(glm::dot(normal, to_light) > (is_caster ? 0.05f : 0.0f))) return;
        const gnomon::map_point p = frame_.to_map(glm::dvec3(point));
        const gnomon::extent size = frame_.size();
        if (!p.in_front() || !(p.x >= 0 && p.y >= 0 && p.x < size.width && p.y < size.height)) return;
        const glm::dvec2 slope = is_caster ? slope_of(frame_, point, normal) : glm::dvec2(0.0);
        place = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.depth), static_cast<float>(slope.x),
                 static_cast<float>(slope.y)};
        seen.receiver = 0; // numbered later
    }

    const scene& scene_;
    const ray_world& world_;
    const std::vector<lightmap>& light_;
    const gnomon::light_frame& frame_;
};

void number_receivers(view& v, const std::vector<map_place>& places) {
    for (std::size_t i = 0; i < v.samples.size(); ++i) {
        if (v.samples[i].receiver < 0) continue;
        v.samples[i].receiver = static_cast<int>(v.points.size());
        v.points.x.push_back(places[i].x);
        v.points.y.push_back(places[i].y);
        v.points.z.push_back(places[i].z);
        v.points.slope_x.push_back(places[i].slope_x);
        v.points.slope_y.push_back(places[i].slope_y);
    }
}

/// Calls f(pixel colour) with the samples of every pixel.
template <typename F> picture for_each_pixel(const view& v, const F& colour_of) {
    picture result(v.width, v.height);
    for_each_row(v.height, [&](int row) {
        for (int column = 0; column < v.width; ++column) {
            const sample* first = v.samples.data() + static_cast<std::ptrdiff_t>(row * v.width + column) * samples_per_pixel;
            glm::vec3 sum(0.0f);
            for (int i = 0; i < samples_per_pixel; ++i) sum += colour_of(first[i]);
            result.set(column, row, sum / static_cast<float>(samples_per_pixel));
        }
    });
    return result;
}

float of_receiver(const sample& s, const std::vector<float>& values) {
    return s.receiver < 0 ? 0.0f : values[static_cast<std::size_t>(s.receiver)];
}

glm::vec3 lit(const sample& s, const scene& where, float shadow) {
    glm::vec3 light = s.light;
    for (int c = 0; c < 3; ++c) light[c] = gnomon::mask_light(light[c], shadow, where.ambient_floor[c]);
    return s.veil + s.colour * light * s.through;
}

} // namespace

view look(const scene& s, const ray_world& world, const std::vector<lightmap>& light, const gnomon::light_frame& frame, int width) {
    view v{.width = width, .height = (std::max)(1, width * 3 / 4), .samples = {}, .points = {}};
    const auto count = static_cast<std::size_t>(v.width) * static_cast<std::size_t>(v.height) * samples_per_pixel;
    v.samples.resize(count);
    std::vector<map_place> places(count);
    const glm::vec3 forward = glm::normalize(s.from.target - s.from.eye),
                    right = glm::normalize(glm::cross(forward, glm::vec3(0, 1, 0))), upward = glm::cross(right, forward);
    constexpr std::array<glm::vec2, samples_per_pixel> grid{
        {{0.375f, 0.125f}, {0.875f, 0.375f}, {0.125f, 0.625f}, {0.625f, 0.875f}}};
    const observer eye(s, world, light, frame);
    for_each_row(v.height, [&](int row) {
        for (int column = 0; column < v.width; ++column)
            for (int i = 0; i < samples_per_pixel; ++i) {
                const glm::vec2 p =
                    (glm::vec2(column, row) + grid[static_cast<std::size_t>(i)]) * 2.0f / static_cast<float>(v.height);
                const float x = (p.x - static_cast<float>(v.width) / static_cast<float>(v.height)) * s.from.height_of_view,
                            y = (1.0f - p.y) * s.from.height_of_view;
                const auto at = static_cast<std::size_t>((row * v.width + column) * samples_per_pixel + i);
                v.samples[at] =
                    eye.follow(s.from.eye, glm::normalize(forward + right * x + upward * y), 1.0f - p.y / 2.0f, places[at]);
            }
    });
    number_receivers(v, places);
    return v;
}

picture shade(const view& v, const scene& s, const std::vector<float>& intensity) {
    return for_each_pixel(v, [&](const sample& each) { return lit(each, s, of_receiver(each, intensity)); });
}

picture shade_difference(const view& v, const scene& s, const std::vector<float>& intensity, const std::vector<float>& truth,
                         float factor) {
    return for_each_pixel(v, [&](const sample& each) {
        const float difference = factor * (of_receiver(each, intensity) - of_receiver(each, truth));
        const glm::vec3 colour = lit(each, s, 0.0f), pale(0.55f + 0.3f * glm::dot(colour, glm::vec3(0.21f, 0.72f, 0.07f)));
        const glm::vec3 signal = difference > 0.0f ? glm::vec3(0.75f, 0.03f, 0.03f) : glm::vec3(0.02f, 0.12f, 0.80f);
        return glm::mix(pale, signal, (std::min)(1.0f, std::abs(difference)));
    });
}

} // namespace gallery
