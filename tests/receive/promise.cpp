// The promises of bias.hpp from one end to the other: a caster at any depth, stored, filtered, rounded, and decided.
#include <gnomon/receive/decide.hpp>

#include "../support/bits.hpp"
#include "../support/float_dice.hpp"
#include "../support/formats.hpp"
#include "../support/scan.hpp"
#include "../support/sweep.hpp"
#include "../support/threshold.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

using namespace gnomon;
using test::sweep;

#define EVERY_PLAIN_TEXEL rg8, rg16, rg16f, rg32f, test::paper8, test::paper16, test::paper16f, test::paper32f
#define SOME_WITH_EFFECTS tm8, tm16, test::ratio_rgba8, rgb16, rga8, rgba8, rgba16f, rgba32f, test::paper_rgba8

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

/// The same where three roundings of a float format are all near their worst, one way or the other: the share of the footprint is
/// half way between two codes, so is the caster's depth but for a float, and their product is left to chance. Relative errors are
/// largest just above a power of two, or wherever `own` of `end_of_doubt` is.
template <typename Texel, typename F> void for_worst_casters(F&& f) {
    using channel_type = typename Texel::channel_type;
    constexpr int digits = std::is_same_v<channel_type, half16> ? 11 : 24;
    test::float_dice dice(99);
    for (int i = 0; i < 600'000; ++i) {
        const double mask = (1.0 + 0.02 * static_cast<double>(dice.unit())) * (i % 2 == 0 ? 1.0 : 1.25);
        const int covered = static_cast<int>(std::ldexp(mask / 2.0, digits)) * 2 + 1; // one bit too long for a code
        const int taps = 1 << (digits + dice(1, 2));
        const double product = 1.0 + 0.02 * static_cast<double>(dice.unit()), depth = product / mask / dice(1, 2);
        const double code = static_cast<double>(channel_type::decode(channel_type::encode(lesser(depth, 1.0 - 0x1p-10))));
        const double error = static_cast<double>(channel_type::max_error);
        const float s = i % 4 < 2 ? test::up(static_cast<float>(1.0 - code - error))    // what is stored lies deeper
                                  : test::down(static_cast<float>(1.0 - code + error)); // or nearer
        f(s, covered, taps, test::filtered(Texel::caster(s), covered, taps));
    }
}

/// A caster at `s` under every box of radius 1 to 16: no false shadow at s and before it, no false light behind it. As a product of
/// two shares it was rounded twice.
template <bool IsCode, typename Texel, typename Check> void try_boxes(const Texel& caster, float s, const Check& check) {
    // With nothing spared for the caster's depth, the paper's arithmetic shows: single precision around 1.
    constexpr bool paper = std::is_same_v<typename Texel::representation_type, paper_depth_mask>;
    const float behind = IsCode && paper ? s + 0x1p-22f : test::up(s);
    const auto try_texel = [&](const Texel& texel, int covered, int taps, auto roundings) {
        constexpr rule light{.caster = {.towards = bias_towards::light, .roundings = roundings(), .caster_is_code = IsCode}},
            shade{.caster = {.towards = bias_towards::shadow, .roundings = roundings(), .caster_is_code = IsCode}};
        for (const float z : {s, test::down(s), 0.5f * s})
            check(test::same_bits(shadow(texel, z, light), 0.0f), "false shadow: s", s, "covered", covered, "of", taps, "z", z,
                  "roundings", roundings(), "code", IsCode);
        check(!texel.occupied() || shadow(texel, behind, shade) > 0.0f, "false light: s", s, "covered", covered, "of", taps,
              "roundings", roundings(), "code", IsCode);
    };
    for (int width = 3; width <= 33; width += 2)
        for (int across = 1; across <= width; ++across) {
            const Texel row = test::filtered(caster, across, width);
            for (int along = 1; along <= width; ++along) {
                try_texel(test::filtered(row, along, width), across * along, width * width, std::integral_constant<int, 2>{});
                const int covered = (across - 1) * width + along; // all from 1 to width * width, in turn
                try_texel(test::filtered(caster, covered, width * width), covered, width * width, std::integral_constant<int, 1>{});
            }
        }
}

} // namespace

TEST_CASE_TEMPLATE("towards light: no receiver at or before its caster is shadowed", Texel, EVERY_PLAIN_TEXEL, SOME_WITH_EFFECTS) {
    sweep wrong;
    const auto try_caster = [&](float s, int covered, int taps, const Texel& texel) {
        const float first = test::first_shadowed(texel, rule{});
        wrong.unless(first > s, "s", s, "covered", covered, "of", taps, "is shadowed from", first);
    };
    for_filtered_casters<Texel>(try_caster);
    if constexpr (!Texel::channel_type::whole_codes) for_worst_casters<Texel>(try_caster);
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("towards light: two roundings ask for two and then nothing at or before its caster is shadowed", Texel,
                   EVERY_PLAIN_TEXEL, tm8, tm16) {
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

TEST_CASE_TEMPLATE("towards shadow: every receiver behind its caster is shadowed", Texel, EVERY_PLAIN_TEXEL, SOME_WITH_EFFECTS) {
    sweep wrong;
    const auto try_caster = [&](float s, int covered, int taps, const Texel& texel) {
        const float first = test::first_shadowed(texel, rule{.caster = towards_shadow});
        wrong.unless(first <= test::up(s), "s", s, "covered", covered, "of", taps, "is shadowed from", first);
    };
    for_filtered_casters<Texel>(try_caster);
    if constexpr (!Texel::channel_type::whole_codes) for_worst_casters<Texel>(try_caster);
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE(
    "exhaustive: no receiver at or before its caster is shadowed and towards shadow none behind it is lit under any box" *
        doctest::skip(),
    Texel, rg8, rg16, rg16f, rg32f, tm8, tm16, rgba8, test::paper8, test::paper32f) {
    using storage = typename Texel::storage;
    constexpr bool is_float = std::is_same_v<storage, float>, is_half = std::is_same_v<typename Texel::channel_type, half16>;
    constexpr int codes = is_float ? 4096 : (is_half ? 0x3C01 : static_cast<int>(Texel::channel_type::scale) + 1);
    const sweep wrong = test::scan(codes, [](int code, sweep& part) {
        const auto stored = [code]() -> storage {
            if constexpr (is_float)
                return test::float_of(static_cast<std::uint32_t>(code) * (0x3F800000u / 4095u)); // spread over the exponents
            else
                return static_cast<storage>(code);
        }();
        const auto depths = test::depths_stored_as<Texel>(stored);
        for (const float s : {depths.first, depths.last})
            part.unless_all([&](auto&& check) { try_boxes<false>(Texel::caster(s), s, check); });
        Texel caster = Texel::caster(0.0f);
        caster.stored[Texel::depth_index] = stored;
        part.unless_all([&](auto&& check) { try_boxes<true>(caster, depths.own, check); });
    });
    CHECK(wrong.report() == "");
    CHECK(wrong.tried() == static_cast<std::size_t>(codes) * 3 * 6544 * 2 * 4); // 6544 shares of 16 boxes
}

TEST_CASE_TEMPLATE("towards shadow: a blended sample with any mask at all is shadowed behind its caster", Texel, EVERY_PLAIN_TEXEL,
                   tm8, tm16) {
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

TEST_CASE_TEMPLATE("towards light: every receiver behind the stated band is shadowed and 99 percent of the band is needed", Texel,
                   EVERY_PLAIN_TEXEL) {
    constexpr bool paper = std::is_same_v<typename Texel::representation_type, paper_depth_mask>;
    sweep wrong;
    double worst = 0.0;
    const auto try_caster = [&](float s, int covered, int taps, const Texel& texel) {
        const double lit = static_cast<double>(test::down(test::first_shadowed(texel, rule{}))), depth = static_cast<double>(s);
        const double bound = test::end_of_doubt<Texel>(depth, covered * 1.0 / taps);
        const double own = paper ? 0x1p-22 : 0x1p-24 * bound; // a receiver is a float, and the paper's own arithmetic around 1 too
        const double share = (lit - depth) / (bound - depth);
        wrong.unless(lit <= bound + own, "s", s, "covered", covered, "of", taps, "lit until", lit, "bound", bound, "share", share);
        if (lit <= bound) worst = std::max(worst, share);
    };
    for_filtered_casters<Texel>(try_caster);
    if constexpr (!Texel::channel_type::whole_codes) for_worst_casters<Texel>(try_caster);
    CHECK(wrong.report() == "");
    MESSAGE("largest share of the stated band that was lit: " << worst);
    CHECK(worst >= 0.99);
}

TEST_CASE_TEMPLATE("towards light: the band that bias.hpp words is that band and 99 percent of it are needed", Texel, rg8, rg16,
                   rg16f, rg32f) {
    using channel_type = typename Texel::channel_type;
    constexpr double q = 2.0 * static_cast<double>(channel_type::max_error);
    sweep wrong;
    double worst = 0.0;
    const auto try_caster = [&](float s, int covered, int taps, const Texel& texel) {
        const double m = covered * 1.0 / taps, t = 1.0 - static_cast<double>(s);
        const double lit = static_cast<double>(test::down(test::first_shadowed(texel, rule{})));
        double band = q + q * (1.0 + t) / m;
        if constexpr (std::is_same_v<channel_type, half16>) band = q * (1.0 + 4.0 * t) + q * q / 4.0 * (1.0 + t) / m;
        if constexpr (std::is_same_v<channel_type, float32>) band = 14.0 * q;
        const double share = (lit - static_cast<double>(s)) / band;
        wrong.unless(lit <= static_cast<double>(s) + band + 0x1p-23 * lit, "s", s, "covered", covered, "of", taps, "lit until", lit,
                     "share", share);
        if (share <= 1.0) worst = std::max(worst, share);
    };
    for_filtered_casters<Texel>(try_caster);
    if constexpr (!channel_type::whole_codes) for_worst_casters<Texel>(try_caster);
    CHECK(wrong.report() == "");
    MESSAGE("largest share of the worded band that was lit: " << worst);
    CHECK(worst >= 0.99);
}
