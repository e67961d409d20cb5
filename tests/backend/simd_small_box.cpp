// Boxes whose taps are summed one by one: which they are, that no sum leaves its lanes, and their bits.
#include <gnomon/backend/simd.hpp>
#include <gnomon/backend/simd_filter.hpp>
#include <gnomon/backend/simd_small_box.hpp>

#include "../support/formats.hpp"
#include "../support/kernels.hpp"
#include "../support/lanes.hpp"
#include "../support/lanes_filter.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <type_traits>

namespace {
using gnomon::box;
using gnomon::image;
using gnomon::image_view;
using gnomon::texel_rect;
using gnomon::on_any::is_small_box;
using test::differing;

using up_to_four = test::kernels<box<1>, box<2>, box<3>, box<4>>;
using up_to_seven = test::kernels<box<1>, box<2>, box<3>, box<4>, box<5>, box<6>, box<7>>;
template <typename Texel> using small_boxes = std::conditional_t<sizeof(typename Texel::storage) == 1, up_to_seven, up_to_four>;
} // namespace

TEST_CASE_TEMPLATE("small boxes of codes have the bits of the oracle, of any part of a map and of the largest sums", Texel,
                   gnomon::rg8, gnomon::rgb8, gnomon::rgba8, test::paper8, gnomon::rg16, test::paper16, gnomon::rgba16) {
    test::dice roll(431);
    image<Texel> map({131, 21}, Texel::clear());
    test::fill_with_bits(roll, map.view());
    test::for_each_texel(texel_rect{90, 0, 131, 21}, [&](int x, int y) { map(x, y) = Texel::caster(0.0f); }); // all ones
    test::for_each_isa([&]<typename Isa>() {
        test::for_each_kernel(small_boxes<Texel>{}, [&]<typename Kernel>() {
            CAPTURE(Kernel::radius);
            static_assert(is_small_box<Kernel, Texel>);
            for (const texel_rect part :
                 {whole(map.size()), texel_rect{60, 3, 61, 4}, texel_rect{1, 0, 65, 9}, texel_rect{99, 8, 131, 21}})
                CHECK(differing<Isa, Kernel>(image_view<const Texel>(map.view()), part) == 0);
        });
    });
}

TEST_CASE("of large maps small boxes call for the rows ahead") {
    const image<gnomon::rg16> map({1024, 1024}, gnomon::rg16::clear());
    image<gnomon::rg16> made(map.size());
    gnomon::filter_scratch<gnomon::rg16, box<2>> scratch(1024);
    test::counted_lanes::forget();
    gnomon::simd<test::counted_lanes>{}.filter_region(map.view(), made.view(), {0, 500, 1024, 504}, scratch);
    CHECK(test::counted_lanes::prefetches == 4 * 1024 * 2 / 8);
}

TEST_CASE("a box is small as far as its sums fit twice a byte, or as sums that run are slower") {
    CHECK((is_small_box<box<7>, gnomon::rga8> && !is_small_box<box<8>, gnomon::rg8>));
    CHECK((is_small_box<gnomon::fast<box<4>>, gnomon::rg16> && !is_small_box<box<5>, gnomon::rg16>));
    CHECK_FALSE((is_small_box<box<0>, gnomon::rg8> || is_small_box<box<2>, gnomon::tm8> || is_small_box<box<2>, gnomon::rg16f> ||
                 is_small_box<gnomon::tent<2>, gnomon::rg8>));
    if constexpr (gnomon::detail::has_lanes<gnomon::best_isa>)
        CHECK((gnomon::simd<>::filters_in_lanes<box<3>, gnomon::rg8> && !gnomon::simd<>::sums_run<box<3>, gnomon::rg8>));
}

TEST_CASE("a sum divided by way of a product is the quotient rounded to nearest, halves upwards, on both sides of every step") {
    const auto wrong_of = []<std::uint64_t Divisor, std::uint64_t Codes, int Bits>() {
        using by = gnomon::on_any::division<Divisor, Codes, Bits>;
        static_assert(by::exact);
        const auto quotient = [](std::uint64_t sum) { return (sum + Divisor / 2) * by::factor >> by::shift; };
        int n = 0;
        for (std::uint64_t code = 0; code <= Codes; ++code) {
            n += quotient(code * Divisor) != code;
            if (code == Codes) break;
            const std::uint64_t half = code * Divisor + (Divisor + 1) / 2; // the first that is nearer to the next code
            n += quotient(half - 1) != code;
            n += quotient(half) != code + 1;
        }
        return n;
    };
    CHECK(wrong_of.template operator()<3 * 3, 255, 16>() == 0);
    CHECK(wrong_of.template operator()<5 * 5, 255, 16>() == 0);
    CHECK(wrong_of.template operator()<7 * 7, 255, 16>() == 0);
    CHECK(wrong_of.template operator()<9 * 9, 255, 16>() == 0);
    CHECK(wrong_of.template operator()<11 * 11, 255, 16>() == 0);
    CHECK(wrong_of.template operator()<13 * 13, 255, 16>() == 0);
    CHECK(wrong_of.template operator()<15 * 15, 255, 16>() == 0);
    CHECK(wrong_of.template operator()<65 * 65, 255, 32>() == 0);
    CHECK(wrong_of.template operator()<513 * 513, 255, 32>() == 0);
    CHECK(wrong_of.template operator()<9, 65535, 32>() == 0);
    CHECK(wrong_of.template operator()<81, 65535, 32>() == 0);
    CHECK(wrong_of.template operator()<219 * 219, 65535, 32>() == 0);
    CHECK_FALSE(gnomon::on_any::division<17 * 17, 255, 16>::exact); // sums of 17 bits
    CHECK_FALSE(gnomon::on_any::division<221 * 221, 65535, 32>::exact);
    static_assert(gnomon::on_any::division<9, 255, 32>::largest == 9 * 255 + 4); // the largest sum, and what rounds it
}
