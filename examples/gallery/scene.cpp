#include "scene.hpp"

#include <gnomon/geometry/directional_light.hpp>
#include <gnomon/geometry/spot_light.hpp>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace gallery {

glm::vec3 quad::normal() const noexcept { return glm::normalize(glm::cross(u, v)); }

namespace {

constexpr glm::vec3 sand{0.80f, 0.77f, 0.71f}, stone{0.62f, 0.64f, 0.67f}, wood{0.66f, 0.53f, 0.40f}, clay{0.83f, 0.47f, 0.31f},
    glass{0.22f, 0.62f, 0.60f}, slate{0.36f, 0.47f, 0.63f};

void add_floor(scene& s, float y, float half, const glm::vec3& colour) {
    s.surfaces.push_back({{-half, y, half}, {2 * half, 0, 0}, {0, 0, -2 * half}, colour});
}

/// A closed box, all six sides outwards.
void add_box(scene& s, const glm::vec3& lower, const glm::vec3& upper, const glm::vec3& colour, bool glows = false) {
    const glm::vec3 size = upper - lower, x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
    for (const quad& side : {quad{lower + y, z, x, colour}, quad{lower, x, z, colour}, quad{lower + z, x, y, colour},
                             quad{lower, y, x, colour}, quad{lower + x, y, z, colour}, quad{lower, z, y, colour}}) {
        s.surfaces.push_back(side);
        s.surfaces.back().glows = glows;
    }
}

/// `size` high or wide, standing at `foot`, turned about the vertical.
glm::dmat4 placed(const glm::dvec3& foot, double size, double degrees = 0.0) {
    const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), foot);
    return glm::scale(glm::rotate(moved, glm::radians(degrees), glm::dvec3(0.0, 1.0, 0.0)), glm::dvec3(size));
}

scene on_the_ground() {
    scene s;
    s.key = {{0.72f, -0.60f, -0.06f}, {0.84f, 0.76f, 0.64f}, 0.045f};
    add_floor(s, 0.0f, 6.0f, sand);
    add_box(s, {-1.20f, 0.0f, 0.46f}, {-1.02f, 1.0f, 0.64f}, stone);
    s.casters = {{placed({-0.25, 0.0, -0.15}, 1.25, 60.0), clay}};
    s.play_area = {{-1.3, 0.0, -1.3}, {1.3, 1.3, 1.3}};
    s.reach = {{-2.5, 0.0, -2.5}, {2.5, 0.1, 2.5}};
    s.from = {{0.35f, 1.9f, 3.3f}, {-0.02f, 0.33f, 0.05f}, 0.315f};
    s.variants = {{"lightmap", "a  Mesh over a floor with a precomputed lightmap",
                   "The pillar's shadow is baked into the lightmap, the mesh's is dynamic; both should look like the work of one "
                   "light, and where they meet nothing may be darkened twice. What error there is sits at the feet, where mesh and "
                   "floor are too close for a mean depth."}};
    return s;
}

scene bridge() {
    scene s;
    s.key = {{0.62f, -0.77f, 0.10f}, {0.84f, 0.76f, 0.64f}, 0.04f};
    const float floor = -1.5f;
    add_floor(s, floor, 6.5f, sand);
    add_box(s, {-3.1f, -0.22f, -0.8f}, {3.1f, 0.0f, 0.8f}, stone);
    for (const float side : {-1.0f, 1.0f})
        add_box(s, {side * 2.3f - 0.45f, floor, -0.7f}, {side * 2.3f + 0.45f, -0.22f, 0.7f}, stone);
    add_box(s, {0.02f, floor, 0.02f}, {0.08f, floor + 0.42f, 0.08f}, {0.05f, 0.035f, 0.02f}, true);
    add_box(s, {-0.01f, floor + 0.42f, -0.01f}, {0.11f, floor + 0.58f, 0.11f}, {1.0f, 0.72f, 0.25f}, true);
    s.fire = torch{{0.05f, floor + 0.50f, 0.05f}, {0.62f, 0.36f, 0.14f}};
    s.casters = {{placed({-0.75, 0.0, -0.05}, 1.2, 60.0), clay}};
    s.play_area = {{-1.6, 0.0, -0.8}, {1.6, 1.3, 0.8}};
    s.reach = {{-1.6, -1.5, -1.2}, {2.6, 0.0, 1.2}};
    s.from = {{0.55f, 2.45f, 4.5f}, {0.10f, -0.28f, 0.0f}, 0.30f};
    s.focus = {0.0f, -1.5f, 0.0f};
    s.edge_of_world = 6.5f;
    s.bounded = true;
    const std::string about = "The lightmap holds the sun and a torch that burns under the bridge; ";
    s.variants = {
        {"bridge_unbounded", "b  The paper's bridge, far bound off",
         about +
             "without a far bound the mesh also takes away light of the torch, below the deck that should have caught its shadow."},
        {"bridge_bounded", "b  The paper's bridge, far bound on",
         about + "a third channel ends every shadow at the underside of the deck, and nothing falls below.",
         gnomon::bias_towards::shadow, true}};
    return s;
}

scene translucent() {
    scene s;
    s.key = {{0.34f, -0.86f, 0.42f}, {0.95f, 0.82f, 0.64f}, 0.05f};
    s.key.cone = key_light::lamp{{-0.95f, 2.7f, -1.1f}, 0.66f, 1.2f, 4.2f};
    add_floor(s, 0.0f, 6.0f, sand);
    s.casters = {{placed({-0.62, 0.0, 0.0}, 1.0, 30.0), clay}, {placed({0.58, 0.0, 0.0}, 1.0, 30.0), glass, 0.45f}};
    s.from = {{0.1f, 2.2f, 3.1f}, {0.10f, 0.20f, 0.25f}, 0.33f};
    s.translucent = true;
    s.variants = {{"translucent", "c  A translucent caster beside an opaque one, under a lamp",
                   "The glass takes 45 % of the light wherever it is first in line, through a contribution channel of its own; its "
                   "thickness does not matter, and two layers of it count once."}};
    return s;
}

scene between() {
    scene s;
    s.key = {{0.70f, -0.68f, 0.05f}, {0.84f, 0.76f, 0.64f}, 0.04f};
    add_floor(s, 0.0f, 6.0f, sand);
    add_box(s, {-1.15f, 0.74f, -0.60f}, {0.95f, 0.80f, 0.60f}, wood);
    for (const float x : {-1.10f, 0.84f})
        for (const float z : {-0.55f, 0.49f}) add_box(s, {x, 0.0f, z}, {x + 0.06f, 0.74f, z + 0.06f}, wood);
    s.casters = {{placed({-0.55, 0.80, -0.05}, 0.95, 65.0), clay}, {placed({0.62, 0.0, 0.02}, 0.72, 15.0), slate}};
    s.play_area = {{-1.3, 0.0, -1.0}, {1.5, 1.7, 1.0}};
    s.reach = {{-1.3, 0.0, -1.0}, {2.4, 0.1, 1.0}};
    s.from = {{0.20f, 2.35f, 3.25f}, {0.02f, 0.74f, 0.0f}, 0.305f};
    s.variants = {{"between", "d  A receiver between two casters: the stated weakness",
                   "One mesh stands on the table, another under it; where both fall into one filter footprint their mean depth "
                   "decides for the table top, and its shadow there is torn at every precision: a hard edge instead of a soft one, "
                   "and a piece of it missing. The thin outline to its right is the price of 8 bits biased towards shadow."}};
    return s;
}

scene bias() {
    scene s;
    s.key = {{0.66f, -0.64f, -0.34f}, {0.84f, 0.76f, 0.64f}, 0.045f};
    add_floor(s, 0.0f, 6.0f, sand);
    s.casters = {{placed({-0.25, 0.0, 0.0}, 1.35, 20.0), clay}};
    s.play_area = {{-1.3, 0.0, -1.3}, {1.3, 1.4, 1.3}};
    s.reach = {{-2.0, 0.0, -2.0}, {2.0, 0.1, 2.0}};
    s.from = {{0.25f, 1.7f, 3.2f}, {0.12f, 0.50f, 0.0f}, 0.285f};
    s.casters_receive = true;
    const std::string about = "The mesh shadows itself here, which the method is not made for: where its surface curves, the mean "
                              "depth around it is not its own, at any precision. ";
    s.variants = {
        {"bias_light", "e  Bias towards light: a mesh that also receives",
         about + "Towards light, rounding to 8 bits adds no false shadow to that; the price is the faint rim of the shadow where "
                 "it meets the floor.",
         gnomon::bias_towards::light},
        {"bias_none", "e  No bias: a mesh that also receives",
         about + "Without bias, rounding decides wherever a surface meets its own stored depth, and 8 bits draw contour lines.",
         gnomon::bias_towards::none},
        {"bias_shadow", "e  Bias towards shadow: a mesh that also receives",
         about + "Towards shadow is right for casters that never receive, as in the rows above; here 8 bits drown the mesh in its "
                 "own shadow.",
         gnomon::bias_towards::shadow}};
    return s;
}

} // namespace

gnomon::light_frame frame_of(const scene& s, gnomon::extent size, int radius) {
    if (const auto& lamp = s.key.cone)
        return gnomon::spot_light{.position = glm::dvec3(lamp->position),
                                  .direction = glm::dvec3(s.key.direction),
                                  .outer_angle = static_cast<double>(lamp->outer_angle),
                                  .near_plane = static_cast<double>(lamp->near_plane),
                                  .far_plane = static_cast<double>(lamp->far_plane)}
            .frame(size, radius);
    gnomon::directional_light sun(glm::dvec3(s.key.direction));
    sun.add_caster(s.play_area);
    sun.add_receiver(s.reach);
    return sun.frame(size, radius);
}

std::vector<scene> all_scenes() { return {on_the_ground(), bridge(), translucent(), between(), bias()}; }

} // namespace gallery
