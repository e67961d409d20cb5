#include <gnomon/gl/object.hpp>
#include <gnomon/gl/program.hpp>
#include <gnomon/gl/transfer.hpp>

#include "../support/fake_gl.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace gl = gnomon::gl;

TYPE_TO_STRING_AS("texture", gl::texture);
TYPE_TO_STRING_AS("sampler", gl::sampler);
TYPE_TO_STRING_AS("framebuffer", gl::framebuffer);
TYPE_TO_STRING_AS("buffer", gl::buffer);
TYPE_TO_STRING_AS("vertex_array", gl::vertex_array);
TYPE_TO_STRING_AS("program", gl::program);

namespace {

/// A fake with a context of it.
struct bench {
    explicit bench(const char* version) : fake(version), context(*gl::context::of(fake.table)) {}
    test::fake_gl fake;
    gl::context context;
};

} // namespace

TEST_CASE_TEMPLATE("an owner deletes what it made, once, however it is moved", Owner, gl::texture, gl::sampler, gl::framebuffer,
                   gl::buffer, gl::vertex_array, gl::program) {
    static_assert(!std::is_copy_constructible_v<Owner> && !std::is_copy_assignable_v<Owner>);
    static_assert(std::is_nothrow_move_constructible_v<Owner> && std::is_nothrow_move_assignable_v<Owner>);
    bench b("3.3");
    {
        Owner first(b.context);
        const unsigned name = first.name();
        CHECK(name != 0);
        CHECK(b.fake.alive() == 1);
        Owner second(std::move(first));
        CHECK(second.name() == name);
        CHECK_FALSE(first); // owns nothing
        Owner third(b.context);
        CHECK(b.fake.alive() == 2);
        third = std::move(second); // the third's own goes now
        CHECK(b.fake.alive() == 1);
        CHECK(third.name() == name);
        Owner& itself = third;
        third = std::move(itself);
        CHECK(third.name() == name);
        third.reset();
        third.reset();
        CHECK(b.fake.alive() == 0);
        third = Owner(b.context);
        CHECK(b.fake.alive() == 1);
    }
    CHECK(b.fake.alive() == 0);
    CHECK(b.fake.wrong == "");
}

TEST_CASE("what was made may be changed where it is, and taken from there") {
    gl::result<std::string> made(std::string("a"));
    *made += 'b';
    made->push_back('c');
    CHECK(std::as_const(made)->size() == 3);
    CHECK(*std::move(made) == "abc");
}

TEST_CASE("an owner that forgets calls nothing, so that a lost context's names are never deleted in the next") {
    bench b("4.5");
    {
        gl::texture kept(b.context);
        gl::program also(b.context);
        b.fake.lost = true;
        b.fake.calls.clear();
        CHECK(kept.forget() == 1);
        CHECK(also.forget() != 0);
        CHECK_FALSE(kept);
    }
    CHECK(b.fake.calls.empty());
}

TEST_CASE("everything made to draw with is gone when its owners are") {
    for (const char* version : {"3.3", "4.5", "OpenGL ES 3.0"}) {
        bench b(version);
        {
            const auto color = gl::make_texture(b.context, gl::rg8_format, {64, 32});
            const auto depth = gl::make_texture(b.context, gl::depth_format, {64, 32});
            REQUIRE(color);
            REQUIRE(depth);
            const auto frame = gl::make_framebuffer(b.context, {color->name()}, depth->name());
            const auto corners = gl::make_buffer(b.context, 64, nullptr, gl::enums::stream_draw);
            const auto shader = gl::make_program(b.context, "vertex", "fragment", {{0, "corner"}});
            CHECK((frame && corners && shader));
            CHECK(b.fake.objects["shader"].empty()); // a linked program needs them no more
            CHECK(b.fake.alive() == 5);
        }
        CHECK(b.fake.alive() == 0);
        CHECK(b.fake.wrong == "");
    }
}

TEST_CASE("a size over the limit is refused before GL is asked, and an empty one is a single texel") {
    bench b("3.3");
    b.fake.calls.clear();
    CHECK(gl::make_texture(b.context, gl::rg16_format, {4097, 2}).error().sentence ==
          "gnomon: a texture of 4097 x 2 texels is wanted, this context allows 4096 on a side");
    CHECK_FALSE(gl::make_texture(b.context, gl::rg16_format, {2, 4097}));
    CHECK(b.fake.calls.empty());
    CHECK(gl::make_texture(b.context, gl::rg16_format, {4096, 4096}));
    CHECK(gl::make_texture(b.context, gl::rg16_format, {0, -5}));
}

TEST_CASE("a failed allocation is reported, leaks nothing, and an error left by the host is not taken for one") {
    bench b("3.3");
    b.fake.errors = {gl::enums::invalid_enum}; // the host's
    CHECK(gl::make_texture(b.context, gl::rg8_format, {8, 8}));
    b.fake.errors = {gl::enums::invalid_value};
    CHECK(gl::make_buffer(b.context, 8, nullptr, gl::enums::static_draw));
    b.fake.errors = {gl::enums::invalid_value};
    CHECK(gl::make_framebuffer(b.context, {1u}));

    b.fake.failing = {{"TexImage2D", 0}, {"BufferData", 0}};
    CHECK(gl::make_texture(b.context, gl::rg16f_format, {8, 9}).error().sentence ==
          "gnomon: a texture of 8 x 9 RG16F: GL_OUT_OF_MEMORY");
    CHECK(gl::make_buffer(b.context, 77, nullptr, gl::enums::static_draw).error().sentence ==
          "gnomon: a buffer of 77 bytes: GL_OUT_OF_MEMORY");
    CHECK(b.fake.alive() == 0);
    CHECK(b.fake.wrong == "");
}

TEST_CASE("an incomplete framebuffer is reported and leaks nothing") {
    bench b("OpenGL ES 3.0");
    const gl::texture color(b.context);
    b.fake.framebuffer_status = 0x8CDD; // unsupported
    CHECK(gl::make_framebuffer(b.context, {color.name()}).error().sentence ==
          "gnomon: a framebuffer is incomplete, status 36061; these formats cannot be drawn into here");
    CHECK(b.fake.objects["framebuffer"].empty());
    b.fake.framebuffer_status = gl::enums::framebuffer_complete;
    b.fake.failing = {{"FramebufferTexture2D", 0}};
    CHECK(gl::make_framebuffer(b.context, {color.name()}).error().sentence == "gnomon: a framebuffer: GL_OUT_OF_MEMORY");
    CHECK(b.fake.objects["framebuffer"].empty());
}

TEST_CASE("a framebuffer reads from its first colour, and one of depth alone from nowhere") {
    bench b("3.3");
    CHECK(gl::make_framebuffer(b.context, {7u}, 8u));
    CHECK(b.fake.read_buffer == gl::enums::color_attachment0);
    CHECK(gl::make_framebuffer(b.context, {}, 8u));
    CHECK(b.fake.read_buffer == gl::enums::none);
}

TEST_CASE("a texture is one level of the size that was asked for, at least a texel, and unfiltered up to its edge") {
    bench b("3.3");
    static std::vector<gnomon::extent> sizes;
    static std::map<unsigned, int> parameters;
    b.fake.table.TexImage2D = [](unsigned, int level, int, int width, int height, int border, unsigned, unsigned, const void*) {
        CHECK(level == 0);
        CHECK(border == 0);
        sizes.push_back({width, height});
    };
    b.fake.table.TexParameteri = [](unsigned, unsigned name, int value) { parameters[name] = value; };
    for (const gnomon::extent size : {gnomon::extent{5, 9}, {0, -5}, {1, 1}, {-2, 3}, {4, 0}})
        CHECK(gl::make_texture(b.context, gl::rg8_format, size));
    CHECK((sizes == std::vector<gnomon::extent>{{5, 9}, {1, 1}, {1, 1}, {1, 3}, {4, 1}}));
    constexpr int nearest = gl::enums::nearest, edge = gl::enums::clamp_to_edge;
    CHECK((parameters == std::map<unsigned, int>{{gl::enums::texture_min_filter, nearest},
                                                 {gl::enums::texture_mag_filter, nearest},
                                                 {gl::enums::texture_wrap_s, edge},
                                                 {gl::enums::texture_wrap_t, edge},
                                                 {gl::enums::texture_max_level, 0}}));
}

TEST_CASE("a framebuffer draws into all its colours, in their order, and has a depth only where one is given") {
    bench b("3.3");
    using names = std::map<unsigned, unsigned>;
    static names attached;
    static std::vector<unsigned> drawn;
    b.fake.table.FramebufferTexture2D = [](unsigned, unsigned where, unsigned, unsigned name, int level) {
        CHECK(level == 0);
        attached[where] = name;
    };
    b.fake.table.DrawBuffers = [](int count, const unsigned* buffers) { drawn.assign(buffers, buffers + count); };
    const auto draws_into = [&](std::initializer_list<unsigned> colors, const names& expected, const auto&... depth) {
        attached.clear();
        CHECK(gl::make_framebuffer(b.context, colors, depth...));
        CHECK(attached == expected);
        CHECK(drawn.size() == colors.size());
        for (std::size_t i = 0; i < drawn.size(); ++i) CHECK(drawn[i] == gl::enums::color_attachment0 + i);
    };
    constexpr unsigned first = gl::enums::color_attachment0, depth = gl::enums::depth_attachment;
    draws_into({7u, 3u, 9u, 5u}, {{first, 7u}, {first + 1, 3u}, {first + 2, 9u}, {first + 3, 5u}, {depth, 1u}}, 1u);
    draws_into({7u}, {{first, 7u}});
    draws_into({}, {{depth, 8u}}, 8u);
}

TEST_CASE("a program is linked with both its shaders and all its attributes, and then lets go of the shaders") {
    bench b("3.3");
    static std::set<unsigned> attached;
    static std::map<unsigned, std::string> bound;
    b.fake.table.ShaderSource = [](unsigned, int texts, const char* const* text, const int* length) {
        CHECK(texts == 1);
        test::fake_gl::current()->sources.emplace_back(*text, static_cast<std::size_t>(*length));
    };
    b.fake.table.AttachShader = [](unsigned, unsigned shader) { attached.insert(shader); };
    b.fake.table.DetachShader = [](unsigned, unsigned shader) { attached.erase(shader); };
    b.fake.table.BindAttribLocation = [](unsigned, unsigned index, const char* name) { bound[index] = name; };
    b.fake.table.LinkProgram = [](unsigned) {
        CHECK(attached.size() == 2);
        CHECK((bound == std::map<unsigned, std::string>{{0, "corner"}, {3, "colour"}}));
    };
    CHECK(gl::make_program(b.context, "v", "f", {{0, "corner"}, {3, "colour"}}));
    CHECK(attached.empty());
    CHECK((b.fake.sources == std::vector<std::string>{"v", "f"}));
}

TEST_CASE("a program of which GL makes a part leaks nothing") {
    bench b("3.3");
    for (const auto& [name, made] : {std::pair{"CreateShader", 0}, {"CreateShader", 1}, {"CreateProgram", 0}}) {
        b.fake.failing = {{name, made}};
        CHECK(gl::make_program(b.context, "v", "f").error().sentence ==
              "gnomon: GL gave no name for a program; the context is lost, or another one is current");
        CHECK(b.fake.alive() == 0);
    }
    CHECK(b.fake.wrong == "");
}

TEST_CASE("a rejected shader brings the driver's log, and leaks nothing") {
    bench b("3.3");
    b.fake.shader_log = "0:3(1): syntax error, unexpected end of file\n\n";
    CHECK(gl::make_program(b.context, "v", "f").error().sentence ==
          "gnomon: the driver rejects the vertex shader: 0:3(1): syntax error, unexpected end of file");
    b.fake.shader_log = "one line\nand another \n ";
    CHECK(gl::make_program(b.context, "v", "f").error().sentence ==
          "gnomon: the driver rejects the vertex shader: one line\nand another");
    b.fake.shader_log = "x";
    CHECK(gl::make_program(b.context, "v", "f").error().sentence == "gnomon: the driver rejects the vertex shader: x");
    b.fake.shader_log = "\n";
    CHECK(gl::make_program(b.context, "v", "f").error().sentence == "gnomon: the driver rejects the vertex shader: ");
    b.fake.shader_log.clear();
    b.fake.link_log = "no main";
    CHECK(gl::make_program(b.context, "v", "f").error().sentence == "gnomon: the driver does not link the program: no main");
    b.fake.failing = {{"GetProgramiv", 0}}; // has no log either
    CHECK(gl::make_program(b.context, "v", "f").error().sentence ==
          "gnomon: the driver does not link the program: the driver says nothing");
    b.fake.failing = {{"GetShaderiv", 0}};
    CHECK(gl::make_program(b.context, "v", "f").error().sentence ==
          "gnomon: the driver rejects the vertex shader: the driver says nothing");
    b.fake.failing.clear();
    b.fake.table.GetShaderiv = [](unsigned, unsigned name, int* to) { *to = name == gl::enums::info_log_length; }; // its zero
    CHECK(gl::make_program(b.context, "v", "f").error().sentence ==
          "gnomon: the driver rejects the vertex shader: the driver says nothing");
    CHECK(b.fake.alive() == 0);
    CHECK(b.fake.wrong == "");
}

TEST_CASE("reading a part of nothing calls nothing of GL") {
    bench b("3.3");
    gl::texel_reader<gnomon::rg8> reader({8, 8});
    gnomon::image<gnomon::rg8> to({8, 8});
    b.fake.calls.clear();
    for (const gnomon::texel_rect part : {gnomon::texel_rect{3, 3, 3, 8}, {3, 3, 8, 3}, {5, 5, 2, 8}, {8, 0, 16, 8}})
        reader.read(b.context, 1, to.view(), part);
    CHECK(b.fake.calls.empty());
}

TEST_CASE("of a lost context nothing is had, and each maker says so") {
    bench b("4.5");
    b.fake.lost = true;
    const auto told = [](const auto& made) { return made.error().sentence.find("the context is lost") != std::string::npos; };
    CHECK(told(gl::make_texture(b.context, gl::rg8_format, {8, 8})));
    CHECK(told(gl::make_framebuffer(b.context, {1u})));
    CHECK(told(gl::make_buffer(b.context, 8, nullptr, gl::enums::static_draw)));
    CHECK(told(gl::make_program(b.context, "v", "f")));
    CHECK(b.fake.alive() == 0);
}

TEST_CASE("objects of two contexts go to their own") {
    bench one("3.3");
    gl::texture first(one.context);
    bench two("OpenGL ES 3.0");
    const gl::texture second(two.context);
    CHECK(one.fake.objects["texture"].size() == 1);
    CHECK(two.fake.objects["texture"].size() == 1);
    one.fake.use();
    first.reset();
    CHECK(one.fake.alive() == 0);
    CHECK(two.fake.alive() == 1);
    two.fake.use();
    CHECK(one.fake.wrong + two.fake.wrong == "");
}
