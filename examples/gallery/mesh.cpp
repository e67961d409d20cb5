#include "mesh.hpp"

#include "failure.hpp"

#include <tiny_obj_loader.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace gallery {

namespace {

constexpr const char* bunny = "/usr/share/glmark2/models/bunny.obj";

/// Faces as they come, in double: a unit mesh far from the origin must not lose its shape before it is moved there.
struct raw_mesh {
    std::vector<glm::dvec3> positions;
    std::vector<std::uint32_t> indices;
};

failure unreadable(const std::string& name, const std::string& why) {
    return failure("cannot read the mesh '" + name + "': " + why);
}

/// Triangles from the vertices and faces of an OBJ file.
///
/// tinyobjloader sees no other line: for a `vw` line it casts whatever number is there to int. The vertices are read here, since it
/// would round them to float, and take for 0 what is no number.
raw_mesh read(const std::string& name, const std::string& text) {
    raw_mesh raw;
    std::string vertices_and_faces;
    int number = 1;
    for (std::size_t at = 0, next = 0; at < text.size(); at = next, ++number) {
        const std::size_t end = (std::min)(text.find_first_of("\r\n", at), text.size());
        next = end + (text.compare(end, 2, "\r\n") == 0 ? 2 : 1);
        const std::size_t key = text.find_first_not_of(" \t", at);
        if (key >= end || (text[key] != 'v' && text[key] != 'f')) continue;
        if (key + 1 < end && text[key + 1] != ' ' && text[key + 1] != '\t') continue; // vn, vt and others
        const std::string line = text.substr(key, end - key);
        vertices_and_faces.append(line).push_back('\n');
        if (line[0] != 'v') continue;
        std::istringstream words(line.substr(1));
        glm::dvec3 p(0.0);
        if (!(words >> p.x >> p.y >> p.z))
            throw unreadable(name, "line " + std::to_string(number) + " is a vertex without three finite numbers");
        raw.positions.push_back(p);
    }
    tinyobj::ObjReaderConfig config;
    config.vertex_color = false;
    tinyobj::ObjReader reader;
    if (!reader.ParseFromString(vertices_and_faces, {}, config) || reader.GetAttrib().vertices.size() != 3 * raw.positions.size())
        throw unreadable(name, "it is no OBJ file that can be opened and parsed");
    for (const tinyobj::shape_t& shape : reader.GetShapes())
        for (const tinyobj::index_t& index : shape.mesh.indices)
            raw.indices.push_back(static_cast<std::uint32_t>(index.vertex_index));
    return raw;
}

/// Leaves out triangles that name a missing or an enormous position, and those without an area.
void keep_sound_triangles(raw_mesh& raw) {
    const auto sound = [&raw](const std::uint32_t* corner) {
        constexpr double reach = 1e150; // squares must stay finite
        for (int i = 0; i < 3; ++i) {
            if (corner[i] >= raw.positions.size()) return false;
            const glm::dvec3 p = glm::abs(raw.positions[corner[i]]);
            if (!(p.x < reach && p.y < reach && p.z < reach)) return false;
        }
        const glm::dvec3 &a = raw.positions[corner[0]], &b = raw.positions[corner[1]], &c = raw.positions[corner[2]];
        return glm::length(glm::cross(b - a, c - a)) > 0.0;
    };
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i + 2 < raw.indices.size(); i += 3)
        if (const std::uint32_t* corner = raw.indices.data() + i; sound(corner)) kept.insert(kept.end(), corner, corner + 3);
    raw.indices = kept;
}

std::vector<glm::vec3> smooth_normals(const mesh& m) {
    std::vector<glm::dvec3> sums(m.positions.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i < m.indices.size(); i += 3) {
        const glm::dvec3 a(m.positions[m.indices[i]]), b(m.positions[m.indices[i + 1]]), c(m.positions[m.indices[i + 2]]);
        const glm::dvec3 twice_area = glm::cross(b - a, c - a);
        for (std::size_t k = 0; k < 3; ++k) sums[m.indices[i + k]] += twice_area;
    }
    std::vector<glm::vec3> normals;
    for (const glm::dvec3& sum : sums) normals.emplace_back(glm::length(sum) > 0.0 ? glm::normalize(sum) : glm::dvec3(0.0));
    return normals;
}

/// Moved and scaled so that scenes can be laid out without knowing the mesh.
mesh normalised(const std::string& name, raw_mesh raw) {
    keep_sound_triangles(raw);
    if (raw.indices.empty()) throw failure("the mesh '" + name + "' has no triangle to draw");
    glm::dvec3 lower = raw.positions[raw.indices[0]], upper = lower;
    for (const std::uint32_t i : raw.indices) {
        lower = glm::min(lower, raw.positions[i]);
        upper = glm::max(upper, raw.positions[i]);
    }
    const glm::dvec3 extent = upper - lower;
    const double size = (std::max)({extent.x, extent.y, extent.z});

    mesh m{.name = name, .positions = {}, .normals = {}, .indices = std::move(raw.indices)};
    const glm::dvec3 foot((lower.x + upper.x) / 2, lower.y, (lower.z + upper.z) / 2);
    for (const glm::dvec3& p : raw.positions)
        m.positions.emplace_back(glm::clamp((p - foot) / size, glm::dvec3(-1.0), glm::dvec3(1.0)));
    m.normals = smooth_normals(m);
    return m;
}

} // namespace

mesh parse_obj(const std::string& name, const std::string& text) { return normalised(name, read(name, text)); }

mesh load_obj(const std::string& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) throw unreadable(file, "there is no such file");
    if (std::filesystem::is_directory(file, error)) throw unreadable(file, "it is a folder");
    const std::ifstream stream(file, std::ios::binary);
    if (!stream) throw unreadable(file, "it is no OBJ file that can be opened and parsed");
    std::ostringstream text;
    text << stream.rdbuf();
    return parse_obj(file, text.str());
}

mesh torus_knot() {
    constexpr std::uint32_t along = 400, around = 32;
    constexpr double thickness = 0.42;
    const auto knot = [](double t) {
        const double a = 2.0 * glm::two_pi<double>() * t, b = 3.0 * glm::two_pi<double>() * t, r = 2.0 + std::cos(b);
        return glm::dvec3(r * std::cos(a), r * std::sin(a), -std::sin(b));
    };
    raw_mesh raw;
    for (std::uint32_t i = 0; i < along; ++i) {
        const double t = static_cast<double>(i) / along;
        const glm::dvec3 centre = knot(t), forward = glm::normalize(knot(t + 1e-4) - centre);
        const glm::dvec3 side = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 0.0, 1.0))), upward = glm::cross(side, forward);
        for (std::uint32_t j = 0; j < around; ++j) {
            const double turn = glm::two_pi<double>() * j / around;
            raw.positions.push_back(centre + thickness * (std::cos(turn) * side + std::sin(turn) * upward));
            const std::uint32_t here = i * around + j, beside = i * around + (j + 1) % around;
            const std::uint32_t next = (i + 1) % along * around + j, across = (i + 1) % along * around + (j + 1) % around;
            for (const std::uint32_t index : {here, beside, across, here, across, next}) raw.indices.push_back(index);
        }
    }
    return normalised("torus knot", std::move(raw));
}

mesh choose_mesh(const std::string& file) {
    if (!file.empty()) return load_obj(file);
    std::error_code ignored;
    return std::filesystem::exists(bunny, ignored) ? load_obj(bunny) : torus_knot();
}

} // namespace gallery
