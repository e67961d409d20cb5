#include <gnomon/gl/context.hpp>

#include "../support/fake_gl.hpp"

#include <doctest/doctest.h>

#include <concepts>
#include <utility>

namespace gl = gnomon::gl;

TEST_CASE("versions are read from what drivers write") {
    const struct {
        const char* text;
        bool es;
        int number;
    } written[] = {
        {"3.3.0 NVIDIA 535.183.01", false, 33},
        {"4.5 (Core Profile) Mesa 22.3.6", false, 45},
        {"4.6.0 - Build 31.0.101.4502", false, 46},
        {"2.1 Metal - 88", false, 21},
        {"OpenGL ES 3.2 Mesa 22.3.6", true, 32},
        {"OpenGL ES 3.0 (WebGL 2.0 (OpenGL ES 3.0 Chromium))", true, 30},
        {"WebGL 2.0 (OpenGL ES 3.0 Chromium)", true, 30},
        {"OpenGL ES-CM 1.1 Mesa 22.3.6", true, 11},
        {"OpenGL ES 3.1 v1.r26p0-01rel0", true, 31},
        {"10.0 from later", false, 100},
        {"3.10 from nowhere", false, 39},
        {"", false, 0},
        {"3", false, 0},
        {"3.", false, 0},
        {".3", false, 0},
        {"OpenGL ES", true, 0},
        {"nothing like it", false, 0},
        {"0.5 of one", false, 0},
        {"1.9", false, 19},
        {"99999999999999999999.1", false, 0},
    };
    for (const auto& w : written) {
        CAPTURE(w.text);
        CHECK(gl::parse_version(w.text).es == w.es);
        CHECK(gl::parse_version(w.text).number == w.number);
    }
}

TEST_CASE("a context that was not asked promises nothing") {
    constexpr gl::context none;
    CHECK((none.gl == nullptr && !none.es && none.version == 0));
    CHECK_FALSE((none.norm16 || none.color_buffer_half || none.color_buffer_float || none.float_blend || none.float_linear));
    CHECK((!none.depth_clamp && none.clip_control == gl::clip_control::none));
    CHECK((none.max_texture_size == 0 && none.max_draw_buffers == 0 && none.max_viewports == 0 && none.max_clip_distances == 0));
}

TEST_CASE("GL 3.3, GL 4.5 and OpenGL ES 3.0 are taken") {
    for (const char* version : {"3.3", "4.5 (Core Profile) Mesa 22.3.6", "OpenGL ES 3.0 Mesa", "OpenGL ES 3.2 Mesa"}) {
        test::fake_gl fake(version);
        const auto made = gl::context::of(fake.table);
        REQUIRE(made);
        CHECK(made.error().sentence == "");
        CHECK(made->gl == &fake.table);
        CHECK(fake.wrong == "");
    }
}

TEST_CASE("too old a context is refused with its own words") {
    for (const char* version :
         {"3.2 (Core Profile) Mesa", "2.1 Metal - 88", "OpenGL ES 2.0 Mesa", "OpenGL ES 2.9", "OpenGL ES-CM 1.1", "unknown"}) {
        test::fake_gl fake(version);
        const auto made = gl::context::of(fake.table);
        CHECK_FALSE(made);
        CHECK(made.error().sentence ==
              "gnomon: GL 3.3 or OpenGL ES 3.0 is needed, this context is \"" + std::string(version) + '"');
    }
}

TEST_CASE("no context, and a loader with gaps, are refused by name") {
    const gl::functions none;
    CHECK(gl::context::of(none).error().sentence == "gnomon: the loader found no glGetString; is a GL context current?");

    test::fake_gl lost("4.5");
    lost.lost = true;
    CHECK(gl::context::of(lost.table).error().sentence ==
          "gnomon: glGetString(GL_VERSION) is null; no GL context is current, or it is lost");

    test::fake_gl fake("3.3 gaps");
    fake.table.DrawArraysInstanced = nullptr;
    fake.table.GetStringi = nullptr;
    fake.table.PauseTransformFeedback = nullptr; // GL 4.0
    CHECK(gl::context::of(fake.table).error().sentence ==
          "gnomon: the context is \"3.3 gaps\", but its loader lacks glGetStringi, glDrawArraysInstanced");
}

TEST_CASE("what a context can do is said by its version and extensions, never by pointers") {
    const auto of = [](const char* version, std::vector<std::string> extensions = {}) {
        const test::fake_gl fake(version, std::move(extensions)); // whose every pointer is there
        auto made = gl::context::of(fake.table);
        REQUIRE(made);
        CHECK(fake.wrong == "");
        return *made;
    };
    SUBCASE("desktops have it all") {
        const gl::context c = of("3.3");
        CHECK((c.norm16 && c.color_buffer_half && c.color_buffer_float && c.float_blend && c.float_linear && c.depth_clamp));
        CHECK(c.clip_control == gl::clip_control::none);
        CHECK(c.max_draw_buffers == 8);
        CHECK(c.max_viewports == 1);
        CHECK(c.max_clip_distances == 8);
        CHECK(of("4.0").max_viewports == 1);
        CHECK(of("4.1").max_viewports == 16);
        CHECK(of("4.4").clip_control == gl::clip_control::none);
        CHECK(of("4.5").clip_control == gl::clip_control::core);
        CHECK(of("3.3", {"GL_ARB_clip_control"}).clip_control == gl::clip_control::core);
    }
    SUBCASE("ES 3.0 has none of it by itself") {
        const gl::context c = of("OpenGL ES 3.0");
        CHECK_FALSE((c.norm16 || c.color_buffer_half || c.color_buffer_float || c.float_blend || c.float_linear || c.depth_clamp));
        CHECK(c.clip_control == gl::clip_control::none);
        CHECK(c.max_draw_buffers == 1);
        CHECK(c.max_clip_distances == 0);
    }
    SUBCASE("each extension brings its own") {
        CHECK(of("OpenGL ES 3.0", {"GL_EXT_texture_norm16"}).norm16);
        CHECK(of("OpenGL ES 3.0", {"GL_EXT_color_buffer_half_float"}).color_buffer_half);
        CHECK_FALSE(of("OpenGL ES 3.0", {"GL_EXT_color_buffer_half_float"}).color_buffer_float);
        CHECK(of("OpenGL ES 3.0", {"GL_EXT_color_buffer_float"}).color_buffer_half);
        CHECK(of("OpenGL ES 3.0", {"GL_EXT_color_buffer_float"}).color_buffer_float);
        CHECK_FALSE(of("OpenGL ES 3.0", {"GL_EXT_float_blend"}).float_blend); // into what?
        CHECK(of("OpenGL ES 3.0", {"GL_EXT_color_buffer_float", "GL_EXT_float_blend"}).float_blend);
        CHECK(of("OpenGL ES 3.0", {"GL_OES_texture_float_linear"}).float_linear);
        CHECK(of("OpenGL ES 3.0", {"GL_EXT_depth_clamp"}).depth_clamp);
        CHECK(of("OpenGL ES 3.0", {"GL_EXT_clip_cull_distance"}).max_clip_distances == 8);
        CHECK(of("OpenGL ES 3.0", {"GL_EXT_clip_control"}).clip_control == gl::clip_control::ext);
    }
    SUBCASE("ES 3.1 neither draws into floats nor has state for each draw buffer") {
        const gl::context c = of("OpenGL ES 3.1");
        CHECK_FALSE((c.color_buffer_half || c.color_buffer_float));
        CHECK(c.max_draw_buffers == 1);
    }
    SUBCASE("ES 3.2 draws into floats, but blends no 32 bits") {
        const gl::context c = of("OpenGL ES 3.2");
        CHECK((c.color_buffer_half && c.color_buffer_float));
        CHECK_FALSE((c.norm16 || c.float_blend));
        CHECK(c.max_draw_buffers == 8);
    }
    SUBCASE("WebGL writes its names without GL_") {
        CHECK(of("OpenGL ES 3.0 (WebGL 2.0)", {"EXT_color_buffer_float"}).color_buffer_float);
    }
    SUBCASE("a name that only begins alike is another") {
        CHECK_FALSE(of("OpenGL ES 3.0", {"GL_EXT_texture_norm16_not"}).norm16);
        CHECK_FALSE(of("OpenGL ES 3.0", {"GL_NV_EXT_texture_norm16"}).norm16);
    }
}

TEST_CASE("a lost context says so where it can, and GL's errors come as sentences") {
    test::fake_gl fake("4.5");
    const auto c = *gl::context::of(fake.table);
    CHECK_FALSE(c.lost());
    CHECK_FALSE(c.problem_while("drawing"));
    fake.errors = {gl::enums::invalid_operation, gl::enums::out_of_memory};
    CHECK(c.problem_while("drawing").sentence == "gnomon: drawing: GL_INVALID_OPERATION");
    CHECK_FALSE(c.problem_while("drawing")); // all flags are read
    fake.calls.clear();
    CHECK_FALSE(c.problem_while("drawing"));
    CHECK(fake.calls["GetError"] == 1); // and none after the last
    for (const auto& [error, name] : {std::pair{0x500u, "GL_INVALID_ENUM"},
                                      {0x501u, "GL_INVALID_VALUE"},
                                      {0x505u, "GL_OUT_OF_MEMORY"},
                                      {0x506u, "GL_INVALID_FRAMEBUFFER_OPERATION"},
                                      {0x9242u, "GL_CONTEXT_LOST"},
                                      {0x503u, "an error that GL does not name"}}) {
        fake.errors = {error};
        CHECK(c.problem_while("drawing").sentence == std::string("gnomon: drawing: ") + name);
    }
    fake.lost = true;
    CHECK(c.lost());
    CHECK(c.problem_while("drawing").sentence == "gnomon: drawing: GL_CONTEXT_LOST"); // and does not ask for ever
    test::fake_gl web("OpenGL ES 3.0 (WebGL 2.0)");
    const auto w = *gl::context::of(web.table);
    CHECK_FALSE(w.lost());
    web.errors = {gl::enums::context_lost_webgl};
    CHECK(w.lost());
    web.errors = {gl::enums::out_of_memory};
    CHECK_FALSE(w.lost());
    web.lost = true;
    CHECK(w.lost());
    CHECK(fake.wrong + web.wrong == "");
}

TEST_CASE("GL before 4.5 is never lost, for it cannot tell, and its error flags stay the host's") {
    test::fake_gl fake("4.4");
    const auto c = *gl::context::of(fake.table);
    fake.lost = true;
    fake.calls.clear();
    CHECK_FALSE(c.lost());
    CHECK(fake.calls.empty());
}

TEST_CASE("ES 3.2 says that it is lost without its error flags, ES 3.1 by them") {
    for (const char* version : {"OpenGL ES 3.1", "OpenGL ES 3.2"}) {
        test::fake_gl fake(version);
        const auto c = *gl::context::of(fake.table);
        fake.lost = true;
        CHECK(c.lost());
        CHECK(fake.calls["GetError"] == (c.version < 32 ? 1 : 0));
        CHECK(fake.wrong == "");
    }
}

TEST_CASE("a context that does not answer has no extension, textures of no size, and one of what it must have") {
    test::fake_gl fake("4.5");
    fake.failing = {{"GetIntegerv", 0}};
    const auto c = *gl::context::of(fake.table);
    CHECK(fake.calls["GetStringi"] == 0);
    CHECK((c.max_texture_size == 0 && c.max_draw_buffers == 1 && c.max_viewports == 1 && c.max_clip_distances == 0));
}

TEST_CASE("an extension that a driver counts and does not name is none") {
    test::fake_gl fake("OpenGL ES 3.0", {"GL_EXT_texture_norm16"});
    fake.put(gl::enums::num_extensions, 0, 3);
    const auto c = *gl::context::of(fake.table);
    CHECK(fake.calls["GetStringi"] == 3);
    CHECK(c.norm16);
    CHECK_FALSE(c.color_buffer_half);
}

TEST_CASE("an extension whose function the loader does not find is not used") {
    const auto without = [](const char* version, const char* extension, auto function) {
        test::fake_gl fake(version, {extension});
        fake.table.*function = nullptr;
        const auto made = gl::context::of(fake.table);
        REQUIRE(made);
        return made->clip_control;
    };
    CHECK(without("3.3", "GL_ARB_clip_control", &gl::functions::ClipControl) == gl::clip_control::none);
    CHECK(without("OpenGL ES 3.0", "GL_EXT_clip_control", &gl::functions::ClipControlEXT) == gl::clip_control::none);
}

TEST_CASE("functions that would go before their context are refused") {
    const auto of = []<typename T>(T&& table)
        requires requires { gl::context::of(std::forward<T>(table)); }
    { return true; };
    static_assert(std::invocable<decltype(of), const gl::functions&>);
    static_assert(!std::invocable<decltype(of), gl::functions>);
    CHECK(true);
}
