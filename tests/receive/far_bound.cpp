// The far bound ends a shadow; translucency thins it; lit_beyond forgets it. Against the formulas in double.
#include <gnomon/receive/decide.hpp>

#include "../support/bits.hpp"
#include "../support/float_dice.hpp"
#include "../support/formats.hpp"
#include "../support/sweep.hpp"
#include "../support/threshold.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace gnomon;
using test::sweep;

#define EVERY_BOUNDED_TEXEL                                                                                                        \
    rgb8, rgb16, rgb16f, rgb32f, test::ratio_rgba8, test::ratio_rgba16, test::paper_rgba8, test::paper_rgba16,                     \
        test::paper_rgba16f, test::paper_rgba32f

namespace {

/// A caster at s that stands over a receiver at f, filtered.
template <typename Texel> Texel bounded(float s, float f, int covered, int taps) {
    Texel t = Texel::caster(s);
    t.bound(f);
    return test::filtered(t, covered, taps);
}

} // namespace

TEST_CASE("a hard far bound ends the shadow behind it and a soft one fades it out as the formula says") {
    test::float_dice dice(70);
    sweep wrong;
    for (int i = 0; i < 200'000; ++i) {
        const int m = dice(1, 65535), e = dice(0, m), f = dice(1, greater(e, 1)), c = dice(0, 65535);
        const rgba16 texel{{static_cast<std::uint16_t>(e), static_cast<std::uint16_t>(m), static_cast<std::uint16_t>(f),
                            static_cast<std::uint16_t>(c)}};
        const double s = 1.0 - e * 1.0 / m, bound = 1.0 - f * 1.0 / m;
        const float fade = i % 3 == 0 ? 0.0f : dice.unit() * 0.25f;
        const float z = i % 2 == 0 ? dice.unit() : static_cast<float>(bound + static_cast<double>(dice.unit() * 0.25f));
        const rule r{.caster = unbiased, .far_bound = unbiased, .fade = fade};
        const double past = static_cast<double>(z) - bound;
        if (std::abs(past) < 1e-6 || std::abs(static_cast<double>(z) - s) < 1e-6) continue; // the edges have tests of their own
        const double left = past < 0.0 ? 1.0 : (fade > 0.0f ? std::max(0.0, 1.0 - past / static_cast<double>(fade)) : 0.0);
        const double expected = static_cast<double>(z) > s ? c / 65535.0 * left : 0.0;
        const double tolerance =
            0x1p-24 * expected + (fade > 0.0f ? 0x1p-40 / static_cast<double>(fade) : 0.0); // one rounding to float
        wrong.unless(std::abs(static_cast<double>(shadow(texel, z, r)) - expected) <= tolerance, "E", e, "M", m, "F", f, "z", z,
                     "fade", fade);
        const int code = shadow_as<std::uint16_t>(read(texel), z, r);
        wrong.unless(std::abs(code - 65535.0 * expected) <= 0.5 + 65535.0 * tolerance, "code: E", e, "M", m, "F", f, "z", z, "fade",
                     fade);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("the receiver that is the far bound keeps the shadow it would have without one", Texel, EVERY_BOUNDED_TEXEL) {
    test::float_dice dice(71);
    sweep wrong;
    for (int i = 0; i < 200'000; ++i) {
        const float s = dice.unit(), f = lesser(s + (i % 2 == 0 ? dice.unit() : dice.any_unit()), 1.0f);
        const int taps = 9 * dice(1, 30), covered = dice(1, taps);
        const Texel with = bounded<Texel>(s, f, covered, taps), without = test::filtered(Texel::caster(s), covered, taps);
        for (const float z : {f, f - (f - s) * dice.unit()}) // on it, and between it and the caster
            wrong.unless(test::same_bits(shadow(with, z), shadow(without, z)), "s", s, "f", f, "z", z, "covered", covered, "of",
                         taps);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("behind the far bound the shadow is over as soon as a caster there would be certain to shadow", Texel,
                   EVERY_BOUNDED_TEXEL) {
    test::float_dice dice(72);
    sweep wrong;
    for (int i = 0; i < 200'000; ++i) {
        const float s = dice.unit(), f = lesser(s + dice.unit() * (1.0f - s), 0.875f);
        if (f < s) continue;
        const int taps = 9 * dice(1, 30), covered = dice(1, taps);
        const Texel texel = bounded<Texel>(s, f, covered, taps);
        if (!texel.occupied()) continue;
        const float over =
            test::up(test::up(static_cast<float>(test::end_of_doubt<Texel>(static_cast<double>(f), covered * 1.0 / taps)))) +
            0x1p-22f;
        if (over > 1.0f) continue;
        wrong.unless(test::same_bits(shadow(texel, over), 0.0f), "s", s, "f", f, "z", over, "covered", covered, "of", taps);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("a fade over nothing, less than nothing or NaN ends the shadow at once, even where a mask is all doubt", Texel,
                   rgb8, rgb16, test::ratio_rgba8) {
    for (const double share : {1.0, 0x1p-10}) { // of one code, so that a bias towards shadow leaves less than no mask
        filtered<Texel> faint = read(bounded<Texel>(0.25f, 0.5f, 1, static_cast<int>(Texel::channel_type::scale)));
        for (double& code : faint.code) code *= share;
        for (const float fade : {0.0f, -0.0f, -0.5f, -test::infinity<float>, test::nan<float>}) {
            const rule r{.caster = towards_shadow, .far_bound = towards_shadow, .fade = fade};
            CAPTURE(share);
            CAPTURE(fade);
            CHECK(test::same_bits(shadow_as<float>(faint, 0.875f, r), 0.0f));
        }
        const bool all_doubt = faint.mask() < static_cast<double>(Texel::mask_rounding.absolute);
        const rule fading{.caster = towards_shadow, .far_bound = towards_shadow, .fade = 0.5f};
        if (all_doubt) CHECK(test::same_bits(shadow_as<float>(faint, 0.875f, fading), 0.0f));
    }
}

TEST_CASE_TEMPLATE("a shadow that no receiver bounds never ends", Texel, EVERY_BOUNDED_TEXEL) {
    sweep wrong;
    for (const float s : {0.0f, 0.25f, 0.5f, 0.875f})
        for (const int covered : {1, 2, 17, 64, 80, 81}) {
            const Texel texel = test::filtered(Texel::caster(s), covered, 81);
            for (const bias far : {towards_light, unbiased, towards_shadow})
                for (const float fade : {0.0f, 0.5f})
                    for (const float z :
                         {0.9375f, 1.0f, test::up(1.0f), 1.03125f, 1.25f, 1.5f, 2.0f, 65536.0f, test::infinity<float>}) {
                        const rule with{.caster = towards_shadow, .far_bound = far, .fade = fade};
                        const float expected = Texel::channel_type::decode(texel.stored[Texel::mask_index]);
                        wrong.unless(test::same_bits(shadow(texel, z, with), expected), "s", s, "covered", covered, "z", z,
                                     "towards", static_cast<int>(far.towards), "fade", fade);
                    }
        }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("a far bound depth pushes the bound away from the light", Texel, rgb8, rgb16, rgb16f, rgb32f) {
    const Texel texel = bounded<Texel>(0.25f, 0.5f, 1, 1);
    rule r = rule{};
    CHECK(test::same_bits(shadow(texel, 0.5625f, r), 0.0f));
    r.far_bound.depth += 0.125f;
    CHECK(test::same_bits(shadow(texel, 0.5625f, r), 1.0f));
    CHECK(test::same_bits(shadow(texel, 0.6875f, r), 0.0f));
}

TEST_CASE_TEMPLATE("a translucent caster shadows with its opacity times the share of the footprint it covers", Texel, rga8, rga32f,
                   rgba16, rgba16f, test::ratio_rgba8, test::paper_rgba8) {
    sweep wrong;
    for (const float opacity : {0.0f, 0.25f, 0.5f, 1.0f})
        for (int covered = 1; covered <= 9; ++covered) {
            const Texel texel = test::filtered(Texel::caster(0.25f, opacity), covered, 9);
            const double expected = static_cast<double>(opacity) * covered / 9;
            // stored once as an opacity, once as a filtered contribution
            wrong.unless(std::abs(static_cast<double>(shadow(texel, 0.875f)) - expected) <=
                             2.0 * static_cast<double>(Texel::channel_type::max_error),
                         "opacity", opacity, "covered", covered);
            wrong.unless(test::same_bits(shadow(texel, 0.125f), 0.0f), "before: opacity", opacity, "covered", covered);
        }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("lit_beyond lights what is behind the far plane and nothing before it", Texel, rg8, rg32f, rgba16, tm8,
                   test::paper8) {
    rule r = rule{};
    const Texel texel = Texel::caster(0.25f);
    for (const float z : {test::up(1.0f), 2.0f, test::infinity<float>}) {
        CHECK(test::same_bits(shadow(texel, z, r), 1.0f));
        r.lit_beyond = true;
        CHECK(test::same_bits(shadow(texel, z, r), 0.0f));
        CHECK(test::same_bits(shadow(texel, 1.0f, r), 1.0f));
        r.lit_beyond = false;
    }
}
