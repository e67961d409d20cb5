// Hard cases of a decision: one stored pair, one receiver.
#include <gnomon/receive/decide.hpp>

#include "hard_cases.hpp"

#include "../support/float_dice.hpp"
#include "../support/flush.hpp"
#include "../support/sweep.hpp"
#include "../support/threshold.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace gnomon;
using test::every_rule;
using test::in_full_shadow;
using test::lit;
using test::sweep;

namespace {

/// The paper's own step 4, s = (d-1)/m + 1, as a shader would have it.
float paper_depth(float d, float m) { return (d - 1.0f) / m + 1.0f; }

/// A pair that no filter of ours makes, as it lies in memory. \pre e and m can be stored
template <typename Texel> Texel fed(double e, double m) {
    using channel_type = typename Texel::channel_type;
    const bool paper = Texel::representation_type::clear_depth > 0.0;
    return {{channel_type::store(paper ? 1.0 - e : e), channel_type::store(m)}};
}

} // namespace

// --- h01: m = 0, e = 0. Intensity exactly 0, and no NaN comes out ---------------------------------------------------------------

TEST_CASE_TEMPLATE("h01_clear_texel_is_lit: at every depth and no NaN escapes", Texel, EVERY_TEXEL) {
    for (const rule& r : every_rule)
        for (const float z : test::hostile_floats) CHECK(lit(Texel::clear(), z, r));
    CHECK(test::same_bits(caster_depth(Texel::clear()), 1.0f));
}

TEST_CASE("h01_clear_texel_is_lit: the paper's depth of one is NaN and harmless only to the test written one way round") {
    const volatile float d = 1.0f, m = 0.0f;
    const float s = paper_depth(d, m);
    CHECK(test::is_nan(s));
    for (const float z : {0.0f, 0.5f, 1.0f}) {
        CHECK_FALSE(z > s); // lit
        CHECK(!(z <= s));   // the same test, written the other way round: shadowed
    }
}

// --- h02: m = 0 beside a depth. Cannot arise from e = sum w t, m = sum w; if it is fed, it is lit --------------------------------

TEST_CASE_TEMPLATE("h02_empty_mask_with_depth_is_lit: numbers no filter makes but a texture unit might", Texel, EVERY_TEXEL) {
    for (const double others : {0.0, 1.0 / 255, 0.5, 1.0}) {
        Texel texel{};
        for (auto& stored : texel.stored) stored = Texel::channel_type::encode(others);
        texel.stored[Texel::mask_index] = Texel::channel_type::encode(0.0);
        for (const rule& r : every_rule)
            for (const float z : test::hostile_floats) CHECK(lit(texel, z, r));
        CHECK(test::same_bits(caster_depth(texel), 1.0f));
    }
}

TEST_CASE_TEMPLATE("h02_empty_mask_with_depth_is_lit: one rounding to nearest leaves no depth where it leaves no mask", Texel, rg8,
                   rg16, rg16f, rg32f, test::paper8, test::paper16) {
    sweep wrong;
    for (const float s : test::trying_depths<typename Texel::channel_type>(256))
        for (int taps = 1; taps <= 1089; taps += 64)
            for (int covered = 0; covered <= taps && covered <= 9; ++covered) {
                const filtered<Texel> f = read(test::filtered(Texel::caster(s), covered, taps));
                wrong.unless(f.depth() <= f.mask() && f.depth() >= 0.0, "s", s, "covered", covered, "of", taps);
            }
    CHECK(wrong.report() == "");
}

TEST_CASE("h02_empty_mask_with_depth_is_lit: the paper's d in floats is coarser than its m and so may hold a depth before the near "
          "plane") {
    const filtered<test::paper16f> f = read(test::filtered(test::paper16f::caster(0.0f), 1, 65));
    CHECK(f.depth() > f.mask()); // 1 - d against m, both 1/65
    CHECK(test::same_bits(caster_depth(f), 0.0f));
}

TEST_CASE("h02_empty_mask_with_depth_is_lit: a depth that is cut off instead leaves one and a blend makes thousands of it") {
    const volatile float d = 0.5f, m = 0.0f;
    CHECK(test::equal(paper_depth(d, m), -test::infinity<float>)); // nearer than anything: all is behind it

    // One caster texel in the 33 x 33 of a box of R = 16: m rounds to 0, d = 1 - e is cut to 254. Beside it lies m = 1, d = 254.
    constexpr double t = 0.5;
    const double cut = std::floor(255.0 * (1.0 - t / 1089.0));
    const auto beside = static_cast<std::uint8_t>(1);
    CHECK(test::equal(cut, 254.0));
    double worst = 0.0;
    sweep wrong;
    for (int right = 1; right < 256; ++right)
        for (int below = 1; below < 256; ++below) {
            const double share = right * below / 65536.0, e = 255.0 - cut, mask = share * beside;
            worst = greater(worst, std::abs(e / mask - t));
            const float s = caster_depth(filtered<test::paper8>{{cut, mask}});
            wrong.unless(s >= 0.0f && s <= 1.0f, "right", right, "below", below, "gives", s);
        }
    CHECK(worst > 1e3);          // of the light's range
    CHECK(wrong.report() == ""); // what the library makes of such a blend stays in it
}

// --- h05: kernels with negative lobes. Refused at compile time: tests/compile_fail/negative_weight.cpp ---------------------------

TEST_CASE_TEMPLATE("h05_negative_lobes_rejected: what another's filter overshoots is lit at m below 0 and full at m above 1", Texel,
                   rg16f, rg32f, test::paper16f, test::paper32f) {
    for (const double t : {0.25, 0.5, 1.0})
        for (const rule& r : every_rule) {
            const Texel below = fed<Texel>(-t / 16.0, -1.0 / 16.0), above = fed<Texel>(t * 17.0 / 16.0, 17.0 / 16.0);
            for (const float z : test::hostile_floats) {
                CHECK(lit(below, z, r));
                const float intensity = shadow(above, z, r);
                CHECK((test::same_bits(intensity, 0.0f) || test::same_bits(intensity, 1.0f)));
            }
            const auto s = static_cast<float>(1.0 - t);
            CHECK(in_full_shadow(above, s + 0x1p-6f, r));
            if (s > 0.0f) CHECK(lit(above, s - 0x1p-6f, r));
        }
}

TEST_CASE(
    "h05_negative_lobes_rejected: floats keep the depth but unorm loses 3 to 10 % of the range and an unguarded test is below 0") {
    constexpr double under = -1.0 / 16.0, over = 17.0 / 16.0; // the taps -1 9 9 -1 over 16, across the edge of a caster
    const auto unorm = [](double v) { return static_cast<double>(unorm8::encode(v)) / 255.0; };
    for (const double t : {0.55, 0.75, 0.9}) {
        CHECK(std::abs(t * over / over - t) < 1e-15);
        CHECK(std::abs(t * under / under - t) < 1e-15);
        const double error = unorm(t * over) / unorm(over) - t; // m was cut to 1, e was not
        CHECK(error > 0.03);
        CHECK(error < 0.10);
        const double r = t + 0.01, e = t * under; // a receiver before the caster
        CHECK((e > under * r ? under : 0.0) < 0.0);
    }
}

// --- h07: s = 1 is t = 0, e = 0; s = 0 is e = m ----------------------------------------------------------------------------------

TEST_CASE_TEMPLATE("h07_casters_at_near_and_far_plane: the first shadows every receiver and the second only beyond the far plane",
                   Texel, EVERY_PLAIN_TEXEL) {
    constexpr rule exactly{.caster = unbiased};
    const auto sure_behind = [](double s) { return static_cast<float>(test::end_of_doubt<Texel>(s, 1.0)) + 0x1p-21f; };
    for (const float z : {test::smallest<float>, 0x1p-20f, 0.5f, 1.0f, 2.0f})
        CHECK(in_full_shadow(Texel::caster(0.0f), z, rule{.caster = towards_shadow}));
    for (const float z : {0x1p-20f, 0.5f, 1.0f, 2.0f}) CHECK(in_full_shadow(Texel::caster(0.0f), z, exactly));
    for (const float z : {sure_behind(0.0), 0.5f, 1.0f}) CHECK(in_full_shadow(Texel::caster(0.0f), z));

    for (const float z : {0.0f, 0.5f, test::down(1.0f), 1.0f}) {
        CHECK(lit(Texel::caster(1.0f), z));
        CHECK(lit(Texel::caster(1.0f), z, exactly));
    }
    CHECK(in_full_shadow(Texel::caster(1.0f), test::up(1.0f), exactly));
    CHECK(in_full_shadow(Texel::caster(1.0f), sure_behind(1.0)));
}

TEST_CASE_TEMPLATE("h07_casters_at_near_and_far_plane: and so they do in every penumbra", Texel, EVERY_PLAIN_TEXEL) {
    for (int covered = 1; covered <= 81; ++covered) {
        const Texel nearest = test::filtered(Texel::caster(0.0f), covered, 81),
                    farthest = test::filtered(Texel::caster(1.0f), covered, 81);
        const float m = Texel::channel_type::decode(nearest.stored[Texel::mask_index]);
        for (const float z : {0x1p-10f, 0.5f, 1.0f}) {
            CHECK(test::same_bits(shadow(nearest, z, {.caster = towards_shadow}), m));
            CHECK(lit(farthest, z));
        }
        CHECK(test::same_bits(shadow(farthest, 1.5f, {.caster = towards_shadow}), m));
    }
}

// --- h08: z <= 0 and NaN are lit, z > 1 is behind every caster, if it is not lit_beyond ------------------------------------------

TEST_CASE_TEMPLATE(
    "h08_receiver_out_of_range: before the near plane and at NaN it is lit and beyond the far plane it is behind every caster",
    Texel, EVERY_TEXEL) {
    for (const float s : {0.0f, 0.25f, 0.5f, 1.0f})
        for (const rule& r : every_rule) {
            for (const float z : {0.0f, -0.0f, -test::smallest<float>, -1.0f, -test::infinity<float>, test::nan<float>})
                CHECK(lit(Texel::caster(s), z, r));
            for (const float z : {1.125f, 2.0f, 0x1p127f, test::infinity<float>}) CHECK(in_full_shadow(Texel::caster(s), z, r));
            for (const float z : {1.125f, test::infinity<float>}) {
                rule forgiving = r;
                forgiving.lit_beyond = true;
                CHECK(lit(Texel::caster(s), z, forgiving));
            }
        }
}

TEST_CASE_TEMPLATE("h08_receiver_out_of_range: at each of the 65536 halves that a shader may hand over", Texel, EVERY_PLAIN_TEXEL) {
    sweep wrong;
    for (unsigned bits = 0; bits < 0x10000; ++bits) {
        const float z = half_to_float(static_cast<std::uint16_t>(bits));
        for (const int covered : {1, 40, 81}) {
            const Texel texel = test::filtered(Texel::caster(0.5f), covered, 81);
            const float m = Texel::channel_type::decode(texel.stored[Texel::mask_index]), intensity = shadow(texel, z);
            const bool out = !(z > 0.0f) || z > 1.0f;
            wrong.unless(test::same_bits(intensity, 0.0f) || test::same_bits(intensity, m), "z", z, "gives", intensity);
            if (out) wrong.unless(test::same_bits(intensity, z > 1.0f ? m : 0.0f), "z", z, "gives", intensity);
        }
    }
    CHECK(wrong.report() == "");
}

// --- h09: z == s is lit under every conservative rule ---------------------------------------------------------------------------

TEST_CASE_TEMPLATE("h09_receiver_on_caster_is_lit: under the default rule at every share of the footprint", Texel,
                   EVERY_PLAIN_TEXEL) {
    sweep wrong;
    for (const float s : test::trying_depths<typename Texel::channel_type>(4096)) // both sides of many codes
        for (int covered = 1; covered <= 25; ++covered)
            wrong.unless(lit(test::filtered(Texel::caster(s), covered, 25), s), "s", s, "covered", covered, "of 25");
    CHECK(wrong.report() == "");
}

TEST_CASE("h09_receiver_on_caster_is_lit: in all of 1.68 million 8-bit cases and without a bias in half of them") {
    constexpr rule least{.caster = {.caster_is_code = true}}, exactly{.caster = unbiased};
    sweep wrong;
    int shadowed = 0, exactly_shadowed = 0, cases = 0;
    for (int code = 0; code < 256; ++code)
        for (int side = 3; side <= 33; side += 2) // boxes of R = 1 to 16
            for (int covered = 1; covered <= side * side; ++covered) {
                const float s = unorm8::decode(static_cast<std::uint8_t>(255 - code));
                const rg8 texel = test::filtered(rg8::caster(s), covered, side * side);
                wrong.unless(lit(texel, s) && lit(texel, s, least), "code", code, "covered", covered, "of", side * side);
                shadowed += lit(texel, s, exactly) ? 0 : 1;
                exactly_shadowed += 255 * texel.stored[0] > code * texel.stored[1]; // at r = code/255, which no float is
                ++cases;
            }
    CHECK(wrong.report() == "");
    CHECK(cases == 1'675'264);
    CHECK(exactly_shadowed > cases * 0.4855); // 48.6 %: a shadow on half of all that casters touch
    CHECK(exactly_shadowed < cases * 0.4865);
    CHECK(shadowed > cases * 0.48); // the nearest float takes sides in what would be ties: 50.5 %
    CHECK(shadowed < cases * 0.52);
}

// --- h10: the same picture with FTZ and DAZ ------------------------------------------------------------------------------------

TEST_CASE_TEMPLATE("h10_denormals_and_ftz_same_picture: flushing changes no intensity above 1e-37", Texel, EVERY_PLAIN_TEXEL) {
    using channel_type = typename Texel::channel_type;
    float (*const volatile decide)(const Texel&, float, const rule&) =
        &shadow<Texel>; // volatile: so that no arithmetic leaves its mode
    test::float_dice dice(10);
    sweep wrong;
    for (int i = 0; i < 100'000; ++i) {
        const auto m = channel_type::encode(static_cast<double>(dice.any_unit())),
                   e = channel_type::encode(static_cast<double>(dice.any_unit()));
        const Texel texel{{lesser(e, m), m}};
        const float z = dice.unit();
        for (const rule& r : every_rule) {
            const float plain = decide(texel, z, r);
            float flushed = 0.0f;
            {
                const test::flush_subnormals mode(true);
                flushed = decide(texel, z, r);
            }
            wrong.unless(test::same_bits(plain, flushed) || (plain < 1e-37f && flushed < 1e-37f), "e", texel.stored[0], "m",
                         texel.stored[1], "z", z, plain, flushed);
        }
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("h10_denormals_and_ftz_same_picture: a subnormal half keeps its value as the processor's own conversion would") {
    float (*const volatile value_of)(std::uint16_t) = &half_to_float;
    sweep wrong;
    const test::flush_subnormals mode(true);
    for (std::uint16_t h = 1; h < 0x400; ++h)
        wrong.unless(test::same_bits(value_of(h), static_cast<float>(h) * 0x1p-24f), "half", h);
    CHECK(wrong.report() == "");
}
