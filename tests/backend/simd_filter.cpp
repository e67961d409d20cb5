// The lanes against the oracle, bit for bit: every target this processor has, every width up to two registers and a bit, every
// alignment, regions in the middle of something, and floats that are none.
#include <gnomon/backend/simd.hpp>
#include <gnomon/backend/simd_box.hpp>
#include <gnomon/backend/simd_filter.hpp>
#include <gnomon/backend/simd_wide.hpp>
#include <gnomon/backend/simd_words.hpp>

#include "../support/bits.hpp"
#include "../support/kernels.hpp"
#include "../support/formats.hpp"
#include "../support/lanes.hpp"
#include "../support/lanes_filter.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <span>
#include <vector>

namespace {
using gnomon::binomial;
using gnomon::box;
using gnomon::emulated;
using gnomon::filter_scratch;
using gnomon::gaussian;
using gnomon::image;
using gnomon::image_view;
using gnomon::rg8;
using gnomon::simd;
using gnomon::tent;
using gnomon::texel_rect;
using test::dice;
using test::differing;
using test::fill_with_bits;
using test::for_each_isa;
using test::for_each_texel;
using test::same_texel;

/// Do the lanes of a name say that they filtered?
template <typename Isa, gnomon::kernel Kernel, typename Texel>
bool filtered(image_view<const Texel> from, image_view<Texel> to, texel_rect region,
              std::span<gnomon::line_element<Texel>> scratch) {
    return gnomon::detail::in_lanes<Isa>(
        [&]<typename Lanes>() { return gnomon::detail::filter_on<Lanes, Kernel>(from, to, region, scratch); });
}

template <typename Isa, typename Kernel, typename Texel> using doubles = gnomon::on_any::wide_filter<Isa, Kernel, Texel, double>;
template <typename Isa, typename Kernel, typename Texel> using floats = gnomon::on_any::wide_filter<Isa, Kernel, Texel, float>;

struct own_channel : gnomon::unorm16 {}; // lanes cannot know what a user's channel does

/// As many taps as lanes sum by fours, but with a weight that in 1/256 is no signed byte.
struct steep {
    static constexpr int radius = 6;
    static constexpr int total = 128;
    static constexpr std::array weights{2, 3, 4, 6, 8, 9, 64, 9, 8, 6, 4, 3, 2};
};

/// Divided by its total, a sum beside the middle of two codes may become the middle in float.
struct of_253 {
    static constexpr int radius = 1;
    static constexpr int total = 253;
    static constexpr std::array weights{84, 85, 84};
};

/// The centre has all of the weight, which is no factor that a product takes: 256 is no byte, and 2^15 no signed word.
struct one_tap {
    static constexpr int radius = 2;
    static constexpr int total = 1;
    static constexpr std::array weights{0, 0, 1, 0, 0};
};

} // namespace

TEST_CASE_TEMPLATE("lanes filter as the oracle does, for every width to 67 and at every alignment", Texel, rg8, gnomon::rg16,
                   gnomon::rgb16f, gnomon::rg32f) {
    dice roll(401);
    constexpr int height = 5;
    for_each_isa([&]<typename Isa>() {
        int wrong = 0, beside = 0;
        test::for_each_alignment([&](int width, int bytes) {
            test::past_a_line<Texel> memory(bytes, width * height), written((width + 7 * bytes) % 64, width * height);
            const auto stride = static_cast<std::ptrdiff_t>(sizeof(Texel)) * width;
            const image_view<Texel> from(memory.elements().data(), {width, height}, stride);
            const image_view<Texel> made(written.elements().data(), {width, height}, stride);
            fill_with_bits(roll, from);
            test::for_each_kernel(test::kernels<binomial<2>, gnomon::fast<gaussian<3>>, box<2>, box<8>>{}, [&]<typename Kernel>() {
                image<Texel> expected(from.size());
                filter_scratch<Texel, Kernel> scratch(width);
                gnomon::filter_region(from, expected.view(), whole(from.size()), scratch);
                simd<Isa>{}.filter_region(from, made, whole(from.size()), scratch);
                for_each_texel(whole(from.size()), [&](int x, int y) { wrong += !same_texel(expected(x, y), made(x, y)); });
                beside += !written.is_alone();
            });
        });
        CHECK(wrong == 0);
        CHECK(beside == 0);
    });
}

TEST_CASE_TEMPLATE("lanes filter as the oracle does, for every shape of kernel and any part of a map", Texel, rg8, gnomon::rgb8,
                   gnomon::rgba16, gnomon::rg16f, test::paper8) {
    dice roll(402);
    image<Texel> map({2060, 23}, Texel::clear()); // wider than what passes the caches at a time
    for_each_texel({40, 0, 2060, 23}, [&](int x, int y) {
        if (!roll.one_in(3)) map(x, y) = test::any_caster<Texel>(roll);
    });
    for_each_isa([&]<typename Isa>() {
        test::for_each_kernel(test::kernels<box<0>, box<8>, box<32>, gaussian<17>, gnomon::fast<gaussian<6>>, test::spread>{},
                              [&]<typename Kernel>() {
                                  CAPTURE(Kernel::radius);
                                  for (const texel_rect part :
                                       {whole(map.size()), texel_rect{7, 3, 8, 4}, texel_rect{2040, 9, 2060, 23},
                                        texel_rect{0, 0, 33, 1}, texel_rect{500, 2, 590, 21}, texel_rect{5, 5, 5, 9}})
                                      CHECK(differing<Isa, Kernel>(image_view<const Texel>(map.view()), part) == 0);
                              });
    });
}

TEST_CASE(
    "lanes filter as the oracle does with the smallest and the widest weights that they count in words, and by the widest box") {
    dice roll(407);
    const auto bytes = test::noise<rg8>(roll, {300, 9}, 3);
    const auto words = test::noise<gnomon::rg16>(roll, {300, 9}, 3);
    const auto papers = test::noise<test::paper16>(roll, {70, 9}, 3); // whose clear depth beside the map is all of the bits
    for_each_isa([&]<typename Isa>() {
        const image_view<const rg8> of_bytes = bytes.view();
        const image_view<const gnomon::rg16> of_words = words.view();
        const image_view<const test::paper16> of_papers = papers.view();
        CHECK(differing<Isa, tent<1>>(of_bytes, whole(bytes.size())) == 0); // 128 is no signed byte
        CHECK(differing<Isa, steep>(of_bytes, whole(bytes.size())) == 0);
        CHECK(differing<Isa, one_tap>(of_bytes, whole(bytes.size())) == 0);
        CHECK(differing<Isa, gnomon::fast<gaussian<1, 28>>>(of_bytes, whole(bytes.size())) == 0); // 256 of 256, where 29 % is not
        CHECK(differing<Isa, gnomon::fast<gaussian<1, 29>>>(of_bytes, whole(bytes.size())) == 0);
        CHECK(differing<Isa, gnomon::fast<one_tap>>(of_words, whole(words.size())) == 0);
        CHECK(differing<Isa, gnomon::fast<gaussian<1, 21>>>(of_words, whole(words.size())) == 0); // 2^15 of 2^15
        CHECK(differing<Isa, gnomon::fast<gaussian<1, 22>>>(of_words, whole(words.size())) == 0);
        CHECK(differing<Isa, gnomon::fast<gaussian<32>>>(of_bytes, whole(bytes.size())) == 0);
        CHECK(differing<Isa, gnomon::fast<tent<1>>>(of_words, whole(words.size())) == 0);
        CHECK(differing<Isa, gnomon::fast<binomial<17>>>(of_words, whole(words.size())) == 0);
        CHECK(differing<Isa, box<109>>(of_words, whole(words.size())) == 0);
        CHECK(differing<Isa, gnomon::fast<binomial<4>>>(of_papers, whole(papers.size())) == 0);
    });
}

TEST_CASE_TEMPLATE("lanes filter as the oracle does, in strips as wide as there is room for", Texel, rg8, gnomon::rgb8,
                   gnomon::rg16, gnomon::rg32f) {
    dice roll(408);
    const auto map = test::noise<Texel>(roll, {1500, 11}, 3);
    for_each_isa([&]<typename Isa>() {
        int wrong = 0;
        for (const int width : {0, 10, 150, 700, 1500})
            for (const texel_rect part : {whole(map.size()), texel_rect{1, 5, 1499, 7}, texel_rect{700, 0, 1301, 11}})
                wrong += differing<Isa, binomial<4>, Texel>(map.view(), part, width) +
                         differing<Isa, gnomon::fast<gaussian<3>>, Texel>(map.view(), part, width);
        CHECK(wrong == 0);
    });
}

TEST_CASE_TEMPLATE("rows of more channels than an int counts are left to the scalar loop", Texel, rg8, gnomon::rgb8,
                   gnomon::rgba16) {
    const image<Texel> memory({200, 1}, Texel::caster(0.25f)); // of such a row, and no more is read
    image<Texel> made({1, 1}, Texel::caster(0.75f));
    std::vector<gnomon::line_element<Texel>> scratch(4096);
    for_each_isa([&]<typename Isa>() {
        const auto of_width = [&]<typename Kernel>(int width) {
            const image_view<const Texel> row(memory.view().data(), {width, 1});
            return filtered<Isa, Kernel, Texel>(row, made.view(), {0, 0, 1, 1}, scratch);
        };
        constexpr int most = 0x7FFFFFFF / Texel::channels;
        const Texel before = made(0, 0);
        for (const int width : {most, most + 1, most / 3 * 4 + 200}) {
            CAPTURE(width);
            CHECK_FALSE(of_width.template operator()<box<2>>(width));
            CHECK_FALSE(of_width.template operator()<binomial<2>>(width));
            CHECK(made(0, 0) == before);
        }
        CHECK(of_width.template operator()<box<2>>(most - (1 << 17)));
        CHECK(of_width.template operator()<binomial<2>>(most - (1 << 17)));
    });
}

TEST_CASE("the scratch of a map has room for whole rows of it, whatever a kernel's radius, or for strips of 32 kB") {
    const auto has_room = []<typename Isa, typename Kernel, typename Texel>(int width) {
        using pass = gnomon::on_any::filter_of<Isa, Kernel, Texel>;
        using room = gnomon::on_any::filter_room<pass, Texel>;
        const std::size_t given = gnomon::filter_scratch_size<Texel, Kernel>(width) * sizeof(gnomon::line_element<Texel>);
        constexpr int strip = 32768 / static_cast<int>(sizeof(typename pass::element)) / Texel::channels;
        return room::widest(given, width) == std::min(width, strip) * Texel::channels;
    };
    for (const int width : {1, 64, 256, 1001, 4096, 10000}) {
        CAPTURE(width);
        CHECK(has_room.operator()<emulated<64>, binomial<4>, rg8>(width));
        CHECK(has_room.operator()<emulated<64>, binomial<4>, gnomon::rgba8>(width));
        CHECK(has_room.operator()<emulated<64>, gnomon::fast<gaussian<16>>, gnomon::texel<gnomon::unorm8>>(width));
        CHECK(has_room.operator()<emulated<64>, gnomon::fast<binomial<4>>, gnomon::rg16>(width));
        CHECK(has_room.operator()<emulated<64>, gnomon::fast<gaussian<32>>, gnomon::rg32f>(width));
        CHECK(has_room.operator()<emulated<64>, gnomon::fast<gaussian<256>>, gnomon::rgba16f>(width));
        CHECK(has_room.operator()<emulated<64>, gaussian<4>, gnomon::rg32f>(width));
        CHECK(has_room.operator()<emulated<64>, gaussian<256>, gnomon::rgba32f>(width));
        CHECK(has_room.operator()<emulated<64>, gaussian<56>, gnomon::rg16>(width));
        CHECK(has_room.operator()<emulated<64>, gaussian<256>, gnomon::rgba16>(width));
        CHECK(has_room.operator()<emulated<64>, gaussian<37>, gnomon::tm8>(width));
        CHECK(has_room.operator()<emulated<64>, gaussian<128>, rg8>(width));
        CHECK(has_room.operator()<emulated<64>, gaussian<256>, gnomon::rgba8>(width));
    }
}

TEST_CASE("of a map wider than the second cache a strip is what that holds, however much room there is") {
    const auto widest = []<typename Kernel, typename Texel>() {
        using room = gnomon::on_any::filter_room<gnomon::on_any::filter_of<emulated<64>, Kernel, Texel>, Texel>;
        return room::widest(~std::size_t{0}, 1 << 28);
    };
    CHECK(widest.operator()<binomial<4>, gnomon::rgba8>() == 32768 / 2);
    CHECK(widest.operator()<gnomon::fast<gaussian<4>>, gnomon::rg32f>() == 32768 / 4);
    CHECK(widest.operator()<gaussian<4>, gnomon::rgb32f>() == 32768 / 8 / 3 * 3);
}

TEST_CASE("a strip is as wide as a row if there is room, fits if there is not, and is nothing without room for a texel") {
    const auto check = []<typename Kernel, typename Texel>() {
        using room = gnomon::on_any::filter_room<gnomon::on_any::filter_of<emulated<64>, Kernel, Texel>, Texel>;
        constexpr int width = 21;
        const auto bytes = [](int texels) { return room::bytes(texels * Texel::channels); };
        CHECK(room::widest(bytes(1) - 1, width) == 0);
        int most = 1; // so many texels would fit
        for (std::size_t given = bytes(1); given <= bytes(width); ++given) {
            while (most < width && bytes(most + 1) <= given) ++most;
            CAPTURE(given);
            const int made = room::widest(given, width);
            CHECK(made % Texel::channels == 0);
            CHECK(2 * made >= most * Texel::channels);
            CHECK((most == width ? made == width * Texel::channels : made <= most * Texel::channels));
        }
    };
    check.operator()<binomial<4>, rg8>();
    check.operator()<gaussian<4>, gnomon::rgb32f>();
}

namespace {
/// How often lanes wrote beside a scratch, of each size there is, that begins where cache lines do or an element later.
template <typename Isa, typename Texel> int written_beside_scratches() {
    using element = gnomon::line_element<Texel>;
    using kernel = gnomon::fast<binomial<1>>;
    const image<Texel> map({24, 2}, Texel::clear());
    image<Texel> made(map.size());
    const std::size_t most = gnomon::filter_scratch_size<Texel, kernel>(map.size().width), around = 64 / sizeof(element);
    std::vector<element> memory(most + 3 * around);
    const std::size_t line = (64 - reinterpret_cast<std::uintptr_t>(memory.data()) % 64) % 64 / sizeof(element) + around;
    int wrong = 0;
    for (std::size_t first = line; first <= line + 1; ++first)
        for (std::size_t count = 0; first + count + 2 < memory.size() && count <= most; ++count) {
            const std::array guards{first - 1, first + count, first + count + 1};
            for (const std::size_t i : guards) memory[i] = element{42};
            filtered<Isa, kernel, Texel>(map.view(), made.view(), whole(map.size()), std::span(memory).subspan(first, count));
            for (const std::size_t i : guards) wrong += memory[i] < element{42} || memory[i] > element{42};
        }
    return wrong;
}
} // namespace

TEST_CASE("lanes write nothing beside a scratch, wherever it begins and however little it is") {
    for_each_isa([]<typename Isa>() {
        CHECK(written_beside_scratches<Isa, rg8>() == 0);
        CHECK(written_beside_scratches<Isa, gnomon::rgb8>() == 0);
        CHECK(written_beside_scratches<Isa, gnomon::rgba32f>() == 0);
    });
}

TEST_CASE("what is too large for the caches goes past them, whole registers where they are aligned, and is the same") {
    dice roll(405);
    image<gnomon::rg32f> map({2070, 1030}, gnomon::rg32f::clear());
    for_each_texel(whole(map.size()), [&](int x, int y) { map(x, y) = gnomon::rg32f::caster(roll.unit()); });
    const texel_rect region{3, 1, 2068, 1029}; // begins within a register
    static_assert((2068LL - 3) * 1028 * 8 >= gnomon::on_any::streamed_bytes);
    for_each_isa([&]<typename Isa>() {
        CHECK(differing<Isa, gnomon::fast<binomial<1>>>(image_view<const gnomon::rg32f>(map.view()), region) == 0);
    });
}

namespace {
/// The middle texel of a map of floats whose rows are all alike, and as high as the kernel.
template <typename Isa> float middle_of_column(const std::array<float, 5>& rows) {
    image<gnomon::rg32f> map({40, 5}), made({40, 5});
    for_each_texel(whole(map.size()), [&](int x, int y) {
        const float v = rows[static_cast<std::size_t>(y)];
        map(x, y) = {{v, v}};
    });
    filter_scratch<gnomon::rg32f, binomial<2>> scratch(40);
    simd<Isa>{}.filter_region(image_view<const gnomon::rg32f>(map.view()), made.view(), whole(map.size()), scratch);
    return made(20, 2).stored[0];
}
} // namespace

TEST_CASE("a map of nothing but negative zeros is filtered to zeros without a sign by lanes too") {
    const image<gnomon::rg16f> map({70, 30}, gnomon::rg16f{{0x8000, 0x8000}});
    for_each_isa([&]<typename Isa>() {
        const image_view<const gnomon::rg16f> from = map.view();
        CHECK(differing<Isa, gnomon::fast<gaussian<4>>>(from, whole(map.size())) == 0);
        CHECK(differing<Isa, gnomon::fast<box<4>>>(from, whole(map.size())) == 0);
        CHECK(differing<Isa, gaussian<4>>(from, whole(map.size())) == 0);
    });
}

TEST_CASE("column sums of floats are rounded to 36 bits in lanes too, halves upwards, before they are summed across") {
    // Sixteen times the middle texel: an odd float and half a last place more, less half a last place of 36 bits, and less `missing`
    // of the bits that go. So it is the next float if 36 bits are rounded upwards, and else the odd one.
    const float odd = 0.5f + 3 * 0x1p-24f;
    for (int missing = -1; missing <= 2; ++missing)
        for_each_isa([&]<typename Isa>() {
            const float below = 0x1p-35f - static_cast<float>(missing) * 0x1p-51f;
            CHECK(middle_of_column<Isa>({0x1p-23f - 0x1p-34f, odd, 0.0f, 0.0f, below}) ==
                  (missing <= 0 ? test::up(odd) : odd) / 4.0f);
        });
}

TEST_CASE("two floats that are each too small for a sum of doubles are not added up first in lanes either") {
    const float odd = 0.5f + 3 * 0x1p-24f, small = 0x1p-52f - 0x1p-60f; // the sum lacks a last place of being rounded upwards
    for_each_isa([&]<typename Isa>() {
        CHECK(middle_of_column<Isa>({small, odd, 21845 * 0x1p-52f, 0x1p-25f - 0x1p-36f, small}) == odd / 4.0f);
        CHECK(middle_of_column<Isa>({2 * small, odd, 21845 * 0x1p-52f, 0x1p-25f - 0x1p-36f, 0.0f}) == test::up(odd) / 4.0f);
    });
}

TEST_CASE_TEMPLATE("a row that is made in pieces is the row", Texel, rg8, gnomon::rg16, gnomon::rgb8, gnomon::rg32f) {
    using lanes = emulated<16>;
    using pass = gnomon::on_any::filter_of<lanes, gnomon::fast<binomial<2>>, Texel>;
    using storage = typename Texel::storage;
    constexpr int count = (2 * pass::piece + 50) / Texel::channels * Texel::channels, plane = count + 100;
    dice roll(408);
    std::vector<typename pass::element> line(static_cast<std::size_t>(pass::planes * plane));
    for (auto& sum : line) sum = static_cast<typename pass::element>(roll(-20000, 12000));
    std::vector<storage> expected(static_cast<std::size_t>(count));
    for (int at = 0; at < count; at += pass::step) {
        const int i = gnomon::lesser(at, count - pass::step);
        pass::row(line.data() + pass::place(i), plane, expected.data() + i);
    }
    for (const bool past_caches : {false, true}) {
        std::vector<storage> made(expected.size());
        gnomon::on_any::make_row<lanes, pass>(line.data(), plane, made.data(), count, past_caches);
        CHECK(std::memcmp(made.data(), expected.data(), made.size() * sizeof(storage)) == 0);
    }
}

TEST_CASE("a region partly or wholly off the map is to lanes what it is to the oracle") {
    const image<rg8> map({40, 5}, rg8::caster(0.5f));
    CHECK(differing<gnomon::best_isa, binomial<2>>(map.view(), {-9, -9, 90, 90}) == 0);
    CHECK(differing<gnomon::best_isa, binomial<2>>(map.view(), {90, 90, 95, 95}) == 0);
}

TEST_CASE_TEMPLATE("a ratio of two sums is the oracle's in lanes too, where the sums are exact in double", Texel, gnomon::tm8,
                   gnomon::tm16) {
    using gnomon::on_any::filtered_in_lanes;
    CHECK((filtered_in_lanes<binomial<4>, Texel> && filtered_in_lanes<box<256>, gnomon::tm8>));
    CHECK((filtered_in_lanes<gaussian<4>, gnomon::tm8> && !filtered_in_lanes<gaussian<4>, gnomon::tm16>));
    CHECK(filtered_in_lanes<gnomon::fast<gaussian<4>>, gnomon::tm16>);
    dice roll(406);
    image<Texel> map({150, 23});
    fill_with_bits(roll, map.view());
    for_each_texel({90, 4, 150, 19},
                   [&](int x, int y) { map(x, y) = roll.one_in(5) ? test::any_caster<Texel>(roll) : Texel::clear(); });
    for_each_isa([&]<typename Isa>() {
        CHECK(differing<Isa, binomial<4>>(image_view<const Texel>(map.view()), whole(map.size())) == 0);
        CHECK(differing<Isa, gaussian<3>>(image_view<const Texel>(map.view()), {5, 2, 131, 23}) == 0);
        CHECK(differing<Isa, box<3>>(image_view<const Texel>(map.view()), whole(map.size())) == 0);
        CHECK(differing<Isa, gnomon::fast<gaussian<4>>>(image_view<const Texel>(map.view()), whole(map.size())) == 0);
    });
}

TEST_CASE_TEMPLATE("what a line holds behind its end stays out of the row of nothing, though its texel is wider than a register",
                   Texel, test::paper_rgba16, test::paper_rgba32f) {
    dice roll(438);
    const image<Texel> map = test::noise<Texel>(roll, {64, 9}, 2);
    for_each_isa([&]<typename Isa>() { CHECK(differing<Isa, binomial<2>, Texel>(map.view(), {10, 0, 42, 9}) == 0); });
}

TEST_CASE("lanes wider than a cache line read nothing before their scratch") {
    dice roll(439);
    const image<gnomon::rg32f> map = test::noise<gnomon::rg32f>(roll, {90, 9}, 2);
    CHECK(differing<emulated<128>, gaussian<1>, gnomon::rg32f>(map.view(), whole(map.size())) == 0);
}

TEST_CASE_TEMPLATE("lanes say that they filtered, and leave nothing to be filtered again", Texel, rg8, gnomon::rg32f, gnomon::tm8) {
    const image<Texel> map({70, 9}, Texel::clear());
    image<Texel> made(map.size());
    for_each_isa([&]<typename Isa>() {
        filter_scratch<Texel, box<3>> of_box(70);
        filter_scratch<Texel, binomial<4>> of_binomial(70);
        CHECK((filtered<Isa, box<3>, Texel>(map.view(), made.view(), {3, 1, 69, 8}, of_box.line())));
        CHECK((filtered<Isa, binomial<4>, Texel>(map.view(), made.view(), {3, 1, 69, 8}, of_binomial.line())));
    });
}

#if GNOMON_X86
TEST_CASE_TEMPLATE("of a map narrower than a register narrower lanes take care, down to eight pairs", Kernel,
                   gnomon::fast<gaussian<4>>, box<2>, gaussian<4>) {
    dice roll(433);
    for_each_isa([&]<typename Isa>() {
        if constexpr (!std::same_as<Isa, emulated<48>>)
            for (int width = 1; width < 40; ++width) {
                CAPTURE(width);
                const image<rg8> map = test::noise<rg8>(roll, {width, 9}, 2);
                image<rg8> made(map.size());
                filter_scratch<rg8, Kernel> scratch(width);
                const bool done = filtered<Isa, Kernel, rg8>(map.view(), made.view(), whole(map.size()), scratch.line());
                CHECK((done || width < 8));
                CHECK(differing<Isa, Kernel>(map.view(), whole(map.size())) == 0);
            }
    });
}
#endif

TEST_CASE_TEMPLATE("a map of any of the four channels is filtered in lanes", Channel, gnomon::unorm8, gnomon::unorm16,
                   gnomon::half16, gnomon::float32) {
    using texel = gnomon::texel<Channel>;
    const image<texel> map({70, 9}, texel::clear());
    image<texel> made(map.size());
    filter_scratch<texel, gnomon::fast<binomial<1>>> scratch(70);
    test::counted_lanes::forget();
    simd<test::counted_lanes>{}.filter_region(map.view(), made.view(), whole(map.size()), scratch);
    CHECK(test::counted_lanes::loads > 0);
}

TEST_CASE("a box that lanes filter leaves its scratch alone, for nothing is filtered again") {
    const image<rg8> map({70, 9}, rg8::caster(0.5f));
    image<rg8> made(map.size());
    for_each_isa([&]<typename Isa>() {
        if constexpr (gnomon::detail::has_lanes<Isa>) {
            filter_scratch<rg8, box<8>> scratch(70);
            for (auto& sum : scratch.line()) sum = 42;
            simd<Isa>{}.filter_region(map.view(), made.view(), whole(map.size()), scratch);
            CHECK(std::all_of(scratch.line().begin(), scratch.line().end(), [](auto sum) { return sum == 42; }));
        }
    });
}

TEST_CASE("a low wide region is filtered in strips as wide as it is, so that lanes load no more of it than of a high one") {
    const image<rg8> map({1024, 64}, rg8::clear());
    image<rg8> made(map.size());
    filter_scratch<rg8, binomial<4>> scratch(map.size().width);
    const auto loads = [&](texel_rect region) {
        test::counted_lanes::forget();
        simd<test::counted_lanes>{}.filter_region(map.view(), made.view(), region, scratch);
        return test::counted_lanes::loads;
    };
    CHECK(16 * loads({0, 30, 1024, 34}) == loads(whole(map.size())));
}

TEST_CASE("lanes add rows to the sums of columns a register at a time, and what is left one by one") {
    using pass = gnomon::on_any::box_filter<test::counted_lanes, box<1>, rg8>;
    std::array<std::uint32_t, 11> sums{};
    std::array<std::uint8_t, 11> in, out{};
    in.fill(3);
    for (const int count : {7, 8, 9, 11}) {
        test::counted_lanes::forget();
        pass::run(sums.data(), in.data(), out.data(), count);
        CHECK(test::counted_lanes::loads == count / 4);
    }
    CHECK(sums == std::array<std::uint32_t, 11>{12, 12, 12, 12, 12, 12, 12, 9, 6, 3, 3});
}

TEST_CASE("results of 16 MiB and more go past the caches, in bands too, and maps of 4 MiB are called for ahead of time, of 1 MiB "
          "by narrow "
          "regions") {
    using kernel = gnomon::fast<box<0>>;
    const image<gnomon::rg32f> map({2048, 1024}, gnomon::rg32f::clear());
    image<gnomon::rg32f> made(map.size());
    filter_scratch<gnomon::rg32f, kernel> scratch(map.size().width);
    const auto filter = [&](texel_rect of_map, texel_rect region) {
        test::counted_lanes::forget();
        simd<test::counted_lanes>{}.filter_region(map.view().part(of_map), made.view(), region, scratch);
    };
    filter(whole(map.size()), {0, 0, 2048, 1024});
    CHECK(test::counted_lanes::streams == 2048 * 1024 * 8 / 16);
    CHECK(test::counted_lanes::fences == 1);
    filter(whole(map.size()), {0, 512, 2048, 515});
    CHECK((test::counted_lanes::streams == 2048 * 3 * 8 / 16 && test::counted_lanes::fences == 1));
    filter(whole(map.size()), {1, 0, 2048, 1024});
    CHECK((test::counted_lanes::streams == 0 && test::counted_lanes::fences == 0));
    filter({0, 0, 2048, 1023}, {0, 0, 2048, 1023});
    CHECK((test::counted_lanes::streams == 0 && test::counted_lanes::fences == 0));
    const auto called_for = [&](int height, int width) {
        filter({0, 0, 1024, height}, {0, 0, width, 4});
        return test::counted_lanes::prefetches > 0;
    };
    CHECK((called_for(512, 1024) && !called_for(511, 1024)));
    CHECK((called_for(128, 1023) && !called_for(127, 1023)));
}

namespace {
template <typename Box, typename Texel> constexpr std::size_t bytes_of_sums() {
    return sizeof(Box) + Box::line_size * sizeof(typename Box::sum) + (Box::strip + Box::step) * sizeof(typename Texel::storage) +
           (Box::line_size / Texel::channels + 1) * sizeof(Texel);
}

/// Memory of its own that a filter takes: what rows are made in, a column's taps, the rows that are told; or a box's sums.
template <typename Kernel, typename Texel> constexpr std::size_t bytes_of_stack() {
    using lanes = emulated<64>;
    using storage = typename Texel::storage;
    if constexpr (gnomon::on_any::runs_sums<Kernel, Texel>) {
        using pass = gnomon::on_any::box_filter<lanes, Kernel, Texel>;
        return bytes_of_sums<pass, Texel>();
    } else if constexpr (gnomon::on_any::runs_in_doubles<Kernel, Texel>) { // before the others, which take no more
        using pass = gnomon::on_any::double_box<lanes, Kernel, Texel>;
        return bytes_of_sums<pass, Texel>();
    } else {
        using pass = gnomon::on_any::filter_of<lanes, Kernel, Texel>;
        constexpr int rows = 2 * Kernel::radius + 2 * gnomon::on_any::rows_at_once;
        return (pass::piece + pass::step) * sizeof(storage) + rows * (lanes::bytes + sizeof(storage*));
    }
}
} // namespace

TEST_CASE("lanes take less than 48 kB of the stack, whatever kernel and texel") {
    const auto of = [](auto... bytes) { return std::max({bytes...}); };
    const std::size_t most = of(
        bytes_of_stack<box<256>, gnomon::tm8>(), bytes_of_stack<binomial<4>, rg8>(), bytes_of_stack<binomial<4>, gnomon::rgba8>(),
        bytes_of_stack<gnomon::fast<binomial<4>>, gnomon::rgba16>(), bytes_of_stack<gaussian<256>, gnomon::rgba16>(),
        bytes_of_stack<gnomon::fast<gaussian<256>>, gnomon::rgba32f>(), bytes_of_stack<box<256>, gnomon::rgba8>(),
        bytes_of_stack<box<109>, gnomon::rgba16>(), bytes_of_stack<box<256>, gnomon::rgba32f>(),
        bytes_of_stack<box<5>, gnomon::rgba16>(), bytes_of_stack<box<4>, gnomon::rgba16>());
    CHECK(most < 48 * 1024);
    CHECK(most > 38 * 1024); // pointers may be of 32 bits
}

TEST_CASE_TEMPLATE("what lanes do not know is left to the oracle: ratios of wide sums, a channel of a user's, radii beyond 256",
                   Texel, gnomon::tm16, gnomon::texel<own_channel>, rg8) {
    dice roll(403);
    const image<Texel> map = test::noise<Texel>(roll, {70, 9}, 2);
    CHECK(differing<gnomon::best_isa, gaussian<3>>(map.view(), whole(map.size())) == 0);
    CHECK(differing<gnomon::best_isa, box<300>>(map.view(), whole(map.size())) == 0);
    const std::vector<float> z(70, 0.75f);
    std::vector<float> expected(70), made(70);
    gnomon::receive(map.view().row_span(4), z, expected);
    gnomon::receive(simd<>{}, map.view().row_span(4), z, made);
    CHECK(expected == made);
}

TEST_CASE("what goes past the caches is copied whole, from any place to any, and nothing beside it") {
    constexpr std::size_t room = 160; // two of the widest registers and a bit
    std::array<unsigned char, room> from;
    for (std::size_t i = 0; i < room; ++i) from[i] = static_cast<unsigned char>(i + 1);
    const auto wrong_by = [&from]<typename Isa>() {
        int wrong = 0;
        for (std::size_t bytes = 0; bytes <= 140; ++bytes)
            for (std::size_t at = 0; at <= 16; ++at) {
                alignas(64) std::array<unsigned char, room> to{}, expected{};
                std::memcpy(&expected[at], &from[3], bytes);
                gnomon::on_any::stream<Isa>(&to[at], &from[3], bytes);
                wrong += to != expected;
            }
        return wrong;
    };
    CHECK(wrong_by.operator()<emulated<16>>() == 0);
    CHECK(wrong_by.operator()<emulated<64>>() == 0);
}

#ifdef NDEBUG
TEST_CASE("without asserts, lanes filter nothing with a scratch of nothing, as the oracle does") {
    const image<rg8> map({70, 9}, rg8::caster(0.5f));
    image<rg8> made(map.size(), rg8::clear());
    filter_scratch<rg8, binomial<2>> none;
    simd<>{}.filter_region(map.view(), made.view(), whole(map.size()), none);
    filter_scratch<rg8, box<2>> none_of_box;
    simd<>{}.filter_region(map.view(), made.view(), whole(map.size()), none_of_box);
    CHECK(test::differences(made, image<rg8>(map.size(), rg8::clear())) == 0);
}

#if GNOMON_X86
TEST_CASE_TEMPLATE("without asserts, lanes that the processor has not are left to the oracle", Isa, gnomon::avx2, gnomon::avx512,
                   test::lanes_to_come) {
    dice roll(404);
    const image<rg8> map = test::noise<rg8>(roll, {70, 9}, 2);
    test::counted_lanes::forget();
    CHECK(differing<Isa, binomial<2>>(map.view(), whole(map.size())) == 0);
    const std::vector<float> z(70, 0.75f), x(70, 33.5f);
    std::vector<float> expected(70), made(70);
    gnomon::receive(map.view().row_span(4), z, expected);
    gnomon::receive(simd<Isa>{}, map.view().row_span(4), z, made);
    CHECK(expected == made);
    gnomon::receive(map.view(), x, x, z, expected);
    gnomon::receive(simd<Isa>{}, map.view(), x, x, z, made);
    CHECK(expected == made);
    CHECK(test::lanes_to_come::loads == 0);
}
#endif
#endif

TEST_CASE("lanes count in what is quickest and still exact, words, floats or doubles, and in floats where a kernel says fast") {
    using gnomon::fast;
    using gnomon::on_any::pair_filter;
    using gnomon::on_any::word_filter;
    using lanes = emulated<16>;
    const auto goes_by = []<template <typename, typename, typename> typename Filter, typename Texel, typename Kernel>() {
        return std::same_as<gnomon::on_any::filter_of<lanes, Kernel, Texel>, Filter<lanes, Kernel, Texel>>;
    };
    CHECK(goes_by.operator()<pair_filter, rg8, binomial<4>>());
    CHECK(goes_by.operator()<pair_filter, rg8, tent<1>>());
    CHECK(goes_by.operator()<pair_filter, rg8, fast<gaussian<2>>>());
    CHECK(goes_by.operator()<word_filter, gnomon::rgb8, binomial<1>>());
    CHECK(goes_by.operator()<word_filter, gnomon::rgba8, fast<gaussian<2>>>());
    CHECK(goes_by.operator()<word_filter, gnomon::rgb16, fast<gaussian<2>>>());
    CHECK(goes_by.operator()<pair_filter, gnomon::rg16, fast<binomial<1>>>());
    CHECK(goes_by.operator()<floats, rg8, tent<2>>());     // 1/81
    CHECK(goes_by.operator()<floats, rg8, gaussian<2>>()); // sixteen bits
    CHECK(goes_by.operator()<floats, rg8, box<0>>());      // 256 is no byte
    CHECK(goes_by.operator()<floats, gnomon::rgba8, fast<gaussian<33>>>());
    CHECK(goes_by.operator()<doubles, gnomon::tm8, gaussian<2>>()); // of products of two bytes
    CHECK(goes_by.operator()<doubles, gnomon::rg16, binomial<1>>());
    CHECK(goes_by.operator()<doubles, gnomon::rg32f, gaussian<2>>());
    CHECK(goes_by.operator()<floats, gnomon::rg32f, fast<gaussian<2>>>());
    CHECK(goes_by.operator()<floats, gnomon::rgb16f, fast<box<1>>>());
}

TEST_CASE_TEMPLATE("a sum of bytes at the middle of two codes, or one unit beside it, is rounded as whole numbers are", Kernel,
                   gaussian<2>, gaussian<4>, gaussian<32>, tent<20>) {
    using pass = floats<emulated<16>, Kernel, rg8>;
    constexpr std::int64_t total = Kernel::total, whole = total * total;
    constexpr std::int64_t centre = Kernel::weights[Kernel::radius];
    constexpr int away = [] { // a weight with which the centre's makes any sum
        int distance = 1;
        while (std::gcd(centre, std::int64_t{Kernel::weights[static_cast<std::size_t>(Kernel::radius + distance)]}) != 1)
            ++distance;
        return distance;
    }();
    constexpr std::int64_t other = Kernel::weights[static_cast<std::size_t>(Kernel::radius + away)];
    int wrong = 0, left_open = 0, told = 0;
    for (std::int64_t code = 2; code < 254; ++code)
        for (int beside = -2; beside <= 2; ++beside)
            for (int lane = 0; lane < pass::step; ++lane) {
                const std::int64_t sum = code * whole + whole / 2 + beside, all = sum / total;
                std::int64_t more = 0; // at the centre, so that what lacks is a multiple of the other weight
                while ((sum - all * total - more * centre) % other != 0) ++more;
                std::vector<float> line(static_cast<std::size_t>(2 * pass::taps + pass::step), 0.0f);
                const auto tap = [&](int t) -> float& { return line[static_cast<std::size_t>(lane + 2 * t)]; };
                for (int t = 0; t < pass::taps; ++t) tap(t) = static_cast<float>(all);
                tap(Kernel::radius) = static_cast<float>(all + more);
                tap(Kernel::radius + away) = static_cast<float>(all + (sum - all * total - more * centre) / other);
                std::array<std::uint8_t, std::size_t{pass::step}> made{}, nearest{};
                pass::row(line.data(), 0, made.data());
                wrong += made[static_cast<std::size_t>(lane)] != (2 * sum + whole) / (2 * whole);
                const auto is_told = [&](std::int64_t n) {
                    return pass::told(emulated<16>::repeat(static_cast<float>(n)), nearest.data());
                };
                left_open += !is_told(sum);
                told += is_told(sum + whole / 4 * 3) && nearest[0] == code + 1;
            }
    CHECK(wrong == 0);
    CHECK(left_open == 252 * 5 * pass::step);
    CHECK(told == left_open);
}

TEST_CASE_TEMPLATE("every sum of bytes that floats hold is rounded halves upwards", Kernel, box<0>, tent<2>, tent<5>, tent<8>,
                   tent<9>, of_253) {
    using pass = floats<emulated<16>, Kernel, rg8>;
    static_assert(pass::all_exact);
    constexpr int whole = Kernel::total * Kernel::total, last = 255 * whole;
    constexpr int around = whole / 2 < 5000 ? whole / 2 + 1 : 20; // all there are, or what is near the middle of two codes
    int wrong = 0;
    for (int middle = whole / 2; middle < last; middle += whole)
        for (int first = middle - around; first <= middle + around; first += pass::step) {
            std::array<float, std::size_t{pass::step}> made{};
            const auto sum = [first, end = last](int k) { return std::clamp(first + k, 0, end); };
            for (int k = 0; k < pass::step; ++k) made[static_cast<std::size_t>(k)] = static_cast<float>(sum(k));
            emulated<16>::store(made.data(), pass::rounded(emulated<16>::load(made.data())));
            for (int k = 0; k < pass::step; ++k)
                wrong += static_cast<int>(made[static_cast<std::size_t>(k)]) != (2 * sum(k) + whole) / (2 * whole);
        }
    CHECK(wrong == 0);
}

TEST_CASE_TEMPLATE(
    "lanes filter as the oracle does where many codes lie at the middle of two: stripes, checkerboards, straight edges", Texel, rg8,
    gnomon::rgba8) {
    const auto pattern = [](const auto& is_caster) {
        image<Texel> map({150, 60}, Texel::clear());
        for_each_texel(whole(map.size()), [&](int x, int y) {
            if (is_caster(x, y)) map(x, y) = Texel::caster(0.0f);
        });
        return map;
    };
    const std::array maps{pattern([](int x, int) { return x % 2 == 0; }), pattern([](int x, int y) { return (x + y) % 2 == 0; }),
                          pattern([](int x, int y) { return x < 70 || y > 30; })};
    for_each_isa([&]<typename Isa>() {
        test::for_each_kernel(test::kernels<tent<5>, tent<9>, tent<19>, binomial<5>, gaussian<4>, gaussian<40>>{},
                              [&]<typename Kernel>() {
                                  CAPTURE(Kernel::total);
                                  for (const auto& map : maps)
                                      CHECK(differing<Isa, Kernel>(image_view<const Texel>(map.view()), whole(map.size())) == 0);
                              });
    });
}

TEST_CASE("what lanes sum of a row has whole cache lines, and its margin before it") {
    using pass = gnomon::on_any::filter_of<emulated<16>, gaussian<3>, gnomon::rgb32f>;
    using room = gnomon::on_any::filter_room<pass, gnomon::rgb32f>;
    static_assert(std::same_as<pass::element, double>); // eight of them a line
    CHECK((room::whole_cache_lines(0) == 0 && room::whole_cache_lines(1) == 8 && room::whole_cache_lines(8) == 8));
    CHECK((room::before == 16 && room::plane_of(30) % 8 == 0)); // nine are the margin
}

TEST_CASE("what lies beside a map is clear to lanes where clear is something: in floats, and in texels of three channels") {
    using three = test::paper<gnomon::unorm8, gnomon::effects{.translucency = true}>;
    dice roll(410);
    const auto singles = test::noise<test::paper32f>(roll, {70, 9}, 3);
    const auto threes = test::noise<three>(roll, {300, 9}, 3);
    for_each_isa([&]<typename Isa>() {
        const image_view<const test::paper32f> of_singles = singles.view();
        const image_view<const three> of_threes = threes.view();
        CHECK(differing<Isa, gnomon::fast<binomial<1>>>(of_singles, whole(singles.size())) == 0);
        CHECK(differing<Isa, gnomon::fast<box<1>>>(of_singles, whole(singles.size())) == 0); // 3 is no power of two
        CHECK(differing<Isa, box<2>>(of_threes, whole(threes.size())) == 0);                 // strips begin at whole texels
        CHECK(differing<Isa, binomial<2>>(of_threes, {295, 0, 300, 9}) == 0); // narrower than a register, and at the end
    });
}

TEST_CASE_TEMPLATE("what lies above and below a tall map is clear to lanes, of whichever end a region is", Texel, rg8,
                   gnomon::rg32f) {
    dice roll(409);
    const auto map = test::noise<Texel>(roll, {40, 90}, 3);
    for_each_isa([&]<typename Isa>() {
        for (const texel_rect region : {texel_rect{0, 0, 40, 20}, {3, 2, 30, 9}, {0, 70, 40, 90}, {5, 80, 40, 89}})
            CHECK(differing<Isa, gnomon::fast<gaussian<8>>>(image_view<const Texel>(map.view()), region) == 0);
    });
}

TEST_CASE("without room for a texel lanes do nothing, and say so") {
    const image<rg8> from({40, 5}, rg8::caster(0.5f));
    image<rg8> to({40, 5}, rg8::clear());
    CHECK_FALSE(gnomon::on_any::filter<emulated<16>, binomial<1>>(from.view(), to.view(), whole(to.size()), {}));
    CHECK_FALSE(gnomon::on_any::filter<emulated<16>, box<1>>(from.view(), to.view(), whole(to.size()), {}));
    CHECK(to(20, 2) == rg8::clear());
}

TEST_CASE("lanes filter by radii up to 256, and ratios as far as their sums are exact in double") {
    using gnomon::on_any::filtered_in_lanes;
    CHECK((filtered_in_lanes<box<256>, rg8> && !filtered_in_lanes<box<257>, rg8>));
    if constexpr (gnomon::detail::has_lanes<gnomon::best_isa>) { // a user may ask; and sums of a box run where lanes filter it
        CHECK((simd<>::filters_in_lanes<gaussian<256>, rg8> && !simd<>::filters_in_lanes<gaussian<4>, gnomon::tm16>));
        CHECK_FALSE(simd<>::filters_in_lanes<gaussian<4>, gnomon::texel<own_channel>>);
        CHECK((simd<>::sums_run<box<256>, rg8> && !simd<>::sums_run<box<257>, rg8> &&
               !simd<>::sums_run<gnomon::narrow<box<4>>, rg8>));
    }
    CHECK((filtered_in_lanes<tent<37>, gnomon::tm16> && !filtered_in_lanes<tent<44>, gnomon::tm16>)); // 65535^2 38^4, 45^4
}

TEST_CASE("boxes of whole codes go by running sums, as far as these fit 32 bits and a division by them is a product") {
    using gnomon::on_any::runs_sums;
    CHECK((runs_sums<box<8>, rg8> && runs_sums<box<256>, gnomon::rgba8> && runs_sums<gnomon::fast<box<7>>, gnomon::rgb16>));
    CHECK((runs_sums<box<80>, gnomon::rg16> && runs_sums<box<127>, gnomon::rg16> && !runs_sums<box<128>, gnomon::rg16>));
    CHECK_FALSE(runs_sums<box<110>, gnomon::rg16>); // of which no product of 32 bits is the quotient
    CHECK_FALSE(
        (runs_sums<box<0>, rg8> || runs_sums<tent<1>, rg8> || runs_sums<test::spread, rg8> || runs_sums<box<1>, gnomon::rg16f>));
}
