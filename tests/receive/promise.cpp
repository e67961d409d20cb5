// The promises of bias.hpp from one end to the other: a caster at any depth, stored, filtered, rounded, and decided.
#include <gnomon/receive/decide.hpp>

#include "../support/bits.hpp"
#include "../support/formats.hpp"
#include "../support/sweep.hpp"
#include "../support/threshold.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <type_traits>

using namespace gnomon;
using test::sweep;

#define EVERY_PLAIN_TEXEL rg8, rg16, rg16f, rg32f, test::paper8, test::paper16, test::paper16f, test::paper32f

namespace {

/// Calls `f(s, covered, taps, texel)` for casters at trying depths under footprints from one texel to 33 x 33.
template <typename Texel, typename F> void for_filtered_casters(F&& f) {
    for (const float s : test::trying_depths<typename Texel::channel_type>(511)) {
        const Texel caster = Texel::caster(s);
        for (const int taps : {1, 9, 25, 81, 256, 289, 1089})
            for (int covered = 1; covered <= taps; covered += 1 + taps / 24) {
                const Texel texel = test::filtered(caster, covered, taps);
                if (texel.occupied()) f(s, covered, taps, texel);
            }
    }
}

} // namespace

TEST_CASE_TEMPLATE("towards light: no receiver at or before its caster is shadowed", Texel, EVERY_PLAIN_TEXEL) {
    sweep wrong;
    for_filtered_casters<Texel>([&](float s, int covered, int taps, const Texel& texel) {
        const float first = test::first_shadowed(texel, rule{});
        wrong.unless(first > s, "s", s, "covered", covered, "of", taps, "is shadowed from", first);
    });
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("towards light: two roundings ask for two and then nothing at or before its caster is shadowed", Texel,
                   EVERY_PLAIN_TEXEL) {
    bias twice = towards_light;
    twice.roundings = 2;
    sweep wrong;
    for (const float s : test::trying_depths<typename Texel::channel_type>(255))
        for (const int taps : {3, 9, 17})
            for (int across = 1; across <= taps; across += 1 + taps / 8)
                for (int along = 1; along <= taps; along += 1 + taps / 8) {
                    const Texel texel = test::filtered(test::filtered(Texel::caster(s), across, taps), along, taps);
                    const float first = test::first_shadowed(texel, rule{.caster = twice});
                    wrong.unless(first > s, "s", s, "covered", across, along, "of", taps, "is shadowed from", first);
                }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("towards shadow: every receiver behind its caster is shadowed", Texel, EVERY_PLAIN_TEXEL) {
    sweep wrong;
    for_filtered_casters<Texel>([&](float s, int covered, int taps, const Texel& texel) {
        const float first = test::first_shadowed(texel, rule{.caster = towards_shadow});
        wrong.unless(first <= test::up(s), "s", s, "covered", covered, "of", taps, "is shadowed from", first);
    });
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("towards light: every receiver behind the band that bias.hpp words is shadowed and no band is twice too wide",
                   Texel, rg8, rg16, rg16f, rg32f) {
    using channel_type = typename Texel::channel_type;
    constexpr bool half = std::is_same_v<channel_type, half16>;
    constexpr double q = 2.0 * static_cast<double>(channel_type::max_error);
    sweep wrong;
    double worst = 0.0;
    for_filtered_casters<Texel>([&](float s, int covered, int taps, const Texel& texel) {
        const double m = covered * 1.0 / taps;
        if (half && m < 0x1p-10) return;
        const double lit = static_cast<double>(test::down(test::first_shadowed(texel, rule{}))), r = std::max(1.0 - lit, 0.0);
        const double band = channel_type::whole_codes ? q * (1.0 + r + q) / m + q : (half ? 6.0 : 16.0) * q;
        const double share = (lit - static_cast<double>(s)) / band;
        wrong.unless(share <= 1.0, "s", s, "covered", covered, "of", taps, "lit until", lit, "share", share);
        worst = std::max(worst, share);
    });
    CHECK(wrong.report() == "");
    CHECK(worst > 0.5);
}

TEST_CASE_TEMPLATE("towards shadow: a blended sample with any mask at all is shadowed behind its caster", Texel,
                   EVERY_PLAIN_TEXEL) {
    sweep wrong;
    for (const float s : {0.25f, 0.5f, 0.9f}) {
        image<Texel> map({2, 1}, Texel::clear());
        map(0, 0) = test::filtered(Texel::caster(s), 1, 255); // the faintest code there is, in 8 bits
        for (int step = 0; step < 256; ++step) {
            const auto faint = sample(map.view(), 0.5f + static_cast<float>(step) / 256.0f, 0.5f);
            wrong.unless(shadow(faint, test::up(s), rule{.caster = towards_shadow}) > 0.0f, "s", s, "step", step, "of 256");
        }
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("towards light: every receiver behind the stated band is shadowed and the band is nearly needed", Texel,
                   EVERY_PLAIN_TEXEL) {
    constexpr bool paper = std::is_same_v<typename Texel::representation_type, paper_depth_mask>;
    sweep wrong;
    double worst = 0.0;
    for_filtered_casters<Texel>([&](float s, int covered, int taps, const Texel& texel) {
        const double first = static_cast<double>(test::first_shadowed(texel, rule{})), depth = static_cast<double>(s);
        const double bound = test::end_of_doubt<Texel>(depth, covered * 1.0 / taps);
        const double next_float = paper ? 0x1p-22 : 0x1p-23 * bound; // the paper's own arithmetic is single precision around 1
        wrong.unless(first <= bound + next_float, "s", s, "covered", covered, "of", taps, "first shadowed", first, "bound", bound,
                     "share", (first - depth) / (bound - depth));
        worst = std::max(worst, (first - depth) / (bound + next_float - depth));
    });
    CHECK(wrong.report() == "");
    MESSAGE("largest share of the stated band that was lit: " << worst);
    CHECK(worst >= (Texel::channel_type::whole_codes ? 0.98 : 0.75));
}
