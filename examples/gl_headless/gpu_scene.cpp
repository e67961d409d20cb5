#include "gpu_scene.hpp"

#include <gallery/failure.hpp>

namespace gl_headless {

namespace {

gl::buffer filled(const gl::context& c, unsigned target, const void* data, std::size_t bytes) {
    auto made = gl::make_buffer(c, static_cast<std::ptrdiff_t>(bytes), data, gl::enums::static_draw);
    if (!made) throw gallery::failure(made.error().sentence);
    c.gl->BindBuffer(target, made->name());
    return *std::move(made);
}

gnomon::bounding_box around(const std::vector<glm::vec3>& positions) {
    glm::vec3 lower(std::numeric_limits<float>::infinity()), upper(-lower);
    for (const glm::vec3& p : positions) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    return {glm::dvec3(lower), glm::dvec3(upper)};
}

gpu_mesh static_world(const gl::context& c, const gallery::scene& s) {
    const gallery::static_triangles world(s);
    return {c, world.positions, world.indices};
}

} // namespace

gpu_mesh::gpu_mesh(const gl::context& c, const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices)
    : array_(c), count_(static_cast<int>(indices.size())), bounds_(around(positions)) {
    c.gl->BindVertexArray(array_.name());
    positions_ = filled(c, gl::enums::array_buffer, positions.data(), positions.size() * sizeof(glm::vec3));
    indices_ = filled(c, gl::enums::element_array_buffer, indices.data(), indices.size() * sizeof(std::uint32_t));
    c.gl->BindBuffer(gl::enums::array_buffer, positions_.name());
    c.gl->EnableVertexAttribArray(0);
    c.gl->VertexAttribPointer(0, 3, gl::enums::type_float, 0, 0, nullptr);
}

void gpu_mesh::draw(const gl::context& c) const {
    c.gl->BindVertexArray(array_.name());
    c.gl->DrawElements(gl::enums::triangles, count_, gl::enums::type_unsigned_int, nullptr);
}

gl::program linked(const gl::context& c, const std::string& fragment) {
    const std::string header(gl::glsl_header(gl::glsl_version_of(c)));
    auto made = gl::make_program(c, header + std::string(vertex_text), header + fragment);
    if (!made) throw gallery::failure(made.error().sentence);
    return *std::move(made);
}

gpu_scene::gpu_scene(const gl::context& c, const gallery::scene& s, const gallery::mesh& m, const gnomon::light_frame& frame)
    : c_(c), scene_(s), frame_(frame), mesh_(c, m.positions, m.indices), static_world_(static_world(c, s)) {}

gnomon::light_footprint gpu_scene::draw(const gl::program& by, const gpu_mesh& what, const glm::dmat4& model, float opacity) const {
    // The light as the mesh sees it: so all products of matrices are made in double.
    const gnomon::light_frame light(frame_.matrix() * model, frame_.size(), frame_.near_w(), frame_.far_w());
    const auto uniform = [&](const char* name) { return c_.gl->GetUniformLocation(by.name(), name); };
    const glm::mat4 to_clip = light.clip_matrix({});
    const glm::vec4 plane = light.depth_plane();
    c_.gl->UseProgram(by.name());
    c_.gl->UniformMatrix4fv(uniform("to_clip"), 1, 0, glm::value_ptr(to_clip));
    c_.gl->Uniform4f(uniform("depth_plane"), plane.x, plane.y, plane.z, plane.w);
    c_.gl->Uniform1i(uniform("near_plane_cuts"), light.perspective() ? 1 : 0);
    c_.gl->Uniform1f(uniform("opacity"), opacity);
    what.draw(c_);
    return footprint(what.bounds(), light);
}

} // namespace gl_headless
