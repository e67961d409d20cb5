// binary16 against its definition, which knows no bits: sign * fraction * 2^exponent, and the midpoints between neighbours.
#include <gnomon/texel/half.hpp>

#include "../support/bits.hpp"
#include "../support/float_dice.hpp"
#include "../support/sweep.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#ifdef __F16C__
#include <immintrin.h>
#endif

using gnomon::half_from;
using gnomon::half_to_float;
using test::sweep;

namespace {

constexpr std::uint16_t half_infinity = 0x7C00, half_sign = 0x8000;

/// The value of a finite half, and of the first one that would follow the largest.
double defined_value(unsigned h) {
    const int exponent = static_cast<int>(h >> 10 & 0x1F), fraction = static_cast<int>(h & 0x3FF);
    const double magnitude = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
    return (h & half_sign) != 0 ? -magnitude : magnitude;
}

static_assert(half_from(1.0) == 0x3C00 && half_from(-2.0) == 0xC000 && half_from(0x1p-24) == 1 && half_from(65504.0) == 0x7BFF);
static_assert(test::same_bits(half_to_float(0x3555), 0x1.554p-2f) && test::same_bits(half_to_float(0x8001), -0x1p-24f));

} // namespace

TEST_CASE("every finite half has the value its definition gives") {
    sweep wrong;
    for (unsigned h = 0; h < 0x10000; ++h)
        if ((h & half_infinity) != half_infinity)
            wrong.unless(test::same_bits(static_cast<double>(half_to_float(static_cast<std::uint16_t>(h))), defined_value(h)),
                         "half", h);
    CHECK(wrong.report() == "");
}

TEST_CASE("every half comes back from its value - NaN as a quiet NaN of the same sign") {
    sweep wrong;
    for (unsigned h = 0; h < 0x10000; ++h) {
        const float value = half_to_float(static_cast<std::uint16_t>(h));
        const bool nan = (h & 0x7FFF) > half_infinity;
        const unsigned expected = nan ? ((h & half_sign) | 0x7E00) : h;
        wrong.unless(test::is_nan(value) == nan && half_from(static_cast<double>(value)) == expected, "half", h);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("a half that is NaN keeps its sign and its bits as a float") {
    sweep wrong;
    for (unsigned h = 0; h < 0x10000; ++h)
        if ((h & 0x7FFF) > half_infinity)
            wrong.unless(std::bit_cast<std::uint32_t>(half_to_float(static_cast<std::uint16_t>(h))) ==
                             ((h & half_sign) << 16 | 0x7F800000u | (h & 0x3FFu) << 13),
                         "half", h);
    CHECK(wrong.report() == "");
}

TEST_CASE("half_from rounds every midpoint to even and a double beside it to the nearer half") {
    sweep wrong;
    for (unsigned h = 0; h < half_infinity; ++h)
        for (const bool negative : {false, true}) {
            const double middle = (defined_value(h) + defined_value(h + 1)) / 2.0; // 12 bits
            const auto from = [negative](double v) { return half_from(negative ? -v : v); };
            const auto half = [negative](unsigned pattern) {
                return static_cast<std::uint16_t>(pattern | (negative ? half_sign : 0u));
            };
            wrong.unless(from(test::down(middle)) == half(h), "below the midpoint after", h);
            wrong.unless(from(middle) == half((h & 1) == 0 ? h : h + 1), "at the midpoint after", h);
            wrong.unless(from(test::up(middle)) == half(h + 1), "above the midpoint after", h);
        }
    CHECK(wrong.report() == "");
}

TEST_CASE("half_from overflows to infinity from 65520 on and keeps the sign of zero and infinity") {
    CHECK(half_from(test::down(65520.0)) == 0x7BFF);
    for (const double v : {65520.0, 65536.0, 0x1.8p16, 0x1p100, 0x1p1000, test::infinity<double>}) {
        CHECK(half_from(v) == half_infinity);
        CHECK(half_from(-v) == (half_infinity | half_sign));
    }
    for (const double v : {0.0, test::smallest<double>, 0x1p-1022, 0x1p-26, 0x1p-25}) {
        CHECK(half_from(v) == 0);
        CHECK(half_from(-v) == half_sign);
    }
    CHECK(half_from(test::nan<double>) == 0x7E00);
}

TEST_CASE("half_from gives the nearest half for a million doubles of every size") {
    test::float_dice dice(1);
    sweep wrong;
    for (int i = 0; i < 1'000'000; ++i) {
        const double v = dice.binade(std::ldexp(1.0, dice(-28, 15)));
        const unsigned h = half_from(v);
        const double above = (defined_value(h) + defined_value(h + 1)) / 2.0;
        const double below = h == 0 ? 0.0 : (defined_value(h - 1) + defined_value(h)) / 2.0;
        wrong.unless(h <= half_infinity && v >= below && (v <= above || h == half_infinity), "v", v, "half", h);
    }
    CHECK(wrong.report() == "");
}

#ifdef __F16C__
TEST_CASE("half_from and half_to_float agree with the processor's own conversions") {
    test::float_dice dice(2);
    sweep wrong;
    for (unsigned h = 0; h < 0x10000; ++h) {
        const auto half = static_cast<std::uint16_t>(h);
        if ((h & 0x7FFF) <= half_infinity) wrong.unless(test::same_bits(half_to_float(half), _cvtsh_ss(half)), "half", h);
    }
    for (int i = 0; i < 1'000'000; ++i) {
        const float v = dice.any();
        if (!test::is_nan(v)) wrong.unless(half_from(static_cast<double>(v)) == _cvtss_sh(v, _MM_FROUND_TO_NEAREST_INT), "v", v);
    }
    CHECK(wrong.report() == "");
}
#endif
