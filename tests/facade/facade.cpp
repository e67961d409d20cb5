// The facade: everything it does is a stage that can be had alone, so the stages are its oracle.
#include <gnomon/soft_shadow_map.hpp>

#include "../support/bits.hpp"
#include "../support/filtering.hpp"
#include "../support/formats.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace {
using gnomon::binomial;
using gnomon::extent;
using gnomon::soft_shadow_map;
using gnomon::texel_rect;
using test::dice;
constexpr float no_depth = test::nan<float>, inf = test::infinity<float>;
constexpr int lowest = std::numeric_limits<int>::min(), highest = std::numeric_limits<int>::max();

template <typename Texel> using map_of = soft_shadow_map<Texel, binomial<3>>;

template <typename Map> bool lit_everywhere(const Map& map) {
    using texel = std::remove_const_t<typename decltype(map.soft())::element_type>;
    int dark = 0;
    test::for_each_texel(whole(map.size()),
                         [&](int x, int y) { dark += !(map.soft()(x, y) == texel::clear()) || map.shadow(x, y, 2.0f) > 0.0f; });
    return dark == 0;
}
template <typename Map> bool same_bits_in(const Map& a, const Map& b) {
    return a.size() == b.size() && test::differences(a.soft(), b.soft(), whole(a.size())) == 0;
}

/// Draws a caster of two depths texel by texel, as a host's rasteriser does, and says what it touched.
template <typename Texel> struct drawing {
    struct touched {
        texel_rect texels;
        gnomon::depth_interval depth;
    };
    texel_rect where;
    float depth;
    int calls = 0;

    touched operator()(gnomon::image_view<Texel> texels) {
        ++calls;
        const texel_rect drawn = clip(where, texels.size());
        test::for_each_texel(drawn, [&](int x, int y) { texels(x, y).cast(Texel::caster(x % 2 == 0 ? depth : depth / 2)); });
        return {drawn, {depth / 2, depth}};
    }
};
template <typename Map, typename Draw>
concept can_cast = requires(Map& map, Draw draw) { map.cast(draw); };
template <typename Map, typename Draw>
concept can_bound = requires(Map& map, Draw draw) { map.bound(draw); };

/// One caster for certain, a few at random, and a ground where the format has one.
template <typename Map> void populate(Map& map, dice& roll) {
    map.cast({15, 12, 30, 22}, 0.2f + 0.5f * roll.unit());
    for (int n = roll(0, 3); n > 0; --n) map.cast(roll.rect(map.size(), 8), roll.unit());
    if constexpr (requires { map.bound(texel_rect{}, 1.0f); }) map.bound(whole(map.size()), roll.unit());
}
} // namespace

TEST_CASE("the ten lines print what they say") {
    map_of<gnomon::rg8> map({.width = 512, .height = 512, .tile = 16});
    map.cast({.x0 = 200, .y0 = 200, .x1 = 300, .y1 = 300}, 0.4f);
    map.filter();
    CHECK(test::equal(map.shadow(10, 10, 0.9f), 0.0f));
    CHECK(test::equal(map.shadow(250, 250, 0.9f), 1.0f));
    CHECK(test::equal(map.shadow(199, 250, 0.9f), 88.0f / 255.0f)); // 22 of 64 taps, of 255
    CHECK(test::equal(map.shadow(250, 250, 0.2f), 0.0f));
}

TEST_CASE_TEMPLATE("maps of nothing, of one texel, of one row, and smaller than their kernel take every call", Texel, gnomon::rg8,
                   gnomon::rgba16, gnomon::rgba32f, gnomon::tm8, test::paper8) {
    for (const extent size : {extent{0, 0}, {0, 9}, {9, 0}, {-5, -7}, {1, 1}, {65, 1}, {1, 65}, {5, 4}})
        for (const int tile : {1, 32, highest}) {
            soft_shadow_map<Texel, gnomon::gaussian<16>, gnomon::scalar> map({size.width, size.height, tile});
            for (int frame = 0; frame < 2; ++frame) {
                map.clear();
                map.cast({-3, -3, 99, 99}, 0.5f);
                if constexpr (Texel::effects.far_bound) map.bound({-3, -3, 99, 99}, 0.9f);
                map.filter();
                CHECK(map.size() == extent{size.width < 0 ? 0 : size.width, size.height < 0 ? 0 : size.height});
                CHECK(test::equal(map.shadow(-1, 0, 0.8f), 0.0f));
                CHECK(test::equal(map.shadow(0, map.size().height, 0.8f), 0.0f));
                gnomon::image<Texel> casters(map.size(), Texel::caster(0.5f));
                if constexpr (Texel::effects.far_bound)
                    test::for_each_texel(whole(map.size()), [&](int x, int y) { casters(x, y).bound(0.9f); });
                CHECK(test::differences<Texel>(map.soft(), test::dense<gnomon::gaussian<16>>(casters).view(), whole(map.size())) ==
                      0);
                CHECK(test::equal(map.shadow_at(0.5f, 0.5f, 0.8f), map.shadow(0, 0, 0.8f)));
                CHECK(map.reaches({0, 0, 1, 1}, {0.7f, 0.8f}) == !size.empty());
                const float z[2] = {0.8f, 0.8f};
                float intensity[2] = {7.0f, 7.0f};
                map.receive_row(-1, z, intensity);
                CHECK(test::equal(intensity[0] + intensity[1], 0.0f));
            }
        }
}

static_assert(std::is_same_v<soft_shadow_map<gnomon::rg8>, soft_shadow_map<gnomon::rg8, binomial<3>, gnomon::simd<>>>);

TEST_CASE("of what a size leaves out there are no texels, and tiles of 32") {
    CHECK(map_of<gnomon::rg8>({}).size() == extent{0, 0});
    CHECK(map_of<gnomon::rg8>({}).tiles().tiles().tile() == 32);
}

TEST_CASE("casting nothing leaves a lit map: empty, inverted and far away rectangles") {
    map_of<gnomon::rgba8> map({.width = 40, .height = 30, .tile = 8});
    for (const texel_rect r : {texel_rect{},
                               {10, 10, 10, 20},
                               {20, 20, 10, 25},
                               {20, 20, 25, 10},
                               {-20, 0, -1, 30},
                               {40, 0, 50, 30},
                               {highest, highest, lowest, lowest},
                               {lowest, lowest, lowest + 1, lowest + 1}}) {
        map.cast(r, 0.5f);
        map.bound(r, 0.7f);
    }
    map.filter();
    CHECK(lit_everywhere(map));
    CHECK(map.tiles().tiles().empty());
    map.cast({lowest, lowest, highest, highest}, 0.5f);
    map.filter();
    CHECK(test::equal(map.shadow(20, 15, 0.6f), 1.0f));
}

TEST_CASE("a caster of no depth lies at the far plane, one beyond the planes on them, and a receiver of no depth is lit") {
    struct given {
        float depth, as;
    };
    for (const given g : {given{no_depth, 1.0f}, {inf, 1.0f}, {-inf, 0.0f}, {-3.0f, 0.0f}, {7.0f, 1.0f}}) {
        map_of<gnomon::rg16> odd({.width = 20, .height = 20, .tile = 8}), plain({.width = 20, .height = 20, .tile = 8});
        odd.cast({5, 5, 12, 12}, g.depth);
        plain.cast({5, 5, 12, 12}, g.as);
        odd.filter();
        plain.filter();
        CAPTURE(g.depth);
        CHECK(same_bits_in(odd, plain));
        CHECK(test::equal(odd.shadow(8, 8, 2.0f), 1.0f));
        CHECK(odd.reaches({8, 8, 9, 9}, {2.0f, 2.0f}));
        for (const float z : {no_depth, -inf, -1.0f, 0.0f}) CHECK(test::equal(odd.shadow(8, 8, z), 0.0f));
    }
}

TEST_CASE_TEMPLATE("opacity is the intensity of an opaque caster's shadow, in umbra and penumbra", Texel, gnomon::rga8,
                   gnomon::rga16, gnomon::rga16f, gnomon::rgba32f, test::ratio_rgba16) {
    dice roll(141);
    for (const float opacity : {0.0f, 0.25f, 0.5f, 1.0f, 2.0f, -1.0f, no_depth}) {
        map_of<Texel> map({.width = 40, .height = 30, .tile = 8}), opaque({.width = 40, .height = 30, .tile = 8});
        map.cast({10, 10, 30, 20}, 0.5f, opacity);
        opaque.cast({10, 10, 30, 20}, 0.5f);
        map.filter();
        opaque.filter();
        float worst = 0.0f;
        test::for_each_texel(whole(map.size()), [&](int x, int y) {
            const float difference = map.shadow(x, y, 0.9f) - gnomon::saturate(opacity) * opaque.shadow(x, y, 0.9f);
            worst = std::max(worst, difference < 0 ? -difference : difference);
        });
        CAPTURE(opacity);
        CHECK(worst <= 2 * Texel::channel_type::max_error);
    }
}

TEST_CASE_TEMPLATE("a far bound ends the shadow at the first receiver, and only where one was drawn", Texel, gnomon::rgb8,
                   gnomon::rgb16, gnomon::rgba16f, gnomon::rgba32f, test::ratio_rgba8) {
    map_of<Texel> map({.width = 60, .height = 30, .tile = 8});
    map.cast({5, 5, 50, 25}, 0.3f);
    map.bound({0, 0, 30, 30}, 0.6f);
    map.bound({0, 0, 30, 30}, 0.2f); // before the caster: bounds nothing
    map.bound({0, 0, 30, 30}, 0.8f); // behind the first: too late
    map.filter();
    CHECK(test::equal(map.shadow(15, 15, 0.2f), 0.0f));
    CHECK(test::equal(map.shadow(15, 15, 0.45f), 1.0f));
    CHECK(test::equal(map.shadow(15, 15, 0.6f), 1.0f)); // the receiver itself
    CHECK(test::equal(map.shadow(15, 15, 0.7f), 0.0f));
    CHECK(test::equal(map.shadow(44, 15, 0.7f), 1.0f));
    map.decision.fade = 0.5f;
    CHECK(map.shadow(15, 15, 0.7f) > 0.7f);
    CHECK(map.shadow(15, 15, 0.7f) < 0.9f);
}

static_assert(can_cast<map_of<gnomon::rg8>, drawing<gnomon::rg8>> && !can_cast<map_of<gnomon::rg8>, drawing<gnomon::rg16>>);
static_assert(!can_cast<map_of<gnomon::rg8>, void (*)(gnomon::image_view<gnomon::rg8>)>, "who draws says what was touched");
static_assert(can_bound<map_of<gnomon::rgb8>, void (*)(gnomon::image_view<gnomon::rgb8>)> &&
              !can_bound<map_of<gnomon::rgb8>, void (*)(gnomon::image_view<gnomon::rg8>)>);
static_assert(!can_bound<map_of<gnomon::rg8>, void (*)(gnomon::image_view<gnomon::rg8>)>, "nothing to write a bound to");

TEST_CASE_TEMPLATE("what is drawn into bound bounds as rectangles do", Texel, gnomon::rgb8, gnomon::rgba32f) {
    map_of<Texel> map({.width = 60, .height = 30, .tile = 8}), by_rect = map;
    for (auto* m : {&map, &by_rect}) m->cast({5, 5, 50, 25}, 0.3f);
    constexpr texel_rect ground{0, 0, 30, 30};
    by_rect.bound(ground, 0.6f);
    map.bound([&](auto texels) { test::for_each_texel(ground, [&](int x, int y) { texels(x, y).bound(0.6f); }); });
    map.filter();
    by_rect.filter();
    CHECK(same_bits_in(map, by_rect));
    CHECK(test::equal(map.shadow(15, 15, 0.7f), 0.0f));
}

template <typename Map, typename... Arguments>
concept can_shadow = requires(const Map& map, Arguments... at) { map.shadow(at...); };
static_assert(can_shadow<map_of<gnomon::rg8>, int, int, float> && can_shadow<map_of<gnomon::rg8>, int, int, double>);
static_assert(!can_shadow<map_of<gnomon::rg8>, float, float, float> && !can_shadow<map_of<gnomon::rg8>, double, double, double>,
              "a position would be cut to a texel without a word");

template <typename Point>
concept is_point = requires(const map_of<gnomon::rg8>& map, Point p) { map.shadow_at(p); };
struct without_x {
    float y, depth;
};
struct without_y {
    float x, depth;
};
struct without_depth {
    float x, y;
};
struct with_all : without_x {
    float x;
};
static_assert(is_point<with_all> && !is_point<without_x> && !is_point<without_y> && !is_point<without_depth>);

TEST_CASE("a point with x, y and depth is asked as its three numbers are") {
    struct {
        double x, y, depth;
    } const point{10.25, 4.75, 0.75}; // at a corner, so that neither number does for the other
    map_of<gnomon::rg16> map({.width = 20, .height = 20, .tile = 8});
    map.cast({10, 5, 15, 15}, 0.5f);
    map.filter();
    CHECK(map.shadow_at(point) > 0.1f);
    CHECK(test::same_bits(map.shadow_at(point), map.shadow_at(10.25f, 4.75f, 0.75f)));
}

TEST_CASE("a receiver before its caster is reached unless the bias is towards light") {
    map_of<gnomon::rg8> map({.width = 20, .height = 20, .tile = 8});
    map.cast({5, 5, 15, 15}, 0.5f);
    map.filter();
    for (const gnomon::bias b : {gnomon::towards_light, gnomon::unbiased, gnomon::towards_shadow}) {
        map.decision.caster = b;
        CHECK(map.reaches({8, 8, 9, 9}, {0.3f, 0.4f}) == (b.towards != gnomon::bias_towards::light));
        CHECK(map.reaches({8, 8, 9, 9}, {0.6f, 0.7f}));
    }
}

TEST_CASE_TEMPLATE("what is drawn into cast is what casters and mark make by hand, and clear forgets all of it", Texel, gnomon::rg8,
                   gnomon::rgba16, gnomon::rgb16f, test::paper32f) {
    dice roll(146);
    map_of<Texel> map({.width = 50, .height = 40, .tile = 8}), by_hand = map;
    for (int frame = 0; frame < 30; ++frame) {
        gnomon::image<Texel> all(map.size(), Texel::clear());
        map.clear();
        by_hand.clear();
        for (int n = roll(1, 4); n > 0; --n) {
            drawing<Texel> draw{roll.rect(map.size(), 8), roll.unit()};
            map.cast(draw);
            CHECK(draw.calls == 1);
            const auto touched = draw(by_hand.casters());
            by_hand.mark(touched.texels, touched.depth);
            draw(all.view());
        }
        map.filter();
        by_hand.filter();
        CHECK(same_bits_in(map, by_hand));
        CHECK(test::differences<Texel>(map.casters(), all.view(), whole(map.size())) == 0);
        CHECK(test::differences<Texel>(map.soft(), test::dense<binomial<3>>(all).view(), whole(map.size())) == 0);
        int wrong = 0;
        test::for_each_texel({0, 0, map.tiles().tiles().columns(), map.tiles().tiles().rows()}, [&](int x, int y) {
            const auto found = map.tiles().depth(x, y), expected = by_hand.tiles().depth(x, y);
            wrong += map.tiles().tiles().test(x, y) != by_hand.tiles().tiles().test(x, y);
            wrong += !test::same_bits(found.nearest, expected.nearest) || !test::same_bits(found.farthest, expected.farthest);
        });
        CHECK(wrong == 0);
    }
    map.clear();
    map.filter();
    CHECK(lit_everywhere(map));
    CHECK(test::differences<Texel>(map.casters(), gnomon::image<Texel>(map.size(), Texel::clear()).view(), whole(map.size())) == 0);
}

TEST_CASE_TEMPLATE("sample, receive and receive_row give the bits of the one-point forms", Texel, gnomon::rg8, gnomon::rgba16,
                   gnomon::rgb16f, gnomon::rga32f, test::ratio_rgba16, test::paper32f) {
    dice roll(142);
    map_of<Texel> map({.width = 50, .height = 40, .tile = 8});
    map.cast(whole(map.size()), 0.4f); // so that no row is lit, the first and the last neither
    populate(map, roll);
    map.filter();
    std::vector<float> x, y, z, points(200), row(50, 7.0f);
    for (int i = 0; i < 200; ++i) {
        x.push_back(60 * roll.unit() - 5);
        y.push_back(50 * roll.unit() - 5);
        z.push_back(roll.unit());
    }
    map.receive(x, y, z, points);
    int wrong = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        wrong += !test::same_bits(points[i], map.shadow_at(x[i], y[i], z[i]));
        wrong += !test::same_bits(points[i], gnomon::shadow(gnomon::sample(map.soft(), x[i], y[i]), z[i], map.decision));
    }
    for (const int line : {-1, 0, 20, 39, 40, lowest, highest}) {
        map.receive_row(line, z, row);
        for (int i = 0; i < 50; ++i)
            wrong += !test::same_bits(row[static_cast<std::size_t>(i)], map.shadow(i, line, z[static_cast<std::size_t>(i)]));
    }
    for (int i = 0; i < 40; ++i)
        wrong += !test::same_bits(map.shadow(20, i, 0.9f), map.shadow_at(20.5f, static_cast<float>(i) + 0.5f, 0.9f));
    CHECK(wrong == 0);
}

TEST_CASE("the decision can be changed between reads, and acts on all of them") {
    map_of<gnomon::rg8> map({.width = 40, .height = 30, .tile = 8});
    map.cast({10, 10, 30, 20}, 0.5f);
    map.filter();
    const auto answers = [&](float z) {
        const float x[1] = {20.5f}, y[1] = {15.5f}, depth[1] = {z};
        float points[1];
        map.receive(x, y, depth, points);
        std::vector<float> row(40), depths(40, z);
        map.receive_row(15, depths, row);
        CHECK(test::equal(map.shadow(20, 15, z), points[0]));
        CHECK(test::equal(map.shadow(20, 15, z), row[20]));
        return points[0];
    };
    const float just_behind = 0.502f;
    CHECK(test::equal(answers(just_behind), 0.0f)); // towards light
    map.decision = gnomon::rule{.caster = gnomon::towards_shadow};
    CHECK(test::equal(answers(just_behind), 1.0f));
    CHECK(test::equal(answers(1.5f), 1.0f));
    map.decision.lit_beyond = true;
    CHECK(test::equal(answers(1.5f), 0.0f));
}

TEST_CASE("a receiver that the map does not reach is lit, and reaches asks its tiles") {
    map_of<gnomon::rg16> map({.width = 64, .height = 64, .tile = 8});
    map.cast({20, 20, 30, 30}, 0.5f);
    map.filter();
    CHECK(map.reaches({0, 0, 64, 64}));
    CHECK(map.reaches({31, 31, 32, 32}, {0.6f, 0.9f}));
    CHECK_FALSE(map.reaches({31, 31, 32, 32}, {0.1f, 0.5f}));
    CHECK_FALSE(map.reaches({40, 40, 50, 50}));
    CHECK(map.reaches({10, 10, 40, 40}, {0.4f, 0.6f}) == gnomon::casters_reach(map.tiles(), {10, 10, 40, 40}, {0.4f, 0.6f}));
}

TEST_CASE_TEMPLATE("clear forgets every caster, but the filtered map stays readable until the next filter", Texel, gnomon::rg8,
                   gnomon::rgba16f, test::paper32f) {
    dice roll(143);
    map_of<Texel> map({.width = 50, .height = 40, .tile = 8});
    populate(map, roll);
    map.filter();
    const map_of<Texel> before = map;
    CHECK_FALSE(lit_everywhere(before));
    map.clear();
    CHECK(same_bits_in(map, before));
    CHECK(map.tiles().tiles().empty());
    map.filter();
    CHECK(lit_everywhere(map));
    int left = 0;
    test::for_each_texel(whole(map.size()), [&](int x, int y) { left += !(map.casters()(x, y) == Texel::clear()); });
    CHECK(left == 0);
}

TEST_CASE_TEMPLATE("filter has no memory: twice is once, and casting between two adds", Texel, gnomon::rg8, gnomon::rgba16,
                   gnomon::rgb32f, gnomon::tm16, test::paper8) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        dice roll(144 + seed), again(144 + seed);
        map_of<Texel> twice({.width = 50, .height = 40, .tile = 8}), once = twice;
        for (int step = 0; step < 3; ++step) {
            populate(twice, roll);
            twice.filter();
            twice.filter();
            populate(once, again);
        }
        once.filter();
        CHECK(same_bits_in(twice, once));
    }
}

TEST_CASE("a map that was copied or moved goes on where the other was") {
    dice roll(145);
    map_of<gnomon::rgba8> original({.width = 50, .height = 40, .tile = 8});
    populate(original, roll);
    original.filter();
    const map_of<gnomon::rgba8> kept = original;
    map_of<gnomon::rgba8> moved = std::move(original);
    CHECK(same_bits_in(moved, kept));
    original = map_of<gnomon::rgba8>({.width = 9, .height = 9, .tile = 4}); // and the old one may be given a new life
    original.cast({0, 0, 9, 9}, 0.5f);
    original.filter();
    CHECK(test::equal(original.shadow(4, 4, 0.9f), 1.0f));
    moved.clear();
    moved.cast({5, 5, 9, 9}, 0.25f);
    moved.filter();
    map_of<gnomon::rgba8> fresh({.width = 50, .height = 40, .tile = 8});
    fresh.cast({5, 5, 9, 9}, 0.25f);
    fresh.filter();
    CHECK(same_bits_in(moved, fresh));
}
