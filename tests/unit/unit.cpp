// The smallest helpers, on the values that break helpers.
#include <gnomon/unit.hpp>

#include "../support/bits.hpp"
#include "../support/sweep.hpp"

#include <doctest/doctest.h>

using namespace gnomon;
using test::sweep;

static_assert(test::same_bits(saturate(test::nan<float>), 0.0f) && test::same_bits(saturate(2.0), 1.0));

TEST_CASE("saturate limits every number to 0 to 1 and takes NaN to 0") {
    sweep wrong;
    for (const float v : test::hostile_floats) {
        const float expected = v >= 1.0f ? 1.0f : (v > 0.0f ? v : 0.0f);
        wrong.unless(test::same_bits(saturate(v), expected), "float", v);
        wrong.unless(test::same_bits(saturate(static_cast<double>(v)), static_cast<double>(expected)), "double", v);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("lesser and greater give the first of two that are equal or unordered") {
    CHECK(lesser(1, 2) == 1);
    CHECK(lesser(2, 1) == 1);
    CHECK(greater(1, 2) == 2);
    CHECK(greater(2, 1) == 2);
    for (const auto pick : {lesser<float>, greater<float>}) {
        CHECK(test::same_bits(pick(0.0f, -0.0f), 0.0f));
        CHECK(test::same_bits(pick(-0.0f, 0.0f), -0.0f));
        CHECK(test::same_bits(pick(3.0f, test::nan<float>), 3.0f));
        CHECK(test::is_nan(pick(test::nan<float>, 3.0f)));
    }
}

TEST_CASE("select gives the first of two if the condition holds and else the second") {
    CHECK(select(true, 2, 3) == 2);
    CHECK(select(false, 2, 3) == 3);
}

TEST_CASE("same is equality, and NaN is the same as nothing") {
    CHECK(same(2.0f, 2.0f));
    CHECK(same(0.0f, -0.0f));
    CHECK_FALSE(same(2.0f, 3.0f));
    CHECK_FALSE(same(3.0f, 2.0f));
    CHECK_FALSE(same(test::nan<float>, test::nan<float>));
    CHECK_FALSE(depth_interval{0.25f, 0.5f} == depth_interval{0.25f, 0.75f});
    CHECK_FALSE(depth_interval{0.25f, 0.5f} == depth_interval{0.125f, 0.5f});
}

TEST_CASE("what is first included in a depth interval is all of it, also beyond 0 and 1") {
    for (const depth_interval first : {depth_interval{1.5f, 2.0f}, {-2.0f, -1.0f}, {0.0f, 0.0f}, {1.0f, 1.0f}}) {
        depth_interval depths;
        depths.include(first);
        CHECK(depths == first);
    }
}

TEST_CASE("a depth interval is empty until something is included and then holds all of it") {
    depth_interval depths;
    CHECK(depths.empty());
    CHECK(depths == depth_interval{1.0f, 0.0f});
    depths.include({});
    CHECK(depths.empty());
    depths.include({0.5f, 0.5f});
    CHECK(depths == depth_interval{0.5f, 0.5f});
    depths.include({0.75f, 0.875f});
    CHECK(depths == depth_interval{0.5f, 0.875f});
    depths.include({0.25f, 0.625f});
    CHECK(depths == depth_interval{0.25f, 0.875f});
    depths.include({0.9f, 0.1f});
    CHECK(depths == depth_interval{0.25f, 0.875f});
    depths.include({test::nan<float>, 1.0f});
    depths.include({0.0f, test::nan<float>});
    CHECK(depths == depth_interval{0.25f, 0.875f});
}

TEST_CASE("depth intervals are equal if and only if both ends are") {
    const depth_interval depths{0.25f, 0.75f};
    CHECK(depths == depth_interval{0.25f, 0.75f});
    CHECK(depths != depth_interval{0.5f, 0.75f});
    CHECK(depths != depth_interval{0.25f, 0.5f});
    CHECK(depths != depth_interval{0.25f, test::nan<float>});
}
