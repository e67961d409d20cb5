// gl_headless: a scene's triangles on the GPU, drawn into a map by a vertex stage of our own, as an engine does it.
#pragma once

#include <gallery/truth.hpp>

#include <gnomon/geometry/footprint.hpp>
#include <gnomon/gl/soft_shadow_map.hpp>

#include <glm/gtc/type_ptr.hpp>

namespace gl_headless {

namespace gl = gnomon::gl;

/// Positions and indices of a mesh, in buffers.
class gpu_mesh {
  public:
    /// Throws gallery::failure if there is no memory.
    gpu_mesh(const gl::context& c, const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices);
    void draw(const gl::context& c) const;
    /// The box around it.
    [[nodiscard]] const gnomon::bounding_box& bounds() const noexcept { return bounds_; }

  private:
    gl::vertex_array array_;
    gl::buffer positions_, indices_;
    int count_;
    gnomon::bounding_box bounds_;
};

/// Where a mesh is drawn: position -> clip space, and unit depth. Depths in front of a lamp's near plane are no caster's.
inline constexpr std::string_view vertex_text = R"(
layout(location = 0) in vec3 position;
uniform mat4 to_clip;
uniform vec4 depth_plane;
out float depth;

void main() {
    gl_Position = to_clip * vec4(position, 1.0);
    gl_Position.z = 0.0; // the pass writes a depth of its own, and what lies before the sun's near plane casts, too
    depth = dot(depth_plane, vec4(position, 1.0));
}
)";
inline constexpr std::string_view caster_main_text = R"(
in float depth;
uniform bool near_plane_cuts;
uniform float opacity;

void main() {
    if (near_plane_cuts && depth < 0.0) discard;
    gnomon_caster(depth@opacity);
}
)";
inline constexpr std::string_view bound_main_text = R"(
in float depth;

void main() {
    if (depth < 0.0) discard;
    gnomon_bound(depth);
}
)";

/// A fragment stage, linked to our vertex stage. Throws gallery::failure with the driver's words.
[[nodiscard]] gl::program linked(const gl::context& c, const std::string& fragment);

/// What draws casters, and what bounds them, into maps of one texel. Throws gallery::failure if it does not compile.
template <gnomon::texel_format Texel> struct caster_programs {
    gl::program casters, bounds;

    explicit caster_programs(const gl::context& c) {
        std::string main(caster_main_text);
        main.replace(main.find("@opacity"), 8, Texel::effects.translucency ? ", opacity" : "");
        casters = linked(c, gl::caster_text<Texel>() + main);
        if constexpr (Texel::effects.far_bound) bounds = linked(c, gl::caster_text<Texel>() + std::string(bound_main_text));
    }
};

/// The triangles of a scene, for as long as it and a context live; its casters may move.
class gpu_scene {
  public:
    gpu_scene(const gl::context& c, const gallery::scene& s, const gallery::mesh& m, const gnomon::light_frame& frame);

    /// Casts the scene into a map, and bounds it where the map can be bounded.
    template <gnomon::texel_format Texel, gnomon::kernel Kernel>
    void cast_into(gnomon::soft_shadow_map<Texel, Kernel, gl::backend>& map, const caster_programs<Texel>& by) const {
        for (const gallery::caster& each : scene_.casters)
            map.cast([&](const gl::map_targets&) { return draw(by.casters, mesh_, each.model, each.opacity); });
        if constexpr (Texel::effects.far_bound)
            map.bound([&](const gl::map_targets&) { draw(by.bounds, static_world_, glm::dmat4(1.0), 1.0f); },
                      gl::faces_drawn::averted);
    }
    [[nodiscard]] const gpu_mesh& mesh() const noexcept { return mesh_; }

  private:
    /// Draws a mesh by a program, and says what of the map it can touch.
    gnomon::light_footprint draw(const gl::program& by, const gpu_mesh& what, const glm::dmat4& model, float opacity) const;

    const gl::context& c_;
    const gallery::scene& scene_;
    gnomon::light_frame frame_;
    gpu_mesh mesh_, static_world_;
};

} // namespace gl_headless
