// gallery: rays against a scene, by Embree.
#pragma once

#include "scene.hpp"

#include <embree3/rtcore.h>

#include <memory>

namespace gallery {

/// What a ray met first.
struct ray_hit {
    float distance = 0.0f;
    int caster = -1;        ///< which caster, or -1
    int surface = -1;       ///< which quad, or -1; both -1: nothing
    glm::vec3 normal{0.0f}; ///< of the triangle, towards where the ray came from
    glm::vec3 smooth{0.0f}; ///< of a caster's vertices, interpolated; elsewhere and at sharp edges `normal`
};

class ray_world {
  public:
    /// The mesh has to live as long.
    ray_world(const scene& s, const mesh& caster_mesh);

    /// The first hit beyond `nearest`, of casters and static world.
    [[nodiscard]] ray_hit first(const glm::vec3& from, const glm::vec3& direction, float nearest = 0.0f) const;
    /// Does the *static* world block the way? That is what a lightmap may know.
    [[nodiscard]] bool blocked(const glm::vec3& from, const glm::vec3& direction, float distance) const;

  private:
    struct release {
        void operator()(RTCDevice device) const noexcept { rtcReleaseDevice(device); }
        void operator()(RTCScene scene) const noexcept { rtcReleaseScene(scene); }
    };
    using device_handle = std::unique_ptr<RTCDeviceTy, release>;
    using scene_handle = std::unique_ptr<RTCSceneTy, release>;

    [[nodiscard]] glm::vec3 smooth_normal(const RTCHit& found, const glm::vec3& flat) const;
    void add(RTCScene to, const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices) const;

    const mesh* mesh_;
    std::vector<glm::mat3> normal_matrices_;
    device_handle device_;
    scene_handle static_world_, everything_;
};

} // namespace gallery
