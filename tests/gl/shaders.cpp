#include <gnomon/gl/shaders.hpp>

#include <doctest/doctest.h>

#include <string>
#include <type_traits>

namespace gl = gnomon::gl;

TEST_CASE(
    "texts are in the latest language that a context is sure to know, in full precision, with precise wherever it is a word") {
    const std::string whole = "precision highp float;\nprecision highp int;\n", // in ES, where less is the default
        samplers = "precision highp sampler2D;\nprecision highp usampler2D;\n";
    const std::string desktop_330 =
        "#version 330 core\n#ifdef GL_ARB_gpu_shader5\n#extension GL_ARB_gpu_shader5 : enable\n#else\n#define precise\n#endif\n";
    struct spoken {
        bool es;
        int version;
        std::string header;
    };
    for (const spoken& s : {spoken{false, 33, desktop_330},
                            {false, 40, "#version 400 core\n"},
                            {false, 46, "#version 400 core\n"},
                            {true, 30, "#version 300 es\n#define precise\n" + whole + samplers},
                            {true, 31, "#version 300 es\n#define precise\n" + whole + samplers},
                            {true, 32, "#version 320 es\n" + whole + samplers}}) {
        CAPTURE(s.version);
        gl::context c;
        c.es = s.es;
        c.version = s.version;
        CHECK(gl::glsl_header(gl::glsl_version_of(c)) == s.header);
    }
}

TEST_CASE("a rule in uniforms declares those of a far bound for texels that have one") {
    const auto declares = []<gnomon::texel_format Texel>(std::type_identity<Texel>, const char* name) {
        return gl::receive_text<Texel>(gl::shader_rule<Texel>::uniforms()).find(name) != std::string::npos;
    };
    for (const char* name : {"gnomon_bound_bias", "gnomon_bound_nearer", "gnomon_fade"}) {
        CHECK(declares(std::type_identity<gnomon::rgb8>{}, name));
        CHECK_FALSE(declares(std::type_identity<gnomon::rg8>{}, name));
    }
    CHECK(declares(std::type_identity<gnomon::rg8>{}, "gnomon_caster_bias"));
}

template <typename Texel>
concept bounded = requires { gnomon::gl::bound_rectangles_text<Texel>(); };
static_assert(bounded<gnomon::rgb8> && !bounded<gnomon::rg8>);
