// Rectangles against the sets of texels they stand for, counted one by one.
#include <gnomon/rect.hpp>

#include "../support/bits.hpp"
#include "../support/float_dice.hpp"
#include "../support/sweep.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <limits>
#include <vector>

using namespace gnomon;
using test::sweep;

namespace {

constexpr int int_max = std::numeric_limits<int>::max(), int_min = std::numeric_limits<int>::min();

/// All rectangles, inverted ones too, with corners in [-1, side].
std::vector<texel_rect> all_rects(int side) {
    std::vector<texel_rect> rects;
    for (int x0 = -1; x0 <= side; ++x0)
        for (int y0 = -1; y0 <= side; ++y0)
            for (int x1 = -1; x1 <= side; ++x1)
                for (int y1 = -1; y1 <= side; ++y1) rects.push_back({x0, y0, x1, y1});
    return rects;
}

/// The set of texels in [-4, 12) x [-4, 12) for which `holds(x, y)`, as its bounding box and its number of texels.
struct counted {
    texel_rect box{};
    int texels = 0;
};
template <typename Holds> counted count(Holds holds) {
    counted set;
    for (int y = -4; y < 12; ++y)
        for (int x = -4; x < 12; ++x)
            if (holds(x, y)) {
                set.box = set.texels == 0 ? texel_rect{x, y, x + 1, y + 1}
                                          : texel_rect{lesser(set.box.x0, x), lesser(set.box.y0, y), greater(set.box.x1, x + 1),
                                                       greater(set.box.y1, y + 1)};
                ++set.texels;
            }
    return set;
}
/// Is `r` that set, and all zero if it is empty?
bool is_set(texel_rect r, counted set) { return r == set.box && r.width() * r.height() == set.texels; }

static_assert(extent{} == extent{0, 0} && tile_rect{} == tile_rect{0, 0, 0, 0} && texel_rect{} == texel_rect{0, 0, 0, 0});
static_assert(intersection({0, 0, 4, 4}, {2, 2, 6, 6}) == texel_rect{2, 2, 4, 4});
static_assert(grow({int_min, int_min, int_max, int_max}, int_max).x1 == int_max);
static_assert(enclosing_texels(0.5, -0.5, 1.5, 2.0) == texel_rect{0, -1, 2, 2});
static_assert(enclosing_texels(test::nan<double>, 0, 1, 1).empty());

} // namespace

TEST_CASE("an extent or rectangle is empty if and only if it holds no texel") {
    CHECK(extent{0, 5}.empty());
    CHECK(extent{5, 0}.empty());
    CHECK(extent{5, -1}.empty());
    CHECK(!extent{1, 1}.empty());
    sweep wrong;
    for (const texel_rect r : all_rects(4)) {
        const counted set = count([r](int x, int y) { return r.contains(x, y); });
        wrong.unless(r.empty() == (set.texels == 0) && r.width() * r.height() == set.texels, r.x0, r.y0, r.x1, r.y1);
        wrong.unless(!r.empty() || (r.width() == 0 && r.height() == 0), "sides", r.x0, r.y0, r.x1, r.y1);
        wrong.unless(tile_rect{r.x0, r.y0, r.x1, r.y1}.empty() == r.empty(), "tiles", r.x0, r.y0, r.x1, r.y1);
    }
    CHECK(wrong.report() == "");
    CHECK(texel_rect{int_max, 0, int_min, 1}.empty());
    CHECK(texel_rect{int_max, 0, int_min, 1}.width() == 0);
    CHECK(texel_rect{0, int_max, 1, int_min}.height() == 0);
}

TEST_CASE("whole counts a negative side as zero") {
    CHECK(whole({3, 4}) == texel_rect{0, 0, 3, 4});
    CHECK(whole({-3, 4}) == texel_rect{0, 0, 0, 4});
    CHECK(whole({int_min, int_min}) == texel_rect{});
}

TEST_CASE("intersection and union_box are those of the sets and an empty result is all zero") {
    const auto rects = all_rects(3);
    sweep wrong;
    for (const texel_rect a : rects)
        for (const texel_rect b : rects) {
            if (((a.x0 + a.y0 * 3 + b.x1 + b.y1 * 5) & 3) != 0) continue; // one pair in four
            const counted shared = count([&](int x, int y) { return a.contains(x, y) && b.contains(x, y); });
            const counted either = count([&](int x, int y) { return a.contains(x, y) || b.contains(x, y); });
            wrong.unless(is_set(intersection(a, b), shared), "intersection", a.x0, a.y0, a.x1, a.y1, b.x0, b.y0, b.x1, b.y1);
            wrong.unless(union_box(a, b) == either.box, "union_box", a.x0, a.y0, a.x1, a.y1, b.x0, b.y0, b.x1, b.y1);
        }
    CHECK(wrong.report() == "");
}

TEST_CASE("clip leaves what lies on the map") {
    sweep wrong;
    for (const texel_rect r : all_rects(4))
        for (const extent size : {extent{3, 2}, extent{0, 4}, extent{-2, 3}, extent{1, 1}}) {
            const counted set = count([&](int x, int y) { return r.contains(x, y) && whole(size).contains(x, y); });
            wrong.unless(is_set(clip(r, size), set), r.x0, r.y0, r.x1, r.y1, "map", size.width, size.height);
        }
    CHECK(wrong.report() == "");
    CHECK(clip({int_min, int_min, int_max, int_max}, {7, 5}) == texel_rect{0, 0, 7, 5});
}

TEST_CASE("grow adds the texels at most so far away in either axis and nothing to an empty rectangle") {
    sweep wrong;
    for (const texel_rect r : all_rects(4))
        for (int g = -1; g <= 2; ++g) {
            const auto near = [&](int x, int y) {
                const int reach = greater(g, 0);
                for (int dy = -reach; dy <= reach; ++dy)
                    for (int dx = -reach; dx <= reach; ++dx)
                        if (r.contains(x + dx, y + dy)) return true;
                return false;
            };
            wrong.unless(is_set(grow(r, g), count(near)), r.x0, r.y0, r.x1, r.y1, "by", g);
        }
    CHECK(wrong.report() == "");
}

TEST_CASE("grow saturates at the ends of int and never moves a side inwards") {
    sweep wrong;
    for (const int low : {int_min, int_min + 1, int_min + 2, -1, 0, 1, int_max - 2})
        for (const int high : {int_min + 2, -1, 0, 1, int_max - 1, int_max})
            for (const int g : {int_min, -1, 0, 1, 2, int_max - 1, int_max}) {
                if (low >= high) continue;
                const texel_rect grown = grow({low, low, high, high}, g);
                const std::int64_t by = greater(g, 0), lowest = std::int64_t{low} - by, highest = std::int64_t{high} + by;
                wrong.unless(grown.x0 == grown.y0 && grown.x1 == grown.y1 && grown.x0 <= low && grown.x1 >= high, "inwards", low,
                             high, "by", g);
                wrong.unless(lowest < -std::int64_t{int_max} || grown.x0 == lowest, "low side", low, "by", g);
                wrong.unless(highest > std::int64_t{int_max} || grown.x1 == highest, "high side", high, "by", g);
            }
    CHECK(wrong.report() == "");
}

TEST_CASE("enclosing_texels are the texels whose area the rectangle touches") {
    sweep wrong;
    const auto touches = [](double low, double high, int i) { return low < i + 1 && high > i; }; // more than a border
    for (double x0 = -2.5; x0 < 4; x0 += 0.25)
        for (double x1 = -2.5; x1 < 4; x1 += 0.25)
            for (const double y0 : {-1.0, 0.0, 0.25, 2.5})
                for (const double y1 : {-0.5, 0.0, 0.75, 3.0}) {
                    const bool empty = x0 >= x1 || y0 >= y1;
                    const counted set = count([&](int x, int y) { return !empty && touches(x0, x1, x) && touches(y0, y1, y); });
                    wrong.unless(is_set(enclosing_texels(x0, y0, x1, y1), set), x0, y0, x1, y1);
                }
    CHECK(wrong.report() == "");
    CHECK(enclosing_texels(test::down(1.0), 0.0, test::up(2.0), 1.0) == texel_rect{0, 0, 3, 1});
    CHECK(enclosing_texels(0.0, 0.0, test::smallest<double>, 1.0) == texel_rect{0, 0, 1, 1});
    CHECK(enclosing_texels(-test::smallest<double>, 0.0, 0.0, 1.0) == texel_rect{-1, 0, 0, 1});
}

TEST_CASE("enclosing_texels moves sides beyond 2^30 to 2^30 and takes NaN for nothing") {
    constexpr int reach = 1 << 30;
    const double inf = test::infinity<double>, nan = test::nan<double>;
    CHECK(enclosing_texels(-inf, -inf, inf, inf) == texel_rect{-reach, -reach, reach, reach});
    CHECK(enclosing_texels(-1e300, -0x1p31, 1e300, 0x1p31) == texel_rect{-reach, -reach, reach, reach});
    CHECK(enclosing_texels(0x1p31, 0.0, 0x1p32, 1.0).empty());
    CHECK(enclosing_texels(-0x1p32, 0.0, -0x1p31, 1.0).empty());
    for (int side = 0; side < 4; ++side) {
        double sides[4]{0.0, 0.0, 1.0, 1.0};
        sides[side] = nan;
        CHECK(enclosing_texels(sides[0], sides[1], sides[2], sides[3]) == texel_rect{});
    }
    CHECK(enclosing_texels(inf, 0.0, inf, 1.0) == texel_rect{});
    CHECK(enclosing_texels(1.0, 0.0, 0.0, 1.0) == texel_rect{});
}

TEST_CASE("extents and rectangles are equal if and only if every number is") {
    CHECK(extent{3, 4} == extent{3, 4});
    CHECK(extent{3, 4} != extent{4, 4});
    CHECK(extent{3, 4} != extent{3, 3});
    const int sides[4]{1, 2, 3, 4};
    for (int i = 0; i < 4; ++i) {
        int other[4]{1, 2, 3, 4};
        CHECK(texel_rect{sides[0], sides[1], sides[2], sides[3]} == texel_rect{other[0], other[1], other[2], other[3]});
        CHECK(tile_rect{sides[0], sides[1], sides[2], sides[3]} == tile_rect{other[0], other[1], other[2], other[3]});
        ++other[i];
        CHECK(texel_rect{sides[0], sides[1], sides[2], sides[3]} != texel_rect{other[0], other[1], other[2], other[3]});
        CHECK(tile_rect{sides[0], sides[1], sides[2], sides[3]} != tile_rect{other[0], other[1], other[2], other[3]});
    }
}
