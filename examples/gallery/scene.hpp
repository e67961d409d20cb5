// gallery: the scenes: what stands where, what lights it, and what is to be seen in it.
#pragma once

#include "mesh.hpp"

#include <gnomon/geometry/bounds.hpp>
#include <gnomon/geometry/light_frame.hpp>
#include <gnomon/receive/bias.hpp>

#include <glm/mat4x4.hpp>

#include <optional>
#include <string>
#include <vector>

namespace gallery {

/// A flat piece of the static world: corner + a u + b v, a and b in [0, 1], seen from the side that u x v points to. Has a lightmap.
struct quad {
    glm::vec3 corner, u, v;
    glm::vec3 colour;
    bool glows = false; ///< a flame: shows its colour whatever the light, and throws no shadow

    [[nodiscard]] glm::vec3 normal() const noexcept;
};

/// The mesh somewhere: the only thing in the shadow map.
struct caster {
    glm::dmat4 model{1.0};
    glm::vec3 colour{0.0f};
    float opacity = 1.0f;
};

/// The light whose shadows move: the sun, or a lamp with a cone. Its light on the static world is precomputed.
struct key_light {
    glm::vec3 direction; ///< the way the light travels
    glm::vec3 colour;
    float softness; ///< radius of its disc as seen from the ground, in distances
    struct lamp {
        glm::vec3 position;
        float outer_angle, near_plane, far_plane;
    };
    std::optional<lamp> cone{};
};

/// A light that never casts a dynamic shadow; it exists in the lightmap only.
struct torch {
    glm::vec3 position;
    glm::vec3 colour; ///< divided by 0.35 + distance squared
};

/// One row of the contact sheet: a scene, and how gnomon is set up for it.
struct variant {
    std::string id;
    std::string title;
    std::string look_for; ///< one honest sentence
    gnomon::bias_towards towards = gnomon::bias_towards::shadow;
    bool far_bound = false;
};

/// Where the picture is taken from.
struct camera {
    glm::vec3 eye, target;
    float height_of_view; ///< tangent of half the vertical angle
};

/// A static world with precomputed light, and casters in it. Lengths are of the order of the mesh, which is one unit across.
struct scene {
    std::vector<quad> surfaces;
    std::vector<caster> casters;
    key_light key{};
    std::optional<torch> fire;
    glm::vec3 sky{0.27f, 0.31f, 0.38f};           ///< what an unhindered surface gets from above
    glm::vec3 ambient_floor{0.24f, 0.28f, 0.35f}; ///< what a dynamic shadow leaves
    gnomon::bounding_box play_area;               ///< where casters may go: covered by the map
    gnomon::bounding_box reach;                   ///< where shadows are looked at: covered by the depth range, with the play area
    camera from{};
    glm::vec3 focus{0.0f};      ///< middle of the floor
    float edge_of_world = 6.0f; ///< distance from the focus where the floor has faded into the backdrop
    bool translucent = false;
    bool bounded = false;         ///< the truth ends at the surface immediately behind a caster
    bool casters_receive = false; ///< the casters also shadow themselves
    std::vector<variant> variants;
};

/// What the shadow map of `size` texels sees, with room for a kernel of `radius`.
[[nodiscard]] gnomon::light_frame frame_of(const scene& s, gnomon::extent size, int radius);

/// All of them. Their casters are placements of one mesh.
[[nodiscard]] std::vector<scene> all_scenes();

} // namespace gallery
