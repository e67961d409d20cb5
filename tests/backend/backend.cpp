// The concept with a model and near misses, the stages with a backend that counts, and the scalar one against the free functions.
#include <gnomon/backend/executor.hpp>
#include <gnomon/backend/scalar.hpp>
#include <gnomon/soft_shadow_map.hpp>

#include "suite.hpp"

#include "../support/formats.hpp"
#include "../support/lanes.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace {
using gnomon::backend_for;
using gnomon::binomial;
using gnomon::box;
using gnomon::extent;
using gnomon::filter_scratch;
using gnomon::image;
using gnomon::image_view;
using gnomon::rg8;
using gnomon::rule;
using gnomon::scalar;
using gnomon::strided_span;
using gnomon::texel_format;
using gnomon::texel_rect;
using test::dice;

/// A backend of a user's: does what scalar does, and keeps count.
struct counting : scalar {
    struct counts {
        std::vector<texel_rect> regions{};
        int rows = 0;
        int points = 0;
    };
    counts* seen = nullptr;

    template <texel_format Texel, gnomon::kernel Kernel>
    void filter_region(image_view<const Texel> from, image_view<Texel> to, texel_rect region,
                       filter_scratch<Texel, Kernel>& scratch) const noexcept {
        seen->regions.push_back(region);
        scalar::filter_region(from, to, region, scratch);
    }
    template <texel_format Texel>
    void receive(strided_span<const Texel> texels, strided_span<const float> z, strided_span<float> intensity,
                 const rule& r) const noexcept {
        ++seen->rows;
        scalar::receive(texels, z, intensity, r);
    }
    template <texel_format Texel>
    void receive(image_view<const Texel> map, strided_span<const float> x, strided_span<const float> y, strided_span<const float> z,
                 strided_span<float> intensity, const rule& r) const noexcept {
        seen->points += z.size();
        scalar::receive(map, x, y, z, intensity, r);
    }
};

} // namespace

/// Only what they declare is asked, so they need no bodies.
namespace near_miss {
struct may_throw : scalar {
    void filter_region(image_view<const rg8>, image_view<rg8>, texel_rect, filter_scratch<rg8, box<1>>&) const;
};
struct needs_state : scalar { // not const
    void filter_region(image_view<const rg8>, image_view<rg8>, texel_rect, filter_scratch<rg8, box<1>>&) noexcept;
};
struct filters_only {
    void filter_region(image_view<const rg8>, image_view<rg8>, texel_rect, filter_scratch<rg8, box<1>>&) const noexcept;
};
struct rows_only : filters_only {
    void receive(strided_span<const rg8>, strided_span<const float>, strided_span<float>, const rule&) const noexcept;
};
struct points_only : filters_only {
    void receive(image_view<const rg8>, strided_span<const float>, strided_span<const float>, strided_span<const float>,
                 strided_span<float>, const rule&) const noexcept;
};
struct only_rg8 : rows_only { // and that suffices
    using rows_only::receive;
    void receive(image_view<const rg8>, strided_span<const float>, strided_span<const float>, strided_span<const float>,
                 strided_span<float>, const rule&) const noexcept;
};
struct receives_only { // which suffices to receive
    void receive(strided_span<const rg8>, strided_span<const float>, strided_span<float>, const rule&) const noexcept;
    void receive(image_view<const rg8>, strided_span<const float>, strided_span<const float>, strided_span<const float>,
                 strided_span<float>, const rule&) const noexcept;
};
} // namespace near_miss

namespace {
static_assert(backend_for<scalar, rg8, box<1>> && backend_for<scalar, gnomon::rgba32f, gnomon::gaussian<8>> &&
              backend_for<scalar, test::paper8, binomial<3>>);
static_assert(backend_for<counting, rg8, box<1>> && backend_for<near_miss::only_rg8, rg8, box<1>>);
static_assert(!backend_for<near_miss::may_throw, rg8, box<1>> && !backend_for<near_miss::filters_only, rg8, box<1>> &&
              !backend_for<near_miss::rows_only, rg8, box<1>> && !backend_for<near_miss::points_only, rg8, box<1>> &&
              !backend_for<near_miss::needs_state, rg8, box<1>>);
static_assert(!backend_for<near_miss::only_rg8, gnomon::rg16, box<1>> && !backend_for<near_miss::only_rg8, rg8, box<2>> &&
              !backend_for<scalar, int, box<1>> && !backend_for<scalar, rg8, int> && !backend_for<int, rg8, box<1>>);
static_assert(gnomon::receives<near_miss::only_rg8, rg8> && gnomon::receives<near_miss::receives_only, rg8> &&
              !backend_for<near_miss::receives_only, rg8, box<1>> && !gnomon::receives<near_miss::receives_only, gnomon::rg16> &&
              !gnomon::receives<near_miss::rows_only, rg8> && !gnomon::receives<near_miss::points_only, rg8>);
template <typename B>
concept is_taken_by_receive = requires(const B& run, image_view<const rg8> map, image_view<float> all, strided_span<float> some) {
    gnomon::receive(run, map.row_span(0), some, some);
    gnomon::receive(run, map, some, some, some, some);
    gnomon::receive(run, map, all, all);
    gnomon::receive(run, map, all, all, rule{}, gnomon::sequential{});
};
static_assert(is_taken_by_receive<near_miss::receives_only> && !is_taken_by_receive<near_miss::filters_only>);
} // namespace

TEST_CASE_TEMPLATE("the scalar backend is the free functions", Texel, rg8, gnomon::rgba16, gnomon::rgb16f, gnomon::rga32f,
                   test::ratio_rgba8, test::paper32f) {
    test::is_the_free_functions<Texel>(scalar{});
}

TEST_CASE("filter hands its backend disjoint regions that hold what its radius reaches, whatever the guard band, and the whole map "
          "if that is most of it") {
    counting::counts seen;
    counting run;
    run.seen = &seen;
    const image<rg8> casters({64, 48}, rg8::clear());
    image<rg8> soft({64, 48}, rg8::clear());
    filter_scratch<rg8, binomial<3>> scratch(64);
    gnomon::tile_grid tiles({64, 48}, 16);
    gnomon::filter(run, casters.view(), soft.view(), tiles, scratch);
    CHECK(seen.regions.empty());
    tiles.mark({4, 4, 8, 8}, 3);
    tiles.mark({36, 36, 60, 44}, 3);
    gnomon::filter(run, casters.view(), soft.view(), tiles, scratch);
    CHECK(seen.regions == std::vector<texel_rect>{{0, 0, 16, 16}, {32, 32, 64, 48}});
    seen.regions.clear();
    tiles.mark({4, 4, 8, 8}, 2);
    gnomon::filter(run, casters.view(), soft.view(), tiles, scratch);
    CHECK(seen.regions == std::vector<texel_rect>{{0, 0, 19, 19}, {29, 29, 64, 48}});
    seen.regions.clear();
    tiles.mark({0, 4, 64, 40}, 3);
    gnomon::filter(run, casters.view(), soft.view(), tiles, scratch);
    CHECK(seen.regions == std::vector<texel_rect>{{0, 0, 64, 48}});
}

TEST_CASE("the facade runs on a backend of a user's, which sees each of its loops") {
    counting::counts seen;
    counting run;
    run.seen = &seen;
    gnomon::soft_shadow_map<gnomon::rg16, binomial<2>, counting> map({.width = 64, .height = 48, .tile = 16}, run);
    gnomon::soft_shadow_map<gnomon::rg16, binomial<2>> same({.width = 64, .height = 48, .tile = 16});
    map.cast({20, 20, 30, 30}, 0.5f);
    same.cast({20, 20, 30, 30}, 0.5f);
    map.filter();
    same.filter();
    CHECK(seen.regions == std::vector<texel_rect>{{16, 16, 32, 32}});
    CHECK(test::differences<gnomon::rg16>(map.soft(), same.soft(), whole(map.size())) == 0);
    const float z[3] = {0.9f, 0.9f, 0.9f}, x[3] = {1.0f, 25.0f, 19.5f};
    float intensity[3];
    map.receive(x, x, z, intensity);
    map.receive_row(25, z, intensity);
    CHECK(seen.points == 3);
    CHECK(seen.rows == 1);
}

static_assert(sizeof(gnomon::soft_shadow_map<rg8, box<1>, counting>) ==
                  sizeof(gnomon::soft_shadow_map<rg8, box<1>, scalar>) + sizeof(counting),
              "a backend without state costs no byte");

TEST_CASE("a whole image of receivers is decided row by row, as far as the map, the depths and the intensities all reach") {
    dice roll(462);
    const image<rg8> map = test::noise<rg8>(roll, {21, 9}, 2);
    for (const extent size : {extent{21, 9}, {30, 5}, {13, 12}}) {
        image<std::uint16_t> z(size);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) z(x, y) = static_cast<std::uint16_t>(roll(0, 65535));
        std::vector<std::uint8_t> expected(std::size_t{19 * 8}, std::uint8_t{77}), made = expected;
        gnomon::receive(map.view(), z.view(), image_view<std::uint8_t>(expected.data(), {19, 8}));
        gnomon::receive(gnomon::simd<>{}, map.view(), z.view(), image_view<std::uint8_t>(made.data(), {19, 8}));
        CHECK(made == expected);
        CHECK((made.back() == 77) == (size.width < 19 || size.height < 8));
    }
}

TEST_CASE("what lanes know is left to the lanes that are named") {
    const image<rg8> casters({48, 3}, rg8::caster(0.5f));
    image<rg8> soft(casters.size());
    filter_scratch<rg8, binomial<1>> scratch(48);
    std::vector<float> at(48, 1.5f), z(48, 0.75f), intensity(48);
    const gnomon::simd<test::counted_lanes> run;
    int& loads = test::counted_lanes::loads;
    test::counted_lanes::forget();
    run.filter_region(casters.view(), soft.view(), whole(soft.size()), scratch);
    CHECK(std::exchange(loads, 0) > 0);
    run.receive(image_view<const rg8>(soft.view()).row_span(0), strided_span<const float>(z), strided_span<float>(intensity),
                rule{});
    CHECK(std::exchange(loads, 0) > 0);
    run.receive(image_view<const rg8>(soft.view()), strided_span<const float>(at), strided_span<const float>(at),
                strided_span<const float>(z), strided_span<float>(intensity), rule{});
    CHECK(std::exchange(loads, 0) > 0);
}
