// Numbers that write GLSL, one expression at a time; texts_receive.cpp runs what the formulas make of them.
#include <gnomon/gl/glsl.hpp>

#include <doctest/doctest.h>

#include <limits>
#include <string>

namespace glsl = gnomon::gl::glsl;
using glsl::number;
using glsl::truth;

TEST_CASE("what is known when an expression is written is decided there and then") {
    CHECK((number(2) > number(1)).value() == true);
    CHECK((number(1) > number(2)).value() == false);
    CHECK((number(2) > number("v")).text() == "2.0 > v"); // which is not known
    CHECK(select(truth(true), number("a"), number("b")).text() == "a");
    CHECK(select(truth(false), number("a"), number("b")).text() == "b");
    CHECK(both(truth("p"), truth(true)).text() == "p");
    CHECK(both(truth("p"), truth(false)).value() == false);
}

TEST_CASE("a comparison with a product is exact, on whichever side it is") {
    const number product = number("a") * number("b"), c("c");
    CHECK((product > c).text() == "gnomon_exceeds(a, b, c)");
    CHECK((c < product).text() == "gnomon_exceeds(a, b, c)");
    CHECK((c > product).text() == "gnomon_exceeds(-a, b, -c)"); // -a b > -c
    CHECK((product < c).text() == "gnomon_exceeds(-a, b, -c)");
}

TEST_CASE("a temporary is written if its name is a word of what follows, not if it is a part or a member of one") {
    const auto written = [](const char* statement) {
        glsl::block body;
        body.let("e", number("texel.x"));
        body.say(statement);
        return body.text().find("precise float e = texel.x;") != std::string::npos;
    };
    for (const char* uses : {"return e;", "return v*e/2.0;", "return e.x;", "return ve + (e);"}) CHECK(written(uses));
    for (const char* others : {"v;", "v.e;", "1e-7;", "e_2;", "_e;", "e2;", "ve;", "ez;", "ze;"}) CHECK_FALSE(written(others));
}

TEST_CASE("a float that is no number or infinite is written as its bits") {
    using limits = std::numeric_limits<float>;
    CHECK(number(limits::infinity()).text() == "uintBitsToFloat(" + std::to_string(0x7F800000u) + "u)");
    CHECK(number(-limits::infinity()).text() == "uintBitsToFloat(" + std::to_string(0xFF800000u) + "u)");
    CHECK(number(limits::quiet_NaN()).text() == "uintBitsToFloat(" + std::to_string(0x7FC00000u) + "u)");
    CHECK(number(limits::max()).text() == "3.4028235e+38");
}
