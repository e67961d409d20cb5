// Tests on every GL context that can be made here, see gl_context.hpp; where there is none they skip, and say so.
//
//     test::in_every_gl_context([](const gnomon::gl::context& c) { ... });
#pragma once

#include "gl_context.hpp"

#include <doctest/doctest.h>

#include <string>

namespace test {

/// Says why a test, or a part of it, does not run; ctest calls a case skipped that says "skipped: no GL context".
inline void skip(const std::string& why) { MESSAGE("skipped: " << why); }

/// Calls body(const gnomon::gl::context&) with every context that this process can make, current and newly made. Where it is none, the
/// case is skipped, with a sentence.
template <typename Body> void in_every_gl_context(Body&& body) {
    bool any = false;
    std::string why;
    for (const gl_kind kind : {gl_4_5, gl_3_3, gl_es}) {
        if (!gl_asked_for(kind.name) && !(kind.es && gl_asked_for("es3.0"))) continue;
        const gl_context made(kind);
        if (!made) {
            why = made.why_not();
            MESSAGE("left out: " << why);
            continue;
        }
        any = true;
        INFO("context: ", made.name());
        body(made.context());
        const auto left = made.context().problem_while("after the test");
        CHECK(left.sentence == "");
    }
    if (!any) skip(why.empty() ? "no GL context is asked for" : why);
}

} // namespace test
