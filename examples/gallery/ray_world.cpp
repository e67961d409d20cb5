#include "ray_world.hpp"

#include "failure.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gallery {

namespace {
/// Embree numbers geometries in the order they are attached: the static world, then the casters.
constexpr unsigned static_world = 0;

std::vector<glm::vec3> corners_of(const std::vector<quad>& surfaces) {
    std::vector<glm::vec3> corners;
    for (const quad& q : surfaces) corners.insert(corners.end(), {q.corner, q.corner + q.u, q.corner + q.u + q.v, q.corner + q.v});
    return corners;
}

std::vector<std::uint32_t> triangles_of(const std::vector<quad>& surfaces) {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < 4 * surfaces.size(); i += 4) indices.insert(indices.end(), {i, i + 1, i + 2, i, i + 2, i + 3});
    return indices;
}

RTCRay ray(const glm::vec3& from, const glm::vec3& direction, float nearest, float farthest) {
    RTCRay r{};
    r.org_x = from.x;
    r.org_y = from.y;
    r.org_z = from.z;
    r.dir_x = direction.x;
    r.dir_y = direction.y;
    r.dir_z = direction.z;
    r.tnear = nearest;
    r.tfar = farthest;
    r.mask = ~0u;
    return r;
}
} // namespace

ray_world::ray_world(const scene& s, const mesh& caster_mesh) : mesh_(&caster_mesh), device_(rtcNewDevice(nullptr)) {
    if (!device_) throw failure("Embree finds no way to run on this machine");
    static_world_.reset(rtcNewScene(device_.get()));
    everything_.reset(rtcNewScene(device_.get()));
    std::vector<quad> solid; // a flame throws no shadow
    for (const quad& q : s.surfaces)
        if (!q.glows) solid.push_back(q);
    add(static_world_.get(), corners_of(solid), triangles_of(solid));
    add(everything_.get(), corners_of(s.surfaces), triangles_of(s.surfaces));
    for (const caster& c : s.casters) {
        std::vector<glm::vec3> placed;
        for (const glm::vec3& p : caster_mesh.positions) placed.emplace_back(c.model * glm::dvec4(glm::dvec3(p), 1.0));
        add(everything_.get(), placed, caster_mesh.indices);
        normal_matrices_.emplace_back(glm::transpose(glm::inverse(glm::dmat3(c.model))));
    }
    rtcCommitScene(static_world_.get());
    rtcCommitScene(everything_.get());
}

void ray_world::add(RTCScene to, const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices) const {
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), positions.size());
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
                                              indices.size() / 3);
    if (!vertices || !triangles) throw failure("Embree has no memory left for this mesh");
    std::copy(positions.begin(), positions.end(), static_cast<glm::vec3*>(vertices));
    std::copy(indices.begin(), indices.end(), static_cast<std::uint32_t*>(triangles));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(to, geometry);
    rtcReleaseGeometry(geometry);
}

ray_hit ray_world::first(const glm::vec3& from, const glm::vec3& direction, float nearest) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit found{ray(from, direction, nearest, std::numeric_limits<float>::infinity()), {}};
    found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(everything_.get(), &context, &found);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};

    ray_hit hit{.distance = found.ray.tfar};
    hit.normal = glm::normalize(glm::vec3(found.hit.Ng_x, found.hit.Ng_y, found.hit.Ng_z));
    if (glm::dot(hit.normal, direction) > 0.0f) hit.normal = -hit.normal;
    hit.smooth = hit.normal;
    if (found.hit.geomID == static_world) {
        hit.surface = static_cast<int>(found.hit.primID / 2);
        return hit;
    }
    hit.caster = static_cast<int>(found.hit.geomID - 1);
    hit.smooth = smooth_normal(found.hit, hit.normal);
    return hit;
}

glm::vec3 ray_world::smooth_normal(const RTCHit& found, const glm::vec3& flat) const {
    const glm::mat3& to_world = normal_matrices_[found.geomID - 1];
    const float weights[3] = {1.0f - found.u - found.v, found.u, found.v};
    glm::vec3 sum(0.0f);
    for (std::size_t i = 0; i < 3; ++i) {
        glm::vec3 normal = to_world * mesh_->normals[mesh_->indices[3 * static_cast<std::size_t>(found.primID) + i]];
        if (!(glm::length(normal) > 0.0f)) return flat;
        normal = glm::normalize(normal);
        const float along = glm::dot(normal, flat);
        if (!(std::abs(along) > 0.7f)) return flat;                // an edge, and meant to be one
        sum += normal * (along < 0.0f ? -weights[i] : weights[i]); // whichever way the mesh is wound
    }
    return glm::normalize(sum);
}

bool ray_world::blocked(const glm::vec3& from, const glm::vec3& direction, float distance) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay r = ray(from, direction, 1e-4f, distance);
    rtcOccluded1(static_world_.get(), &context, &r);
    return r.tfar < 0.0f;
}

} // namespace gallery
