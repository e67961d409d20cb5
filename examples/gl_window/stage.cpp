#include "stage.hpp"

#include <gallery/failure.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cmath>

namespace gl_window {

namespace {

constexpr const char* surface_vertex_text = R"(
uniform vec3 corner, u, v;
uniform mat4 camera, to_map;
out vec2 at;      // in the lightmap
out vec3 on_map;  // x and y in texels, depth
out vec3 world;

void main() {
    at = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    world = corner + at.x * u + at.y * v;
    on_map = (to_map * vec4(world, 1.0)).xyz;
    gl_Position = camera * vec4(world, 1.0);
}
)";
/// As the gallery shades: a shadow takes away what the lightmap has above the floor; the world fades into the backdrop.
constexpr const char* surface_main_text = R"(
in vec2 at;
in vec3 on_map, world;
uniform sampler2D soft_map, lightmap;
uniform vec3 colour, ambient_floor, focus;
uniform float edge_of_world;
uniform bool receives, glows;
layout(location = 0) out vec4 pixel;

void main() {
    vec3 light = glows ? vec3(1.0) : texture(lightmap, at).rgb;
    float shadow = receives ? gnomon_shadow_at(soft_map, on_map.xy, on_map.z) : 0.0;
    light -= shadow * max(light - ambient_floor, 0.0);
    float fade = smoothstep(0.45, 0.97, length((world - focus).xz) / edge_of_world);
    pixel = vec4(pow(mix(colour * light, vec3(0.56, 0.58, 0.59), fade), vec3(1.0 / 2.2)), 1.0);
}
)";
constexpr const char* caster_vertex_text = R"(
layout(location = 0) in vec3 position;
uniform mat4 model, camera;
out vec3 world;

void main() {
    world = vec3(model * vec4(position, 1.0));
    gl_Position = camera * vec4(world, 1.0);
}
)";
constexpr const char* caster_fragment_text = R"(
in vec3 world;
uniform vec3 colour, sky, key, to_light;
uniform float opacity;
layout(location = 0) out vec4 pixel;

void main() {
    vec3 normal = normalize(cross(dFdx(world), dFdy(world)));
    vec3 light = sky * (0.72 + 0.28 * normal.y) + key * max(dot(normal, to_light), 0.0);
    pixel = vec4(pow(colour * light, vec3(1.0 / 2.2)), opacity);
}
)";

gl::program linked(const gl::context& c, const std::string& vertex, const std::string& fragment) {
    const std::string header(gl::glsl_header(gl::glsl_version_of(c)));
    auto made = gl::make_program(c, header + vertex, header + fragment);
    if (!made) throw gallery::failure(made.error().sentence);
    return *std::move(made);
}

/// The uniforms of a program, by name.
struct uniforms {
    const gl::functions& gl;
    unsigned program;

    [[nodiscard]] int at(const char* name) const { return gl.GetUniformLocation(program, name); }
    void set(const char* name, const glm::vec3& v) const { gl.Uniform3f(at(name), v.x, v.y, v.z); }
    void set(const char* name, const glm::mat4& m) const { gl.UniformMatrix4fv(at(name), 1, 0, glm::value_ptr(m)); }
    void set(const char* name, float v) const { gl.Uniform1f(at(name), v); }
    void set(const char* name, int v) const { gl.Uniform1i(at(name), v); }
};

gl::texture texture_of(const gl::context& c, const gallery::lightmap& map) {
    auto made = gl::make_texture(c, gl::rgba16f_format, {map.width, map.height});
    if (!made) throw gallery::failure(made.error().sentence);
    c.gl->TexParameteri(gl::enums::texture_2d, gl::enums::texture_min_filter, gl::enums::linear);
    c.gl->TexParameteri(gl::enums::texture_2d, gl::enums::texture_mag_filter, gl::enums::linear);
    c.gl->TexSubImage2D(gl::enums::texture_2d, 0, 0, 0, map.width, map.height, gl::enums::rgb, gl::enums::type_float,
                        map.light.data());
    return *std::move(made);
}

bool is_lit(const gallery::scene& s, const gallery::quad& q) { return glm::dot(q.normal(), s.key.direction) < 0.0f; }

} // namespace

gallery::scene orbits() {
    gallery::scene s;
    for (gallery::scene& each : gallery::all_scenes())
        if (each.variants.front().id == "bridge_unbounded") s = std::move(each);
    s.casters.assign(3, gallery::caster{});
    s.casters[0].colour = {0.83f, 0.47f, 0.31f};
    s.casters[1].colour = {0.36f, 0.47f, 0.63f};
    s.casters[2].colour = {0.22f, 0.62f, 0.60f};
    s.casters[2].opacity = 0.45f;
    s.play_area = {{-1.7, 0.0, -1.5}, {1.7, 1.6, 1.5}};
    s.reach = {{-1.8, -1.5, -1.7}, {3.2, 0.0, 1.9}};
    move_casters(s, 0.0);
    return s;
}

void move_casters(gallery::scene& s, double seconds) {
    for (std::size_t i = 0; i < s.casters.size(); ++i) {
        const double turn = 0.6 * seconds + 2.0943951 * static_cast<double>(i) + 0.5;
        const glm::dvec3 foot(1.05 * std::cos(turn), 0.18 + 0.15 * std::sin(1.7 * turn), 0.80 * std::sin(turn));
        const glm::dmat4 there = glm::rotate(glm::translate(glm::dmat4(1.0), foot), -1.3 * turn, glm::dvec3(0.0, 1.0, 0.0));
        s.casters[i].model = glm::scale(there, glm::dvec3(0.75));
    }
}

gallery::receivers points_of(const gallery::scene& s, const gnomon::light_frame& frame, float step) {
    gallery::receivers points;
    for (const gallery::quad& q : s.surfaces) {
        if (q.glows || !is_lit(s, q)) continue;
        const float across = glm::length(q.u), along = glm::length(q.v);
        for (float a = 0.5f * step; a < across; a += step)
            for (float b = 0.5f * step; b < along; b += step) {
                const gnomon::map_point p = frame.to_map(glm::dvec3(q.corner + q.u * (a / across) + q.v * (b / along)));
                if (!(p.x >= 0 && p.y >= 0 && p.x < map_side && p.y < map_side)) continue;
                points.x.push_back(static_cast<float>(p.x));
                points.y.push_back(static_cast<float>(p.y));
                points.z.push_back(static_cast<float>(p.depth));
            }
    }
    points.slope_x.assign(points.size(), 0.0f);
    points.slope_y.assign(points.size(), 0.0f);
    return points;
}

stage::stage(const gl::context& c, const gallery::scene& s, const std::vector<gallery::lightmap>& light,
             const gnomon::light_frame& frame)
    : c_(c), scene_(s), frame_(frame), casters_(linked(c, caster_vertex_text, caster_fragment_text)), none_(c) {
    const gl::state_guard guard(c);
    for (const gallery::lightmap& each : light) light_.push_back(texture_of(c, each));
}

void stage::decide_by(const std::string& receive_text) {
    surfaces_ = linked(c_, surface_vertex_text, receive_text + surface_main_text);
}

void stage::draw(const gl_headless::gpu_mesh& mesh, unsigned soft_texture, const glm::mat4& camera) const {
    const gl::functions& gl = *c_.gl;
    const gl::state_guard guard(c_);
    constexpr std::array<float, 4> backdrop{0.769f, 0.781f, 0.787f, 1.0f};
    constexpr float farthest = 1.0f;
    gl.ClearBufferfv(gl::enums::color, 0, backdrop.data());
    gl.ClearBufferfv(gl::enums::depth, 0, &farthest);
    gl.Enable(gl::enums::depth_test);
    draw_surfaces(soft_texture, camera);
    draw_casters(mesh, camera);
}

void stage::draw_surfaces(unsigned soft_texture, const glm::mat4& camera) const {
    const gl::functions& gl = *c_.gl;
    gl.UseProgram(surfaces_.name());
    gl.BindVertexArray(none_.name());
    const uniforms u{gl, surfaces_.name()};
    u.set("camera", camera);
    u.set("to_map", glm::mat4(frame_.matrix()));
    u.set("soft_map", 0);
    u.set("lightmap", 1);
    u.set("ambient_floor", scene_.ambient_floor);
    u.set("focus", scene_.focus);
    u.set("edge_of_world", scene_.edge_of_world);
    for (std::size_t i = 0; i < scene_.surfaces.size(); ++i) {
        const gallery::quad& q = scene_.surfaces[i];
        gl::bind_textures(c_, {soft_texture, light_[i].name()});
        u.set("corner", q.corner);
        u.set("u", q.u);
        u.set("v", q.v);
        u.set("colour", q.colour);
        u.set("glows", q.glows ? 1 : 0);
        u.set("receives", is_lit(scene_, q) && !q.glows ? 1 : 0);
        gl.DrawArrays(gl::enums::triangle_strip, 0, 4);
    }
}

void stage::draw_casters(const gl_headless::gpu_mesh& mesh, const glm::mat4& camera) const {
    const gl::functions& gl = *c_.gl;
    gl.UseProgram(casters_.name());
    const uniforms u{gl, casters_.name()};
    u.set("camera", camera);
    u.set("sky", scene_.sky);
    u.set("key", scene_.key.colour);
    u.set("to_light", -glm::normalize(scene_.key.direction));
    for (const gallery::caster& each : scene_.casters) { // glass is last
        const bool glass = each.opacity < 1.0f;
        if (glass) {
            gl.Enable(gl::enums::blend);
            gl.BlendFunc(0x0302, 0x0303); // by alpha
        }
        u.set("model", glm::mat4(each.model));
        u.set("colour", each.colour);
        u.set("opacity", glass ? 0.6f : 1.0f);
        mesh.draw(c_);
    }
}

glm::mat4 camera_of(const gallery::scene& s, float aspect) {
    const glm::mat4 beside_the_panel = glm::translate(glm::mat4(1.0f), glm::vec3(0.22f, 0.0f, 0.0f));
    return beside_the_panel * glm::perspective(2.0f * std::atan(1.15f * s.from.height_of_view), aspect, 0.1f, 40.0f) *
           glm::lookAt(s.from.eye, s.from.target, glm::vec3(0.0f, 1.0f, 0.0f));
}

} // namespace gl_window
