// Hard cases of a surface that receives its own shadow: how much bias.depth it takes before it has none.
#include <gnomon/receive/decide.hpp>

#include "hard_cases.hpp"

#include "../support/filtering.hpp"

#include <doctest/doctest.h>

#include <utility>

using namespace gnomon;

namespace {

constexpr int width = 160;

/// A surface whose depth is `depth_at(x)`, from column `first` to column `last`, under a box of radius R.
template <int Radius, typename F> image<rg32f> surface(int first, int last, F depth_at) {
    image<rg32f> map({width, 2 * Radius + 1}, rg32f::clear());
    test::for_each_texel({first, 0, last, 2 * Radius + 1}, [&](int x, int y) { map(x, y) = rg32f::caster(depth_at(x)); });
    return test::dense<box<Radius>>(map);
}

/// The darkest texel from `first` to `last` if every texel receives at its own depth.
template <int Radius, typename F> float darkest(const image<rg32f>& soft, int first, int last, F depth_at, float bias_depth) {
    rule r{};
    r.caster.depth = bias_depth;
    float most = 0.0f;
    for (int x = first; x < last; ++x) most = greater(most, shadow(soft(x, Radius), depth_at(x), r));
    return most;
}

} // namespace

// --- h26: a plane of slope a a texel. The mean of a footprint is its own depth, but at the far edge, where it is half one --------------

TEST_CASE("h26_plane_self_shadow: no bias in the interior and half of slope times radius at the far edge where exact filtering "
          "needs all") {
    constexpr int radius = 8, first = 20, last = 140;
    constexpr float slope = 0x1p-8f;
    const auto plane = [](int x) { return 0.125f + slope * static_cast<float>(x - first); };
    const image<rg32f> soft = surface<radius>(first, last, plane);
    const auto worst = [&](int from, int to, float share) { // of slope times radius
        return darkest<radius>(soft, from, to, plane, share * slope * radius);
    };
    CHECK(test::equal(worst(first + radius, last - radius, 0.0f), 0.0f));
    CHECK(test::equal(worst(first, first + radius, 0.0f), 0.0f)); // the near edge: its mean lies behind it
    CHECK(worst(last - radius, last, 0.49f) > 0.5f);
    CHECK(test::equal(worst(last - radius, last, 0.501f), 0.0f));

    // Exact filtering counts every tap that lies before the receiver: the farthest needs slope times radius.
    const auto exact = [&](int x, float share) {
        int before = 0;
        for (int i = x - radius; i <= x + radius; ++i) before += plane(x) - share * slope * radius > plane(i) ? 1 : 0;
        return before;
    };
    CHECK(exact(80, 0.99f) == 1); // 6 % of false shadow
    CHECK(exact(80, 1.0f) == 0);
}

// --- h27: a surface of curvature k. The mean of a valley lies before its floor --------------------------------------------------------

TEST_CASE("h27_concave_receiver: a valley needs a bias of curvature times R(R+1)/3 and a ridge needs none") {
    test::for_each_kernel(test::kernels<box<4>, box<8>, box<16>>{}, []<typename Kernel>() {
        constexpr int radius = Kernel::radius, middle = width / 2;
        constexpr float curvature = 0x1p-14f, needed = curvature * static_cast<float>(radius * (radius + 1)) / 3.0f;
        const auto bent = [](int x) { return curvature * static_cast<float>((x - middle) * (x - middle)); };
        const auto valley = [&](int x) { return 0.75f - bent(x); };
        const auto ridge = [&](int x) { return 0.25f + bent(x); };
        const auto in_valley = surface<radius>(0, width, valley), on_ridge = surface<radius>(0, width, ridge);
        CAPTURE(radius);
        CHECK(test::equal(darkest<radius>(on_ridge, radius, width - radius, ridge, 0.0f), 0.0f));
        CHECK(test::equal(darkest<radius>(in_valley, radius, width - radius, valley, needed * 1.001f), 0.0f));
        CHECK(test::equal(darkest<radius>(in_valley, radius, width - radius, valley, needed * 0.999f), 1.0f));
        const float share = needed / (curvature * radius * radius); // .417, .375, .354
        CHECK(share > (radius == 4 ? 0.416f : (radius == 8 ? 0.374f : 0.353f)));
        CHECK(share < (radius == 4 ? 0.418f : (radius == 8 ? 0.376f : 0.355f)));
    });
}
