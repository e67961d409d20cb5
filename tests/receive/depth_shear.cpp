// Storing a part of the light's depth range: it commutes with the filter, and everything that depth loses shrinks with it.
#include <gnomon/receive/depth_error.hpp>
#include <gnomon/texel/depth_shear.hpp>

#include "../support/bits.hpp"
#include "../support/filtering.hpp"
#include "../support/formats.hpp"
#include "../support/sweep.hpp"
#include "../support/threshold.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace gnomon;
using test::sweep;

TEST_CASE("a shear commutes with the filter: e' = (e - t m) / span, to the precision of the texel") {
    test::dice roll(81);
    const depth_shear shear{{0.5f, 0.5625f}};
    image<rg32f> plain({40, 30}, rg32f::clear()), sheared = plain;
    test::for_each_texel(whole(plain.size()), [&](int x, int y) {
        if (!roll.one_in(3)) return;
        const float s = 0.5f + roll.unit() / 16.0f;
        plain(x, y) = rg32f::caster(s);
        sheared(x, y) = rg32f::caster(shear(s));
    });
    plain = test::dense<gaussian<4>>(plain);
    sheared = test::dense<gaussian<4>>(sheared);
    double worst = 0.0;
    test::for_each_texel(whole(plain.size()), [&](int x, int y) {
        const auto e = static_cast<double>(plain(x, y).stored[0]), m = static_cast<double>(plain(x, y).stored[1]);
        CHECK(test::same_bits(plain(x, y).stored[1], sheared(x, y).stored[1]));
        worst = greater(worst, std::abs(static_cast<double>(sheared(x, y).stored[0]) - (e - (1.0 - 0.5625) * m) * 16.0));
    });
    CHECK(worst < 16.0 * 0x1p-24); // the rounding of e, sixteen times
    CHECK(worst > 0x1p-25);
}

TEST_CASE_TEMPLATE("a shear to a sixteenth of the range makes the error and the lit band behind a caster sixteen times smaller",
                   Texel, rg8, rg16, rg16f, tm8) {
    const depth_shear shear{{0.25f, 0.3125f}};
    sweep wrong;
    double band = 0.0, sheared_band = 0.0;
    for (int i = 0; i <= 1000; ++i) {
        const float s = 0.25f + 0.0625f * static_cast<float>(i) / 1000.0f;
        for (const int covered : {30, 150, 289}) {
            const auto first = [covered](float depth) {
                return test::first_shadowed(test::filtered(Texel::caster(depth), covered, 289), rule{});
            };
            band = greater(band, static_cast<double>(first(s)) - static_cast<double>(s));
            const double back = static_cast<double>(shear.inverse(first(shear(s))));
            wrong.unless(first(shear(s)) > shear(s), "shadowed at its caster", s, covered);
            sheared_band = greater(sheared_band, back - static_cast<double>(s));
        }
    }
    CHECK(wrong.report() == "");
    CHECK(sheared_band < band / 11.0); // 16, but for the slope 1+r: r runs over 0 to 1 there and only over .69 to .75 here
    CHECK(sheared_band > band / 17.0);
}

TEST_CASE_TEMPLATE("with a shear a receiver before the casters is lit and one beyond them is behind every one", Texel, rg8, rg16,
                   rg16f, rg32f, tm8, tm16) {
    const depth_shear shear{{0.25f, 0.5f}};
    for (const float s : {0.25f, 0.3f, 0.5f}) {
        const Texel texel = Texel::caster(shear(s));
        for (const float z : {0.0f, 0.1f, 0.2499f, 0.25f}) CHECK(test::same_bits(shadow(texel, shear(z)), 0.0f));
        for (const float z : {0.53f, 0.9f, 1.0f, 2.0f, test::infinity<float>})
            CHECK(test::same_bits(shadow(texel, shear(z)), 1.0f));
    }
}

TEST_CASE_TEMPLATE("with a shear a receiver bounds the shadow if the interval reaches over it and not beyond", Texel, rgb8, rgb16f,
                   test::ratio_rgba8) {
    const auto behind_a_floor_at_half = [](depth_shear shear) {
        Texel texel = Texel::caster(shear(0.25f));
        texel.bound(shear(0.5f));
        return shadow(texel, shear(0.9f));
    };
    CHECK(test::same_bits(behind_a_floor_at_half({}), 0.0f));
    CHECK(test::same_bits(behind_a_floor_at_half({{0.2f, 0.6f}}), 0.0f));
    CHECK(test::same_bits(behind_a_floor_at_half({{0.2f, 0.3f}}), 1.0f)); // as depth_shear says
}
