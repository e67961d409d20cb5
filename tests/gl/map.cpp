// A map on a GL that draws nothing and remembers all: what goes wrong is a sentence, nothing leaks, and a frame's calls can be counted.
#include "../support/fake_gl.hpp"

#include <gnomon/gl/soft_shadow_map.hpp>

#include <doctest/doctest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace {
namespace gl = gnomon::gl;
using gnomon::texel_rect;
template <typename Texel, typename Backend = gl::backend>
using map_of = gnomon::soft_shadow_map<Texel, gnomon::binomial<3>, Backend>;

/// A fake with a context of it.
struct bench {
    explicit bench(const char* version, std::vector<std::string> extensions = {})
        : fake(version, std::move(extensions)), context(*gl::context::of(fake.table)) {}
    test::fake_gl fake;
    gl::context context;

    [[nodiscard]] int calls_of(const std::string& names) const { // "Gen": all that begin so
        int sum = 0;
        for (const auto& [name, count] : fake.calls) sum += name.compare(0, names.size(), names) == 0 ? count : 0;
        return sum;
    }
};

/// A frame of everything that a map can do on its own, and what is shadowed of it.
template <typename Map> float frame(Map& map, int shift = 0) {
    map.clear();
    map.cast({10 + shift, 10, 40 + shift, 30}, 0.25f);
    map.cast({50 + shift, 10, 60 + shift, 30}, 0.5f);
    if constexpr (requires { map.bound(texel_rect{}, 0.5f); }) map.bound({0, 0, 64, 64}, 0.75f);
    map.filter();
    return map.shadow(20 + shift, 20, 0.9f);
}

/// What an engine's draw returns.
struct touched {
    texel_rect texels;
    gnomon::depth_interval depth;
};

bool says(const gl::problem& why, const char* part) { return why.sentence.find(part) != std::string::npos; }

template <typename Texel>
constexpr bool has_bounds = requires(gl::passes<Texel, gnomon::binomial<3>>& passes, const gl::context& c,
                                     const gl::map_targets& to, void (&walk)(void (*)(texel_rect))) {
    gl::begin_bounds<Texel>(c, to);
    passes.bound(c, to, walk);
};
template <typename Texel>
constexpr bool begins_bounds = requires(const gl::context& c, const gl::map_targets& to) { gl::begin_bounds<Texel>(c, to); };
static_assert(has_bounds<gnomon::rgb8> && !has_bounds<gnomon::rg8> && !begins_bounds<gnomon::rg8>);
template <typename Texel>
constexpr bool draws_bounds = requires(map_of<Texel>& map, void (*draw)(const gl::map_targets&)) { map.bound(draw); };
static_assert(draws_bounds<gnomon::rgb8> && !draws_bounds<gnomon::rg8>);
static_assert(!std::is_copy_constructible_v<map_of<gnomon::rg8>> && std::is_nothrow_move_constructible_v<map_of<gnomon::rg8>>);
} // namespace

TEST_CASE("a map that cannot be made says why, keeps nothing of GL, and is lit everywhere") {
    const auto try_one = [](bench& b, gnomon::map_size size, const char* part) {
        {
            map_of<gnomon::rgba16> map(size, gl::backend(b.context));
            CAPTURE(map.problem().sentence);
            CHECK(says(map.problem(), "gnomon: "));
            CHECK(says(map.problem(), part));
            b.fake.calls.clear();
            CHECK(frame(map) <= 0.0f);
            CHECK(map.soft_texture() == 0);
            CHECK(map.caster_framebuffer() == 0);
            map.cast([](const gl::map_targets&) {
                FAIL_CHECK("draws into nothing");
                return touched{};
            });
            map.bound([](const gl::map_targets&) { FAIL_CHECK("bounds nothing"); });
            CHECK(b.fake.calls.empty());
        }
        CHECK(b.fake.alive() == 0);
        CHECK(b.fake.wrong == "");
    };
    {
        bench b("OpenGL ES 3.0");
        try_one(b, {64, 64}, "GL_EXT_texture_norm16");
    }
    bench b("3.3");
    try_one(b, {5000, 10}, "5000 x 10");
    try_one(b, {10, 5000}, "4096");
    b.fake.framebuffer_status = 0x8CDD;
    try_one(b, {64, 64}, "incomplete");
    b.fake.framebuffer_status = gl::enums::framebuffer_complete;
    b.fake.shader_log = "0:7: no such thing";
    try_one(b, {64, 64}, "0:7: no such thing");
    b.fake.shader_log = "";
    b.fake.link_log = "too many things";
    try_one(b, {64, 64}, "too many things");
    b.fake.link_log = "";
    const auto fails = [&](const char* name, int calls, const char* part) {
        for (int made = 0; made < calls; ++made) {
            CAPTURE(made);
            b.fake.failing = {{name, made}};
            try_one(b, {64, 64}, part);
        }
        b.fake.failing.clear();
    };
    fails("BufferData", 1, "GL_OUT_OF_MEMORY"); // the rectangles'
    fails("TexImage2D", 4, "GL_OUT_OF_MEMORY");
    fails("GenVertexArrays", 1, "no name for a vertex array");
    fails("CreateProgram", 5, "no name for a program"); // one for each pass
    fails("GenFramebuffers", 3, "no name for a framebuffer");
    fails("ClearBufferfv", 3, "clearing a new map: GL_OUT_OF_MEMORY");
    const map_of<gnomon::rgba16> map({64, 64}, gl::backend(b.context));
    CHECK(map.problem().sentence == "");
    CHECK(b.fake.objects["program"].size() == 5);
}

TEST_CASE("a map allocates nothing of GL after it was made, and all is gone when it is") {
    for (const char* version : {"3.3", "4.5", "OpenGL ES 3.0", "OpenGL ES 3.2"}) {
        CAPTURE(std::string(version));
        bench b(version);
        {
            const gl::backend run(b.context);
            map_of<gnomon::rgba8> map({64, 64, 8}, run), other({32, 32, 8}, run);
            CHECK(map.problem().sentence == "");
            const std::size_t alive = b.fake.alive();
            b.fake.calls.clear();
            for (int i = 0; i < 3; ++i) frame(map, i);
            for (const char* names : {"Gen", "Create", "TexImage", "Compile", "Delete"}) CHECK(b.calls_of(names) == 0);
            CHECK(b.fake.alive() == alive);
            map_of<gnomon::rgba8> moved = std::move(map);
            frame(moved);
            moved = map_of<gnomon::rgba8>({16, 16, 8}, run);
        }
        CHECK(b.fake.alive() == 0);
        CHECK(b.fake.wrong == "");
    }
}

TEST_CASE("maps of one backend share their programs") {
    bench b("3.3");
    const gl::backend run(b.context), copy = run;
    const map_of<gnomon::rg8> first({64, 64}, run), second({32, 32}, copy);
    CHECK(b.fake.objects["program"].size() == 4);
    const map_of<gnomon::rg8> apart({64, 64}, gl::backend(b.context));
    CHECK(b.fake.objects["program"].size() == 8);
}

TEST_CASE("a backend that forgot what it compiled compiles it anew") {
    bench b("3.3");
    gl::backend run(b.context);
    static_cast<void>(map_of<gnomon::rg8>({64, 64}, run));
    b.fake.calls.clear();
    run.forget();
    CHECK(b.fake.calls.empty());
    const map_of<gnomon::rg8> map({64, 64}, run);
    CHECK(b.fake.calls["CreateProgram"] == 4);
}

TEST_CASE("an empty frame after an empty frame calls no function of GL, nor does a map of no texels ever") {
    bench b("3.3");
    map_of<gnomon::rgb8> map({64, 64, 8}, gl::backend(b.context));
    b.fake.calls.clear();
    static_cast<void>(map.soft()); // clear, as is known
    CHECK(b.fake.calls.empty());
    frame(map);
    map.clear();
    map.filter(); // clears what is left
    b.fake.calls.clear();
    map.clear();
    map.bound({0, 0, 64, 64}, 0.5f);
    map.bound([](const gl::map_targets&) { FAIL_CHECK("bounds the shadow of nothing"); });
    map.filter();
    CHECK(b.fake.calls.empty());
    const std::size_t textures = b.fake.objects["texture"].size();
    for (const gnomon::map_size size : {gnomon::map_size{0, 64}, {64, 0}, {-3, -3}}) {
        map_of<gnomon::rgb8> none(size, gl::backend(b.context));
        CHECK(none.problem().sentence == "");
        CHECK(b.fake.objects["texture"].size() == textures); // of no texels there is nothing to own
        b.fake.calls.clear();
        CHECK(frame(none) <= 0.0f);
        CHECK(b.fake.calls.empty());
    }
}

TEST_CASE("a frame takes a draw for all casters, one for all bounds, and one for each pass of the blur") {
    bench b("3.3");
    map_of<gnomon::rgb8> map({64, 64, 8}, gl::backend(b.context));
    b.fake.calls.clear();
    map.cast({0, 0, 4, 4}, 0.5f);
    map.cast({30, 0, 34, 4}, 0.5f);
    map.cast({0, 40, 4, 44}, 0.5f);
    map.bound({0, 0, 64, 64}, 0.75f);
    map.bound({0, 0, 32, 32}, 0.5f);
    CHECK(b.fake.calls["DrawArraysInstanced"] == 1); // the bounds wait
    map.filter();
    CHECK(b.fake.calls["DrawArraysInstanced"] == 4);
    CHECK(b.fake.calls["Scissor"] == 0);
    CHECK(b.calls_of("Get") == 0);
    b.fake.calls.clear();
    map.filter(gl::rectangles_by::scissor);
    CHECK(b.fake.calls["DrawArraysInstanced"] == 2 * b.fake.calls["Scissor"] / 2);
    CHECK(b.fake.calls["Scissor"] == 6); // three rectangles, two passes
    CHECK(b.calls_of("ReadPixels") == 0);
    static_cast<void>(map.shadow(1, 1, 0.9f));
    static_cast<void>(map.shadow_at(1.5f, 1.5f, 0.9f));
    CHECK(b.calls_of("ReadPixels") == 1); // once for each filter
    map.filter();
    static_cast<void>(map.soft());
    CHECK(b.calls_of("ReadPixels") == 2);
}

TEST_CASE("more rectangles than fit into one draw take two") {
    bench b("3.3");
    map_of<gnomon::rg8> map({64, 64, 8}, gl::backend(b.context));
    b.fake.calls.clear();
    for (int i = 0; i < gl::rectangle_list::capacity + 1; ++i) map.cast({i % 60, i / 60, i % 60 + 1, i / 60 + 1}, 0.5f);
    CHECK(b.fake.calls["DrawArraysInstanced"] == 1);               // there is no room for the last
    CHECK(map.caster_framebuffer() == map.targets().into_casters); // who asks for it finds all in it
    CHECK(b.fake.calls["DrawArraysInstanced"] == 2);
    map.cast({0, 0, 1, 1}, 0.5f);
    map.clear();
    b.fake.calls.clear();
    static_cast<void>(map.caster_framebuffer()); // what was forgotten before it was drawn never is
    CHECK(b.fake.calls.empty());
}

TEST_CASE("a clear draws over the tiles of casters and over no texel beside them") {
    bench b("3.3");
    map_of<gnomon::rg8> map({64, 64, 16}, gl::backend(b.context));
    map.cast({16, 32, 20, 36}, 0.5f);            // whose guard band reaches the tiles beside it
    static_cast<void>(map.caster_framebuffer()); // has drawn them
    static std::vector<gl::surface> drawn;
    b.fake.table.BufferSubData = [](unsigned, std::ptrdiff_t, std::ptrdiff_t bytes, const void* data) {
        drawn.resize(static_cast<std::size_t>(bytes) / sizeof(gl::surface));
        std::memcpy(drawn.data(), data, static_cast<std::size_t>(bytes));
    };
    map.clear();
    REQUIRE(drawn.size() == 1);
    CHECK(drawn[0].where == texel_rect{16, 32, 32, 48});
}

TEST_CASE("a map on a backend that restores leaves all state as it was, at its making and in a frame") {
    for (const char* version : {"3.3", "4.5", "OpenGL ES 3.0", "OpenGL ES 3.2"}) {
        CAPTURE(std::string(version));
        bench b(version);
        unsigned names[8] = {};
        b.fake.table.GenTextures(2, names);
        b.fake.table.GenSamplers(1, names + 2);
        b.fake.table.GenFramebuffers(1, names + 3);
        b.fake.table.GenBuffers(3, names + 4);
        b.fake.table.GenVertexArrays(1, names + 7);
        b.fake.table.BindTexture(gl::enums::texture_2d, names[0]);
        b.fake.table.BindSampler(0, names[2]);
        b.fake.table.ActiveTexture(gl::enums::texture0 + 1);
        b.fake.table.BindTexture(gl::enums::texture_2d, names[1]);
        b.fake.table.BindFramebuffer(gl::enums::framebuffer, names[3]);
        b.fake.table.BindBuffer(gl::enums::array_buffer, names[4]);
        b.fake.table.BindBuffer(gl::enums::pixel_pack_buffer, names[5]);
        b.fake.table.BindBuffer(gl::enums::pixel_unpack_buffer, names[6]);
        b.fake.table.BindVertexArray(names[7]);
        b.fake.table.Enable(gl::enums::scissor_test);
        b.fake.table.Enable(gl::enums::depth_test);
        b.fake.table.DepthFunc(gl::enums::never);
        b.fake.table.ColorMask(0, 1, 0, 1);
        b.fake.table.PixelStorei(gl::enums::pack_row_length, 7);
        auto before = b.fake.state;
        const auto same = [&] { // what was never set is 0
            auto now = b.fake.state;
            for (const auto& [name, value] : now) before[name];
            for (const auto& [name, value] : before) now[name];
            return now == before;
        };
        map_of<gnomon::rgba8, gl::backend_that_restores> map({64, 64, 8}, gl::backend_that_restores(b.context));
        CHECK(same());
        frame(map);
        frame(map, 5);
        CHECK(same());
        const map_of<gnomon::rg8> dirty({64, 64, 8}, gl::backend(b.context));
        CHECK(same()); // its making restores as well
    }
}

TEST_CASE("casters, their depths and the soft map begin clear") {
    bench b("3.3");
    using cleared = std::pair<unsigned, unsigned>; // a framebuffer, and what of it
    static std::vector<cleared> all;
    b.fake.table.ClearBufferfv = [](unsigned what, int index, const float* to) {
        CHECK(index == 0);
        for (int i = 0; i < (what == gl::enums::color ? 4 : 1); ++i) CHECK(std::bit_cast<std::uint32_t>(to[i]) == 0);
        all.emplace_back(static_cast<unsigned>(test::fake_gl::current()->get(gl::enums::draw_framebuffer_binding)[0]), what);
    };
    const map_of<gnomon::rg8> map({64, 64}, gl::backend(b.context));
    const gl::map_targets& to = map.targets();
    CHECK((all == std::vector<cleared>{
                      {to.into_casters, gl::enums::color}, {to.into_casters, gl::enums::depth}, {to.into_soft, gl::enums::color}}));
}

TEST_CASE("names that nobody gave are 0, GL's for nothing and for the screen") {
    constexpr gl::map_targets map;
    for (const unsigned name : {map.casters, map.scratch, map.soft, map.into_casters, map.into_scratch, map.into_soft})
        CHECK(name == 0);
    CHECK(gl::pass_state{}.framebuffer == 0);
    CHECK(gl::mask_target{}.framebuffer == 0);
}

TEST_CASE("textures that an engine lends are drawn into, and stay when the map goes") {
    bench b("3.3");
    unsigned lent[2] = {};
    b.fake.table.GenTextures(2, lent);
    {
        map_of<gnomon::rg16> map({64, 64}, gl::backend(b.context), {.casters = lent[0], .soft = lent[1]});
        CHECK(map.problem().sentence == "");
        CHECK(map.soft_texture() == lent[1]);
        CHECK(map.targets().casters == lent[0]);
        CHECK(b.fake.objects["texture"].size() == 4);
        frame(map);
    }
    CHECK(b.fake.objects["texture"] == std::set<unsigned>{lent[0], lent[1]});
    CHECK(b.fake.alive() == 2);
}

TEST_CASE("a map that forgets a lost context calls nothing of GL again, nor does its backend") {
    bench b("4.5");
    std::optional<gl::backend> run(b.context);
    std::optional<map_of<gnomon::rgba8>> map;
    map.emplace(gnomon::map_size{64, 64, 8}, *run);
    map->cast({1, 1, 9, 9}, 0.5f);
    map->filter(); // and nobody read it
    map->cast({1, 1, 9, 9}, 0.5f);
    const std::vector<float> z(4, 0.5f);
    std::vector<float> intensity(4);
    gnomon::receive(*run, std::vector<gnomon::rg8>(4), z, intensity); // has programs of its own
    b.fake.lost = true;
    CHECK(b.context.lost());
    b.fake.calls.clear();
    map->forget();
    CHECK(says(map->problem(), "lost"));
    CHECK(map->soft_texture() == 0);
    CHECK(map->caster_framebuffer() == 0); // what was cast before is not drawn
    map->filter();
    CHECK(map->shadow(5, 5, 0.9f) <= 0.0f);
    CHECK(frame(*map) <= 0.0f);
    map.reset();
    run.reset();
    CHECK(b.fake.calls.empty());
}

TEST_CASE("an engine's own draws find their framebuffer bound, and depths, blending and colour mask set") {
    using namespace gl::enums;
    bench b("3.3");
    map_of<gnomon::rgb8> map({64, 48, 8}, gl::backend(b.context));
    int calls = 0;
    const auto state = [&](unsigned name) { return static_cast<unsigned>(b.fake.get(name)[0]); };
    map.cast({1, 1, 2, 2}, 0.5f);
    map.cast([&](const gl::map_targets& target) {
        ++calls;
        CHECK(b.fake.calls["DrawArraysInstanced"] == 1); // rectangles before it are in
        CHECK(state(draw_framebuffer_binding) == target.into_casters);
        CHECK(b.fake.get(viewport) == test::fake_gl::values{0, 0, 64, 48});
        CHECK(state(depth_test) == 1);
        CHECK(state(depth_func) == greater);
        CHECK(state(depth_writemask) == 1);
        CHECK(state(depth_clamp) == 1);
        CHECK(state(blend) == 0);
        CHECK(state(cull_face) == 0);
        CHECK(b.fake.get(color_writemask) == test::fake_gl::values{1, 1, 1, 1});
        return touched{{8, 8, 24, 24}, {0.25f, 0.5f}};
    });
    CHECK(map.reaches({10, 10, 11, 11}, {0.6f, 0.7f}));
    for (const auto& [drawn, culled] :
         {std::pair{gl::faces_drawn::both, 0u}, {gl::faces_drawn::facing, back_face}, {gl::faces_drawn::averted, front}})
        map.bound(
            [&, cull = culled](const gl::map_targets& target) {
                ++calls;
                CHECK(state(draw_framebuffer_binding) == target.into_casters);
                CHECK(state(depth_func) == lequal);
                CHECK(state(depth_writemask) == 0);
                CHECK(state(blend) == 1);
                CHECK(state(blend_equation_rgb) == blend_max);
                CHECK(state(cull_face) == (cull != 0 ? 1u : 0u));
                if (cull != 0) CHECK(state(cull_face_mode) == cull);
                CHECK(b.fake.get(color_writemask) == test::fake_gl::values{0, 0, 1, 0});
            },
            drawn);
    CHECK(calls == 4);
}
