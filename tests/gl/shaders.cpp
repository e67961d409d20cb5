#include <gnomon/gl/shaders.hpp>

#include <doctest/doctest.h>

#include <string>
#include <type_traits>

namespace gl = gnomon::gl;

TEST_CASE("texts are in the latest language that a context is sure to know, and begin by naming it") {
    struct spoken {
        bool es;
        int version;
        const char* begin;
    };
    for (const spoken& s : {spoken{false, 33, "#version 330 core\n"},
                            {false, 44, "#version 330 core\n"},
                            {false, 45, "#version 450 core\n"},
                            {false, 46, "#version 450 core\n"},
                            {true, 30, "#version 300 es\n"},
                            {true, 31, "#version 300 es\n"},
                            {true, 32, "#version 320 es\n"}}) {
        CAPTURE(s.version);
        gl::context c;
        c.es = s.es;
        c.version = s.version;
        const std::string header(gl::glsl_header(gl::glsl_version_of(c)));
        CHECK(header.find(s.begin) == 0);
        CHECK((header.find("#define precise\n") != std::string::npos) == (s.version < (s.es ? 32 : 45))); // a word of later ones
        CHECK((header.find("precision highp float;\n") != std::string::npos) == s.es);
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
