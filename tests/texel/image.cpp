// Images, views and spans: every address they give is the one that a size and a stride in bytes define.
#include <gnomon/texel/image.hpp>

#include "../support/dice.hpp"
#include "../support/sweep.hpp"

#include <gnomon/texel/texel.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

using namespace gnomon;
using test::sweep;

namespace {

struct pixel {
    int x;
    int y;
    friend bool operator==(pixel, pixel) = default;
};

struct alignas(64) whole_line {
    std::byte bytes[64];
};

image<pixel> numbered(extent size) {
    image<pixel> made(size);
    for (int y = 0; y < made.size().height; ++y)
        for (int x = 0; x < made.size().width; ++x) made(x, y) = {x, y};
    return made;
}

std::uintptr_t address(const void* p) { return reinterpret_cast<std::uintptr_t>(p); }

template <typename From, typename To> constexpr bool converts = std::is_convertible_v<From, To>;

// A view becomes a view of const, never the other way; a span is made from contiguous ranges of its own element.
static_assert(converts<image_view<int>, image_view<const int>> && !converts<image_view<const int>, image_view<int>>);
static_assert(converts<strided_span<int>, strided_span<const int>> && !converts<strided_span<const int>, strided_span<int>>);
static_assert(converts<std::vector<float>&, strided_span<const float>> && converts<std::vector<float>&, strided_span<float>>);
static_assert(converts<std::array<float, 3>&, strided_span<float>> && converts<std::span<float>, strided_span<float>>);
static_assert(!converts<const std::vector<float>&, strided_span<float>> &&
              !converts<std::vector<double>&, strided_span<const float>>);
static_assert(!converts<float, strided_span<const float>>);
static_assert(std::is_same_v<decltype(strided_span(std::declval<std::vector<rg8>&>())), strided_span<rg8>>);
static_assert(std::is_same_v<decltype(strided_span(std::declval<const std::vector<rg8>&>())), strided_span<const rg8>>);
static_assert(std::is_nothrow_move_constructible_v<image<rg8>> && std::is_nothrow_move_assignable_v<image<rg8>>);

// Spans work at compile time where the stride is the element's own.
constexpr int sum_of_three() {
    const int numbers[3]{1, 20, 300};
    const strided_span<const int> span(numbers);
    int sum = 0;
    for (int i = 0; i < span.size(); ++i) sum += span[i];
    return sum;
}
static_assert(sum_of_three() == 321);
static_assert(strided_span<int>().size() == 0 && strided_span<int>(nullptr, -3).size() == 0);
static_assert(strided_span<int>(nullptr, 0).size() == 0 && strided_span<int>(nullptr, 1).size() == 1);

} // namespace

TEST_CASE_TEMPLATE("every row of an image begins on a 64-byte boundary, the next that makes their distance an odd number of those",
                   T, std::uint8_t, std::array<std::uint8_t, 3>, std::uint16_t, float, std::array<double, 4>, whole_line) {
    sweep wrong;
    for (int width = 1; width < 140; ++width)
        for (const int height : {1, 2, 5}) {
            image<T> made({width, height});
            for (int y = 0; y < height; ++y) wrong.unless(address(made.view().row(y)) % 64 == 0, "width", width, "row", y);
            const std::ptrdiff_t gap = made.view().stride() - static_cast<std::ptrdiff_t>(sizeof(T)) * width;
            wrong.unless(gap >= 0 && gap < 128 && made.view().stride() % 128 == 64, "width", width, "gap", gap);
        }
    CHECK(wrong.report() == "");
}

TEST_CASE("an image is filled with what it is told or with zero") {
    const image<int> sevens({5, 3}, 7), zeros({5, 3});
    sweep wrong;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x) wrong.unless(sevens(x, y) == 7 && zeros(x, y) == 0, "x", x, "y", y);
    CHECK(wrong.report() == "");
}

TEST_CASE("an image with a side that is zero or negative has no texels there") {
    const auto size_of = [](extent wished) { return image<int>(wished).size(); };
    CHECK(size_of({0, 0}) == extent{0, 0});
    CHECK(size_of({0, 4}) == extent{0, 4});
    CHECK(size_of({4, 0}) == extent{4, 0});
    CHECK(size_of({-3, 4}) == extent{0, 4});
    CHECK(size_of({4, -2147483647 - 1}) == extent{4, 0});
    CHECK(image<int>({0, 4}).view().stride() == 0);
    CHECK(image<int>().size() == extent{});
    CHECK(image<int>().view().part({-5, -5, 5, 5}).size() == extent{});
    image<int>({-3, 4}).view().fill({-9, -9, 9, 9}, 1);
    CHECK(image_view<int>(nullptr, {-3, 4}).size() == extent{});
    CHECK(image_view<int>(nullptr, {4, -3}).size() == extent{});
    CHECK(image_view<int>().size().empty());
    CHECK((image_view<int>().data() == nullptr && image_view<int>().stride() == 0));
}

TEST_CASE("filling a view without a rectangle fills all of it") {
    image<int> numbers({5, 3}, 1);
    numbers.view().part({1, 1, 4, 3}).fill(2);
    int sum = 0;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x) sum += numbers(x, y);
    CHECK(sum == 5 * 3 + 3 * 2);
    numbers.view().fill(7);
    CHECK(numbers(0, 0) == 7);
    CHECK(numbers(4, 2) == 7);
}

TEST_CASE("a span of more elements than an int counts ends at the last that it does") {
    struct {
        int* data() const { return nullptr; }
        std::size_t size() const { return (std::size_t{1} << 32) + 5; }
    } const huge;
    CHECK(gnomon::strided_span<int>(huge).size() == 2147483647);
}

TEST_CASE("a copy of an image is its own memory with the same texels") {
    const image<pixel> original = numbered({7, 4});
    image<pixel> copy = original;
    copy(3, 2) = {-1, -1};
    CHECK(original(3, 2) == pixel{3, 2});
    CHECK(copy(6, 3) == pixel{6, 3});
    copy = original;
    CHECK(copy(3, 2) == pixel{3, 2});
    CHECK(copy.view().data() != original.view().data());
}

TEST_CASE("a moved-from image is empty and can be filled again") {
    image<pixel> first = numbered({7, 4});
    const pixel* memory = first.view().data();
    image<pixel> second = std::move(first);
    CHECK(second.view().data() == memory);
    CHECK(first.size() == extent{}); // NOLINT: that is the promise
    CHECK(first.view().part({0, 0, 9, 9}).size().empty());
    first.view().fill({0, 0, 9, 9}, {1, 1});
    first = std::move(second);
    CHECK(first(6, 3) == pixel{6, 3});
    CHECK(second.size() == extent{}); // NOLINT
    second = first;
    CHECK(second(6, 3) == pixel{6, 3});
}

TEST_CASE("an image moved onto another of any width brings its own rows along") {
    for (const int width : {1, 16, 17, 40}) { // one to several lines a row
        image<pixel> made = numbered({width, 3}), here = numbered({20, 2});
        const std::ptrdiff_t stride = made.view().stride();
        here = std::move(made);
        CHECK(here.view().stride() == stride);
        CHECK(here.size() == extent{width, 3});
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < width; ++x) CHECK(here(x, y) == pixel{x, y});
    }
    CHECK(image<pixel>().view().stride() == 0);
}

TEST_CASE("an image moved into itself keeps its texels") {
    image<pixel> made = numbered({7, 4});
    image<pixel>& same = made;
    made = std::move(same);
    CHECK(made.size() == extent{7, 4});
    CHECK(made(6, 3) == pixel{6, 3});
    made = same;
    CHECK(made(6, 3) == pixel{6, 3});
}

TEST_CASE("a view without a stride takes rows that follow each other") {
    std::vector<int> memory(12);
    std::iota(memory.begin(), memory.end(), 0);
    const image_view<int> view(memory.data(), {4, 3});
    CHECK(view(0, 0) == 0);
    CHECK(view(3, 1) == 7);
    CHECK(view(0, 2) == 8);
    CHECK(view.row_span(1).size() == 4);
    CHECK(view.row_span(1)[2] == 6);
}

TEST_CASE("a view of memory with a side that is zero or negative has no texels there") {
    int memory[4]{};
    CHECK(image_view<int>(memory, {0, 4}).size() == extent{0, 4});
    CHECK(image_view<int>(memory, {-3, 4}).size() == extent{0, 4});
    CHECK(image_view<int>(memory, {4, 0}).size() == extent{4, 0});
    CHECK(image_view<int>(memory, {4, -3}).size() == extent{4, 0});
}

TEST_CASE("a span or a view of const sees what it was made from") {
    image<pixel> made = numbered({7, 4});
    const strided_span<pixel> column(made.view().data() + 5, 4, made.view().stride());
    const strided_span<const pixel> seen = column;
    CHECK(seen.size() == 4);
    CHECK(seen[3] == pixel{5, 3});
    const image_view<const pixel> view = made.view().part({2, 1, 5, 4});
    CHECK(view.size() == extent{3, 3});
    CHECK(view(2, 2) == pixel{4, 3});
}

TEST_CASE("a negative stride turns a view upside down") {
    image<pixel> made = numbered({7, 4});
    const image_view<pixel> upright = made.view();
    const image_view<const pixel> flipped(upright.row(3), {7, 4}, -upright.stride());
    sweep wrong;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 7; ++x) wrong.unless(flipped(x, y) == pixel{x, 3 - y}, "x", x, "y", y);
    CHECK(wrong.report() == "");
    const image_view<const pixel> part = flipped.part({2, 1, 5, 9});
    CHECK(part.size() == extent{3, 3});
    CHECK(part(0, 0) == pixel{2, 2});
    CHECK(part(2, 2) == pixel{4, 0});
}

TEST_CASE("part and fill reach exactly the texels that the rectangle and the image share") {
    constexpr extent size{5, 4};
    sweep wrong;
    for (int x0 = -2; x0 < 7; ++x0)
        for (int x1 = -2; x1 < 7; ++x1)
            for (int y0 = -2; y0 < 6; ++y0)
                for (int y1 = -2; y1 < 6; ++y1) {
                    const texel_rect r{x0, y0, x1, y1};
                    image<int> filled(size), parted(size);
                    filled.view().fill(r, 1);
                    const image_view<int> part = parted.view().part(r);
                    wrong.unless(part.size().empty() == (part.data() == nullptr), "memory", x0, y0, x1, y1);
                    for (int y = 0; y < part.height(); ++y)
                        for (int x = 0; x < part.width(); ++x) part(x, y) = 1;
                    for (int y = 0; y < size.height; ++y)
                        for (int x = 0; x < size.width; ++x) {
                            const int expected = r.contains(x, y) ? 1 : 0;
                            wrong.unless(filled(x, y) == expected && parted(x, y) == expected, "rectangle", x0, y0, x1, y1, "texel",
                                         x, y);
                        }
                }
    CHECK(wrong.report() == "");
}

TEST_CASE("two views share texels where one address is in both, however they lie, if their rows are as far apart") {
    std::vector<pixel> memory(60);
    test::dice roll(77);
    const auto any_view = [&](std::ptrdiff_t stride) {
        const extent size{roll(0, static_cast<int>(stride)), roll(0, 4)};
        const bool flipped = roll.one_in(2) && !size.empty();
        pixel* const first = memory.data() + roll(0, 20) + (flipped ? stride * (size.height - 1) : 0);
        return image_view<const pixel>(first, size, (flipped ? -stride : stride) * static_cast<std::ptrdiff_t>(sizeof(pixel)));
    };
    const auto in_both = [](image_view<const pixel> a, image_view<const pixel> b) {
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x)
                for (int v = 0; v < b.height(); ++v)
                    for (int u = 0; u < b.width(); ++u)
                        if (&a(x, y) == &b(u, v)) return true;
        return false;
    };
    sweep wrong;
    int shared = 0, between = 0, apart = 0;
    for (int round = 0; round < 20000; ++round) {
        const std::ptrdiff_t stride = roll(1, 9);
        const image_view<const pixel> a = any_view(stride), b = any_view(stride), other = any_view(stride + 1);
        const bool expected = in_both(a, b);
        wrong.unless(share_texels<pixel>(a, b) == expected, "round", round, "stride", stride);
        wrong.unless(share_texels<pixel>(a, other) || !in_both(a, other), "another stride: round", round);
        const pixel* const first = std::min(a.row(0), a.row(greater(a.height() - 1, 0)));
        const pixel* const last = std::max(a.row(0), a.row(greater(a.height() - 1, 0)));
        const bool among = !a.size().empty() && !b.size().empty() && b.row(0) >= first && b.row(0) < last + a.width();
        ++(expected ? shared : among ? between : apart);
    }
    CHECK(wrong.report() == "");
    CHECK(shared > 1000);
    CHECK(between > 100);
    CHECK(apart > 1000);
    const image_view<const pixel> repeated(memory.data(), {4, 3}, 0);
    CHECK(share_texels<pixel>(repeated, repeated));
    CHECK_FALSE(share_texels<pixel>(repeated, image_view<const pixel>(memory.data() + 4, {4, 3}, 0)));
}

TEST_CASE("a strided span walks a row or a column or one field of an array of structures") {
    image<pixel> made = numbered({7, 4});
    const image_view<pixel> view = made.view();
    const strided_span<pixel> row = view.row_span(2);
    CHECK(row.size() == 7);
    CHECK(row[6] == pixel{6, 2});

    const strided_span<const pixel> column(view.data() + 5, 4, view.stride());
    CHECK(column[3] == pixel{5, 3});
    const strided_span<const pixel> upwards(view.row(3) + 5, 4, -view.stride());
    CHECK(upwards[3] == pixel{5, 0});

    const strided_span<int> ys(&view.row(2)->y, 7, sizeof(pixel));
    for (int i = 0; i < 7; ++i) ys[i] = 100 + i;
    CHECK(view(4, 2) == pixel{4, 104});

    const strided_span<const int> repeated(&view(6, 3).x, 1000, 0);
    CHECK(repeated[999] == 6);
}
