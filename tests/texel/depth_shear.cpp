// A light's depth range cut to where its casters are.
#include <gnomon/texel/depth_shear.hpp>

#include "../support/bits.hpp"
#include "../support/float_dice.hpp"
#include "../support/sweep.hpp"

#include <doctest/doctest.h>

using namespace gnomon;
using test::sweep;

TEST_CASE("a shear takes the nearest caster to 0 and the farthest to 1 and leaves the order of any two depths alone") {
    test::float_dice dice(41);
    sweep wrong;
    for (int i = 0; i < 300'000; ++i) {
        const float a = dice.unit(), b = dice.unit();
        const depth_shear shear{{lesser(a, b), greater(a, b)}};
        if (greater(a, b) - lesser(a, b) >= 0x1p-16f) {
            wrong.unless(test::same_bits(shear(lesser(a, b)), 0.0f), "nearest", a, b);
            wrong.unless(test::same_bits(shear(greater(a, b)), 1.0f), "farthest", a, b);
        }
        const float z = dice.any_unit(), next = i % 2 == 0 ? test::up(z) : dice.any_unit();
        wrong.unless((shear(z) <= shear(next)) || next < z, "order of", z, next);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("a sheared depth is within 3 * 2^-24 of the exact quotient relatively and two thirds of that are reached") {
    test::float_dice dice(42);
    sweep wrong;
    double worst = 0.0;
    for (int i = 0; i < 1'000'000; ++i) {
        const float a = dice.unit() * dice.unit(), b = dice.unit() * dice.unit(), z = dice.unit() * dice.unit();
        const depth_shear shear{{lesser(a, b), greater(a, b)}};
        if (shear.span() <= 0x1p-16f) continue;
        const double exact = (static_cast<double>(z) - static_cast<double>(lesser(a, b))) /
                             (static_cast<double>(greater(a, b)) - static_cast<double>(lesser(a, b)));
        const double error = static_cast<double>(shear(z)) - exact, bound = 3.0001 * 0x1p-24 * (exact < 0.0 ? -exact : exact);
        wrong.unless(error <= bound && error >= -bound, "z", z, "of", a, b);
        if (bound > 0.0) worst = greater(worst, error / bound);
    }
    CHECK(wrong.report() == "");
    CHECK(worst > 0.66);
}

TEST_CASE("an empty or infinite interval changes nothing - one of a single depth is 2^-16 wide - NaN stays NaN") {
    for (const float z : {0.0f, 0.25f, 1.0f, 2.0f}) {
        CHECK(test::same_bits(depth_shear{{1.0f, 0.0f}}(z), z));
        CHECK(test::same_bits(depth_shear{}(z), z));
        CHECK(test::same_bits(depth_shear{}.inverse(z), z));
    }
    for (const depth_interval infinite : {depth_interval{-test::infinity<float>, 0.5f},
                                          {0.0f, test::infinity<float>},
                                          {-test::infinity<float>, test::infinity<float>},
                                          {test::nan<float>, 0.5f}})
        CHECK(test::same_bits(depth_shear{infinite}(0.25f), 0.25f));
    CHECK(test::same_bits(depth_shear{{0.0f, 0x1.8p59f}}.span(), 0x1.8p59f));
    CHECK(test::same_bits(depth_shear{{0.0f, 0x1p60f}}.span(), 1.0f));
    const depth_shear flat{{0.5f, 0.5f}};
    CHECK(test::same_bits(flat(0.5f), 0.0f));
    CHECK(test::same_bits(flat(0.5f + 0x1p-16f), 1.0f));
    CHECK(test::same_bits(flat.span(), 0x1p-16f));
    CHECK(test::is_nan(flat(test::nan<float>)));
    CHECK(test::equal(flat(test::infinity<float>), test::infinity<float>));
    CHECK(test::equal(depth_shear{{0.25f, 0.75f}}.inverse(0.5f), 0.5f));
}
