// The un-premultiplied pair, unfiltered: which way a depth is rounded, and that a filter sees products.
#include <gnomon/texel/texel.hpp>

#include "../support/bits.hpp"
#include "../support/float_dice.hpp"
#include "../support/formats.hpp"
#include "../support/sweep.hpp"

#include <doctest/doctest.h>

#include <cstdint>

using namespace gnomon;
using test::sweep;

namespace {

/// Is T / N <= 1-s < (T+1) / N?  A float times 16 bits is exact in double, and so is T + N s where it could lie near N.
template <typename Texel> bool is_next_below(int code, float s) {
    const double scale = static_cast<double>(Texel::channel_type::scale), rest = scale - code,
                 exact = scale * static_cast<double>(s);
    return exact <= rest && exact > rest - 1.0;
}

} // namespace

TEST_CASE_TEMPLATE("a ratio stores the largest depth code that is not nearer to the light than the caster", Texel, tm8, tm16) {
    constexpr int last = static_cast<int>(Texel::channel_type::scale);
    sweep wrong;
    const auto check = [&wrong](float s) {
        const Texel t = Texel::caster(s);
        wrong.unless(is_next_below<Texel>(t.stored[0], s) && t.stored[1] == last, "s", s, "stored", t.stored[0]);
    };
    for (int code = 0; code <= last; ++code) { // each code's own depth, and the floats beside it
        const float s = static_cast<float>(code / static_cast<double>(last));
        check(s);
        if (code > 0) check(test::down(s));
        if (code < last) check(test::up(s));
    }
    test::float_dice dice(31);
    for (int i = 0; i < 1'000'000; ++i) check(dice.any_unit());
    for (const float s : {test::smallest<float>, 0x1p-126f, test::down(1.0f)}) check(s);
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("a ratio takes what lies outside of 0 to 1 to the nearer end and NaN to the far plane", Texel, tm8, tm16,
                   test::ratio_rgba8) {
    for (const float s : {0.0f, -0.0f, -1.0f, -test::infinity<float>}) CHECK(Texel::caster(s) == Texel::caster(0.0f));
    for (const float s : {1.0f, 2.0f, test::infinity<float>, test::nan<float>}) CHECK(Texel::caster(s) == Texel::caster(1.0f));
    CHECK(Texel::caster(0.0f).stored[0] == static_cast<typename Texel::storage>(Texel::channel_type::scale));
    CHECK(Texel::caster(1.0f).stored[0] == 0);
}

TEST_CASE("a filter sees a ratio as products and what it sums comes back: all 65536 pairs of tm8") {
    sweep wrong;
    for (int t = 0; t <= 255; ++t)
        for (int m = 0; m <= 255; ++m) {
            const tm8 texel{{static_cast<std::uint8_t>(t), static_cast<std::uint8_t>(m)}};
            const std::uint64_t sums[] = {texel.linear<std::uint64_t>(0), texel.linear<std::uint64_t>(1)};
            const auto product = static_cast<std::uint64_t>(t * m), mask = static_cast<std::uint64_t>(255 * m);
            wrong.unless(sums[0] == product && sums[1] == mask, "T", t, "M", m, "products");
            wrong.unless(tm8::from_linear(sums, std::uint64_t{1}) == (m > 0 ? texel : tm8::clear()), "T", t, "M", m, "back");
        }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("the largest sums of the largest kernel fit: a full texel comes back", Texel, rg8, rg16, tm8, tm16,
                   test::ratio_rgba8, test::ratio_rgba16) {
    constexpr std::uint64_t whole = std::uint64_t{65536} * 65536;
    const Texel full = Texel::caster(0.0f);
    std::uint64_t sums[static_cast<std::size_t>(Texel::channels)];
    for (int c = 0; c < Texel::channels; ++c) sums[c] = whole * full.template linear<std::uint64_t>(c);
    CHECK(Texel::from_linear(sums, whole) == full);
}

TEST_CASE("a ratio of sums is rounded down and its mask to nearest - and a mask that rounds to nothing takes the depth with it") {
    const auto made = [](std::uint64_t t, std::uint64_t m, std::uint64_t whole) {
        const std::uint64_t sums[] = {t * m, 255 * m};
        return tm8::from_linear(sums, whole);
    };
    CHECK(made(200, 255, 510) == tm8{{200, 1}}); // half a code of mask is rounded up
    CHECK(made(200, 254, 510) == tm8::clear());
    const std::uint64_t two_depths[] = {100 * 255 + 101 * 254, 255 * (255 + 254)}; // a mean of 100.499: down
    CHECK(tm8::from_linear(two_depths, std::uint64_t{2}) == tm8{{100, 255}});
    const std::uint64_t nearly[] = {100 * 1 + 101 * 254, 255 * 255}; // 100.996: down, too
    CHECK(tm8::from_linear(nearly, std::uint64_t{1}) == tm8{{100, 255}});
}

namespace {
struct far_when_clear : gnomon::depth_ratio { // a user's
    static constexpr double clear_depth = 1.0;
};
} // namespace

TEST_CASE("sums without a mask are the clear texel of their representation") {
    using texel = gnomon::texel<unorm8, far_when_clear>;
    const std::uint64_t nothing[] = {0, 0};
    CHECK(texel::from_linear(nothing, 1) == texel::clear());
    CHECK(texel::clear() == texel{{255, 0}});
}
