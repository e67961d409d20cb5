// How far to trust a texel's depth: never farther off than depth_error says, and sometimes as far.
#include <gnomon/receive/depth_error.hpp>

#include "../support/bits.hpp"
#include "../support/formats.hpp"
#include "../support/sweep.hpp"
#include "../support/threshold.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

using namespace gnomon;
using test::sweep;

#define EVERY_PLAIN_TEXEL rg8, rg16, rg16f, rg32f, tm8, tm16, test::paper8, test::paper16, test::paper16f, test::paper32f

namespace {

/// The largest share of depth_error that casters at trying depths use up, filtered once or twice; none may use more.
template <typename Texel, typename F> double largest_share(int roundings, F&& filter) {
    sweep wrong;
    double worst = 0.0;
    for (const float s : test::trying_depths<typename Texel::channel_type>(255)) {
        const Texel caster = Texel::caster(s);
        const double depth = static_cast<double>(caster_depth(caster));
        for (const int taps : {3, 9, 25, 81, 289, 1089})
            for (int covered = 1; covered <= taps; covered += 1 + taps / 120) {
                const Texel texel = filter(caster, covered, taps);
                const double error = std::abs(static_cast<double>(caster_depth(texel)) - depth);
                const double bound = static_cast<double>(depth_error(texel, roundings));
                wrong.unless(error <= bound, "s", s, "covered", covered, "of", taps, "error", error, "bound", bound);
                if (bound < 0.9) worst = greater(worst, error / bound);
            }
    }
    CHECK(wrong.report() == "");
    return worst;
}

} // namespace

TEST_CASE("depth_error is the farthest depth that each of the 32895 pairs of rg8 can come from, in rational numbers") {
    sweep wrong;
    for (int m = 1; m <= 255; ++m)
        for (int e = 0; e <= m; ++e) {
            // t' in [(2E-1)/(2M+1), (2E+1)/(2M-1)] and in [0, 1]; the distance to E/M of each end, over a common denominator
            const int above = lesser(m * (2 * e + 1), m * (2 * m - 1)) - e * (2 * m - 1); // over M (2M-1)
            const int below = e * (2 * m + 1) - greater(m * (2 * e - 1), 0);              // over M (2M+1)
            const double farthest = greater(above / (m * (2.0 * m - 1.0)), below / (m * (2.0 * m + 1.0)));
            const rg8 texel{{static_cast<std::uint8_t>(e), static_cast<std::uint8_t>(m)}};
            const double stated = static_cast<double>(depth_error(texel));
            wrong.unless(stated >= lesser(farthest, 1.0) && stated <= lesser(1.0, farthest + 0x1p-22), "E", e, "M", m, stated,
                         farthest);
        }
    CHECK(wrong.report() == "");
}

TEST_CASE("depth_error has in it what a caster_depth half way between two floats was rounded by") {
    sweep wrong;
    for (int n = 1; n < 1 << 23; n += 4 * 1023) { // 1 - t is rounded to the even float, half of 2^-24 away from the light
        const rg32f texel{{static_cast<float>(n) * 0x1p-25f, 1.0f}};
        const double most = n * 0x1p-25 * (1.0 + 0x1p-24) / (1.0 - 0x1p-24); // of t: both numbers were rounded once
        wrong.unless(static_cast<double>(depth_error(texel)) >= most - (1.0 - static_cast<double>(caster_depth(texel))), "n", n);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("one depth in the footprint comes back within depth_error of it and nearly that far off", Texel,
                   EVERY_PLAIN_TEXEL) {
    const double worst =
        largest_share<Texel>(1, [](const Texel& caster, int covered, int taps) { return test::filtered(caster, covered, taps); });
    MESSAGE("largest share: " << worst);
    if (Texel::representation_type::premultiplied)
        CHECK(worst > (Texel::channel_type::whole_codes ? 0.99 : 0.4));
    else
        CHECK(worst < 0.01); // a ratio brings a lone depth back as it was; its bound is for means
}

TEST_CASE_TEMPLATE("two roundings ask for two and nearly use them", Texel, EVERY_PLAIN_TEXEL) {
    const double worst = largest_share<Texel>(2, [](const Texel& caster, int covered, int taps) {
        return test::filtered(test::filtered(caster, covered, taps), taps - taps / 3, taps);
    });
    if (Texel::representation_type::premultiplied) CHECK(worst > 0.3);
}

TEST_CASE_TEMPLATE("a ratio of two casters is within one code of their mean and nearly that far off", Texel, tm8, tm16) {
    sweep wrong;
    double worst = 0.0;
    const double code = 1.0 / static_cast<double>(Texel::channel_type::scale);
    for (int i = 0; i <= 255; ++i)
        for (int share = 0; share <= 255; ++share) {
            const Texel a = Texel::caster(static_cast<float>(i) / 255.0f), b = Texel::caster(0.3f);
            const Texel mean = test::filtered(a, share, 255, b);
            const double exact =
                (share * static_cast<double>(caster_depth(a)) + (255 - share) * static_cast<double>(caster_depth(b))) / 255.0;
            const double error = static_cast<double>(caster_depth(mean)) - exact; // away from the light
            wrong.unless(error >= -0x1p-24 && error <= static_cast<double>(depth_error(mean)), "depth", i, "share", share);
            worst = greater(worst, error);
        }
    CHECK(wrong.report() == "");
    CHECK(worst > 0.98 * code);
}

TEST_CASE_TEMPLATE("a ratio is in doubt by a code a rounding at every mask, and by no more than the range", Texel, tm8, tm16) {
    const double scale = static_cast<double>(Texel::channel_type::scale);
    for (const int covered : {1, 128, 255})
        for (const int roundings : {0, 1, 2, 3}) {
            const double error =
                static_cast<double>(depth_error(test::filtered(Texel::caster(0.25f), covered, 255), roundings)) * scale;
            CHECK(error >= roundings);
            CHECK(error <= roundings + scale * 0x1p-23);
        }
    CHECK(test::same_bits(depth_error(Texel::caster(0.25f), 65536), 1.0f));
}

TEST_CASE_TEMPLATE("an empty mask, one that may have been empty, and NaN know nothing", Texel, rg8, rg32f, tm8, test::paper8) {
    CHECK(test::same_bits(depth_error(Texel::clear()), 1.0f));
    CHECK(test::same_bits(depth_error(filtered<Texel>{{test::nan<double>, 0.5}}), 1.0f));
    CHECK(test::same_bits(depth_error(filtered<Texel>{{0.5, test::nan<double>}}), 1.0f));
    CHECK(test::same_bits(depth_error(filtered<Texel>{{0.0, -0.5}}), 1.0f));
    CHECK(depth_error(Texel::caster(0.5f), 0) <= (Texel::representation_type::premultiplied ? 0x1p-23f : 0.004f));
    CHECK(test::same_bits(depth_error(rg8{{3, 4}}, 8), 1.0f)); // 4 codes of which 4 are doubt
    CHECK(test::same_bits(depth_error(rg8{{3, 4}}, -1), depth_error(rg8{{3, 4}}, 0)));
    CHECK(test::same_bits(depth_error(read(rg8{{100, 200}})), depth_error(rg8{{100, 200}}, 1)));
}

TEST_CASE("mask_threshold is the last column of the table in numerics section 3") {
    CHECK(mask_threshold<rg8, 16> == doctest::Approx(16.0 / 255.0));
    CHECK(mask_threshold<rg8, 64> == doctest::Approx(64.0 / 255.0));
    CHECK(mask_threshold<rg16, 16> == doctest::Approx(0.00024).epsilon(0.02));
    CHECK(mask_threshold<rg16, 256> == doctest::Approx(0.0039).epsilon(0.02));
    CHECK(mask_threshold<rg16, 1024> == doctest::Approx(0.0156).epsilon(0.02));
    CHECK(mask_threshold<rg16f, 512> <= 0x1p-14f);
    CHECK(mask_threshold<tm8, 255> == doctest::Approx(0.5 / 255.0)); // the least mask that is stored at all
    CHECK(mask_threshold<rg8, 1> == doctest::Approx(1.0 / 255.0));
    // and depth_error keeps it: from that mask on, at the near plane
    for (int m = 64; m <= 255; ++m) {
        const rg8 texel{{static_cast<std::uint8_t>(m), static_cast<std::uint8_t>(m)}};
        CHECK(static_cast<double>(depth_error(texel)) <= 1.0 / 64.0 + 0x1p-20);
    }
}

namespace {
/// Into how many depths is the most that a texel tells?
template <typename Texel, int Steps>
constexpr bool tells_at_most = detail::depth_steps<Texel, Steps>::told && !detail::depth_steps<Texel, Steps + 1>::told;

static_assert(tells_at_most<rg8, 255> && tells_at_most<rg16, 65535> && tells_at_most<tm8, 255> && tells_at_most<tm16, 65535>);
static_assert(tells_at_most<rg16f, 1023>, "both numbers of a pair are wrong by up to 2^-11 of themselves");
} // namespace
