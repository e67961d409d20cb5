// The oracle snaps the position to 1/256 texel and blends in long double.
#include <gnomon/filter/sample.hpp>

#include "../support/bits.hpp"
#include "../support/formats.hpp"
#include "../support/images.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace {
using gnomon::extent;
using gnomon::image;
using test::dice;

template <typename Texel> long double blended(const image<Texel>& map, float x, float y, int channel) {
    const auto snapped = [](float v) { return std::floor((static_cast<long double>(v) - 0.5L) * 256 + 0.5L) / 256; };
    const long double u = snapped(x), v = snapped(y), column = std::floor(u), row = std::floor(v);
    long double sum = 0;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const int cx = static_cast<int>(column) + i, cy = static_cast<int>(row) + j;
            const Texel t = whole(map.size()).contains(cx, cy) ? map(cx, cy) : Texel::clear();
            const long double weight = (i == 0 ? 1 - (u - column) : u - column) * (j == 0 ? 1 - (v - row) : v - row);
            sum += weight * static_cast<long double>(Texel::channel_type::code(t.stored[channel]));
        }
    return sum;
}
template <typename Texel> bool equal(const gnomon::filtered<Texel>& a, const gnomon::filtered<Texel>& b) {
    for (int c = 0; c < Texel::channels; ++c)
        if (!test::same_bits(a.code[c], b.code[c])) return false;
    return true;
}
} // namespace

TEST_CASE_TEMPLATE("a sample at a texel's centre is that texel, exactly", Texel, gnomon::rg8, gnomon::rgba16, gnomon::rgb16f,
                   gnomon::rgba32f, test::paper8, test::paper32f) {
    dice roll(91);
    const auto map = test::noise<Texel>(roll, {23, 17}, 2);
    int wrong = 0;
    test::for_each_texel(whole(map.size()), [&](int x, int y) {
        wrong += !equal(gnomon::sample(map.view(), static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f), read(map(x, y)));
    });
    CHECK(wrong == 0);
}

TEST_CASE_TEMPLATE("a sample is the blend of four texels at a position taken to 1/256, exactly for unorm and half", Texel,
                   gnomon::rg8, gnomon::rgba16, gnomon::rgb16f, gnomon::rgba32f, test::paper8, test::paper32f) {
    dice roll(92);
    int wrong = 0;
    for (const extent size : {extent{23, 17}, {1, 1}, {1, 9}, {9, 1}, {0, 0}}) {
        const auto map = test::noise<Texel>(roll, size, 2);
        for (int i = 0; i < 4000; ++i) {
            const float x = static_cast<float>(roll(-3 * 1024, (size.width + 3) * 1024)) / 1024,
                        y = static_cast<float>(roll(-3 * 1024, (size.height + 3) * 1024)) / 1024;
            const auto found = gnomon::sample(map.view(), x, y);
            for (int c = 0; c < Texel::channels; ++c) {
                const long double expected = blended(map, x, y, c);
                const long double allowed = sizeof(typename Texel::storage) < 4 ? 0 : expected * 0x1p-50L;
                wrong += std::fabs(static_cast<long double>(found.code[c]) - expected) > allowed;
            }
            if constexpr (std::same_as<typename Texel::representation_type, gnomon::depth_mask>)
                wrong += !(found.depth() <= found.mask());
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("a position is off by at most 1/512 texel") {
    image<gnomon::rg32f> ramp({64, 1});
    for (int x = 0; x < 64; ++x) ramp(x, 0).stored[1] = static_cast<float>(x) + 0.5f; // holds its own position
    double worst = 0;
    for (int i = 0; i < 200'000; ++i) {
        const float x = 0.5f + 63.0f * static_cast<float>(i) / 200'000.0f;
        worst = std::max(worst, std::fabs(gnomon::sample(ramp.view(), x, 0.5f).mask() - static_cast<double>(x)));
    }
    CHECK(worst <= 1.0 / 512);
    CHECK(worst > 0.999 / 512);
}

TEST_CASE_TEMPLATE("off the map, at infinity and nowhere lies clear", Texel, gnomon::rg8, gnomon::rg32f, test::paper8) {
    const image<Texel> map({4, 3}, Texel::caster(0.25f));
    const auto clear = read(Texel::clear());
    constexpr float inf = test::infinity<float>;
    for (const float away : {-inf, -1e30f, -2e9f, -1.0f, -0.5f, 4.5f, 5.0f, 2e9f, 1e30f, inf, test::nan<float>}) {
        CAPTURE(away);
        CHECK(equal(gnomon::sample(map.view(), away, 1.5f), clear));
        CHECK(equal(gnomon::sample(map.view(), 1.5f, away), clear));
        CHECK(equal(gnomon::sample(map.view(), away, away), clear));
    }
    CHECK_FALSE(equal(gnomon::sample(map.view(), -0.49f, 1.5f), clear));
    CHECK_FALSE(equal(gnomon::sample(map.view(), 4.49f, 1.5f), clear));
    CHECK(equal(gnomon::sample(gnomon::image_view<const Texel>{}, 0.0f, 0.0f), clear));
}
