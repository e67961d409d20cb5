#include "../support/bits.hpp"
#include "../support/float_dice.hpp"
#include "../support/formats.hpp"
#include "../support/glsl.hpp"
#include "../support/sweep.hpp"

#include <gnomon/texel/half.hpp>
#include <gnomon/texel/texel.hpp>

#include <cstdint>
#include <vector>

#include "../support/glsl_begin.inl"
namespace {
using namespace test::glsl;
namespace unorm8_text {
#include "golden/caster_rgba8.glsl"
}
namespace unorm16_text {
#include "golden/caster_rgba16.glsl"
}
namespace half16_text {
#include "golden/caster_rgba16f.glsl"
}
namespace float32_text {
#include "golden/caster_rgba32f.glsl"
}
namespace opaque_text {
#include "golden/caster_rg32f.glsl"
}
namespace tm8_text {
#include "golden/caster_tm8.glsl"
}
namespace tm16_text {
#include "golden/caster_tm16.glsl"
}
namespace bound_text {
#include "golden/bound_rgb8.glsl"
}
namespace rectangles_text {
#include "golden/rectangles_vertex.glsl"
}
namespace surfaces_text {
#include "golden/surfaces_vertex.glsl"
}
} // namespace
#include "../support/glsl_end.inl"

namespace {

using namespace gnomon;
using test::glsl::real;

bool exceeds(float a, float b, float c) { return unorm8_text::gnomon_exceeds(a, b, c); }
/// In doubles, in which the product of two floats is exact.
bool exceeds_in_doubles(float a, float b, float c) {
    return static_cast<double>(a) * static_cast<double>(b) > static_cast<double>(c);
}
float neighbour(float v, int away) {
    for (; away > 0; --away) v = test::up(v);
    for (; away < 0; ++away) v = test::down(v);
    return v;
}

/// Depths next to which an encoder of so many codes may err: both sides of every tie and every code; and floats of every size.
std::vector<float> trying(double codes) {
    std::vector<float> tried(test::hostile_floats.begin(), test::hostile_floats.end());
    for (int i = 0; i <= static_cast<int>(2.0 * codes); ++i) {
        const auto middle = static_cast<float>(i / (2.0 * codes));
        for (int away = -3; away <= 3; ++away) tried.push_back(neighbour(middle, away));
    }
    test::float_dice roll(551);
    for (int i = 0; i < 100'000; ++i) tried.push_back(roll.any_unit());
    for (int i = 0; i < 20'000; ++i) tried.push_back(roll.any());
    return tried;
}

/// What a text writes for a texel, against what the scalar functions store.
template <typename Texel, typename Caster, typename Translucent, typename Output>
void compare(const Caster& caster, const Translucent& translucent, const Output& output, double codes) {
    using channel_type = typename Texel::channel_type;
    const auto stored = [&](int c) { return channel_type::encode(static_cast<double>(output()[c].value)); };
    test::sweep wrong, wrong_order;
    float before_depth = 0.0f, before_order = 0.0f;
    for (const float s : trying(codes)) {
        const Texel expected = Texel::caster(s);
        caster(s);
        for (int c = 0; c < Texel::channels; ++c) wrong.unless(gnomon::same(stored(c), expected.stored[c]), "s", s, "channel", c);
        const float depth = channel_type::code(expected.stored[0]), order = test::glsl::gl_FragDepth.value;
        wrong_order.unless(order > 0.0f && order <= 1.0f, "s", s);
        wrong_order.unless((depth > before_depth) == (order > before_order) && (depth < before_depth) == (order < before_order),
                           "s", s);
        before_depth = depth;
        before_order = order;
        if constexpr (Texel::effects.translucency) {
            translucent(0.25f, s); // an opacity that tries as much
            const Texel through = Texel::caster(0.25f, s);
            for (int c = 0; c < Texel::channels; ++c)
                wrong.unless(gnomon::same(stored(c), through.stored[c]), "opacity", s, "channel", c);
        }
    }
    CHECK(wrong.report() == "");
    CHECK(wrong_order.report() == "");
}

} // namespace

TEST_CASE("gnomon_exceeds compares a product as if it were not rounded") {
    test::sweep wrong;
    const auto holds = [&](float a, float b, float c) { wrong.unless(exceeds(a, b, c) == exceeds_in_doubles(a, b, c), a, b, c); };
    for (const float a : test::hostile_floats)
        for (const float b : test::hostile_floats)
            for (const float c : test::hostile_floats) holds(a, b, c);
    test::float_dice roll(550);
    for (int i = 0; i < 300'000; ++i) {
        const float a = roll.any(), b = roll.any();
        holds(a, b, roll.any());
        const float product = a * b; // a float beside the product, where they are hardest to tell apart
        if (!(product - product <= 0.0f)) continue;
        for (int away = -1; away <= 1; ++away) holds(a, b, neighbour(product, away));
        holds(a, b, neighbour(product, roll(-64, 64))); // where floats begin to tell
    }
    for (int i = 0; i < 300'000; ++i) { // products that are floats
        const float a = static_cast<float>(roll(1, 4095)) * 0x1p-12f, b = test::float_of(0x3F800000u + (roll.word() & 0x7FF000u));
        for (const float sign : {1.0f, -1.0f})
            for (int away = -1; away <= 1; ++away) holds(sign * a, b, neighbour(sign * (a * b), away));
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("gnomon_half is the nearest half, ties to even, and a half") {
    test::sweep wrong;
    const auto holds = [&](float v) {
        const float made = half16_text::gnomon_half(v).value, expected = half_to_float(half_from(static_cast<double>(v)));
        wrong.unless(test::same_bits(made, expected) || (test::is_nan(v) && test::is_nan(made)), v, made, expected);
    };
    for (std::uint32_t h = 0; h < 0x10000; ++h) {
        const float v = half_to_float(static_cast<std::uint16_t>(h));
        holds(v);
        if (!(v - v <= 0.0f)) continue;
        const float next = half_to_float(static_cast<std::uint16_t>(h + 1));
        const float tie = 0.5f * v + 0.5f * next;
        for (int away = -2; away <= 2; ++away) {
            holds(neighbour(v, away));
            if (tie - tie <= 0.0f) holds(neighbour(tie, away));
        }
    }
    for (const float v : test::hostile_floats) holds(v);
    for (const float v : {65519.0f, 65519.996f, 65520.0f}) holds(v); // about to be infinite
    test::float_dice roll(552);
    for (int i = 0; i < 200'000; ++i) holds(roll.any());
    CHECK(wrong.report() == "");
}

TEST_CASE("casters in GLSL are stored as Texel::caster stores them, in the order of their codes") {
    const auto none = [](float, float) {};
    compare<rgba8>([](float s) { unorm8_text::gnomon_caster(s); }, [](float s, float o) { unorm8_text::gnomon_caster(s, o); },
                   [] { return unorm8_text::gnomon_texel; }, 255.0);
    compare<rgba16>([](float s) { unorm16_text::gnomon_caster(s); }, [](float s, float o) { unorm16_text::gnomon_caster(s, o); },
                    [] { return unorm16_text::gnomon_texel; }, 65535.0);
    compare<rgba16f>([](float s) { half16_text::gnomon_caster(s); }, [](float s, float o) { half16_text::gnomon_caster(s, o); },
                     [] { return half16_text::gnomon_texel; }, 4096.0);
    compare<rgba32f>([](float s) { float32_text::gnomon_caster(s); }, [](float s, float o) { float32_text::gnomon_caster(s, o); },
                     [] { return float32_text::gnomon_texel; }, 4096.0);
    compare<rg32f>([](float s) { opaque_text::gnomon_caster(s); }, none, [] { return opaque_text::gnomon_texel; }, 4096.0);
    compare<tm8>([](float s) { tm8_text::gnomon_caster(s); }, none, [] { return tm8_text::gnomon_texel; }, 255.0);
    compare<tm16>([](float s) { tm16_text::gnomon_caster(s); }, none, [] { return tm16_text::gnomon_texel; }, 65535.0);
}

TEST_CASE("a bound in GLSL is the code of its depth in the far channel, at the depth of a caster there") {
    test::sweep wrong;
    for (const float z : trying(255.0)) {
        bound_text::gnomon_caster(z);
        const real depth = test::glsl::gl_FragDepth;
        bound_text::gnomon_depth_opacity.x = z;
        bound_text::main();
        const auto code = unorm8::encode(static_cast<double>(bound_text::gnomon_texel.z.value));
        wrong.unless(code == depth_mask::encode<unorm8>(z) && test::same_bits(test::glsl::gl_FragDepth.value, depth.value), z);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("the vertices of a rectangle are its corners, in clip coordinates that are exact to a thousandth of a texel") {
    test::sweep wrong;
    const auto holds = [&](auto& size, auto& rectangle, const auto& main, int width, int height, texel_rect r) {
        size = test::glsl::ivec2(width, height);
        rectangle = test::glsl::ivec4(r.x0, r.y0, r.x1, r.y1);
        for (int vertex = 0; vertex < 4; ++vertex) {
            test::glsl::gl_VertexID = vertex;
            main();
            const auto at = test::glsl::gl_Position;
            const double x = (static_cast<double>(at.x.value) + 1.0) / 2.0 * width,
                         y = (static_cast<double>(at.y.value) + 1.0) / 2.0 * height;
            const double dx = x - (vertex % 2 == 0 ? r.x0 : r.x1), dy = y - (vertex < 2 ? r.y0 : r.y1);
            wrong.unless(dx * dx < 1e-6 && dy * dy < 1e-6 && at.w == 1.0, width, height, vertex, x, y);
        }
    };
    for (const texel_rect r : {texel_rect{0, 0, 1, 1}, texel_rect{3, 5, 100, 97}, texel_rect{0, 0, 1000, 777}}) {
        holds(rectangles_text::gnomon_size, rectangles_text::gnomon_rectangle, rectangles_text::main, 1000, 777, r);
        holds(surfaces_text::gnomon_size, surfaces_text::gnomon_rectangle, surfaces_text::main, 1000, 777, r);
    }
    CHECK(wrong.report() == "");
}
