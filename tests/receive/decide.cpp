// The decision against exact arithmetic, at the threshold and one float to each side of it: not one may be wrong.
#include <gnomon/receive/decide.hpp>

#include "../support/bits.hpp"
#include "../support/exact.hpp"
#include "../support/float_dice.hpp"
#include "../support/formats.hpp"
#include "../support/scan.hpp"
#include "../support/sweep.hpp"
#include "../support/threshold.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <utility>

using namespace gnomon;
using test::sweep;

namespace {

/// Is m z > whole, for a float z? \pre m < 2^19, whole < 2^19
constexpr bool exceeds(std::int64_t m, float z, std::int64_t whole) {
    if (whole <= 0) return whole < 0 || (m > 0 && z > 0.0f);
    const auto [significand, shift] = test::split(z);
    return shift < 44 && m * significand > whole << shift; // both sides below 2^63; a smaller z makes less than 1
}

/// A rule, and how many half codes it moves a pair: k roundings towards light, -k towards shadow.
template <bias_towards Towards, int Roundings> struct tried_rule {
    static constexpr rule decision{.caster = {.towards = Towards, .roundings = Roundings, .caster_is_code = true}};
    static constexpr int k = Towards == bias_towards::light ? Roundings : (Towards == bias_towards::shadow ? -Roundings : 0);
};

/// The three rules to use, and if they are asked for those against two roundings.
template <bool Twice, typename F> void for_each_rule(F&& f) {
    f(tried_rule<bias_towards::none, 1>{});
    f(tried_rule<bias_towards::light, 1>{});
    f(tried_rule<bias_towards::shadow, 1>{});
    if constexpr (!Twice) return;
    f(tried_rule<bias_towards::light, 2>{});
    f(tried_rule<bias_towards::shadow, 2>{});
}

/// The three floats around the exact threshold of a stored pair, against numerics, section 4, in integers:
/// E - k/2 > (M + k/2) (1-z), all times 2, is m z > m - e.
template <typename Texel, typename Tried, typename Check> void try_pair(int depth_code, int mask_code, Tried, const Check& check) {
    using storage = typename Texel::storage;
    const Texel texel{{static_cast<storage>(depth_code), static_cast<storage>(mask_code)}};
    const int e = 2 * depth_code - Tried::k, m = 2 * mask_code + Tried::k;
    const double threshold = (m - e) / static_cast<double>(m);
    const bool in_range = mask_code > 0 && threshold > 0.0 && threshold < 2.0;
    const float at = in_range ? static_cast<float>(threshold) : 0x1p-100f, full = Texel::channel_type::decode(texel.stored[1]);
    int shadowed = 0;
    for (const float z : {test::down(at), at, test::up(at)}) {
        const bool expected = mask_code > 0 && exceeds(m, z, m - e);
        check(test::same_bits(shadow(texel, z, Tried::decision), expected ? full : 0.0f), "E", depth_code, "M", mask_code, "k",
              Tried::k, "z", z);
        shadowed += expected ? 1 : 0;
    }
    check(!in_range || shadowed == 1 || shadowed == 2, "no threshold: E", depth_code, "M", mask_code, "k", Tried::k, "z", at);
}

/// All depth codes under one mask code, by every rule.
template <typename Texel, bool Twice = true> void try_mask(int mask_code, sweep& wrong) {
    for_each_rule<Twice>([&](auto tried) {
        wrong.unless_all([&](auto&& check) {
            for (int depth_code = 0; depth_code <= static_cast<int>(Texel::channel_type::scale); ++depth_code)
                try_pair<Texel>(depth_code, mask_code, tried, check); // e > m too: a hostile pair has an exact answer as well
        });
    });
}

// At compile time: the paper's step 4 for a half covered texel with its caster at 1/2.
static_assert(test::same_bits(shadow(rg8{{64, 128}}, 0.5f, {.caster = unbiased}), 0.0f));
static_assert(test::same_bits(shadow(rg8{{64, 128}}, 0x1.000002p-1f, {.caster = unbiased}), 128.0f / 255.0f));
// nor by a depth without end, where no side is favoured
static_assert(test::same_bits(shadow(rg8{{64, 128}}, 0x1.000002p-1f,
                                     {.caster = {.towards = gnomon::bias_towards::none, .depth = test::infinity<float>}}),
                              128.0f / 255.0f));
static_assert(test::same_bits(shadow(rg16f::clear(), 1.0f), 0.0f) && shadow(rg32f::caster(0.25f), 0.75f) > 0.99f);

} // namespace

TEST_CASE("no decision on any of the 65536 pairs of 8-bit codes is wrong under any rule") {
    sweep wrong;
    for (int m = 0; m < 256; ++m) try_mask<rg8>(m, wrong);
    CHECK(wrong.report() == "");
}

TEST_CASE("no decision on two million pairs of 16-bit codes is wrong under any rule") {
    test::dice dice(16);
    sweep wrong;
    const auto check = [&wrong](bool holds, const auto&... words) { wrong.unless(holds, words...); };
    for (int m = 0; m < 65536; ++m) {
        const auto try_depth = [&](int e) { for_each_rule<true>([&](auto tried) { try_pair<rg16>(e, m, tried, check); }); };
        for (const int e : {0, 1, 2, m / 2, m / 2 + 1, m - 2, m - 1, m, m + 1, m + 2})
            if (e >= 0 && e < 65536) try_depth(e);
        for (int i = 0; i < 24; ++i) try_depth(i % 8 == 0 ? dice(0, 65535) : dice(0, m));
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("exhaustive: no decision on any of the 2^32 pairs of 16-bit codes is wrong under the three rules to use" *
          doctest::skip()) {
    const sweep wrong = test::scan(65536, [](int m, sweep& part) { try_mask<rg16, false>(m, part); });
    CHECK(wrong.report() == "");
    CHECK(wrong.tried() == 3 * (3 + 1) * (std::size_t{1} << 32)); // once more for each pair: that there is a threshold
}

TEST_CASE_TEMPLATE("an unbiased decision on floats is exact from subnormals to one", Texel, rg16f, rg32f) {
    using channel_type = typename Texel::channel_type;
    constexpr rule exactly{.caster = unbiased};
    test::float_dice dice(32);
    sweep wrong;
    for (int i = 0; i < 400'000; ++i) {
        auto m = channel_type::encode(static_cast<double>(dice.any_unit()));
        auto e = channel_type::encode(static_cast<double>(i % 3 == 0 ? dice.any_unit() : channel_type::decode(m) * dice.unit()));
        if (i % 5 == 0)
            e = channel_type::encode(static_cast<double>(test::down(channel_type::decode(m)))); // a caster at the near plane
        if (e > m) std::swap(e, m);
        const Texel texel{{e, m}};
        const double depth = static_cast<double>(channel_type::decode(e)), mask = static_cast<double>(channel_type::decode(m));
        const float threshold = mask > 0.0 ? static_cast<float>(1.0 - depth / mask) : 0.5f;
        for (const float z : {test::down(threshold), threshold, test::up(threshold), dice.any_unit(), 1.0f + dice.unit()}) {
            const bool expected = mask > 0.0 && z > 0.0f && test::exactly_behind(depth, mask, static_cast<double>(z));
            wrong.unless(test::same_bits(shadow(texel, z, exactly), expected ? channel_type::decode(m) : 0.0f), "e", depth, "m",
                         mask, "z", z);
        }
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("a deeper receiver is never lit if a nearer one is shadowed", Texel, rg8, rg16, rg16f, rg32f, test::paper8,
                   test::paper16, test::paper16f, test::paper32f) {
    test::float_dice dice(33);
    sweep wrong;
    for (int i = 0; i < 20'000; ++i) {
        const Texel texel = test::filtered(Texel::caster(dice.unit()), dice(1, 81), 81);
        for (const bias towards : {towards_light, unbiased, towards_shadow}) {
            const rule decision = rule{.caster = towards};
            const float first = test::first_shadowed(texel, decision);
            for (int j = 0; j < 8; ++j) {
                const float z = j < 4 ? first + dice.unit() * 0x1p-20f * static_cast<float>(j) : 2.0f * dice.unit();
                wrong.unless((shadow(texel, z, decision) > 0.0f) == (z >= first), "depth", texel.stored[0], "mask", texel.stored[1],
                             "first", first, "z", z);
            }
        }
    }
    CHECK(wrong.report() == "");
}
