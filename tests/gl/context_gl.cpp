#include <gnomon/gl/context.hpp>

#include "../support/egl.hpp"

TEST_CASE("a context says what it is, and holds all that gl/ calls") {
    test::in_every_gl_context([](const gnomon::gl::context& c) {
        CHECK(c.version >= (c.es ? 30 : 33));
        CHECK(c.max_texture_size >= 1024);
        CHECK(c.max_draw_buffers >= (c.since(33, 32) ? 4 : 1));
        CHECK(gnomon::gl::missing_functions(*c.gl, c.es, c.version) == "");
    });
}

TEST_CASE("two contexts of two kinds live at once") {
    test::gl_context one(test::gl_3_3), two(test::gl_es);
    if (!one || !two) return test::skip(one ? two.why_not() : one.why_not());
    one.make_current();
    CHECK(one.functions().GetString(gnomon::gl::enums::version) != nullptr);
    CHECK_FALSE(one.context().es);
    CHECK(one.context().version == 33);
    CHECK(two.context().es);
}
