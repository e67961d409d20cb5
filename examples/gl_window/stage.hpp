// gl_window: the scene, its camera, and how both are drawn with GL.
#pragma once

#include "maps.hpp"

#include <gallery/lightmap.hpp>

namespace gl_window {

/// The gallery's bridge with three casters that orbit above it, the last one of glass.
[[nodiscard]] gallery::scene orbits();
/// Where the casters are after so many seconds.
void move_casters(gallery::scene& s, double seconds);

/// Points of the static world that are turned to the light, a step apart, on the map.
[[nodiscard]] gallery::receivers points_of(const gallery::scene& s, const gnomon::light_frame& frame, float step);

/// Draws the static world with its lightmaps, and the casters, into whatever framebuffer is bound.
class stage {
  public:
    stage(const gl::context& c, const gallery::scene& s, const std::vector<gallery::lightmap>& light,
          const gnomon::light_frame& frame);

    /// Receivers are decided by this text from now on.
    void decide_by(const std::string& receive_text);
    void draw(const gl_headless::gpu_mesh& mesh, unsigned soft_texture, const glm::mat4& camera) const;

  private:
    void draw_surfaces(unsigned soft_texture, const glm::mat4& camera) const;
    void draw_casters(const gl_headless::gpu_mesh& mesh, const glm::mat4& camera) const;

    const gl::context& c_;
    const gallery::scene& scene_;
    gnomon::light_frame frame_;
    gl::program surfaces_, casters_;
    gl::vertex_array none_;
    std::vector<gl::texture> light_;
};

[[nodiscard]] glm::mat4 camera_of(const gallery::scene& s, float aspect);

} // namespace gl_window
