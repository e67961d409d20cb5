// gallery: the caster: any OBJ file, or a torus knot.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace gallery {

/// Indexed triangles, one unit across at their widest, standing on y = 0 with their middle over the origin.
struct mesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; ///< one a position, the mean of its triangles; zero where they cancel
    std::vector<std::uint32_t> indices;
};

/// The mesh of an OBJ file, whatever its size and place. Throws `failure`, in one sentence, if there is no mesh in it.
[[nodiscard]] mesh load_obj(const std::string& file);

/// The same from the text of such a file; `name` is what a failure calls it.
[[nodiscard]] mesh parse_obj(const std::string& name, const std::string& text);

/// A trefoil tied in a tube: as intermingled a silhouette as one could wish, and no file needed.
[[nodiscard]] mesh torus_knot();

/// The file if one is named, else the bunny of glmark2-data if it is installed, else the torus knot.
[[nodiscard]] mesh choose_mesh(const std::string& file);

} // namespace gallery
