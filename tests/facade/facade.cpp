// The facade: everything it does is a stage that can be had alone, so the stages are its oracle.
#include "suite.hpp"

#include "../support/bits.hpp"

#include <doctest/doctest.h>

#include <type_traits>
#include <utility>

namespace {
namespace suite = test::facade;
using gnomon::binomial;
using gnomon::texel_rect;
using suite::lit_everywhere, suite::populate, suite::same_bits_in;
using test::dice;
constexpr gnomon::simd<> run{}; // what a map runs on if nothing is said

template <typename Texel> using map_of = gnomon::soft_shadow_map<Texel, binomial<3>>;

// A position is no texel, not even along one axis.
template <typename X, typename Y>
concept asked_as_a_texel = requires(const map_of<gnomon::rg8>& map, X x, Y y) { map.shadow(x, y, 0.5f); };
static_assert(asked_as_a_texel<int, int> && asked_as_a_texel<short, unsigned char>);
static_assert(!asked_as_a_texel<float, float> && !asked_as_a_texel<int, float> && !asked_as_a_texel<double, int>);

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
} // namespace

TEST_CASE("the ten lines print what they say") { suite::ten_lines(run); }

TEST_CASE_TEMPLATE("maps of nothing, of one texel, of one row, and smaller than their kernel take every call", Texel, gnomon::rg8,
                   gnomon::rgba16, gnomon::rgba32f, gnomon::tm8, test::paper8) {
    suite::maps_of_nothing<Texel>(gnomon::scalar{});
}

static_assert(
    std::is_same_v<gnomon::soft_shadow_map<gnomon::rg8>, gnomon::soft_shadow_map<gnomon::rg8, binomial<3>, gnomon::simd<>>>);

TEST_CASE("of what a size leaves out there are no texels, and tiles of 32") {
    CHECK(map_of<gnomon::rg8>({}).size() == gnomon::extent{0, 0});
    CHECK(map_of<gnomon::rg8>({}).tiles().tiles().tile() == 32);
}

TEST_CASE("casting nothing leaves a lit map: empty, inverted and far away rectangles") { suite::casting_nothing(run); }

TEST_CASE("a caster of no depth lies at the far plane, one beyond the planes on them, and a receiver of no depth is lit") {
    suite::odd_depths(run);
}

TEST_CASE_TEMPLATE("opacity is the intensity of an opaque caster's shadow, in umbra and penumbra", Texel, gnomon::rga8,
                   gnomon::rga16, gnomon::rga16f, gnomon::rgba32f, test::ratio_rgba16) {
    suite::opacity_is_intensity<Texel>(run);
}

TEST_CASE_TEMPLATE("a far bound ends the shadow at the first receiver, and only where one was drawn", Texel, gnomon::rgb8,
                   gnomon::rgb16, gnomon::rgba16f, gnomon::rgba32f, test::ratio_rgba8) {
    suite::far_bound_ends_the_shadow<Texel>(run);
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

TEST_CASE("a point with x, y and depth is asked as its three numbers are") { suite::points_of_three_numbers(run); }

TEST_CASE("a receiver before its caster is reached unless the bias is towards light") { suite::reached_under_a_bias(run); }

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

TEST_CASE_TEMPLATE("sample, receive and receive_row give the bits of the one-point forms, and so does an image of receivers", Texel,
                   gnomon::rg8, gnomon::rgba16, gnomon::rgb16f, gnomon::rga32f, test::ratio_rgba16, test::paper32f) {
    suite::many_are_as_one<Texel>(run);
}

TEST_CASE_TEMPLATE("what an executor filters as jobs is what is filtered at once", Texel, gnomon::rg8, gnomon::rgba32f) {
    suite::jobs_are_as_one<Texel>(run);
}

TEST_CASE("the decision can be changed between reads, and acts on all of them") { suite::decision_acts_on_all(run); }

TEST_CASE("a receiver that the map does not reach is lit, and reaches asks its tiles") { suite::reaches_asks_tiles(run); }

TEST_CASE_TEMPLATE("clear forgets every caster, but the filtered map stays readable until the next filter", Texel, gnomon::rg8,
                   gnomon::rgba16f, test::paper32f) {
    suite::clear_forgets<Texel>(run);
}

TEST_CASE_TEMPLATE("filter has no memory: twice is once, and casting between two adds", Texel, gnomon::rg8, gnomon::rgba16,
                   gnomon::rgb32f, gnomon::tm16, test::paper8) {
    suite::filter_has_no_memory<Texel>(run, 20);
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

TEST_CASE("casters that are marked piece by piece cost what each covers, and each tile knows the depths of its own") {
    map_of<gnomon::rg16> map({.width = 256, .height = 256, .tile = 32});
    const texel_rect first{4, 4, 20, 20}, last{230, 230, 250, 250};
    map.cast([&](auto texels, const auto& marks) {
        texels.fill(first, gnomon::rg16::caster(0.25f));
        marks(first, {0.25f, 0.25f});
        texels.fill(last, gnomon::rg16::caster(0.75f));
        marks(last, {0.75f, 0.75f});
    });
    map.filter();
    CHECK(map.tiles().tiles().count() == 2);
    CHECK(
        (map.reaches(first, {0.5f, 0.5f}) && !map.reaches(last, {0.5f, 0.5f}) && !map.reaches({100, 100, 120, 120}, {1.0f, 1.0f})));
    CHECK((map.shadow(10, 10, 0.5f) > 0.9f && map.shadow(240, 240, 0.9f) > 0.9f));
}

TEST_CASE("a caster at a depth that is no number lies on the far plane, where it is stored and where it is marked") {
    map_of<gnomon::rg16> map({.width = 32, .height = 32, .tile = 32});
    map.cast({4, 4, 20, 20}, test::nan<float>);
    CHECK((map.reaches({4, 4, 20, 20}, {0.5f, 1.5f}) && !map.reaches({4, 4, 20, 20}, {0.5f, 0.75f})));
}
