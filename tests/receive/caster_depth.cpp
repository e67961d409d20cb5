// The depth behind a texel, s = 1 - e/m: correctly rounded, and as wrong as the storage makes it but no more.
#include <gnomon/receive/decide.hpp>

#include "../support/bits.hpp"
#include "../support/exact.hpp"
#include "../support/float_dice.hpp"
#include "../support/formats.hpp"
#include "../support/scan.hpp"
#include "../support/sweep.hpp"
#include "../support/threshold.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>

using namespace gnomon;
using test::sweep;

namespace {

template <typename Texel> void try_pair(typename Texel::storage e, typename Texel::storage m, sweep& wrong) {
    const float s = caster_depth(Texel{{e, m}});
    wrong.unless(test::is_nearest_depth(s, Texel::channel_type::code(e), Texel::channel_type::code(m)), "e", e, "m", m, "s", s);
}

void try_code_pair(int e, int m, sweep& wrong) {
    try_pair<rg16>(static_cast<std::uint16_t>(e), static_cast<std::uint16_t>(m), wrong);
}

static_assert(test::same_bits(caster_depth(rg8::clear()), 1.0f) && test::same_bits(caster_depth(rg8{{1, 3}}), 0x1.555556p-1f));

} // namespace

TEST_CASE("caster_depth is correctly rounded for all 8-bit pairs and the paper's pair gives the same") {
    sweep wrong;
    for (int m = 1; m < 256; ++m)
        for (int e = 0; e <= m; ++e) {
            const rg8 texel{{static_cast<std::uint8_t>(e), static_cast<std::uint8_t>(m)}};
            try_pair<rg8>(texel.stored[0], texel.stored[1], wrong);
            wrong.unless(test::is_nearest_share(caster_depth(texel), m - e, m), "share: E", e, "M", m); // what the scan goes by
            const test::paper8 same{{static_cast<std::uint8_t>(255 - e), static_cast<std::uint8_t>(m)}};
            wrong.unless(test::same_bits(caster_depth(texel), caster_depth(same)), "paper: E", e, "M", m);
        }
    CHECK(wrong.report() == "");
}

TEST_CASE("caster_depth is correctly rounded for 16-bit pairs at every mask") {
    test::dice dice(80);
    sweep wrong;
    for (int m = 1; m < 65536; ++m) {
        for (const int e : {0, 1, m / 3, m / 2, m - 1, m}) try_code_pair(e, m, wrong);
        for (int i = 0; i < 26; ++i) try_code_pair(dice(0, m), m, wrong);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("exhaustive: caster_depth is correctly rounded for all 2147516415 valid 16-bit pairs" * doctest::skip(), Texel,
                   rg16, test::paper16) {
    constexpr bool complement = std::is_same_v<typename Texel::representation_type, paper_depth_mask>;
    const sweep wrong = test::scan(65535, [](int row, sweep& part) {
        const int m = 65535 - row; // the longest first, so that no thread is left waiting
        part.unless_all([m](auto&& check) {
            for (int e = 0; e <= m; ++e) {
                const Texel texel{{static_cast<std::uint16_t>(complement ? 65535 - e : e), static_cast<std::uint16_t>(m)}};
                const float s = caster_depth(texel);
                check(test::is_nearest_share(s, m - e, m), "E", e, "M", m, "s", s);
            }
        });
    });
    CHECK(wrong.report() == "");
    CHECK(wrong.tried() == 2'147'516'415);
}

TEST_CASE("caster_depth is correctly rounded for halves: every mask and depths that are near it or far below") {
    test::float_dice dice(81);
    sweep wrong;
    for (unsigned m = 1; m <= 0x3C00; ++m) {
        const auto half = [m](unsigned e) { return static_cast<std::uint16_t>(e < m ? e : m); };
        for (unsigned back = 0; back < 4; ++back) try_pair<rg16f>(half(m - lesser(back, m)), half(m), wrong);
        for (int i = 0; i < 40; ++i) try_pair<rg16f>(half(dice.word() % (m + 1)), half(m), wrong);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("caster_depth is correctly rounded for random floats") {
    test::float_dice dice(82);
    sweep wrong;
    for (int i = 0; i < 2'000'000; ++i) {
        float m = dice.any_unit(), e = i % 3 == 0 ? dice.any_unit() : m * dice.unit();
        if (e > m) std::swap(e, m);
        if (m > 0.0f) try_pair<rg32f>(e, m, wrong);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("caster_depth is correctly rounded where 1 - e/m is as near to a tie of two floats as floats can bring it") {
    // For a tie T of two floats, e = round(m (1 - T)) brings the quotient as near to T as floats can: to T itself, or 2^-50 away.
    test::float_dice dice(83);
    sweep wrong;
    int ties = 0;
    for (int i = 0; i < 2'000'000; ++i) {
        const float m = static_cast<float>(dice.binade(0.5));
        const float s = static_cast<float>(dice.binade(i % 2 == 0 ? 0.5 : 0x1p-12));
        const double tie = (static_cast<double>(s) + static_cast<double>(test::up(s))) / 2.0;
        const float e = static_cast<float>(static_cast<double>(m) * (1.0 - tie));
        if (!(e >= 0.0f && e <= m)) continue;
        const double quotient = (static_cast<double>(m) - static_cast<double>(e)) / static_cast<double>(m);
        ties += (std::bit_cast<std::uint64_t>(quotient) & 0x1FFFFFFF) == 0x10000000 ? 1 : 0;
        try_pair<rg32f>(e, m, wrong);
    }
    CHECK(wrong.report() == "");
    CHECK(ties > 0); // else this test says nothing that the one before did not
}

TEST_CASE_TEMPLATE("an empty negative or NaN mask is at the far plane and no pair leaves 0 to 1", Texel, rg16f, rg32f,
                   test::paper16f, test::paper32f) {
    using channel_type = typename Texel::channel_type;
    for (const double m : {0.0, -0.0, -1.0, test::nan<double>})
        for (const double e : {0.0, 0.5, 1.0, test::nan<double>})
            CHECK(test::same_bits(caster_depth(Texel{{channel_type::store(e), channel_type::store(m)}}), 1.0f));
    CHECK(test::same_bits(
        caster_depth(Texel{{channel_type::store(std::is_same_v<typename Texel::representation_type, depth_mask> ? 0.75 : 0.25),
                            channel_type::store(0.5)}}),
        0.0f));
}

TEST_CASE_TEMPLATE("a unorm pair is within (2-s)/(2M) of the depth that was filtered and nearly that far away", Texel, rg8, rg16,
                   test::paper8, test::paper16) {
    sweep wrong;
    double worst = 0.0;
    for (int code = 0; code <= static_cast<int>(Texel::channel_type::scale);
         code += Texel::channel_type::scale > 255.0f ? 521 : 1) {
        const double s = 1.0 - code / static_cast<double>(Texel::channel_type::scale);
        const Texel caster = Texel::caster(static_cast<float>(s));
        for (const int taps : {9, 25, 81, 289, 1089})
            for (int covered = 1; covered <= taps; covered += 1 + taps / 50) {
                const Texel texel = test::filtered(caster, covered, taps);
                const int mask_code = texel.stored[1];
                if (mask_code == 0) continue;
                const double bound = (2.0 - s) / (2.0 * mask_code);
                const double error = std::abs(static_cast<double>(caster_depth(texel)) - s);
                wrong.unless(error <= bound + 0x1p-25, "s", s, "covered", covered, "of", taps, "share", error / bound);
                worst = std::max(worst, error / bound);
            }
    }
    CHECK(wrong.report() == "");
    MESSAGE("largest share of (2-s)/(2M): " << worst);
    CHECK(worst >= 0.98);
}
