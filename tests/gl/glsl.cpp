// Numbers that write GLSL, one expression at a time; texts_receive.cpp runs what the formulas make of them.
#include <gnomon/gl/glsl.hpp>
#include <gnomon/gl/glsl_text.hpp>
#include <gnomon/texel/depth_mask.hpp>
#include <gnomon/unit.hpp>

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

TEST_CASE("of two known numbers the greater is greater, and of equals neither") {
    CHECK((number(2) > number(2)).value() == false);
    CHECK((number("v") > number(2)).text() == "v > 2.0");
    CHECK((number("v") < number("w") + number("x")).text() == "v < w + x");
    CHECK_FALSE((number("v") > number(2)).value().has_value());
}

TEST_CASE("a word after an at sign is replaced wherever it stands") {
    using gnomon::gl::detail::filled;
    CHECK(filled("@a and @a", {{"a", "a long text"}}) == "a long text and a long text");
    CHECK(filled("@a@a", {{"a", "@a"}}) == "@a@a"); // and what replaces it is none any more
    CHECK(filled("@b or a", {{"a", "x"}, {"b", ""}}) == " or a");
}

TEST_CASE("the formulas of the library are written down as they stand") {
    const number e("e"), m("m"), z("z");
    CHECK(gnomon::saturate(z).text() == "z > 0.0 ? (z < 1.0 ? z : 1.0) : 0.0");
    CHECK(gnomon::depth_mask::behind(e, m, z).text() == "z < 0.5 ? gnomon_exceeds(m, z, m - e) : gnomon_exceeds(-m, 1.0 - z, -e)");
}

TEST_CASE("a condition is written with the parentheses that it needs, and without what is known") {
    const truth p("p"), q("q"), r("r");
    CHECK(truth(true).text() == "true");
    CHECK(truth(false).text() == "false");
    CHECK((!truth(true)).value() == false);
    CHECK((!truth(false)).value() == true);
    CHECK((!p).text() == "!p");
    CHECK((!both(p, q)).text() == "!(p && q)");
    CHECK(both(p, both(q, r)).text() == "p && q && r");
    CHECK(both(truth(true), p).text() == "p");
    CHECK(both(truth(false), p).value() == false);
    CHECK(select(p, q, r).text() == "p ? q : r");
    CHECK(select(both(p, q), r, select(p, q, r)).text() == "p && q ? r : (p ? q : r)");
    CHECK(both(p, select(p, q, r)).text() == "p && (p ? q : r)");
}

TEST_CASE("a number is written with the parentheses that it needs, and without what changes nothing") {
    const number a("a"), b("b"), c("c");
    CHECK(number().text() == "0.0");
    CHECK(number(3).text() == "3.0");
    CHECK(number(0.5).text() == "0.5");
    for (const number& same : {a + number(0), a - number(0), a * number(1), a / number(1)}) CHECK(same.text() == "a");
    CHECK((a + number(1)).text() == "a + 1.0");
    CHECK((a * number(0)).text() == "a * 0.0");
    CHECK((a / b).text() == "a / b");
    CHECK(((a + b) / number(2) * c).text() == "gnomon_divide(a + b, 2.0, 0.5) * c");
    CHECK_FALSE((a / number(2)).is_short());
    CHECK((a - number(-2)).text() == "a + 2.0");
    CHECK((a - number(0.5)).text() == "a - 0.5");
    CHECK((-a).text() == "-a");
    CHECK((-(a + b)).text() == "-(a + b)");
    CHECK((a + b + c).text() == "a + b + c");
    CHECK((a + (b + c)).text() == "a + b + c");
    CHECK((a - b - c).text() == "a - b - c");
    CHECK((a - (b - c)).text() == "a - (b - c)");
    CHECK((a - b * c).text() == "a - b * c");
    CHECK((a * b + c).text() == "a * b + c");
    CHECK(((a + b) * (b - c)).text() == "(a + b) * (b - c)");
    CHECK((a / (b * c)).text() == "a / (b * c)");
    const truth p("p"), q("q");
    CHECK(select(p, a + b, c).text() == "p ? a + b : c");
    CHECK(select(both(p, q), select(p, a, b), c).text() == "p && q ? (p ? a : b) : c");
    CHECK(a.is_short());
    CHECK(number(2).is_short());
    CHECK_FALSE((a + b).is_short());
}

TEST_CASE("a wide number stays one among sums, and is a float in all else") {
    glsl::block body;
    const number w = number::wide("w", &body), v = number::wide("v", nullptr), a("a");
    const auto wide = [](const number& made, const char* text) { return made.is_wide() && made.text() == text; };
    const auto single = [](const number& made, const char* text) { return !made.is_wide() && made.text() == text; };
    CHECK(wide(w, "w"));
    CHECK(single(a, "a"));
    CHECK(wide(-w, "-w"));
    CHECK(wide(w + v, "w + v"));
    CHECK(wide(w + a, "w + vec2(a, 0.0)"));
    CHECK(wide(w - a, "w - vec2(a, 0.0)"));
    CHECK(single(a + w, "a + w.x + w.y"));
    CHECK(single(a - w, "a - (w.x + w.y)"));
    CHECK(single(w * a, "(w.x + w.y) * a"));
    CHECK(single((w + v) / a, "((w + v).x + (w + v).y) / a"));
    CHECK(single(select(truth("p"), w, a), "p ? w.x + w.y : a"));
    CHECK((w > a).text() == "w.x + w.y > a");
    for (const number& made : {-w, w + a, v + w, a * w, select(truth("p"), a, w), select(truth("p"), w, a)})
        CHECK(made.where() == &body);
    for (const truth& made : {w > a, a<w, w * a> a, !(w > a), both(truth("p"), w > a), select(truth("p"), a > w, truth("q"))})
        CHECK(made.where() == &body);
}

TEST_CASE("a temporary has the type of its value and a name of its own, and stands before what uses it") {
    glsl::block body;
    const number a("a", &body), sum = let("t", a + number(2)), again = let("t", a - number(2));
    CHECK(let("t", a).text() == "a");                             // a name already
    CHECK(let("t", number("b") + number("c")).text() == "b + c"); // of no block
    CHECK(let("t", truth("p")).text() == "p");
    CHECK(sum.text() == "t");
    CHECK(again.text() == "t_2");
    CHECK(let("t", a * number(2)).text() == "t_3");
    const number w = let("w", number::wide("v", &body) + number("b"));
    CHECK((w.is_wide() && w.text() == "w"));
    const truth lit = let("lit", sum > again);
    CHECK(lit.where() == &body);
    CHECK(let("q", a + number(3)).text() == "q");       // which nobody uses
    body.say("if (lit) return w + q0 - q9 * qa / aq;"); // other names
    CHECK(body.text() == "    precise float t = a + 2.0;\n    precise float t_2 = a - 2.0;\n"
                         "    precise vec2 w = v + vec2(b, 0.0);\n    bool lit = t > t_2;\n"
                         "    if (lit) return w + q0 - q9 * qa / aq;\n");
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
