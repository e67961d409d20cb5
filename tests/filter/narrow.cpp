// What narrow<Kernel> promises: nothing wider than the map lies between the passes, and lanes know it too.
#include <gnomon/backend/simd.hpp>
#include <gnomon/filter/separable.hpp>
#include <gnomon/texel/half.hpp>

#include "../support/filtering.hpp"
#include "../support/formats.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace {
using namespace gnomon;

template <kernel Kernel, texel_format Texel> image<Texel> in_lanes(const image<Texel>& from) {
    image<Texel> to(from.size());
    filter_scratch<Texel, Kernel> scratch(from.size().width);
    simd<>{}.filter_region(from.view(), to.view(), whole(from.size()), scratch);
    return to;
}
} // namespace

static_assert(kernel<narrow<gaussian<4>>> && kernel_is_sound<narrow<gaussian<4>>>());
static_assert(filter_roundings<rg8, narrow<box<2>>> == 2 && filter_roundings<rgba16, narrow<gaussian<9>>> == 2);
static_assert(filter_roundings<rg16f, narrow<box<2>>> == 3 &&
              filter_roundings<rg32f, narrow<box<2>>> == filter_roundings<rg32f, fast<box<2>>>);

TEST_CASE_TEMPLATE("a narrow filter rounds columns to texels, and rows of those again", Texel, rg8, rgba8, rg16, rgb16) {
    test::dice roll(711);
    const auto from = test::noise<Texel>(roll, {41, 37}, 3);
    const auto holds = [&]<typename Kernel>() {
        const auto made = test::dense<narrow<Kernel>>(from);
        CHECK(test::differences(made, test::twice_rounded(from, test::taps_of<Kernel>(), test::first::columns)) == 0);
        CHECK(test::differences(in_lanes<narrow<Kernel>>(from), made) == 0);
        CHECK(test::differences(test::dense<Kernel>(from), made) > 0); // there is something to tell
    };
    holds.template operator()<box<2>>();
    holds.template operator()<tent<3>>();
    holds.template operator()<gaussian<4>>();
}

TEST_CASE("a narrow filter of floats, which leaves them as they are between the passes, is the fast one") {
    test::dice roll(713);
    const auto from = test::noise<rg32f>(roll, {41, 37}, 3);
    const auto is_fast = [&]<typename Kernel>() {
        const auto made = test::dense<fast<Kernel>>(from);
        CHECK(test::differences(test::dense<narrow<Kernel>>(from), made) == 0);
        CHECK(test::differences(in_lanes<narrow<Kernel>>(from), made) == 0);
    };
    is_fast.template operator()<tent<12>>(); // 169 is no power of two
    is_fast.template operator()<gaussian<3>>();
}

TEST_CASE("a narrow filter of halves is within three roundings of the convolution") {
    test::dice roll(712);
    const auto from = test::noise<rg16f>(roll, {41, 37}, 3);
    const auto made = test::dense<narrow<gaussian<3>>>(from);
    CHECK(test::differences(in_lanes<narrow<gaussian<3>>>(from), made) == 0);
    CHECK(test::differences(test::dense<fast<gaussian<3>>>(from), made) > 0);
    const auto k = test::taps_of<gaussian<3>>();
    double worst = 0.0;
    test::for_each_texel(whole(from.size()), [&](int x, int y) {
        for (int c = 0; c < 2; ++c) {
            const double exact = test::convolved<double>(from, k, x, y, c) / k.total / k.total;
            const double off = std::fabs(static_cast<double>(half_to_float(made(x, y).stored[c])) - exact);
            if (exact > 0.0) worst = std::fmax(worst, (off - 0x1p-25 * 3) / (exact * 0x1p-11));
        }
    });
    CHECK(worst <= 3.0);
    CHECK(worst > 1.0); // one is not enough
}
