// The oracle convolves in two dimensions at once: unorm texels as exact fractions, half and float in long double.
#include <gnomon/filter/sample.hpp>
#include <gnomon/filter/separable.hpp>

#include "../support/bits.hpp"
#include "../support/filtering.hpp"
#include "../support/formats.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace {
using gnomon::binomial;
using gnomon::box;
using gnomon::extent;
using gnomon::filter_scratch;
using gnomon::gaussian;
using gnomon::image;
using gnomon::tent;
using gnomon::texel_rect;
using test::dense;
using test::dice;
using test::for_each_kernel;
using test::for_each_texel;
using test::kernels;

using some_kernels = kernels<box<0>, box<1>, tent<2>, binomial<3>, binomial<9>, gaussian<5>, test::spread>;

/// Sizes that are smaller than most kernels, thin, empty and ordinary.
constexpr extent sizes[] = {{0, 0}, {0, 4}, {5, 0}, {1, 1}, {1, 19}, {23, 1}, {3, 2}, {19, 13}};

/// Everything that is not noise: nothing, all full, one texel, stripes, a disc, halves of two depths.
template <gnomon::texel_format Texel> std::vector<image<Texel>> pictures(dice& roll, extent size) {
    std::vector<image<Texel>> all{image<Texel>(size, Texel::clear()), image<Texel>(size, Texel::caster(0.0f)),
                                  test::noise<Texel>(roll, size, 1), test::noise<Texel>(roll, size, 6)};
    const auto draw = [&](auto&& covers) {
        all.emplace_back(size, Texel::clear());
        for_each_texel(whole(size), [&](int x, int y) {
            if (covers(x, y)) all.back()(x, y) = Texel::caster(x < size.width / 2 ? 0.25f : 0.7f);
        });
    };
    draw([&](int x, int y) { return x == size.width / 2 && y == size.height / 2; });
    draw([](int x, int y) { return (x + y) % 2 == 0; });
    draw([](int x, int) { return x % 3 == 0; });
    draw([&](int x, int y) {
        return (2 * x - size.width) * (2 * x - size.width) + (2 * y - size.height) * (2 * y - size.height) < 60;
    });
    return all;
}

template <typename Kernel, typename Texel> int not_the_rational_result(const image<Texel>& from) {
    const test::taps k = test::taps_of<Kernel>();
    const image<Texel> to = dense<Kernel>(from);
    const auto total = static_cast<std::uint64_t>(k.total) * static_cast<std::uint64_t>(k.total);
    int wrong = 0;
    for_each_texel(whole(from.size()), [&](int x, int y) {
        for (int c = 0; c < Texel::channels; ++c)
            wrong += to(x, y).stored[c] !=
                     (2 * test::convolved<std::uint64_t>(from, k, x, y, c) + total) / (2 * total); // halves upwards
    });
    return wrong;
}

/// The distance of two neighbours of the format around `v`.
template <typename Channel> long double spacing(long double v) {
    constexpr int digits = sizeof(typename Channel::storage) == 2 ? 11 : 24,
                  least = sizeof(typename Channel::storage) == 2 ? -24 : -149;
    int exponent = 0;
    std::frexp(v, &exponent);
    return std::ldexp(1.0L, std::max(exponent - digits, least));
}
} // namespace

TEST_CASE_TEMPLATE("a filtered unorm map is the exact rational convolution, rounded once, halves upwards", Texel, gnomon::rg8,
                   gnomon::rgb8, gnomon::rgba16, test::paper8, test::paper16) {
    dice roll(61);
    for (const extent size : sizes)
        for (const image<Texel>& from : pictures<Texel>(roll, size))
            for_each_kernel(some_kernels{}, [&]<typename Kernel>() { CHECK(not_the_rational_result<Kernel>(from) == 0); });
}

#ifdef GNOMON_EXHAUSTIVE // takes long to compile
TEST_CASE("exhaustive: a filtered unorm map is the exact rational convolution for every shape and every radius to 16" *
          doctest::skip()) {
    dice roll(62);
    const auto three_channels = test::noise<gnomon::rgb8>(roll, {11, 9}, 3);
    const auto four_channels = test::noise<gnomon::rgba16>(roll, {11, 9}, 3);
    test::for_each_shape(std::make_integer_sequence<int, 17>{}, [&]<typename Kernel>() {
        CAPTURE(Kernel::radius);
        CHECK(not_the_rational_result<Kernel>(three_channels) == 0);
        CHECK(not_the_rational_result<Kernel>(four_channels) == 0);
    });
}
#endif

TEST_CASE_TEMPLATE("a filtered half or float map is rounded once from a sum within 2^-35 of the exact one", Texel, gnomon::rg16f,
                   gnomon::rgba16f, gnomon::rgb32f, test::paper16f, test::paper32f) {
    using channel_type = typename Texel::channel_type;
    dice roll(63);
    long double worst = 0;
    int wrong = 0;
    for (const extent size : sizes)
        for (const image<Texel>& from : pictures<Texel>(roll, size))
            for_each_kernel(some_kernels{}, [&]<typename Kernel>() {
                const test::taps k = test::taps_of<Kernel>();
                const image<Texel> to = dense<Kernel>(from);
                for_each_texel(whole(size), [&](int x, int y) {
                    for (int c = 0; c < Texel::channels; ++c) {
                        const long double exact = test::convolved<long double>(from, k, x, y, c) / k.total / k.total;
                        const long double error =
                            std::fabs(static_cast<long double>(channel_type::code(to(x, y).stored[c])) - exact);
                        const long double ulp = spacing<channel_type>(exact);
                        wrong += error > ulp / 2 + exact * 0x1p-35L;
                        worst = std::max(worst, error / ulp);
                    }
                });
            });
    CHECK(wrong == 0);
    CHECK(worst > 0.499L); // of an ulp: nothing closer can be promised
}

TEST_CASE_TEMPLATE("before its rounding, a float sum really uses the 2^-35 it is given", Channel, gnomon::float32) {
    dice roll(64);
    using Texel = gnomon::texel<Channel>;
    for (const std::size_t column : {0u, 1u}) { // the first of the line and the last
        long double worst = 0;
        for (int i = 0; i < 4000; ++i) {
            image<Texel> from({3, 3}, Texel::clear());
            long double exact = 0;
            for (int y = 0; y < 3; ++y) { // digits of many magnitudes: the sum needs them all
                const float e = roll.unit() * std::ldexp(1.0f, -roll(0, 24));
                from(1 + static_cast<int>(column), y).stored[0] = e;
                exact += static_cast<long double>(e);
            }
            std::vector<double> line(2 * 2);
            gnomon::detail::sum_columns<box<1>, Texel>(from.view(), 1, 1, 3, line);
            if (exact > 0) worst = std::max(worst, std::fabs(static_cast<long double>(line[2 * column]) - exact) / exact);
        }
        CHECK(worst <= 0x1p-36L);
        CHECK(worst > 0x1p-36L * 0.9L);
    }
    long double worst = 0;
    for (int i = 0; i < 100000; ++i) {
        const double v = 1.0 + static_cast<double>(roll.unit()) + static_cast<double>(roll.unit()) * 0x1p-24;
        const double cut = gnomon::detail::to_bits<36>(v);
        worst =
            std::max(worst, std::fabs(static_cast<long double>(cut) - static_cast<long double>(v)) / static_cast<long double>(v));
        CHECK_FALSE(std::fabs(cut * 65535.0 - static_cast<double>(static_cast<long double>(cut) * 65535.0L)) >
                    0.0); // the product is exact
    }
    CHECK(worst <= 0x1p-36L);
    CHECK(worst > 0x1p-36L * 0.99L);
}

TEST_CASE("a double is cut to so many bits upwards from a half on") {
    CHECK(test::same_bits(gnomon::detail::to_bits<36>(1.0 + 0x1p-36), 1.0 + 0x1p-35));
    CHECK(test::same_bits(gnomon::detail::to_bits<36>(test::down(1.0 + 0x1p-36)), 1.0));
}

TEST_CASE("a scratch is five lines of what lanes count in, as wide as the map or a strip and three radii more, and 512 elements a "
          "channel") {
    CHECK(gnomon::filter_scratch_size<gnomon::rg8, box<0>>(8) == 2 * (5 * 8 + 512));
    CHECK(gnomon::filter_scratch_size<gnomon::rg16, gnomon::fast<tent<5>>>(8) == 2 * (5 * 23 + 512));
    CHECK(gnomon::filter_scratch_size<gnomon::rg16, tent<5>>(8) == 2 * (5 * 2 * 23 + 512));
    CHECK(gnomon::filter_scratch_size<gnomon::tm8, tent<5>>(8) == 2 * (5 * 2 * 23 + 512));
    CHECK(gnomon::filter_scratch_size<gnomon::rgba16f, gnomon::fast<tent<5>>>(8) == 4 * (57 + 512)); // an element is a double
    CHECK(gnomon::filter_scratch_size<gnomon::rgba16f, tent<5>>(0) == 4 * (75 + 512));
    CHECK(gnomon::filter_scratch_size<gnomon::rgba16f, tent<5>>(-7) == 4 * (75 + 512));
    CHECK(gnomon::filter_scratch_size<gnomon::rg16, tent<5>>(3000) == 2 * (5 * 2 * (2048 + 15) + 512));
    CHECK(gnomon::filter_scratch_size<gnomon::rg16, tent<5>>(1'000'000) == 2 * (1'000'010 + 512)); // which the oracle needs
    // 65535 * 65536 < 2^32, so only products of 16-bit codes need 64 bits.
    CHECK(sizeof(gnomon::line_element<gnomon::rg16>) == 4);
    CHECK(sizeof(gnomon::line_element<gnomon::tm8>) == 4);
    CHECK(sizeof(gnomon::line_element<gnomon::tm16>) == 8);
}

TEST_CASE_TEMPLATE("after any filter 0 <= e <= m, and no far bound lies before its caster", Texel, gnomon::rgb8, gnomon::rgba16,
                   gnomon::rgb16f, gnomon::rgba32f, test::ratio_rgba8, test::ratio_rgba16) {
    dice roll(65);
    for (int i = 0; i < 30; ++i) {
        auto from = test::noise<Texel>(roll, {17, 14}, roll(1, 8));
        if (i % 2 ==
            0) // at the near plane e is m, and where each receiver touches its caster, the far bound is e: no room for an error
            for_each_texel(whole(from.size()), [&](int x, int y) {
                if (!from(x, y).occupied()) return;
                const float s = i % 4 == 0 ? 0.0f : roll.unit();
                from(x, y) = Texel::caster(s);
                from(x, y).bound(s);
            });
        for_each_kernel(some_kernels{}, [&]<typename Kernel>() {
            const image<Texel> once = dense<Kernel>(from), twice = dense<Kernel>(once);
            int wrong = 0;
            for (const image<Texel>& to : {once, twice})
                for_each_texel(whole(to.size()), [&](int x, int y) {
                    const auto t = read(to(x, y));
                    wrong += !(0.0 <= t.far_bound() && t.far_bound() <= t.depth() && t.depth() <= t.mask() &&
                               t.mask() <= gnomon::filtered<Texel>::scale);
                });
            CHECK(wrong == 0);
        });
    }
}

TEST_CASE_TEMPLATE("a region is filtered as the whole map is, nothing outside it is written, and the scratch may hold anything",
                   Texel, gnomon::rg8, gnomon::rgba16, gnomon::rgb16f, gnomon::rg32f, test::ratio_rgba16) {
    dice roll(70);
    const image<Texel> untouched({29, 21}, Texel::caster(0.123f));
    for (int i = 0; i < 60; ++i) {
        const auto from = test::noise<Texel>(roll, untouched.size(), 3);
        const texel_rect region = roll.rect(untouched.size(), 10);
        for_each_kernel(some_kernels{}, [&]<typename Kernel>() {
            image<Texel> to = untouched, expected = untouched;
            filter_scratch<Texel, Kernel> scratch(from.size().width);
            const int rubbish = roll.one_in(2) ? 0xFF : 0x41;
            std::memset(scratch.line().data(), rubbish, scratch.line().size_bytes());
            gnomon::filter_region(from.view(), to.view(), region, scratch);
            const image<Texel> all = dense<Kernel>(from);
            for_each_texel(clip(region, from.size()), [&](int x, int y) { expected(x, y) = all(x, y); });
            CHECK(test::differences(to, expected) == 0);
        });
    }
}

namespace {
/// A user's channel of so many whole codes.
template <int Scale> struct codes_to : gnomon::unorm16 {
    using storage = std::uint32_t;
    static constexpr float scale = Scale;
    static constexpr float max_error = 0.5f / scale + 0x1p-25f;
    [[nodiscard]] static constexpr storage encode(double v) noexcept {
        return static_cast<storage>(gnomon::saturate(v) * Scale + 0.5);
    }
    [[nodiscard]] static constexpr storage store(double code) noexcept { return static_cast<storage>(code + 0.5); }
    [[nodiscard]] static constexpr float code(storage c) noexcept { return static_cast<float>(c); }
    [[nodiscard]] static constexpr float decode(storage c) noexcept { return code(c) / scale; }
};
} // namespace

TEST_CASE_TEMPLATE("a column of the widest kernel holds its sum of a channel of more than sixteen bits", Channel, codes_to<65536>,
                   codes_to<131071>) {
    using texel = gnomon::texel<Channel>;
    using widest = binomial<8>;
    static_assert(widest::total == gnomon::kernel_total_limit);
    const image<texel> from({33, 33}, texel::caster(0.0f));
    const image<texel> soft = dense<widest>(from);
    for (int x = 8; x < 25; ++x) CHECK(soft(x, 16) == texel::caster(0.0f)); // uniform as far as the kernel sees
}

TEST_CASE("images of different sizes share what both have, and an empty one shares nothing") {
    dice roll(71);
    const auto from = test::noise<gnomon::rg16>(roll, {12, 9}, 2);
    const auto expected = dense<binomial<2>>(from);
    filter_scratch<gnomon::rg16, binomial<2>> scratch(40);
    for (const extent size : {extent{0, 0}, {1, 1}, {12, 3}, {5, 9}, {40, 30}}) {
        image<gnomon::rg16> to(size, gnomon::rg16::caster(0.5f));
        gnomon::filter_region(from.view(), to.view(), {-100, -100, 100, 100}, scratch);
        int wrong = 0;
        for_each_texel(whole(size), [&](int x, int y) {
            wrong += !(to(x, y) == (whole(from.size()).contains(x, y) ? expected(x, y) : gnomon::rg16::caster(0.5f)));
        });
        CHECK(wrong == 0);
    }
}

#ifdef NDEBUG
TEST_CASE_TEMPLATE("without asserts, too narrow a scratch only cuts the region into strips", Texel, gnomon::rg8, gnomon::rgba32f) {
    dice roll(72);
    const auto from = test::noise<Texel>(roll, {1201, 4}, 3);
    for (const int width : {0, 1, 30, 101}) // 512 texels and more
        for_each_kernel(some_kernels{}, [&]<typename Kernel>() {
            image<Texel> to(from.size());
            filter_scratch<Texel, Kernel> scratch(width);
            gnomon::filter_region(from.view(), to.view(), whole(from.size()), scratch);
            CHECK(test::differences(to, dense<Kernel>(from)) == 0);
        });
}

TEST_CASE("without asserts, filtering an image into itself leaves it as it was") {
    dice roll(73);
    const auto before = test::noise<gnomon::rg16>(roll, {9, 9}, 2);
    auto both = before;
    filter_scratch<gnomon::rg16, box<1>> scratch(9);
    gnomon::filter_region(both.view(), both.view(), whole(both.size()), scratch);
    CHECK(test::differences(both, before) == 0);
}

TEST_CASE("without asserts, a scratch of nothing filters nothing") {
    const image<gnomon::rg8> from({4, 4}, gnomon::rg8::caster(0.5f));
    image<gnomon::rg8> to({4, 4}, gnomon::rg8::clear());
    filter_scratch<gnomon::rg8, box<1>> none;
    gnomon::filter_region(from.view(), to.view(), whole(to.size()), none);
    CHECK(test::differences(to, image<gnomon::rg8>({4, 4}, gnomon::rg8::clear())) == 0);
}
#endif
