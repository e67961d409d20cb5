// gl_engine: gnomon inside a renderer that has a life of its own: its function table, its state cache, its passes, its shaders.
//
//   each frame: gnomon clears, casts (by the engine's draws) and filters -> the engine is told what that touched -> it draws the scene,
//   whose ground asks gnomon's text how dark it is.
#include "headless_gl.hpp"

#include <gnomon/geometry/footprint.hpp>
#include <gnomon/gl/soft_shadow_map.hpp>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <vector>

// --- the engine ----------------------------------------------------------------------------------------------------------------
namespace {
namespace engine {

// clang-format off
#define ENGINE_FUNCTIONS(X) \
    X(void, Enable, unsigned) X(void, Disable, unsigned) X(unsigned char, IsEnabled, unsigned) X(void, GetIntegerv, unsigned, int*) \
    X(void, DepthFunc, unsigned) X(void, Viewport, int, int, int, int) X(void, ClearColor, float, float, float, float) \
    X(void, ClearDepthf, float) X(void, Clear, unsigned) X(void, UseProgram, unsigned) X(void, BindVertexArray, unsigned) \
    X(void, BindFramebuffer, unsigned, unsigned) X(void, ActiveTexture, unsigned) X(void, BindTexture, unsigned, unsigned) \
    X(void, BindBuffer, unsigned, unsigned) X(void, DrawArrays, unsigned, int, int) \
    X(void, ReadPixels, int, int, int, int, unsigned, unsigned, void*) X(void, GenTextures, int, unsigned*) \
    X(void, TexImage2D, unsigned, int, int, int, int, int, unsigned, unsigned, const void*) X(void, TexParameteri, unsigned, unsigned, int) \
    X(void, GenFramebuffers, int, unsigned*) X(void, FramebufferTexture2D, unsigned, unsigned, unsigned, unsigned, int) \
    X(void, GenVertexArrays, int, unsigned*) X(void, GenBuffers, int, unsigned*) \
    X(void, BufferData, unsigned, std::ptrdiff_t, const void*, unsigned) X(void, EnableVertexAttribArray, unsigned) \
    X(void, VertexAttribPointer, unsigned, int, unsigned, unsigned char, int, const void*) X(unsigned, CreateShader, unsigned) \
    X(void, ShaderSource, unsigned, int, const char* const*, const int*) X(void, CompileShader, unsigned) X(unsigned, CreateProgram) \
    X(void, AttachShader, unsigned, unsigned) X(void, LinkProgram, unsigned) X(void, GetProgramiv, unsigned, unsigned, int*) \
    X(int, GetUniformLocation, unsigned, const char*) X(void, UniformMatrix4fv, int, int, unsigned char, const float*) \
    X(void, Uniform1i, int, int)
// clang-format on

/// The engine's own table of GL.
struct api {
#define X(result, name, ...) result (*name)(__VA_ARGS__) = nullptr;
    ENGINE_FUNCTIONS(X)
#undef X
    explicit api(const headless_gl& from) {
#define X(result, name, ...) name = reinterpret_cast<decltype(name)>(from.get_proc_address("gl" #name));
        ENGINE_FUNCTIONS(X)
#undef X
    }
};

enum : unsigned {
    texture_2d = 0x0DE1,
    rgba = 0x1908,
    unsigned_byte = 0x1401,
    framebuffer = 0x8D40,
    array_buffer = 0x8892,
    depth_test = 0x0B71,
    cull_face = 0x0B44,
    blend = 0x0BE2,
    greater = 0x0204,
    triangles = 0x0004,
    color_buffer_bit = 0x4000,
    depth_buffer_bit = 0x0100,
};

/// Remembers what GL was told, and does not tell it twice.
class state_cache {
  public:
    explicit state_cache(const api& gl) : gl_(gl) {}

    int asked = 0, told = 0; ///< how often the engine wanted a state, and how often GL had to hear of it

    void program(unsigned name) {
        set(program_, name, [&] { gl_.UseProgram(name); });
    }
    void vertices(unsigned name) {
        set(vertices_, name, [&] { gl_.BindVertexArray(name); });
    }
    void target(unsigned name) {
        set(target_, name, [&] { gl_.BindFramebuffer(framebuffer, name); });
    }
    void depth_function(unsigned which) {
        set(depth_function_, which, [&] { gl_.DepthFunc(which); });
    }
    void viewport(int width, int height) {
        set(viewport_, std::array{0, 0, width, height}, [&] { gl_.Viewport(0, 0, width, height); });
    }
    void enabled(unsigned what, bool on) {
        set(enabled_[what], on, [&] { on ? gl_.Enable(what) : gl_.Disable(what); });
    }
    void texture(unsigned unit, unsigned name) {
        set(texture_[unit], name, [&] {
            gl_.ActiveTexture(0x84C0 + unit);
            gl_.BindTexture(texture_2d, name);
        });
    }

    /// What gnomon's state_policy::dirty lists, as far as it is remembered here. Textures of the units beyond the fourth stay known.
    void forget_what_gnomon_touches() {
        program_.reset();
        vertices_.reset();
        target_.reset();
        depth_function_.reset();
        viewport_.reset();
        for (auto& [what, on] : enabled_) on.reset();
        for (auto& [unit, name] : texture_)
            if (unit < 4) name.reset();
    }

    /// A debug engine's check: does GL say the same? Leaves the active unit dirty, as `texture` does.
    [[nodiscard]] bool is_right() const {
        const auto value = [&](unsigned name) {
            int v[4] = {};
            gl_.GetIntegerv(name, v);
            return std::array{v[0], v[1], v[2], v[3]};
        };
        const auto agrees = [&](const std::optional<unsigned>& known, unsigned name) {
            return !known || *known == static_cast<unsigned>(value(name)[0]);
        };
        bool right = agrees(program_, 0x8B8D) && agrees(vertices_, 0x85B5) && agrees(target_, 0x8CA6) &&
                     agrees(depth_function_, 0x0B74) && (!viewport_ || *viewport_ == value(0x0BA2));
        for (const auto& [what, on] : enabled_) right = right && (!on || *on == (gl_.IsEnabled(what) != 0));
        for (const auto& [unit, name] : texture_) {
            gl_.ActiveTexture(0x84C0 + unit);
            right = right && agrees(name, 0x8069);
        }
        return right;
    }

  private:
    template <typename T, typename Tell> void set(std::optional<T>& known, const T& wanted, Tell&& tell) {
        ++asked;
        if (known == wanted) return;
        ++told;
        tell();
        known = wanted;
    }

    const api& gl_;
    std::optional<unsigned> program_{}, vertices_{}, target_{}, depth_function_{};
    std::optional<std::array<int, 4>> viewport_{};
    std::map<unsigned, std::optional<bool>> enabled_{};
    std::map<unsigned, std::optional<unsigned>> texture_{};
};

unsigned make_texture(const api& gl, int internal, unsigned format, unsigned type, int size, const void* texels) {
    unsigned name = 0;
    gl.GenTextures(1, &name);
    gl.ActiveTexture(0x84C0);
    gl.BindTexture(texture_2d, name);
    gl.TexImage2D(texture_2d, 0, internal, size, size, 0, format, type, texels);
    gl.TexParameteri(texture_2d, 0x2801, 0x2600); // no mipmaps
    return name;
}

unsigned make_program(const api& gl, const std::string& vertex, const std::string& fragment) {
    const unsigned name = gl.CreateProgram();
    for (const auto& [stage, text] : {std::pair{0x8B31u, &vertex}, std::pair{0x8B30u, &fragment}}) {
        const unsigned shader = gl.CreateShader(stage);
        const char* const start = text->c_str();
        gl.ShaderSource(shader, 1, &start, nullptr);
        gl.CompileShader(shader);
        gl.AttachShader(name, shader);
    }
    gl.LinkProgram(name);
    int linked = 0;
    gl.GetProgramiv(name, 0x8B82, &linked);
    return linked != 0 ? name : 0;
}

/// A flat square, its corners in the world: all there is to draw here.
unsigned make_square(const api& gl, const glm::vec3& lower, const glm::vec3& upper) {
    const std::array<glm::vec3, 6> corners{{lower, {lower.x, lower.y, upper.z}, upper, lower, upper, {upper.x, lower.y, lower.z}}};
    unsigned array = 0, buffer = 0;
    gl.GenVertexArrays(1, &array);
    gl.BindVertexArray(array);
    gl.GenBuffers(1, &buffer);
    gl.BindBuffer(array_buffer, buffer);
    gl.BufferData(array_buffer, sizeof corners, corners.data(), 0x88E4);
    gl.EnableVertexAttribArray(0);
    gl.VertexAttribPointer(0, 3, 0x1406, 0, 0, nullptr);
    return array;
}

} // namespace engine
} // namespace

// --- its shadows ----------------------------------------------------------------------------------------------------------------
namespace {

using namespace gnomon;
using texel_type = rg16;
using kernel_type = binomial<3>;

constexpr int screen = 64, map_side = 128, frames = 3; // pixels, and units of the world; texels

constexpr const char* vertex_text = R"(
layout(location = 0) in vec3 position;
uniform mat4 model, to_clip, to_map;
out vec3 on_map; // x and y in texels, depth

void main() {
    vec4 world = model * vec4(position, 1.0);
    gl_Position = to_clip * world;
    on_map = (to_map * world).xyz;
}
)";
constexpr const char* caster_text = "\nin vec3 on_map;\nvoid main() { gnomon_caster(on_map.z); }\n";
constexpr const char* plain_text =
    "\nin vec3 on_map;\nlayout(location = 0) out vec4 colour;\nvoid main() { colour = vec4(0.0, 0.0, 1.0, 1.0); }\n";
constexpr const char* ground_text = R"(
in vec3 on_map;
uniform sampler2D soft_map, paint;
layout(location = 0) out vec4 colour;

void main() {
    float light = 1.0 - gnomon_shadow_at(soft_map, on_map.xy, on_map.z);
    colour = vec4(light * texture(paint, on_map.xy / 128.0).rgb, 1.0);
}
)";

/// The sun shines along x and down, and 32 units above the ground its depth is 0.
light_frame sunlight() {
    glm::dmat4 slanted(1.0); // x of the map is x + y of the world, its y is z
    slanted[0] = {2.0 / screen, 0.0, 0.0, 0.0};
    slanted[1] = {2.0 / screen, 0.0, -2.0 / 32.0, 0.0};
    slanted[2] = {0.0, 2.0 / screen, 0.0, 0.0};
    slanted[3] = {-1.0, -1.0, 1.0, 1.0};
    return light_frame::from_matrix(slanted, {map_side, map_side}, {});
}

class renderer {
  public:
    renderer(const headless_gl& display, const gl::context& context)
        : gl_(display), cache_(gl_), shadows_({.width = map_side, .height = map_side}, gl::backend(context)), light_(sunlight()) {
        const std::string header(gl::glsl_header(gl::glsl_version_of(context))); // the engine's own would do as well
        const auto program = [&](const std::string& fragment) {
            return make_program(gl_, header + vertex_text, header + fragment);
        };
        casts_ = program(gl::caster_text<texel_type>() + caster_text);
        receives_ = program(gl::receive_text<texel_type>(shadows_.decision) + ground_text);
        plain_ = program(plain_text);
        ground_ = engine::make_square(gl_, {0.0f, 0.0f, 0.0f}, {screen, 0.0f, screen});
        box_ = engine::make_square(gl_, {0.0f, 0.0f, 0.0f}, {16.0f, 0.0f, 16.0f});
        const std::array<unsigned char, 4> white{255, 255, 255, 255};
        paint_ = engine::make_texture(gl_, 0x8058, engine::rgba, engine::unsigned_byte, 1, white.data());
        const unsigned colour = engine::make_texture(gl_, 0x8058, engine::rgba, engine::unsigned_byte, screen, nullptr),
                       depth = engine::make_texture(gl_, 0x81A6, 0x1902, 0x1405, screen, nullptr);
        gl_.GenFramebuffers(1, &target_);
        gl_.BindFramebuffer(engine::framebuffer, target_);
        gl_.FramebufferTexture2D(engine::framebuffer, 0x8CE0, engine::texture_2d, colour, 0);
        gl_.FramebufferTexture2D(engine::framebuffer, 0x8D00, engine::texture_2d, depth, 0);
        gl_.ClearColor(0.0f, 1.0f, 0.0f, 1.0f);
        gl_.ClearDepthf(0.0f); // the engine's depth is reversed
    }

    /// Empty, or why nothing can be drawn.
    [[nodiscard]] std::string problem() const {
        if (shadows_.problem()) return shadows_.problem().sentence;
        return casts_ != 0 && receives_ != 0 && plain_ != 0 ? "" : "the engine's shaders do not compile";
    }

    /// Draws the box with its corner at `corner`, and its shadow on the ground.
    void draw(const glm::vec3& corner) {
        const glm::mat4 moved = glm::translate(glm::mat4(1.0f), corner);
        shadows_.clear();
        shadows_.cast([&](const gl::map_targets&) {
            cache_.forget_what_gnomon_touches(); // the pass is set up; the cache only learns of what the engine sets itself
            draw_mesh(casts_, box_, moved, light_.clip_matrix({}));
            return footprint(bounding_box{corner, corner + glm::vec3(16.0f, 0.0f, 16.0f)}, light_);
        });
        shadows_.filter();
        cache_.forget_what_gnomon_touches();
        check();

        cache_.target(target_);
        cache_.viewport(screen, screen);
        cache_.enabled(engine::depth_test, true);
        cache_.enabled(engine::blend, false);
        cache_.enabled(engine::cull_face, false);
        cache_.depth_function(engine::greater);
        gl_.Clear(engine::color_buffer_bit | engine::depth_buffer_bit);
        cache_.texture(0, shadows_.soft_texture());
        cache_.texture(5, paint_);
        const glm::mat4 camera =
            glm::scale(glm::translate(glm::mat4(1.0f), {-1.0f, -1.0f, 0.0f}), glm::vec3(2.0f / screen)) *
            glm::mat4(glm::vec4(1, 0, 0, 0), glm::vec4(0, 0, 1, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, 0, 1));
        draw_mesh(receives_, ground_, glm::mat4(1.0f), camera);
        draw_mesh(plain_, box_, moved, camera);
        check();
    }

    /// Red is light; blue is the box.
    [[nodiscard]] std::vector<std::array<unsigned char, 4>> pixels() {
        std::vector<std::array<unsigned char, 4>> read(static_cast<std::size_t>(screen * screen));
        cache_.target(target_);
        gl_.ReadPixels(0, 0, screen, screen, engine::rgba, engine::unsigned_byte, read.data());
        return read;
    }

    [[nodiscard]] const engine::state_cache& cache() const { return cache_; }
    int checks = 0, right = 0;

  private:
    void draw_mesh(unsigned program, unsigned mesh, const glm::mat4& model, const glm::mat4& to_clip) {
        const glm::mat4 to_map(light_.matrix());
        const auto matrix = [&](const char* name, const glm::mat4& m) {
            gl_.UniformMatrix4fv(gl_.GetUniformLocation(program, name), 1, 0, glm::value_ptr(m));
        };
        cache_.program(program);
        cache_.vertices(mesh);
        matrix("model", model);
        matrix("to_clip", to_clip);
        matrix("to_map", to_map);
        gl_.Uniform1i(gl_.GetUniformLocation(program, "soft_map"), 0);
        gl_.Uniform1i(gl_.GetUniformLocation(program, "paint"), 5);
        gl_.DrawArrays(engine::triangles, 0, 6);
    }
    void check() {
        ++checks;
        right += cache_.is_right() ? 1 : 0;
        gl_.ActiveTexture(0x84C0);
    }

    engine::api gl_;
    engine::state_cache cache_;
    soft_shadow_map<texel_type, kernel_type, gl::backend> shadows_;
    light_frame light_;
    unsigned casts_ = 0, receives_ = 0, plain_ = 0, ground_ = 0, box_ = 0, paint_ = 0, target_ = 0;
};

/// What the CPU says about the same box and every pixel of the ground, counted: pixels of ground, in the umbra, in the penumbra, and
/// those that are not within a step of 255.
struct verdict {
    int ground = 0, dark = 0, half_dark = 0, wrong = 0;

    void add(const std::vector<std::array<unsigned char, 4>>& pixels, const glm::ivec3& corner) {
        soft_shadow_map<texel_type, kernel_type> cpu({.width = map_side, .height = map_side});
        const texel_rect shadow{2 * (corner.x + corner.y), 2 * corner.z, 2 * (corner.x + corner.y) + 32, 2 * corner.z + 32};
        cpu.cast(shadow, 1.0f - static_cast<float>(corner.y) / 32.0f);
        cpu.filter();
        for (int i = 0; i < screen * screen; ++i) {
            const auto& pixel = pixels[static_cast<std::size_t>(i)];
            if (pixel[2] == 255 && pixel[0] == 0 && pixel[1] == 0) continue;
            const float x = 2.0f * static_cast<float>(i % screen) + 1.0f, y = 2.0f * static_cast<float>(i / screen) + 1.0f;
            const float expected = 255.0f * (1.0f - cpu.shadow_at(x, y, 1.0f));
            ++ground;
            dark += pixel[0] == 0 ? 1 : 0;
            half_dark += pixel[0] > 0 && pixel[0] < 255 ? 1 : 0;
            wrong += std::abs(expected - static_cast<float>(pixel[0])) > 1.0f ? 1 : 0;
        }
    }
};

int give_up(const std::string& why) {
    std::fprintf(stderr, "gnomon_gl_engine: %s\n", why.c_str());
    return 1;
}

} // namespace

int main() {
    const headless_gl display(headless_gl::api::desktop, 33);
    if (!display) return give_up(display.why_not());
    const gl::functions functions = gl::load([&](const char* name) { return display.get_proc_address(name); });
    const auto context = gl::context::of(functions);
    if (!context) return give_up(context.error().sentence);
    renderer scene(display, *context);
    if (const std::string why = scene.problem(); !why.empty()) return give_up(why);
    verdict seen;
    for (int i = 0; i < frames; ++i) {
        const glm::ivec3 corner(4 + 7 * i, 8, 20 + 5 * i);
        scene.draw(glm::vec3(corner));
        seen.add(scene.pixels(), corner);
    }
    std::printf(
        "%d pixels of ground, %d dark, %d half dark, %d not as on the CPU; cache right %d times of %d, %d of %d states told\n",
        seen.ground, seen.dark, seen.half_dark, seen.wrong, scene.right, scene.checks, scene.cache().told, scene.cache().asked);
    return 0;
}
