#include "golden_texts.hpp"

#include "../support/bits.hpp"
#include "../support/float_dice.hpp"
#include "../support/formats.hpp"
#include "../support/glsl.hpp"
#include "../support/images.hpp"
#include "../support/sweep.hpp"
#include "../support/threshold.hpp"

#include <cstdint>
#include <type_traits>

#include "../support/glsl_begin.inl"
namespace {
using namespace test::glsl;
namespace rg8_text {
#include "golden/receive_rg8.glsl"
}
namespace rg16_text {
#include "golden/receive_rg16.glsl"
}
namespace rg16f_text {
#include "golden/receive_rg16f.glsl"
}
namespace rg32f_text {
#include "golden/receive_rg32f.glsl"
}
namespace tm8_text {
#include "golden/receive_tm8.glsl"
}
namespace rgb8_text {
#include "golden/receive_rgb8.glsl"
}
namespace rgba8_text {
#include "golden/receive_rgba8_fading.glsl"
}
namespace rgb16f_text {
#include "golden/receive_rgb16f_fading.glsl"
}
namespace uniforms_text {
#include "golden/receive_rgb8_uniforms.glsl"
}
} // namespace
#include "../support/glsl_end.inl"

namespace {

using namespace gnomon;
namespace glsl = test::glsl;

/// The texture that holds one texel, or an image of them.
template <texel_format Texel> glsl::sampler2D texture(image_view<const Texel> from) {
    return {glsl::ivec2(from.width(), from.height()), [from](glsl::ivec2 at) {
                glsl::vec4 read;
                for (int c = 0; c < Texel::channels; ++c) read[c] = Texel::channel_type::decode(from(at.x, at.y).stored[c]);
                return read;
            }};
}

/// The depths at which a decision may be wrong: beside that where the shadow begins; and what is no depth.
template <texel_format Texel, typename Shadow>
void compare_at_threshold(test::sweep& wrong, const Texel& texel, const rule& rule, const Shadow& text) {
    const auto holds = [&](float z) {
        const float expected = shadow(texel, z, rule), made = text(texel, z);
        wrong.unless(test::same_bits(made + 0.0f, expected + 0.0f), texel.stored[0], texel.stored[1], "z", z, made, expected);
    };
    const float first = test::first_shadowed(texel, rule);
    for (const float z : {test::down(test::down(first)), test::down(first), first, test::up(first)}) holds(z);
    for (const float z : {0.0f, test::up(0.0f), 0.5f, test::down(0.5f), 1.0f, test::up(1.0f), 2.0f, -1.0f, test::infinity<float>,
                          -test::infinity<float>, test::nan<float>})
        holds(z);
}

template <typename Texel> Texel pair(typename Texel::storage e, typename Texel::storage m) { return {{e, m}}; }

/// The text's decision about one stored texel, read through a texture.
#define TEXT(space)                                                                                                                \
    [](const auto& stored, float receiver) {                                                                                       \
        using type = std::remove_cvref_t<decltype(stored)>;                                                                        \
        return space::gnomon_shadow(texture(image_view<const type>(&stored, {1, 1})), glsl::ivec2(0), receiver).value;             \
    }

} // namespace

TEST_CASE("every pair of bytes decides in GLSL as on the CPU, a float to each side of where its shadow begins") {
    test::sweep wrong;
    for (int e = 0; e < 256; ++e)
        for (int m = 0; m < 256; ++m)
            compare_at_threshold(wrong, pair<rg8>(static_cast<std::uint8_t>(e), static_cast<std::uint8_t>(m)), rule{},
                                 TEXT(rg8_text));
    CHECK(wrong.report() == "");
}

TEST_CASE("gnomon_exceeds compares a product of a blend as if it were not rounded") {
    test::sweep wrong;
    test::float_dice roll(558);
    const auto number = [&] {
        const int halves = roll(-(1 << roll(0, 18)), 1 << roll(0, 18));
        return glsl::vec2(static_cast<float>(halves) * 0.5f, static_cast<float>(roll(-65535, 65535)) * 0x1p-16f);
    };
    const auto holds = [&](glsl::vec2 a, float b, glsl::vec2 c) {
        test::exact_sum difference;
        for (const auto part : {a.x, a.y}) difference.add_product(static_cast<double>(part.value), static_cast<double>(b));
        for (const auto part : {c.x, c.y}) difference.add(static_cast<double>(-part.value));
        wrong.unless(rg16_text::gnomon_exceeds(a, b, c) == (difference.sign() > 0), a.x.value, a.y.value, b, c.x.value, c.y.value);
    };
    for (int i = 0; i < 200'000; ++i) {
        const auto a = number(), c = number();
        const double share = (static_cast<double>(c.x.value) + static_cast<double>(c.y.value)) /
                             (static_cast<double>(a.x.value) + static_cast<double>(a.y.value));
        if (share - share <= 0.0) // where the two are hardest to tell apart
            for (const float b :
                 {test::down(static_cast<float>(share)), static_cast<float>(share), test::up(static_cast<float>(share))})
                holds(a, b, c);
        holds(a, static_cast<float>(roll(-65536, 65536)) * 0x1p-16f, c);
        const auto whole = glsl::vec2(static_cast<float>(roll(0, 131072)) * 0.5f, 0.0f); // products that are such numbers
        const float b = static_cast<float>(roll(-256, 256)) * 0x1p-8f;
        for (int away = -1; away <= 1; ++away)
            holds(whole, b,
                  glsl::vec2(0.0f, 0.0f) + glsl::vec2(0.5f * static_cast<float>(static_cast<int>(2.0f * (whole.x.value * b))),
                                                      static_cast<float>(away) * 0x1p-16f));
    }
    for (const float b : test::hostile_floats)
        for (const auto a : {glsl::vec2(0.0f, 0.0f), glsl::vec2(1.0f, -1.0f), glsl::vec2(65535.5f, 0x1p-16f),
                             glsl::vec2(-3.0f, 0x1p-16f), glsl::vec2(0.0f, 0x1p-16f)})
            for (const auto c :
                 {glsl::vec2(0.0f, 0.0f), glsl::vec2(0.0f, -0x1p-16f), glsl::vec2(65536.0f, 0.0f), glsl::vec2(-65536.5f, 0.5f)}) {
                const auto sum = [](glsl::vec2 v) { return static_cast<double>(v.x.value) + static_cast<double>(v.y.value); };
                const bool expected = sum(a) * static_cast<double>(b) > sum(c); // so few bits are exact in doubles
                wrong.unless(rg16_text::gnomon_exceeds(a, b, c) == expected, a.x.value, a.y.value, b, c.x.value, c.y.value);
            }
    CHECK(wrong.report() == "");
}

TEST_CASE("gnomon_divide is the nearest float, of every code, of blends of bytes, and of floats by numbers of 16 bits") {
    test::sweep wrong;
    const auto holds = [&](float a, float b) {
        const float inverse = 1.0f / b;
        for (const float by : {test::down(test::down(inverse)), inverse, test::up(test::up(inverse))})
            wrong.unless(test::same_bits(rg8_text::gnomon_divide(a, b, by).value, a / b), a, b, by);
    };
    for (int code = 0; code <= 255; ++code)
        for (int by = 0; by <= 255; ++by) holds(static_cast<float>(code * by), 65025.0f); // ratios
    for (int code = 0; code <= 65535; ++code) holds(static_cast<float>(code), 65535.0f);
    for (int sum = 0; sum <= 255 * 65536; sum += 13) holds(static_cast<float>(sum) / 65536.0f, 255.0f);
    test::float_dice roll(560);
    for (int taps = 1; taps <= 255; ++taps)
        for (int i = 0; i < 1000; ++i) {
            const float sum = roll.any_unit();
            if (sum > 0x1p-78f) holds(sum, static_cast<float>(taps * taps) / 65536.0f);
        }
    CHECK(wrong.report() == "");
}

TEST_CASE("every ratio of bytes decides in GLSL as on the CPU") {
    test::sweep wrong;
    for (int t = 0; t < 256; ++t)
        for (int m = 0; m < 256; ++m)
            compare_at_threshold(wrong, pair<tm8>(static_cast<std::uint8_t>(t), static_cast<std::uint8_t>(m)), rule{},
                                 TEXT(tm8_text));
    CHECK(wrong.report() == "");
}

TEST_CASE("pairs of 16 bits, of halves and of floats decide in GLSL as on the CPU") {
    test::sweep wrong;
    test::float_dice roll(554);
    const auto word = [&](int low, int high) { return static_cast<std::uint16_t>(roll(low, high)); };
    for (int i = 0; i < 30'000; ++i) {
        const auto m = word(0, roll.one_in(2) ? 65535 : 40);
        compare_at_threshold(wrong, pair<rg16>(word(0, m), m), rule{}, TEXT(rg16_text));
        compare_at_threshold(wrong, pair<rg16>(word(0, 65535), m), rule{}, TEXT(rg16_text));
        const float mask = roll.any_unit(), depth = mask * roll.unit();
        if (mask > 0x1p-100f) compare_at_threshold(wrong, pair<rg32f>(depth, mask), rule{}, TEXT(rg32f_text)); // no subnormals
        compare_at_threshold(wrong, pair<rg32f>(roll.any_unit(), roll.any_unit()), rule{}, TEXT(rg32f_text));
    }
    for (int e = 0; e < 65536; ++e) // every half, NaN and infinities too
        for (const int m : {0, 1, 0x3FF, 0x400, 0x3800, 0x3BFF, 0x3C00, 0x7C00, 0x7E00, 0xBC00, e, (e * 7) & 0xFFFF}) {
            compare_at_threshold(wrong, pair<rg16f>(static_cast<std::uint16_t>(e), static_cast<std::uint16_t>(m)), rule{},
                                 TEXT(rg16f_text));
        }
    CHECK(wrong.report() == "");
}

TEST_CASE("a fade past the far bound is in GLSL what it is on the CPU, within 2^-14, and nothing else is otherwise") {
    test::dice roll(555);
    test::sweep wrong;
    const auto holds = [&](const auto& texel, const auto& text) {
        for (int i = 0; i < 8; ++i) {
            const float z = i < 4 ? roll.unit() : 1.5f * roll.unit() - 0.25f;
            const double expected = static_cast<double>(shadow(texel, z, test::fading)), made = static_cast<double>(text(texel, z));
            wrong.unless(made - expected < 0x1p-14 && expected - made < 0x1p-14, texel.stored[0], texel.stored[1], texel.stored[2],
                         z, made, expected);
        }
    };
    for (int i = 0; i < 30'000; ++i) {
        const auto caster8 = test::any_caster<rgba8>(roll);
        holds(caster8, TEXT(rgba8_text));
        holds(test::filtered(caster8, roll(1, 49), 49, test::any_caster<rgba8>(roll)), TEXT(rgba8_text));
        const auto caster16 = test::any_caster<rgb16f>(roll);
        holds(test::filtered(caster16, roll(1, 49), 49, test::any_caster<rgb16f>(roll)), TEXT(rgb16f_text));
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("without a fade a shadow ends at its far bound in GLSL as on the CPU, in every bit") {
    test::dice roll(559);
    test::sweep wrong;
    int bounded = 0;
    for (int i = 0; i < 30'000; ++i) {
        const auto texel = test::filtered(test::any_caster<rgb8>(roll), roll(1, 49), 49, test::any_caster<rgb8>(roll));
        const float z = 1.25f * roll.unit(), expected = shadow(texel, z);
        wrong.unless(test::same_bits(TEXT(rgb8_text)(texel, z), expected), texel.stored[0], texel.stored[1], texel.stored[2], z);
        bounded += !test::same_bits(expected, shadow(texel, z, rule{.fade = 1.0f}));
    }
    CHECK(wrong.report() == "");
    CHECK(bounded > 1000);
}

TEST_CASE("a rule in uniforms decides as the same rule printed") {
    test::dice roll(556);
    test::sweep wrong;
    const bias moved{.towards = bias_towards::shadow, .roundings = 2, .depth = 0.125f},
        code{.depth = 0.0625f, .caster_is_code = true};
    for (const rule& r : {rule{}, rule{.caster = unbiased, .lit_beyond = true}, rule{.caster = moved, .far_bound = code},
                          rule{.caster = towards_shadow, .far_bound = moved}}) {
        const auto set = [](glsl::vec4& four, glsl::real& nearer, const bias& b) {
            const auto by = bias_steps<rgb8, float>::of(b);
            four = glsl::vec4(by.depth_less, by.depth_share, by.mask_more, by.mask_share);
            nearer = by.nearer;
        };
        set(uniforms_text::gnomon_caster_bias, uniforms_text::gnomon_caster_nearer, r.caster);
        set(uniforms_text::gnomon_bound_bias, uniforms_text::gnomon_bound_nearer, r.far_bound);
        uniforms_text::gnomon_fade = r.fade;
        uniforms_text::gnomon_lit_beyond = r.lit_beyond;
        for (int i = 0; i < 5'000; ++i) {
            const auto texel = test::filtered(test::any_caster<rgb8>(roll), roll(1, 49), 49, test::any_caster<rgb8>(roll));
            for (int k = 0; k < 4; ++k) {
                const float z = 1.25f * roll.unit();
                wrong.unless(test::same_bits(TEXT(uniforms_text)(texel, z), shadow(texel, z, r)), texel.stored[0], texel.stored[1],
                             texel.stored[2], z);
            }
        }
    }
    CHECK(wrong.report() == "");
}

namespace {

/// Decisions about blends: the shadow may begin `share` of the reversed depth, and `floats` of 2^-24, from where it does on the CPU.
template <texel_format Texel, typename Shadow> void compare_blends(const Shadow& text, double share, double floats) {
    test::float_dice roll(557);
    const image<Texel> map = test::noise<Texel>(roll, {9, 7}, 2);
    const auto begins = [](const auto& shadowed) {
        std::uint32_t lit = 0, dark = 0x3F800000;
        while (dark - lit > 1) {
            const std::uint32_t middle = lit + (dark - lit) / 2;
            (shadowed(test::float_of(middle)) ? dark : lit) = middle;
        }
        return static_cast<double>(test::float_of(dark));
    };
    test::sweep wrong;
    const auto holds = [&](float x, float y) {
        const auto blend = sample(map.view(), x, y);
        const auto scalar = [&](float z) { return shadow(blend, z); };
        const auto glsl_text = [&](float z) { return text(texture(map.view()), glsl::vec2(x, y), z).value; };
        const double expected = begins([&](float z) { return scalar(z) > 0.0f; }),
                     made = begins([&](float z) { return glsl_text(z) > 0.0f; });
        const double off = expected > made ? expected - made : made - expected;
        wrong.unless(off <= share * (1.0 - made) + floats * 0x1p-24, x, y, expected, made);
        const float full = scalar(2.0f), full_text = glsl_text(2.0f);
        wrong.unless(full_text - full <= 0x1p-22f && full - full_text <= 0x1p-22f, x, y, full, full_text);
    };
    for (int i = 0; i < 3'000; ++i) holds(11.0f * roll.unit() - 1.0f, 9.0f * roll.unit() - 1.0f);
    for (int i = 0; i < 2'000; ++i) { // between two 256ths, and beside the borders
        const float x = static_cast<float>(roll(-520, 10 * 512)) / 512.0f, y = static_cast<float>(roll(-520, 8 * 512)) / 512.0f;
        holds(x, y);
        holds(test::up(x), test::down(y));
    }
    for (const float v : test::hostile_floats) {
        holds(v, 3.25f);
        holds(2.25f, v);
    }
    CHECK(wrong.report() == "");
}

} // namespace

TEST_CASE("blends decide in GLSL as on the CPU, to the bit where codes are whole, else within what is written") {
    compare_blends<rg8>([](const auto&... of) { return rg8_text::gnomon_shadow_at(of...); }, 0.0, 0.0);
    compare_blends<rg16>([](const auto&... of) { return rg16_text::gnomon_shadow_at(of...); }, 0.0, 0.0);
    compare_blends<tm8>([](const auto&... of) { return tm8_text::gnomon_shadow_at(of...); }, 0.0, 0.0);
    compare_blends<rg16f>([](const auto&... of) { return rg16f_text::gnomon_shadow_at(of...); }, 0x1p-20, 2.0);
    compare_blends<rg32f>([](const auto&... of) { return rg32f_text::gnomon_shadow_at(of...); }, 0x1p-20, 2.0);
}
