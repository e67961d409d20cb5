#include <gnomon/gl/functions.hpp>

#include "../support/fake_gl.hpp"

#include <doctest/doctest.h>

namespace gl = gnomon::gl;

TEST_CASE("a loader is asked for every function by GL's name, and the table holds its answers") {
    const test::fake_gl fake("4.5");
    int asked = 0;
    const auto ask = fake.loader();
    const gl::functions table = gl::load([&](const char* name) {
        CHECK(std::string(name).substr(0, 2) == "gl");
        ++asked;
        return ask(name);
    });
    CHECK(asked == static_cast<int>(sizeof(gl::functions) / sizeof(void (*)())));
    CHECK(static_cast<std::size_t>(asked) == fake.entries.size());
    CHECK((table.BindTexture == fake.table.BindTexture));
    CHECK((table.ResumeTransformFeedback == fake.table.ResumeTransformFeedback));
}

TEST_CASE("loaders that return void pointers or pointers to functions both serve") {
    const test::fake_gl fake("3.3");
    const auto as_void = [&](const char* name) { return std::bit_cast<void*>(fake.loader()(name)); };
    CHECK((gl::load(as_void).ClearBufferfi == fake.table.ClearBufferfi));
    CHECK((gl::load(fake.loader()).ClearBufferfi == fake.table.ClearBufferfi));
}

TEST_CASE("what a loader lacks is found by name, where the version has it") {
    test::fake_gl fake("4.5");
    fake.entries.erase("glBlitFramebuffer");
    fake.entries.erase("glViewportIndexedf");
    fake.entries.erase("glClipControlEXT");
    const gl::functions table = gl::load(fake.loader());
    CHECK(gl::missing_functions(table, false, 45) == "glBlitFramebuffer, glViewportIndexedf");
    CHECK(gl::missing_functions(table, false, 41) == "glBlitFramebuffer, glViewportIndexedf");
    CHECK(gl::missing_functions(table, false, 33) == "glBlitFramebuffer");
    CHECK(gl::missing_functions(table, true, 32) == "glBlitFramebuffer");
}

TEST_CASE("of an empty table ES 3.0 misses no function that only desktops have") {
    const std::string es = ", " + gl::missing_functions({}, true, 30) + ",";
    const std::string desktop = ", " + gl::missing_functions({}, false, 33) + ",";
    for (const char* name : {"glPolygonMode", "glDepthRange", "glGetDoublev", "glIsEnabledi", "glColorMaski"}) {
        CHECK(es.find(std::string(", ") + name + ",") == std::string::npos);
        CHECK(desktop.find(std::string(", ") + name + ",") != std::string::npos);
    }
    CHECK(es.find(", glDepthRangef,") != std::string::npos);
    CHECK(desktop.find(", glDepthRangef,") == std::string::npos); // GL 4.1
}
