// Boxes in lanes whose sums run in doubles where that rounds nothing, of half and float and of wide boxes of words: the bits of the oracle,
// and a cost that does not know the radius.
#include <gnomon/backend/simd.hpp>
#include <gnomon/backend/simd_double_box.hpp>

#include "../support/formats.hpp"
#include "../support/kernels.hpp"
#include "../support/lanes.hpp"
#include "../support/lanes_filter.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace {
using gnomon::box;
using gnomon::filter_scratch;
using gnomon::image;
using gnomon::image_view;
using gnomon::rg16;
using gnomon::rg32f;
using gnomon::simd;
using gnomon::texel_rect;
using test::dice;
using test::differing;
using test::for_each_isa;
using test::for_each_texel;

/// Casters at depths that are floats, and at codes of 16 bits, as masks are after a filter; and clear.
template <typename Texel> image<Texel> casters(dice& roll, gnomon::extent size) {
    image<Texel> map(size, Texel::clear());
    for_each_texel(whole(size), [&](int x, int y) {
        if (roll.one_in(3)) return;
        map(x, y) = Texel::caster(roll.unit());
        if (roll.one_in(4))
            for (auto& stored : map(x, y).stored)
                stored = Texel::channel_type::encode(static_cast<double>(roll(0, 1 << 24)) * 0x1p-24);
    });
    return map;
}

/// Did sums run?
template <typename Isa, typename Kernel, typename Texel>
bool runs(image_view<const Texel> from, image_view<Texel> to, texel_rect region) {
    return gnomon::detail::in_lanes<Isa>([&]<typename Lanes>() {
        if constexpr (gnomon::detail::level_needed<Lanes> == gnomon::cpu_level::portable)
            return gnomon::on_any::filter_box<gnomon::on_any::double_box<Lanes, Kernel, Texel>, Kernel>(from, to, region);
        else
            return gnomon::on_any::filter_box<gnomon::on_any::double_box<gnomon::emulated<32>, Kernel, Texel>, Kernel>(from, to,
                                                                                                                       region);
    });
}
} // namespace

TEST_CASE("sums run in doubles for boxes of words, ratios, half and float of radius 8 to 256, summed exactly") {
    using gnomon::on_any::runs_in_doubles;
    CHECK(
        (runs_in_doubles<box<8>, rg32f> && runs_in_doubles<box<256>, gnomon::rgba16f> && runs_in_doubles<box<9>, test::paper16f>));
    CHECK((runs_in_doubles<gnomon::fast<box<256>>, rg16> && simd<>::sums_run<box<110>, rg16> && simd<>::sums_run<box<256>, rg16>));
    CHECK_FALSE((runs_in_doubles<box<7>, rg32f> || runs_in_doubles<box<257>, rg32f> || runs_in_doubles<box<257>, rg16>));
    CHECK((simd<>::sums_run<box<8>, gnomon::tm8> && simd<>::sums_run<gnomon::fast<box<256>>, gnomon::tm16>));
    CHECK_FALSE((runs_in_doubles<gnomon::fast<box<8>>, rg32f> || runs_in_doubles<gnomon::tent<8>, rg32f> ||
                 runs_in_doubles<gnomon::narrow<box<130>>, rg16> || simd<>::sums_run<box<8>, test::ratio_rgba8>));
}

TEST_CASE_TEMPLATE(
    "boxes of words have the bits of the oracle where their sums have more than 32 bits, or no product is their mean", Texel, rg16,
    gnomon::rgb16) {
    dice roll(444);
    const image<Texel> map = casters<Texel>(roll, {300, 30}), full({520, 3}, Texel::caster(0.0f));
    for_each_isa([&]<typename Isa>() {
        test::for_each_kernel(test::kernels<box<110>, box<128>, gnomon::fast<box<200>>>{}, [&]<typename Kernel>() {
            CAPTURE(Kernel::radius);
            for (const texel_rect part : {whole(map.size()), texel_rect{3, 7, 5, 9}, texel_rect{290, 20, 300, 30}})
                CHECK(differing<Isa, Kernel>(image_view<const Texel>(map.view()), part) == 0);
            CHECK(differing<Isa, Kernel>(image_view<const Texel>(full.view()), texel_rect{200, 1, 290, 2}) == 0);
        });
    });
}

TEST_CASE_TEMPLATE("boxes of half and float and of a ratio have the bits of the oracle, of the whole of a map and any part", Texel,
                   rg32f, gnomon::rg16f, gnomon::rgb32f, gnomon::rgba16f, test::paper16f, gnomon::tm8, gnomon::tm16) {
    dice roll(441);
    const image<Texel> wide = casters<Texel>(roll, {700, 40}), small = casters<Texel>(roll, {9, 5});
    for_each_isa([&]<typename Isa>() {
        test::for_each_kernel(test::kernels<box<8>, box<30>>{}, [&]<typename Kernel>() {
            CAPTURE(Kernel::radius);
            const image_view<const Texel> map = wide.view();
            for (const texel_rect part : {whole(wide.size()), texel_rect{3, 7, 5, 9}, texel_rect{690, 30, 700, 40},
                                          texel_rect{130, 0, 420, 1}, texel_rect{0, 39, 300, 40}})
                CHECK(differing<Isa, Kernel>(map, part) == 0);
            CHECK(differing<Isa, Kernel>(image_view<const Texel>(small.view()), whole(small.size())) == 0);
        });
    });
    image<Texel> made(wide.size());
    CHECK(runs<gnomon::best_isa, box<8>, Texel>(wide.view(), made.view(), whole(made.size())));
}

TEST_CASE("the widest box of a full map is a sum of 2^18 ones and more, and exact") {
    const image<rg32f> full({530, 520}, rg32f::caster(0x1p-24f)); // the least depth, and so the largest of 1 - 2^-24
    image<rg32f> made({530, 520});
    CHECK(runs<gnomon::best_isa, box<256>, rg32f>(full.view(), made.view(), {200, 256, 300, 260}));
    const rg32f inside = made(262, 258);
    CHECK(inside == full(0, 0));
}

TEST_CASE_TEMPLATE("a number that sums do not run over, wherever it stands, is left to the other ways, and the bits are theirs",
                   Texel, rg32f, gnomon::rg16f) {
    using channel_type = typename Texel::channel_type;
    constexpr bool halves = sizeof(typename Texel::storage) == 2;
    dice roll(442);
    const image<Texel> map = casters<Texel>(roll, {45, 30});
    image<Texel> made(map.size());
    const texel_rect part{4, 12, 21, 15}; // a box of 8 reads columns 0 to 28 of rows 4 to 22: 58 numbers, no whole registers
    REQUIRE(runs<gnomon::best_isa, box<8>, Texel>(map.view(), made.view(), part));
    std::vector<float> numbers{
        -0.0f, -0x1p-24f, 1.0f + 0x1p-10f, 2.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()};
    if (!halves) numbers.insert(numbers.end(), {0x1p-25f, 0.5f - 0x1p-25f, 1.0f + 0x1p-23f, 0x1p-149f, 3e38f});
    const auto stored = [](float number) { // with the sign of a zero, which `store` drops
        typename Texel::storage made_of = channel_type::store(static_cast<double>(number));
        const bool zero = std::fpclassify(number) == FP_ZERO;
        if (zero && halves) made_of = typename Texel::storage{0x8000};
        if (zero && !halves) std::memcpy(&made_of, &number, sizeof number);
        return made_of;
    };
    for (const float number : numbers) {
        CAPTURE(number);
        for (int x = 0; x < 29; ++x) {
            image<Texel> odd = map;
            odd(x, x % 2 == 0 ? 4 : 22).stored[x % 2] = stored(number);
            CHECK_FALSE(runs<gnomon::best_isa, box<8>, Texel>(odd.view(), made.view(), part));
            CHECK_FALSE(runs<gnomon::emulated<32>, box<8>, Texel>(odd.view(), made.view(), part));
            CHECK(differing<gnomon::best_isa, box<8>>(image_view<const Texel>(odd.view()), part) == 0);
        }
        for (const auto& [x, y] : {std::array{29, 12}, {10, 3}, {10, 23}}) { // not read
            image<Texel> odd = map;
            odd(x, y).stored[0] = stored(number);
            CHECK(runs<gnomon::best_isa, box<8>, Texel>(odd.view(), made.view(), part));
        }
    }
}

TEST_CASE("a box of floats eight times as wide loads little more, and far less than tap by tap") {
    dice roll(443);
    const image<rg32f> map = casters<rg32f>(roll, {256, 256});
    image<rg32f> made(map.size());
    const auto loads = [&]<typename Kernel>() {
        filter_scratch<rg32f, Kernel> scratch(256);
        test::counted_lanes::forget();
        simd<test::counted_lanes>{}.filter_region(map.view(), made.view(), whole(map.size()), scratch);
        return test::counted_lanes::loads;
    };
    const int narrow = loads.operator()<box<8>>();
    CHECK(loads.operator()<box<64>>() < 2 * narrow);
    CHECK(loads.operator()<box<7>>() > 2 * narrow);
}
