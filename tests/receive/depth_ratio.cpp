// Decisions on the un-premultiplied pair: exact, without false shadow though nothing is given up, and as good as floats from one code of
// depth on.
#include <gnomon/receive/decide.hpp>

#include "../support/bits.hpp"
#include "../support/exact.hpp"
#include "../support/float_dice.hpp"
#include "../support/formats.hpp"
#include "../support/sweep.hpp"
#include "../support/threshold.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

using namespace gnomon;
using test::sweep;

namespace {

/// At the threshold of a stored pair, z = 1 - T/N, and one float to each side: T > N (1-z) decides, whatever the mask.
template <typename Texel> void try_threshold(int t, int m, sweep& wrong) {
    constexpr int scale = static_cast<int>(Texel::channel_type::scale);
    const Texel texel{{static_cast<typename Texel::storage>(t), static_cast<typename Texel::storage>(m)}};
    const float full = Texel::channel_type::decode(texel.stored[1]);
    const float at = static_cast<float>((scale - t) / static_cast<double>(scale));
    for (const float z : {at > 0.0f ? test::down(at) : at, at, test::up(at)}) {
        const bool expected = m > 0 && z > 0.0f && test::exactly_behind(t, scale, static_cast<double>(z));
        wrong.unless(test::same_bits(shadow(texel, z, rule{.caster = unbiased}), expected ? full : 0.0f), "T", t, "M", m, "z", z);
        wrong.unless(test::same_bits(shadow(texel, z), expected ? full : 0.0f), "towards light: T", t, "M", m, "z", z);
    }
}

} // namespace

TEST_CASE("a decision on tm8 is exact for all 65536 pairs at the threshold and one float to each side") {
    sweep wrong;
    for (int t = 0; t <= 255; ++t)
        for (int m = 0; m <= 255; ++m) try_threshold<tm8>(t, m, wrong);
    CHECK(wrong.report() == "");
}

TEST_CASE("a decision on tm16 is exact for every depth at many masks") {
    sweep wrong;
    for (int t = 0; t <= 65535; ++t)
        for (const int m : {0, 1, 2, 255, 32767 + t % 7, 65535 - t % 5}) try_threshold<tm16>(t, m, wrong);
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("no receiver at or before both of two casters is shadowed and none behind both is lit towards shadow", Texel,
                   tm8, tm16) {
    test::float_dice dice(71);
    sweep light, dark;
    for (int i = 0; i < 200'000; ++i) {
        const float a = dice.one_in(2) ? dice.unit() : dice.any_unit(), b = dice.one_in(3) ? a : dice.unit();
        const int taps = dice(1, 1089), covered = dice(0, taps), others = dice(0, taps - covered);
        if (covered == 0) continue;
        const int casters = covered + others;
        const Texel texel =
            test::filtered(test::filtered(Texel::caster(a), covered, casters, Texel::caster(b)), casters, taps); // two passes
        if (!texel.occupied()) continue;
        const float nearest = others > 0 ? lesser(a, b) : a, farthest = others > 0 ? greater(a, b) : a;
        light.unless(test::same_bits(shadow(texel, nearest), 0.0f), "casters", a, b, "covered", covered, others, "of", taps);
        dark.unless(shadow(texel, test::up(farthest), rule{.caster = towards_shadow}) > 0.0f, "casters", a, b, "covered", covered,
                    others, "of", taps);
    }
    CHECK(light.report() == "");
    CHECK(dark.report() == "");
}

TEST_CASE_TEMPLATE("towards light a ratio shadows from one code behind its caster on, at every mask, and nearly needs that code",
                   Texel, tm8, tm16) {
    const double code = 1.0 / static_cast<double>(Texel::channel_type::scale);
    sweep wrong;
    double worst = 0.0;
    for (const float s : test::trying_depths<typename Texel::channel_type>(2047))
        for (const int covered : {1, 17, 289}) {
            const Texel texel = test::filtered(Texel::caster(s), covered, 289);
            if (!texel.occupied()) continue;
            const double first = static_cast<double>(test::first_shadowed(texel, rule{}));
            const double share = (first - static_cast<double>(s)) / code;
            wrong.unless(first > static_cast<double>(s) && share <= 1.0 + 0x1p-7, "s", s, "covered", covered, "share",
                         share); // a float on
            worst = greater(worst, share);
        }
    CHECK(wrong.report() == "");
    CHECK(worst > 0.99);
}

TEST_CASE("16 bits a texel within .0011 of the float result once a receiver is one code behind: numerics section 3") {
    double square = 0.0;
    int cases = 0;
    test::float_dice dice(72);
    for (int i = 0; i < 200'000; ++i) {
        const float s = 0.9f * dice.unit(), z = s + 1.01f / 255.0f;
        const int covered = dice(1, 1000); // m uniform over the penumbra
        const double soft = static_cast<double>(shadow(test::filtered(tm8::caster(s), covered, 1000), z));
        const double exact = covered / 1000.0;
        square += (soft - exact) * (soft - exact);
        ++cases;
    }
    const double rms = std::sqrt(square / cases);
    CHECK(rms < 0.00115); // 1/255/sqrt 12 = .00113
    CHECK(rms > 0.0010);
}

TEST_CASE_TEMPLATE("a blend of ratios is decided as sum w t m > r sum w m, and never shadows what lies before its casters", Texel,
                   tm8, tm16) {
    test::float_dice dice(73);
    sweep wrong, light;
    for (int i = 0; i < 100'000; ++i) {
        image<Texel> map({2, 1}, Texel::clear());
        const float a = dice.unit(), b = dice.unit();
        map(0, 0) = test::filtered(Texel::caster(a), dice(1, 9), 9);
        map(1, 0) = test::filtered(Texel::caster(b), dice(1, 9), 9);
        const int u = dice(0, 256);
        const filtered<Texel> f = sample(map.view(), 0.5f + static_cast<float>(u) / 256.0f, 0.5f);
        const float z = dice.unit();
        test::exact_sum side; // sum w M (T - N (1-z))
        for (const int x : {0, 1}) {
            const double weight = (x == 0 ? 256.0 - u : u) * static_cast<double>(map(x, 0).stored[1]);
            const double scale = static_cast<double>(Texel::channel_type::scale);
            side.add_product(weight, static_cast<double>(map(x, 0).stored[0]) - scale)
                .add_product(weight * scale, static_cast<double>(z));
        }
        wrong.unless((shadow(f, z, rule{.caster = unbiased}) > 0.0f) == (side.sign() > 0), "a", a, "b", b, "u", u, "z", z);
        const float nearest = u == 0 ? a : (u == 256 ? b : lesser(a, b));
        light.unless(test::same_bits(shadow(f, nearest), 0.0f), "a", a, "b", b, "u", u);
    }
    CHECK(wrong.report() == "");
    CHECK(light.report() == "");
}
