#include <gnomon/gl/object.hpp>
#include <gnomon/gl/pass_state.hpp>

#include "../support/fake_gl.hpp"

#include <doctest/doctest.h>

#include <cstddef>

namespace {
namespace gl = gnomon::gl;
using namespace gl::enums;
using test::fake_gl;
} // namespace

TEST_CASE("a pass begins with all of its state set, whatever the pass before it was") {
    struct depths {
        gl::depth_use use;
        bool tested;
        unsigned passes;
        bool written;
    };
    for (const char* text : {"3.3", "OpenGL ES 3.0"}) {
        fake_gl fake(text);
        const gl::context c = *gl::context::of(fake.table);
        const auto state = [&fake](unsigned name) { return static_cast<unsigned>(fake.get(name)[0]); };
        const gl::framebuffer into(c);
        for (const depths& d : {depths{gl::depth_use::none, false, always, true},
                                {gl::depth_use::overwritten, true, always, true},
                                {gl::depth_use::not_before_stored, true, lequal, false},
                                {gl::depth_use::nearest_stays, true, greater, true},
                                {gl::depth_use::none, false, always, true}})
            for (int channel = -1; channel < 4; ++channel)
                for (const bool maximum : {false, true})
                    for (const unsigned culled : {0u, front, back_face}) {
                        const unsigned culled_before = state(cull_face_mode);
                        gl::begin_pass(c, {into.name(), {17, 19}, d.use, channel, maximum, culled});
                        CHECK(state(draw_framebuffer_binding) == into.name());
                        CHECK(fake.get(viewport) == fake_gl::values{0, 0, 17, 19});
                        CHECK((state(depth_test) != 0) == d.tested);
                        CHECK((state(depth_clamp) != 0) == (d.tested && c.depth_clamp));
                        if (d.tested) CHECK(state(depth_func) == d.passes);
                        if (d.tested) CHECK((state(depth_writemask) != 0) == d.written);
                        for (int i = 0; i < 4; ++i)
                            CHECK((fake.get(color_writemask)[static_cast<std::size_t>(i)] > 0) == (channel < 0 || channel == i));
                        CHECK((state(blend) != 0) == maximum);
                        CHECK(state(blend_equation_rgb) == (maximum ? blend_max : func_add));
                        CHECK((state(cull_face) != 0) == (culled != 0));
                        CHECK(state(cull_face_mode) == (culled != 0 ? culled : culled_before));
                    }
        CHECK(fake.wrong == "");
    }
}

TEST_CASE("a pass of which no more is said draws every channel over what was there, both faces, without depths") {
    fake_gl fake("3.3");
    const gl::context c = *gl::context::of(fake.table);
    gl::begin_pass(c, {});
    CHECK(fake.get(draw_framebuffer_binding)[0] < 1);
    CHECK(fake.get(color_writemask) == fake_gl::values{1, 1, 1, 1});
    for (const unsigned what : {depth_test, blend, cull_face}) CHECK(fake.get(what)[0] < 1);
}
