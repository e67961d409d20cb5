// A map inside an engine: the engine's own draws, its textures, and whatever state it left.
#include "../support/filtering.hpp"
#include "../support/formats.hpp"
#include "../support/gl_map.hpp"
#include "../support/gl_state.hpp"

#include <gnomon/gl/soft_shadow_map.hpp>

#include <doctest/doctest.h>

#include <string>
#include <utility>

namespace {
namespace gl = gnomon::gl;
using gnomon::binomial;
using gnomon::extent;
using gnomon::image;
using gnomon::texel_rect;
using test::dice;

constexpr extent size{50, 38};
struct touched {
    texel_rect texels;
    gnomon::depth_interval depth;
};

/// An engine's surface: a triangle over the whole target whose depths, and opacities, are read from a texture of floats, discarded
/// where they are negative. Its clip depth is of no account, here before the near plane where that is allowed.
template <gnomon::texel_format Texel> class surface_of {
  public:
    surface_of(const gl::context& c, const std::string& call, bool mirrored = false) : c_(c), array_(c) {
        const std::string header(gl::glsl_header(gl::glsl_version_of(c)));
        const std::string corners = mirrored ? "gl_VertexID == 2 ? 3.0 : -1.0, gl_VertexID == 1 ? 3.0 : -1.0"
                                             : "gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0";
        auto made = gl::make_program(
            c, header + "void main() { gl_Position = vec4(" + corners + ", " + (c.depth_clamp ? "-7.0" : "0.0") + ", 1.0); }\n",
            header + gl::caster_text<Texel>() +
                "uniform sampler2D depths;\nvoid main() {\n    vec4 at = texelFetch(depths, "
                "ivec2(gl_FragCoord), 0);\n    if (at.y < 0.0) discard;\n    " +
                call + ";\n}\n");
        CHECK(made.error().sentence == "");
        if (made) program_ = *std::move(made);
    }
    /// Depths and opacities; no surface where an opacity is negative.
    void put(dice& roll, int one_in) {
        const gl::state_guard<gl::state_policy::restore> forced(c_);
        auto texture = gl::make_texture(c_, gl::rg32f_format, size);
        REQUIRE(static_cast<bool>(texture));
        texture_ = *std::move(texture);
        test::for_each_texel(whole(size), [&](int x, int y) {
            at(x, y) = {{roll.unit(), roll.one_in(one_in) ? static_cast<float>(roll(0, 16)) / 16.0f : -1.0f}};
        });
        gl::write_texels<gnomon::rg32f>(c_, at.view());
    }
    void draw() const {
        c_.gl->UseProgram(program_.name());
        c_.gl->BindVertexArray(array_.name());
        c_.gl->BindTexture(gl::enums::texture_2d, texture_.name());
        c_.gl->DrawArrays(gl::enums::triangles, 0, 3);
    }
    image<gnomon::rg32f> at{size};

  private:
    gl::context c_;
    gl::vertex_array array_;
    gl::program program_ = {};
    gl::texture texture_ = {};
};

/// Two frames of an engine whose state is hostile before every call, against the same on the host. `after` is called after each call.
template <typename Texel, gl::state_policy Policy> void frames_among_hostile_state(const gl::context& c) {
    using backend = gl::backend_of<Policy>;
    using kernel = binomial<2>;
    if (const auto why = gl::supports<Texel>(c)) return test::skip(why.sentence);
    dice roll(741);
    constexpr bool translucent = Texel::effects.translucency;
    surface_of<Texel> casters(c, translucent ? "gnomon_caster(at.x, at.y)" : "gnomon_caster(at.x)");
    surface_of<Texel> ground(c, Texel::effects.far_bound ? "gnomon_bound(at.x)" : "gnomon_caster(at.x)");
    const auto among = [&](auto&& call) {
        const test::hostile_host host(c, roll, 4, 0);
        const auto before = test::state_of(c, 4);
        call();
        if (Policy == gl::state_policy::restore) CHECK(test::differing_state(before, test::state_of(c, 4)) == "");
        const gl::state_guard<> calm(c); // what else the test does is not its subject
    };
    gnomon::soft_shadow_map<Texel, kernel, backend> map({size.width, size.height, 8}, backend(c));
    CHECK(map.problem().sentence == "");
    int differing = 0;
    for (int frame = 0; frame < 2; ++frame) {
        image<Texel> expected(size, Texel::clear());
        casters.put(roll, 3);
        ground.put(roll, 2);
        among([&] { map.clear(); });
        const texel_rect r = roll.rect(size, 5);
        map.cast(r, 0.5f);
        test::for_each_texel(clip(r, size), [&](int x, int y) { expected(x, y).cast(Texel::caster(0.5f)); });
        among([&] {
            map.cast([&](const gl::map_targets&) {
                casters.draw();
                return touched{whole(size), {}};
            });
        });
        test::for_each_texel(whole(size), [&](int x, int y) {
            const auto& s = casters.at(x, y).stored;
            if (s[1] < 0.0f) return;
            if constexpr (translucent)
                expected(x, y).cast(Texel::caster(s[0], s[1]));
            else
                expected(x, y).cast(Texel::caster(s[0]));
        });
        if constexpr (Texel::effects.far_bound) {
            among([&] { map.bound([&](const gl::map_targets&) { ground.draw(); }); });
            test::for_each_texel(whole(size), [&](int x, int y) {
                if (!(ground.at(x, y).stored[1] < 0.0f)) expected(x, y).bound(ground.at(x, y).stored[0]);
            });
        }
        among([&] { map.filter(); });
        among([&] { static_cast<void>(map.soft()); });
        const auto soft = test::dense<gl::kernel_in_gl<Texel, kernel>>(expected);
        differing += test::differences<Texel>(map.soft(), soft.view(), whole(size));
    }
    test::gl_report(test::format_name<Texel>(), "an engine's draws", 2ll * size.width * size.height, differing);
    CHECK(differing == 0);
}
} // namespace

TEST_CASE_TEMPLATE("an engine's draws cast and bound as scalar does, whatever state the engine leaves", Texel, gnomon::rg8,
                   gnomon::rgba16, gnomon::rgba16f, gnomon::rgb32f) {
    test::in_every_gl_context([](const gl::context& c) { frames_among_hostile_state<Texel, gl::state_policy::dirty>(c); });
}
TEST_CASE("an engine's draws cast and bound as scalar does, and all its state is as it was where the backend restores") {
    test::in_every_gl_context(
        [](const gl::context& c) { frames_among_hostile_state<gnomon::rgba8, gl::state_policy::restore>(c); });
}

TEST_CASE("of an engine's receivers both faces bound, or those that face the light, or those averted from it") {
    test::in_every_gl_context([](const gl::context& c) {
        using Texel = gnomon::rgb8;
        dice roll(742);
        surface_of<Texel> facing(c, "gnomon_bound(at.x)"), averted(c, "gnomon_bound(at.x)", true);
        facing.put(roll, 1);
        averted.put(roll, 1);
        for (const auto drawn : {gl::faces_drawn::both, gl::faces_drawn::facing, gl::faces_drawn::averted}) {
            gnomon::soft_shadow_map<Texel, gnomon::box<0>, gl::backend> map({size.width, size.height, 8}, gl::backend(c));
            map.cast(whole(size), 0.25f);
            image<Texel> expected(size, Texel::caster(0.25f));
            map.bound(
                [&](const gl::map_targets&) {
                    facing.draw();
                    averted.draw();
                },
                drawn);
            test::for_each_texel(whole(size), [&](int x, int y) {
                if (drawn != gl::faces_drawn::averted) expected(x, y).bound(facing.at(x, y).stored[0]);
                if (drawn != gl::faces_drawn::facing) expected(x, y).bound(averted.at(x, y).stored[0]);
            });
            map.filter();
            CHECK(test::differences<Texel>(map.soft(), expected.view(), whole(size)) == 0);
        }
    });
}

TEST_CASE("a map in an engine's textures is the map in its own, and they hold what they held but for the casters") {
    test::in_every_gl_context([](const gl::context& c) {
        using Texel = gnomon::rg8;
        gl::texture lent[2];
        {
            const gl::state_guard<> forced(c);
            for (auto& each : lent) each = *gl::make_texture(c, gl::format_of<Texel>, size);
        }
        using map_type = gnomon::soft_shadow_map<Texel, binomial<3>, gl::backend>;
        const gl::backend run(c);
        map_type theirs({size.width, size.height, 8}, run, {.casters = lent[0].name(), .soft = lent[1].name()}),
            own(gnomon::map_size{size.width, size.height, 8}, run);
        for (auto* map : {&theirs, &own}) {
            map->cast({5, 5, 20, 30}, 0.25f);
            map->filter();
        }
        CHECK(theirs.soft_texture() == lent[1].name());
        CHECK(theirs.shadow(10, 10, 0.5f) > 0.99f);
        CHECK(test::differences<Texel>(theirs.soft(), own.soft(), whole(size)) == 0);
    });
}

TEST_CASE("maps of two contexts work side by side") {
    test::gl_context one(test::gl_3_3), two(test::gl_es);
    if (!one || !two) return test::skip(one ? two.why_not() : one.why_not());
    using map_type = gnomon::soft_shadow_map<gnomon::rg8, binomial<3>, gl::backend>;
    const gnomon::map_size same{size.width, size.height, 8};
    one.make_current();
    {
        map_type first(same, gl::backend(one.context()));
        two.make_current();
        {
            map_type second(same, gl::backend(two.context()));
            second.cast({5, 5, 20, 30}, 0.25f);
            one.make_current();
            first.cast({15, 5, 30, 30}, 0.25f);
            first.filter();
            two.make_current();
            second.filter();
            CHECK(second.shadow(9, 10, 0.5f) > 0.99f);
            CHECK(second.shadow(25, 10, 0.5f) < 0.01f);
        }
        one.make_current();
        CHECK(first.shadow(9, 10, 0.5f) < 0.01f);
        CHECK(first.shadow(25, 10, 0.5f) > 0.99f);
        CHECK(one.context().problem_while("two contexts").sentence == "");
    }
}
