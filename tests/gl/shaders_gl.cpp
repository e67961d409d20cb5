#include <gnomon/gl/shaders.hpp>

#include "../support/egl.hpp"
#include "../support/formats.hpp"

#include <string>

namespace {

using namespace gnomon;
namespace enums = gl::enums;

/// Empty, or the compiler's complaint and the text.
std::string complaint(const gl::context& c, unsigned stage, std::string_view body) {
    const std::string text = std::string(gl::glsl_header(gl::glsl_version_of(c))) + std::string(body);
    const char* const pointer = text.c_str();
    const unsigned shader = c.gl->CreateShader(stage);
    c.gl->ShaderSource(shader, 1, &pointer, nullptr);
    c.gl->CompileShader(shader);
    int compiled = 0;
    c.gl->GetShaderiv(shader, enums::compile_status, &compiled);
    std::string log(4096, '\0');
    int length = 0;
    c.gl->GetShaderInfoLog(shader, static_cast<int>(log.size()), &length, log.data());
    c.gl->DeleteShader(shader);
    return compiled != 0 && length == 0 ? "" : log.substr(0, static_cast<std::size_t>(length)) + "\n" + text;
}

template <typename Texel, typename... Kernels> void compile_filters(const gl::context& c) {
    const auto one = [&]<typename Kernel>() {
        CHECK(complaint(c, enums::fragment_shader, gl::filter_columns_text<Texel, Kernel>()) == "");
        CHECK(complaint(c, enums::fragment_shader, gl::filter_rows_text<Texel, Kernel>()) == "");
    };
    (one.template operator()<Kernels>(), ...);
}

template <typename Texel> void compile_texel(const gl::context& c) {
    CHECK(complaint(c, enums::fragment_shader, gl::caster_rectangles_text<Texel>()) == "");
    if constexpr (Texel::effects.far_bound) CHECK(complaint(c, enums::fragment_shader, gl::bound_rectangles_text<Texel>()) == "");
    const std::string printed = gl::receive_text<Texel>({.fade = 0.25f, .lit_beyond = true});
    const std::string uniforms = gl::receive_text<Texel>(gl::shader_rule<Texel>::uniforms());
    for (const std::string& receive : {printed, uniforms})
        for (const std::string_view main :
             {gl::receive_texels_main_text, gl::receive_points_main_text, gl::receive_screen_main_text})
            CHECK(complaint(c, enums::fragment_shader, receive + std::string(main)) == "");
    if constexpr (Texel::representation_type::premultiplied) compile_filters<Texel, narrow<tent<2>>>(c);
    compile_filters<Texel, box<0>, box<2>, tent<2>, binomial<3>, fast<gaussian<4>>, gaussian<4>, box<20>, gaussian<20>>(c);
}

} // namespace

TEST_CASE("every shader text compiles without a word in every context") {
    test::in_every_gl_context([](const gl::context& c) {
        CHECK(complaint(c, enums::vertex_shader, gl::rectangles_vertex_text) == "");
        CHECK(complaint(c, enums::vertex_shader, gl::surfaces_vertex_text) == "");
        compile_texel<rg8>(c);
        compile_texel<rg16>(c);
        compile_texel<rg16f>(c);
        compile_texel<rg32f>(c);
        compile_texel<rgb16>(c);
        compile_texel<rga8>(c);
        compile_texel<rgba8>(c);
        compile_texel<rgba16f>(c);
        compile_texel<rgba32f>(c);
        compile_texel<tm8>(c);
        compile_texel<test::ratio_rgba8>(c);
    });
}
