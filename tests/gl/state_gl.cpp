#include <gnomon/gl/program.hpp>
#include <gnomon/gl/state.hpp>

#include "../support/egl.hpp"
#include "../support/gl_state.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace gl = gnomon::gl;
namespace enums = gnomon::gl::enums;

namespace {

constexpr int units = 4, width = 13, height = 7;

std::string header(const gl::context& c) { return c.es ? "#version 300 es\nprecision highp float;\n" : "#version 330 core\n"; }

gl::program program_of(const gl::context& c, const char* vertex, const char* fragment) {
    auto made = gl::make_program(c, header(c) + vertex, header(c) + fragment);
    REQUIRE_MESSAGE(static_cast<bool>(made), made.error().sentence);
    return *std::move(made);
}
constexpr const char* whole_map =
    "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.5, 1.0); }\n";
/// Reads a texel of the map uploaded before and adds where it is: upload, sampling and every fragment show in what is read back.
constexpr const char* shift = "uniform sampler2D map;\nout vec4 color;\nvoid main() {\n    ivec2 at = ivec2(gl_FragCoord.xy);\n"
                              "    color = texelFetch(map, at, 0) + vec4(at.x, at.y, 0, 0) / 255.0;\n}\n";

/// Uploads, draws and reads back as passes do. The bytes are RGBA.
std::vector<std::uint8_t> drawn(const gl::context& c) {
    const gl::functions& f = *c.gl;
    const gl::program shader = program_of(c, whole_map, shift);
    const gl::vertex_array corners(c);
    const auto from = gl::make_texture(c, gl::rgba8_format, {width, height}),
               to = gl::make_texture(c, gl::rgba8_format, {width, height});
    REQUIRE((from && to));
    std::vector<std::uint8_t> texels(4 * width * height);
    for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<std::uint8_t>(i * 7 % 200);
    f.BindTexture(enums::texture_2d, from->name());
    f.TexSubImage2D(enums::texture_2d, 0, 0, 0, width, height, enums::rgba, enums::type_unsigned_byte, texels.data());
    const auto frame = gl::make_framebuffer(c, {to->name()});
    REQUIRE(frame);
    f.BindVertexArray(corners.name());
    f.Viewport(0, 0, width, height);
    f.UseProgram(shader.name());
    f.DrawArrays(enums::triangles, 0, 3);
    f.ReadPixels(0, 0, width, height, enums::rgba, enums::type_unsigned_byte, texels.data());
    f.UseProgram(0);
    return texels;
}

std::vector<std::uint8_t> expected() {
    std::vector<std::uint8_t> texels(4 * width * height);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const std::size_t x = i / 4 % width, y = i / 4 / width;
        texels[i] = static_cast<std::uint8_t>(i * 7 % 200 + (i % 4 == 0 ? x : i % 4 == 1 ? y : 0));
    }
    return texels;
}

} // namespace

TEST_CASE("in a new context a pass draws what it should") {
    test::in_every_gl_context([](const gl::context& c) {
        const gl::state_guard guard(c);
        CHECK(drawn(c) == expected());
    });
}

TEST_CASE("among a hostile host's state a pass draws the same, and leaves all as found") {
    test::in_every_gl_context([](const gl::context& c) {
        for (int seed = 0; seed < 5; ++seed) {
            CAPTURE(seed);
            test::dice roll(static_cast<std::uint64_t>(seed));
            const gl::program engine = program_of(c, whole_map, "out vec4 color;\nvoid main() { color = vec4(1); }\n");
            const test::hostile_host host(c, roll, units, engine.name());
            CHECK(c.problem_while("the host").sentence == "");
            const auto found = test::state_of(c, units);
            {
                const gl::state_guard<gl::state_policy::restore> guard(c, units);
                CHECK(test::differing_state(found, test::state_of(c, units)) != "");
                CHECK(drawn(c) == expected());
            }
            CHECK(test::differing_state(found, test::state_of(c, units)) == "");
            {
                const gl::state_guard dirty(c, units);
                CHECK(drawn(c) == expected());
            }
            CHECK(c.problem_while("both guards").sentence == "");
        }
    });
}

TEST_CASE("transform feedback that runs is paused while a restoring guard lives, and records the host's vertices alone") {
    test::in_every_gl_context([](const gl::context& c) {
        if (!c.since(40, 30)) return test::skip("GL 3.3 cannot pause transform feedback; it is the host's to see to");
        const auto find = test::egl::library().get_proc_address;
        const auto begin = gl::detail::as_function<void (*)(unsigned)>(find("glBeginTransformFeedback"));
        const auto end = gl::detail::as_function<void (*)()>(find("glEndTransformFeedback"));
        const auto base = gl::detail::as_function<void (*)(unsigned, unsigned, unsigned)>(find("glBindBufferBase"));
        const auto varyings =
            gl::detail::as_function<void (*)(unsigned, int, const char* const*, unsigned)>(find("glTransformFeedbackVaryings"));
        const auto map =
            gl::detail::as_function<void* (*)(unsigned, std::ptrdiff_t, std::ptrdiff_t, unsigned)>(find("glMapBufferRange"));
        constexpr unsigned feedback_buffer = 0x8C8E, interleaved = 0x8C8C, map_read = 1;

        const gl::program recorded(c);
        for (const auto& [stage, text] :
             {std::pair{enums::vertex_shader, header(c) + whole_map},
              {enums::fragment_shader, header(c) + "out vec4 color;\nvoid main() { color = vec4(1); }\n"}}) {
            const unsigned shader = c.gl->CreateShader(stage);
            const char* const start = text.c_str();
            c.gl->ShaderSource(shader, 1, &start, nullptr);
            c.gl->CompileShader(shader);
            c.gl->AttachShader(recorded.name(), shader);
            c.gl->DeleteShader(shader);
        }
        const char* const position = "gl_Position";
        varyings(recorded.name(), 1, &position, interleaved);
        c.gl->LinkProgram(recorded.name());
        constexpr float unwritten = 7.0f;
        const std::vector<float> start(64, unwritten);
        const auto buffer = gl::make_buffer(c, 256, start.data(), enums::stream_draw);
        const auto target = gl::make_texture(c, gl::rgba8_format, {4, 4});
        REQUIRE((buffer && target));
        const auto frame = gl::make_framebuffer(c, {target->name()});
        const gl::vertex_array corners(c);
        base(feedback_buffer, 0, buffer->name());
        c.gl->BindVertexArray(corners.name());
        c.gl->UseProgram(recorded.name());
        begin(enums::triangles);
        CHECK(c.problem_while("the host").sentence == "");
        const auto found = test::state_of(c, units);
        {
            const gl::state_guard<gl::state_policy::restore> guard(c, units);
            CHECK(drawn(c) == expected());
        }
        CHECK(test::differing_state(found, test::state_of(c, units)) == "");
        c.gl->DrawArrays(enums::triangles, 0, 3);
        end();
        const auto* record = static_cast<const float*>(map(feedback_buffer, 0, 256, map_read));
        REQUIRE(record != nullptr);
        const auto recorded_at = [&](int i) { return static_cast<int>(record[i]); };
        for (const int corner : {0, 1, 2}) {
            CHECK(recorded_at(4 * corner) == (corner == 1 ? 3 : -1));
            CHECK(recorded_at(4 * corner + 1) == (corner == 2 ? 3 : -1));
        }
        CHECK(recorded_at(12) == static_cast<int>(unwritten));
        CHECK(c.problem_while("feedback").sentence == "");
        c.gl->UseProgram(0);
    });
}
