// The decision against exact arithmetic, at the threshold and one float to each side of it: not one may be wrong.
#include <gnomon/receive/decide.hpp>

#include "../support/bits.hpp"
#include "../support/exact.hpp"
#include "../support/float_dice.hpp"
#include "../support/formats.hpp"
#include "../support/sweep.hpp"
#include "../support/threshold.hpp"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cstdint>

using namespace gnomon;
using test::sweep;

namespace {

/// Is product / 2^shift > whole? \pre 0 <= product < 2^44, whole < 2^19
bool exceeds(std::int64_t product, int shift, std::int64_t whole) {
    if (whole <= 0) return whole < 0 || product > 0;
    return shift < 44 && product > whole << shift;
}

/// Numerics, section 4, in integers: E - k/2 > (M + k/2) (1-z), with k negative for a bias towards shadow, all times 2.
bool shadowed_exactly(int depth_code, int mask_code, int k, float z) {
    const std::int64_t e = 2 * depth_code - k, m = 2 * mask_code + k;
    const auto bits = std::bit_cast<std::uint32_t>(z);
    const bool normal = bits >> 23 != 0;
    const std::int64_t significand = (bits & 0x7FFFFF) | (normal ? 0x800000u : 0u);
    return mask_code > 0 && z > 0.0f &&
           exceeds(m * significand, 150 - static_cast<int>(normal ? bits >> 23 : 1), m - e); // m z > m - e
}

struct tried_rule {
    rule decision;
    int k;
};
tried_rule rule_with(bias_towards towards, int roundings) {
    const int sign = towards == bias_towards::light ? 1 : (towards == bias_towards::shadow ? -1 : 0);
    return {{.caster = {.towards = towards, .roundings = roundings, .caster_is_code = true}}, sign * roundings};
}
const std::array every_rule{rule_with(bias_towards::none, 1), rule_with(bias_towards::light, 1), rule_with(bias_towards::light, 2),
                            rule_with(bias_towards::shadow, 1), rule_with(bias_towards::shadow, 2)};

/// The three floats around the exact threshold of a stored pair, and some that are far from it.
template <typename Texel> void try_pair(int e, int m, const tried_rule& tried, sweep& wrong) {
    using storage = typename Texel::storage;
    const Texel texel{{static_cast<storage>(e), static_cast<storage>(m)}};
    const double threshold = 1.0 - (2.0 * e - tried.k) / (2.0 * m + tried.k);
    const bool in_range = threshold > 0.0 && threshold < 2.0;
    const float at = in_range ? static_cast<float>(threshold) : 0.5f;
    const float full = Texel::channel_type::decode(static_cast<storage>(m));
    for (const float z : {test::down(at), at, test::up(at), in_range ? 1.0f : test::smallest<float>}) {
        const bool expected = shadowed_exactly(e, m, tried.k, z);
        wrong.unless(test::same_bits(shadow(texel, z, tried.decision), expected ? full : 0.0f), "E", e, "M", m, "k", tried.k, "z",
                     z);
    }
}

// At compile time: the paper's step 4 for a half covered texel with its caster at 1/2.
static_assert(test::same_bits(shadow(rg8{{64, 128}}, 0.5f, {.caster = unbiased}), 0.0f));
static_assert(test::same_bits(shadow(rg8{{64, 128}}, 0x1.000002p-1f, {.caster = unbiased}), 128.0f / 255.0f));
static_assert(test::same_bits(shadow(rg16f::clear(), 1.0f), 0.0f) && shadow(rg32f::caster(0.25f), 0.75f) > 0.99f);

} // namespace

TEST_CASE("no decision on any of the 65536 pairs of 8-bit codes is wrong under any rule") {
    sweep wrong;
    for (int e = 0; e < 256; ++e)
        for (int m = 0; m < 256; ++m) // e > m too: a hostile pair has an exact answer as well
            for (const tried_rule& tried : every_rule) try_pair<rg8>(e, m, tried, wrong);
    CHECK(wrong.report() == "");
}

TEST_CASE("no decision on ten million pairs of 16-bit codes is wrong under any rule") {
    test::dice dice(16);
    sweep wrong;
    for (int m = 0; m < 65536; ++m) {
        const auto try_all = [&](int e) {
            try_pair<rg16>(e, m, every_rule[static_cast<std::size_t>(e + m) % every_rule.size()], wrong);
        };
        for (const int e : {0, 1, 2, m / 2, m / 2 + 1, m - 2, m - 1, m, m + 1, m + 2})
            for (const tried_rule& tried : every_rule)
                if (e >= 0 && e < 65536) try_pair<rg16>(e, m, tried, wrong);
        for (int i = 0; i < 104; ++i) try_all(i % 8 == 0 ? dice(0, 65535) : dice(0, m));
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("exhaustive: no decision on any of the 2^32 pairs of 16-bit codes is wrong" * doctest::skip()) {
    sweep wrong;
    for (int m = 0; m < 65536; ++m)
        for (int e = 0; e < 65536; ++e)
            for (const tried_rule& tried : every_rule) try_pair<rg16>(e, m, tried, wrong);
    CHECK(wrong.report() == "");
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
