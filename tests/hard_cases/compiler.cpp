// Hard cases of compilers: what they do to floats, and that nothing here depends on it. fast_math/ has the guard under -ffast-math.
#include <gnomon/receive/decide.hpp>

#include "hard_cases.hpp"

#include "../support/exact.hpp"
#include "../support/float_dice.hpp"
#include "../support/sweep.hpp"

#include <doctest/doctest.h>

using namespace gnomon;
using test::sweep;

namespace {

// What g++ 12 may see whole, and from -O2 on then drops the rounding to float of the pair.
filtered<rg32f> stored_and_read(double e, double m) { return read(rg32f{{float32::store(e), float32::store(m)}}); }
float blended_and_decided(double e, double m, float z) { return shadow(filtered<rg32f>{{e, m}}, z, {.caster = unbiased}); }

double rounded_to_float(double v) {
    const volatile float rounded = static_cast<float>(v);
    return static_cast<double>(rounded);
}

/// The canary: two doubles to float and back, side by side.
void narrow_and_widen(double* to, const double* from) {
    to[0] = static_cast<double>(static_cast<float>(from[0]));
    to[1] = static_cast<double>(static_cast<float>(from[1]));
}

} // namespace

// --- h28: a compiler that drops a rounding changes no stored number and no decision ---------------------------------------------------

TEST_CASE("h28_compiler_canaries: whether this compiler drops the rounding of a pair is worth knowing and does not matter") {
    void (*const volatile canary)(double*, const double*) = &narrow_and_widen;
    const double pair[2] = {0.1, 0.2};
    double back[2] = {};
    canary(back, pair);
    const bool dropped = test::equal(back[0], 0.1);
    MESSAGE("this compiler ", (dropped ? "drops" : "keeps"), " the rounding of two numbers that are narrowed side by side");
    CHECK((dropped || test::equal(back[0], rounded_to_float(0.1)))); // there is no third way
    CHECK(test::equal(stored_and_read(0.1, 0.2).depth(), rounded_to_float(0.1)));
    CHECK(test::equal(stored_and_read(0.1, 0.2).mask(), rounded_to_float(0.2)));
}

TEST_CASE("h28_compiler_canaries: a pair of floats that is stored and read in one expression is rounded in between") {
    filtered<rg32f> (*const volatile store_and_read)(double, double) = &stored_and_read;
    test::float_dice dice(28);
    sweep wrong;
    for (int i = 0; i < 1'000; ++i) {
        const double m = dice.binade(0.5), e = m * static_cast<double>(dice.unit());
        const filtered<rg32f> f = store_and_read(e, m);
        wrong.unless(test::equal(f.depth(), rounded_to_float(e)) && test::equal(f.mask(), rounded_to_float(m)), "e", e, "m", m);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("h28_compiler_canaries: a blend of floats is rounded to float before it is decided so that every ISA can agree") {
    float (*const volatile decide)(double, double, float) = &blended_and_decided;
    test::float_dice dice(29);
    sweep wrong;
    for (int i = 0; i < 100'000; ++i) {
        const double m = dice.binade(0.5), e = m * static_cast<double>(dice.unit());
        const double depth = rounded_to_float(e), mask = rounded_to_float(m);
        const float at = static_cast<float>(1.0 - depth / mask);
        for (const float z : {test::down(at), at, test::up(at)})
            wrong.unless((decide(e, m, z) > 0.0f) == (z > 0.0f && test::exactly_behind(depth, mask, static_cast<double>(z))), "e",
                         e, "m", m, "z", z);
    }
    CHECK(wrong.report() == "");
}
