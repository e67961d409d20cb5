// What fast<Kernel> promises of each texel, and how far it may be off.
#include <gnomon/filter/separable.hpp>
#include <gnomon/soft_shadow_map.hpp>

#include "../support/filtering.hpp"
#include "../support/formats.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

namespace {
using namespace gnomon;
using test::dice;
using test::for_each_texel;

template <typename Texel> int differing(const image<Texel>& a, const image<Texel>& b) {
    int n = 0;
    for_each_texel(whole(a.size()), [&](int x, int y) { n += a(x, y) != b(x, y); });
    return n;
}

/// The largest distance, in codes, of a filtered map from the convolution with these weights.
template <typename Texel> long double worst_error(const image<Texel>& from, const image<Texel>& to, const test::taps& k) {
    long double worst = 0;
    for_each_texel(whole(from.size()), [&](int x, int y) {
        for (int c = 0; c < Texel::channels; ++c) {
            const long double exact = test::convolved<long double>(from, k, x, y, c) / k.total / k.total;
            worst = std::max(worst, std::fabs(static_cast<long double>(to(x, y).stored[c]) - exact));
        }
    });
    return worst;
}
/// One pass in single precision, along x or y: from the centre outwards, pairs, products and sums each rounded.
image<texel<float32>> summed(const image<texel<float32>>& from, const test::taps& k, bool along_x) {
    const auto at = [&from](int x, int y) {
        const bool there = x >= 0 && y >= 0 && x < from.size().width && y < from.size().height;
        return there ? from(x, y) : texel<float32>::clear();
    };
    image<texel<float32>> to(from.size());
    for_each_texel(whole(from.size()), [&](int x, int y) {
        for (std::size_t c = 0; c < 2; ++c)
            for (int i = 0; i <= k.radius; ++i) {
                const int dx = along_x ? i : 0, dy = along_x ? 0 : i;
                const float both = i == 0 ? at(x, y).stored[c] : at(x - dx, y - dy).stored[c] + at(x + dx, y + dy).stored[c];
                const auto product =
                    static_cast<float>(static_cast<double>(both) * k.at(i) / k.total); // exact before it is rounded
                to(x, y).stored[c] = i == 0 ? product : to(x, y).stored[c] + product;
            }
    });
    return to;
}
/// A user's, whose total neither divides 256 nor has a part in it.
struct fifths {
    static constexpr int radius = 1, total = 5;
    static constexpr std::array<int, 3> weights{1, 3, 1};
};
/// One more than there are eight bits for.
struct one_too_many {
    static constexpr int radius = 1, total = 257;
    static constexpr std::array<int, 3> weights{1, 255, 1};
};
/// The sum of what floats are weighed by.
template <kernel Kernel>
constexpr int fast_total = [] {
    int sum = 0;
    for (const int w : detail::sums<rg32f, fast<Kernel>>::weights_of::weights) sum += w;
    return sum;
}();
/// What floats weigh by if a kernel's total is no power of two.
template <kernel Kernel> using of_24_bits = detail::in_units<Kernel, 1 << 24>;
} // namespace

static_assert(kernel<fast<gaussian<4>>> && kernel_is_sound<fast<gaussian<4>>>());
static_assert(detail::is_box<box<2>> && !detail::is_box<test::spread> && !detail::is_box<tent<1>>);
static_assert(fast<tent<3>>::weights == tent<3>::weights && fast<tent<3>>::total == 16);
static_assert(fast_total<box<4096>> == 1 << 24); // compilers count what they compute

TEST_CASE_TEMPLATE("fast, bytes are filtered by weights of eight bits, and by the kernel itself where that is as quick or too wide",
                   Texel, rg8, rgba8) {
    dice roll(701);
    const auto from = test::noise<Texel>(roll, {41, 37}, 3);
    const auto by_eight_bits = test::dense<eight_bit<gaussian<3>>>(from);
    CHECK(differing(test::dense<fast<gaussian<3>>>(from), by_eight_bits) == 0);
    CHECK(differing(test::dense<gaussian<3>>(from), by_eight_bits) > 0); // there is something to tell
    CHECK(differing(test::dense<fast<fifths>>(from), test::dense<eight_bit<fifths>>(from)) == 0);
    CHECK(differing(test::dense<fifths>(from), test::dense<eight_bit<fifths>>(from)) > 0);
    CHECK(differing(test::dense<fast<one_too_many>>(from), test::dense<eight_bit<one_too_many>>(from)) == 0);
    CHECK(differing(test::dense<one_too_many>(from), test::dense<eight_bit<one_too_many>>(from)) > 0);
    CHECK(differing(test::dense<fast<box<3>>>(from), test::dense<box<3>>(from)) == 0);
    CHECK(differing(test::dense<fast<binomial<4>>>(from), test::dense<binomial<4>>(from)) == 0);
    CHECK(differing(test::dense<fast<gaussian<32>>>(from), test::dense<eight_bit<gaussian<32>>>(from)) == 0);
    CHECK(differing(test::dense<fast<gaussian<33>>>(from), test::dense<gaussian<33>>(from)) == 0);
    CHECK(differing(test::dense<fast<gaussian<0>>>(from), from) == 0);
}

TEST_CASE_TEMPLATE("fast, sixteen bits are filtered by weights of fifteen and stored between columns and rows", Texel, rg16,
                   rgb16) {
    dice roll(702);
    const auto from = test::noise<Texel>(roll, {41, 37}, 3);
    const auto expected = [&from]<typename Kernel>() {
        return test::twice_rounded(from, test::taps_of<detail::in_units<Kernel, 1 << 15>>(), test::first::columns);
    };
    CHECK(differing(test::dense<fast<gaussian<3>>>(from), expected.template operator()<gaussian<3>>()) == 0);
    CHECK(differing(test::dense<fast<binomial<1>>>(from), expected.template operator()<binomial<1>>()) == 0);
    CHECK(differing(test::dense<fast<tent<20>>>(from), expected.template operator()<tent<20>>()) == 0);
    CHECK(differing(test::dense<fast<box<3>>>(from), test::dense<box<3>>(from)) == 0);
    CHECK(differing(test::dense<fast<gaussian<0>>>(from), from) == 0);
}

TEST_CASE(
    "fast, ratios of 16 bits are filtered by weights of ten bits, those of 8 bits and a user's channel by the kernel itself") {
    struct own : unorm16 {};
    dice roll(706);
    const auto from = test::noise<tm16>(roll, {41, 37}, 3);
    CHECK(differing(test::dense<fast<gaussian<3>>>(from), test::dense<detail::in_units<gaussian<3>, 1024>>(from)) == 0);
    CHECK(differing(test::dense<fast<gaussian<3>>>(from), test::dense<gaussian<3>>(from)) > 0);
    CHECK(differing(test::dense<fast<binomial<5>>>(from), test::dense<binomial<5>>(from)) == 0); // 1024 already
    CHECK(differing(test::dense<fast<gaussian<128>>>(from), test::dense<detail::in_units<gaussian<128>, 1024>>(from)) == 0);
    CHECK(differing(test::dense<fast<gaussian<129>>>(from), test::dense<gaussian<129>>(from)) == 0);
    using just_wider = detail::in_units<gaussian<3>, 1025>;
    CHECK(differing(test::dense<fast<just_wider>>(from), test::dense<detail::in_units<just_wider, 1024>>(from)) == 0);
    const auto bytes = test::noise<tm8>(roll, {41, 37}, 3);
    CHECK(differing(test::dense<fast<gaussian<3>>>(bytes), test::dense<gaussian<3>>(bytes)) == 0);
    const auto of_user = test::noise<texel<own>>(roll, {41, 37}, 3);
    CHECK(differing(test::dense<fast<gaussian<3>>>(of_user), test::dense<gaussian<3>>(of_user)) == 0);
}

TEST_CASE("fast, sixteen bits are at most one code from the convolution, and that far if both roundings are halves") {
    dice roll(703);
    const auto from = test::noise<rg16>(roll, {41, 37}, 3);
    CHECK(worst_error(from, test::dense<fast<gaussian<3>>>(from), test::taps_of<detail::in_units<gaussian<3>, 1 << 15>>()) <= 1.0L);
    // (1, 2, 1) / 4 down a column is 1/2 where the code below is odd; and across, of 1 and 2 in turn, 3/2.
    image<rg16> halves({5, 5}, rg16::clear());
    for_each_texel(whole(halves.size()), [&](int x, int y) {
        const auto code = static_cast<std::uint16_t>(y == 3 ? 2 : (x % 2 == 0 && y == 1 ? 4 : 0));
        halves(x, y).stored[0] = halves(x, y).stored[1] = code;
    });
    const auto made = test::dense<fast<tent<1>>>(halves);
    CHECK(worst_error(halves, made, test::taps_of<tent<1>>()) == 1.0L);
}

TEST_CASE("fast, a float is the sum of the columns' sums, every number of it in single precision, by weights of 24 bits") {
    dice roll(707);
    const auto from = test::noise<rg32f>(roll, {41, 37}, 2);
    const auto try_kernel = [&from]<typename Kernel, typename Weights>() {
        const test::taps k = test::taps_of_any<Weights>();
        CHECK(differing(test::dense<fast<Kernel>>(from), summed(summed(from, k, false), k, true)) == 0);
    };
    try_kernel.template operator()<gaussian<3>, gaussian<3>>();
    try_kernel.template operator()<binomial<2>, binomial<2>>();
    try_kernel.template operator()<box<4>, of_24_bits<box<4>>>();
    try_kernel.template operator()<tent<12>, of_24_bits<tent<12>>>();
    try_kernel.template operator()<test::spread, of_24_bits<test::spread>>();
}

TEST_CASE(
    "fast, a number is within filter_deviation of what the kernel itself gives, beside its roundings, and half as far and more") {
    dice roll(709);
    const auto try_kernel = [&]<typename Texel, typename Kernel>() {
        constexpr int radius = Kernel::radius;
        constexpr auto scale = static_cast<long double>(Texel::channel_type::scale);
        constexpr long double most = static_cast<long double>(filter_deviation<Texel, fast<Kernel>>) * scale;
        constexpr long double rounding = filter_roundings<Texel, fast<Kernel>> / 2.0L;
        const test::taps own = test::taps_of<typename detail::plan<Texel, fast<Kernel>>::weights_of>(), k = test::taps_of<Kernel>();
        image<Texel> worst({2 * radius + 1, 2 * radius + 1}, Texel::clear()); // casters where fast weighs more
        for_each_texel(whole(worst.size()), [&](int x, int y) {
            const auto weight = [&](const test::taps& w) {
                return static_cast<long double>(w.at(x - radius)) * w.at(y - radius) / w.total / w.total;
            };
            if (weight(own) > weight(k)) worst(x, y) = Texel::caster(0.0f);
        });
        const long double exact = test::convolved<long double>(worst, k, radius, radius, 1) / k.total / k.total;
        const long double off = static_cast<long double>(test::dense<fast<Kernel>>(worst)(radius, radius).stored[1]) - exact;
        CAPTURE(radius);
        CAPTURE(scale);
        CHECK(off <= most + rounding);
        CHECK(off >= most / 2 - rounding);
        const auto from = test::noise<Texel>(roll, {41, 37}, 3);
        if constexpr (Texel::representation_type::premultiplied)
            CHECK(worst_error(from, test::dense<fast<Kernel>>(from), k) <= most + rounding);
    };
    try_kernel.operator()<rg8, gaussian<2>>();
    try_kernel.operator()<rg8, gaussian<16>>();
    try_kernel.operator()<rg8, gaussian<32>>();
    try_kernel.operator()<rg16, gaussian<16>>();
    try_kernel.operator()<tm16, gaussian<8>>();
    static_assert(filter_deviation<rg8, fast<binomial<4>>> <= 0.0 && filter_deviation<rg8, narrow<gaussian<4>>> <= 0.0);
    static_assert(filter_deviation<rg32f, fast<gaussian<4>>> <= 0.0 && filter_deviation<rg32f, fast<tent<12>>> < 8 * 0x1p-24);
}

TEST_CASE_TEMPLATE("fast, a float is within its roundings of the convolution, and farther from it than an exact sum would be",
                   Texel, rg32f, rgba32f) {
    dice roll(704);
    constexpr long double each = static_cast<long double>(Texel::channel_type::rounding.relative);
    const auto try_kernel = [&]<typename Kernel, typename Weights>() {
        const auto from = test::noise<Texel>(roll, {41, 37}, 2);
        const auto to = test::dense<fast<Kernel>>(from);
        const test::taps k = test::taps_of_any<Weights>();
        long double worst = 0;
        for_each_texel(whole(from.size()), [&](int x, int y) {
            for (int c = 0; c < Texel::channels; ++c) {
                const long double exact = test::convolved<long double>(from, k, x, y, c) / k.total / k.total;
                const long double error = std::fabs(static_cast<long double>(to(x, y).stored[c]) - exact);
                if (exact > 0) worst = std::max(worst, error / exact / each);
            }
        });
        CAPTURE(Kernel::radius);
        CHECK(worst <= filter_roundings<Texel, fast<Kernel>>);
        CHECK(worst > 1.01L);
    };
    try_kernel.template operator()<gaussian<2>, gaussian<2>>();
    try_kernel.template operator()<box<4>, of_24_bits<box<4>>>();
    try_kernel.template operator()<tent<12>, of_24_bits<tent<12>>>();
}

TEST_CASE("fast, a half is within half a step of the convolution and what floats round, and now and then not the nearest half") {
    dice roll(708);
    const auto try_kernel = [&]<typename Kernel, typename Weights>() {
        const auto from = test::noise<rg16f>(roll, {97, 81}, 2);
        const auto to = test::dense<fast<Kernel>>(from);
        const test::taps k = test::taps_of_any<Weights>();
        long double worst = 0; // in half steps of a normal half
        for_each_texel(whole(from.size()), [&](int x, int y) {
            for (int c = 0; c < rg16f::channels; ++c) {
                const long double exact = test::convolved<long double>(from, k, x, y, c) / k.total / k.total;
                const long double error = std::fabs(static_cast<long double>(half16::code(to(x, y).stored[c])) - exact);
                if (exact > 0x1p-14L) worst = std::max(worst, error / std::exp2(std::floor(std::log2(exact)) - 11.0L));
            }
        });
        CAPTURE(Kernel::radius);
        CHECK(worst <= 1.0L + 2 * (Kernel::radius + 2) * 0x1p-12L);
        CHECK(worst > 0.99L);
        return differing(to, test::dense<Kernel>(from));
    };
    CHECK(try_kernel.template operator()<gaussian<2>, gaussian<2>>() +
              try_kernel.template operator()<box<4>, of_24_bits<box<4>>>() +
              try_kernel.template operator()<tent<12>, of_24_bits<tent<12>>>() >
          0);
}

TEST_CASE_TEMPLATE("fast, clear stays clear, a uniform region of whole codes stays itself, and e <= m everywhere", Texel, rg8, rgb8,
                   rg16, rgba16, rg16f, rgb32f) {
    using kernel = fast<gaussian<3>>;
    CHECK(differing(test::dense<kernel>(image<Texel>({9, 9}, Texel::clear())), image<Texel>({9, 9}, Texel::clear())) == 0);
    const auto uniform = test::dense<kernel>(image<Texel>({9, 9}, Texel::caster(0.3f)));
    if constexpr (Texel::channel_type::whole_codes) CHECK(uniform(4, 4) == Texel::caster(0.3f));
    dice roll(705);
    int wrong = 0;
    for (int i = 0; i < 20; ++i) {
        const auto made = test::dense<kernel>(test::noise<Texel>(roll, {33, 17}, 1 + i % 4));
        for_each_texel(whole(made.size()), [&](int x, int y) {
            const auto code = [&](int c) { return Texel::channel_type::code(made(x, y).stored[c]); };
            wrong += code(Texel::depth_index) > code(Texel::mask_index);
        });
    }
    CHECK(wrong == 0);
}

TEST_CASE_TEMPLATE("fast, clear stays clear by every kernel where it is not zero: the paper's pair in half and float", Texel,
                   test::paper16f, test::paper32f) {
    const auto stays_clear = []<typename Kernel>() {
        const image<Texel> nothing({40, 9}, Texel::clear());
        CAPTURE(Kernel::total);
        CHECK(differing(test::dense<Kernel>(nothing), nothing) == 0);
    };
    const auto both = [&]<typename Kernel>() {
        stays_clear.template operator()<fast<Kernel>>();
        stays_clear.template operator()<narrow<Kernel>>();
    };
    both.template operator()<gaussian<3>>();
    both.template operator()<box<16>>();
    both.template operator()<tent<13>>();
    both.template operator()<detail::in_units<gaussian<3>, 50001>>(); // whose square no float is
}

TEST_CASE("a map knows how often its filter rounds, and its decisions allow for it") {
    CHECK(soft_shadow_map<rg16, gaussian<2>>({8, 8}).decision.caster.roundings == 1);
    CHECK(soft_shadow_map<rg16, fast<gaussian<2>>>({8, 8}).decision.caster.roundings == 2);
    CHECK(soft_shadow_map<rgb16, fast<gaussian<2>>>({8, 8}).decision.far_bound.roundings == 2);
    CHECK(filter_roundings<rg8, fast<gaussian<2>>> == 1);
    CHECK(filter_roundings<tm16, fast<gaussian<2>>> == 1);
    CHECK(filter_roundings<rg16f, fast<gaussian<2>>> == 2);
    CHECK(filter_roundings<rg32f, fast<gaussian<2>>> == 2 * 4 + 1);
}
