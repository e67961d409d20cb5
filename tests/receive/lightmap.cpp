// A shadow on precomputed light takes away what the light adds to the ambient, and nothing that is not there.
#include <gnomon/receive/lightmap.hpp>

#include "../support/bits.hpp"
#include "../support/float_dice.hpp"
#include "../support/sweep.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <vector>

using namespace gnomon;
using test::sweep;

namespace {

/// What must hold for any three floats.
bool is_sound(float light, float shadow, float ambient) {
    const float masked = mask_light(light, shadow, ambient);
    if (!(light > ambient))
        return test::same_bits(masked, light) || (test::is_nan(light) && test::is_nan(masked)); // dark already, or NaN
    return masked <= light && masked >= ambient;
}

/// The formula, in double; every step of it is within 2^-52 of the result as long as shadow is a multiple of 2^-24.
double formula(float light, float shadow, float ambient) {
    const double l = static_cast<double>(light), a = static_cast<double>(ambient), s = static_cast<double>(shadow);
    return (1.0 - s) * l + s * a; // the same as l - s (l - a), without its cancellation
}

static_assert(test::same_bits(mask_light(0.75f, 0.5f, 0.25f), 0.5f));
static_assert(test::same_bits(mask_light(0.125f, 1.0f, 0.25f), 0.125f));

} // namespace

TEST_CASE("no shadow leaves the light and full shadow the ambient unless the light was below it") {
    sweep wrong;
    for (const float light : test::hostile_floats)
        for (const float ambient : test::hostile_floats) {
            if (test::is_nan(light) || test::is_nan(ambient)) continue;
            for (const float none : {0.0f, -0.0f, -1.0f, -test::infinity<float>, test::nan<float>})
                wrong.unless(test::equal(mask_light(light, none, ambient), light), "light", light, "ambient", ambient, "no shadow",
                             none);
            for (const float full : {1.0f, 2.0f, test::infinity<float>})
                if (light < test::infinity<float> && ambient > -test::infinity<float>)
                    wrong.unless(test::equal(mask_light(light, full, ambient), lesser(light, ambient)), "light", light, "ambient",
                                 ambient, "shadow", full);
        }
    CHECK(wrong.report() == "");
}

TEST_CASE("a NaN light or ambient, or one without end, gives the light itself") {
    for (const float shadow : test::hostile_floats) {
        CHECK(test::same_bits(mask_light(0.5f, shadow, -test::infinity<float>), 0.5f));
        CHECK(test::same_bits(mask_light(0.5f, shadow, test::infinity<float>), 0.5f));
        CHECK(test::same_bits(mask_light(test::infinity<float>, shadow, 0.5f), test::infinity<float>));
        CHECK(test::same_bits(mask_light(0.5f, shadow, test::nan<float>), 0.5f));
        CHECK(test::is_nan(mask_light(test::nan<float>, shadow, 0.5f)));
    }
}

TEST_CASE("a shadow never brightens and never goes below the ambient for all 8-bit lights and shadows and ambients") {
    sweep wrong;
    for (int light = 0; light < 256; ++light)
        for (int shadow = 0; shadow < 256; ++shadow)
            for (int ambient = 0; ambient < 256; ++ambient) {
                const float l = static_cast<float>(light) / 255.0f, s = static_cast<float>(shadow) / 255.0f,
                            a = static_cast<float>(ambient) / 255.0f;
                wrong.unless(is_sound(l, s, a), "light", light, "shadow", shadow, "ambient", ambient);
            }
    CHECK(wrong.report() == "");
}

TEST_CASE("a shadow never brightens and never goes below the ambient for floats of any kind") {
    test::float_dice dice(100);
    const auto number = [&dice] {
        return dice.one_in(4) ? test::hostile_floats[static_cast<std::size_t>(dice(0, 29))]
                              : (dice.one_in(2) ? dice.any() : dice.unit());
    };
    sweep wrong;
    for (int i = 0; i < 2'000'000; ++i) {
        const float light = number(), shadow = number(), ambient = number();
        wrong.unless(is_sound(light, shadow, ambient), "light", light, "shadow", shadow, "ambient", ambient);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("mask_light is within 1 ulp of its formula also where a deep shadow leaves little") {
    test::float_dice dice(101);
    sweep wrong;
    for (int i = 0; i < 1'000'000; ++i) {
        const float light = dice.unit() + 0x1p-24f, ambient = light * (i % 2 == 0 ? dice.unit() : dice.any_unit());
        const float shadow = i % 3 == 0 ? 1.0f - static_cast<float>(dice(0, 256)) * 0x1p-24f : dice.unit();
        if (!(light > ambient)) continue;
        const double expected = formula(light, shadow, ambient);
        const float masked = mask_light(light, shadow, ambient), nearest = static_cast<float>(expected);
        const double ulp = static_cast<double>(test::up(nearest)) - static_cast<double>(nearest);
        wrong.unless(std::abs(static_cast<double>(masked) - expected) <= ulp, "light", light, "shadow", shadow, "ambient", ambient,
                     "gives", masked, "formula", expected);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("a row of lights may be masked in place and the shortest span counts") {
    const std::vector<float> light{1.0f, 0.75f, 0.5f, 0.25f, 0.125f}, shadow{0.0f, 0.5f, 1.0f, 1.0f};
    std::vector<float> masked = light;
    mask_light(masked, shadow, 0.25f, masked);
    for (std::size_t i = 0; i < 5; ++i)
        CHECK(test::same_bits(masked[i], i < 4 ? mask_light(light[i], shadow[i], 0.25f) : light[i]));
    std::vector<float> two(2);
    mask_light(light, shadow, 0.25f, two);
    CHECK(test::same_bits(two[1], 0.5f));
    mask_light(light, std::vector<float>(), 0.25f, two);
    CHECK(test::same_bits(two[1], 0.5f));
}

TEST_CASE("one colour of three may be masked where it lies") {
    std::vector<float> rgb{1.0f, 1.0f, 1.0f, 0.5f, 0.5f, 0.5f};
    const std::vector<float> shadow{1.0f, 0.5f};
    const strided_span<float> green(rgb.data() + 1, 2, 3 * sizeof(float));
    mask_light(green, shadow, 0.0f, green);
    CHECK(rgb == std::vector<float>{1.0f, 0.0f, 1.0f, 0.5f, 0.25f, 0.5f});
}
