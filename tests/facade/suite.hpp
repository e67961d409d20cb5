// What a map promises, whatever backend it runs on: written once, a function for each promise, and run by facade.cpp and gl/.
#pragma once

#include "../support/backends.hpp"
#include "../support/bits.hpp"
#include "../support/filtering.hpp"
#include "../support/formats.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

namespace test::facade {
using gnomon::binomial;
using gnomon::extent;
using gnomon::map_size;
using gnomon::soft_shadow_map;
using gnomon::texel_rect;
inline constexpr float no_depth = nan<float>, inf = infinity<float>;
inline constexpr int lowest = std::numeric_limits<int>::min(), highest = std::numeric_limits<int>::max();

template <typename Texel, typename Backend> using map_on = soft_shadow_map<Texel, binomial<3>, Backend>;
template <typename Map> using texel_of = std::remove_const_t<typename decltype(std::declval<const Map&>().soft())::element_type>;

template <typename Map> bool lit_everywhere(const Map& map) {
    const auto soft = map.soft();
    int dark = 0;
    for_each_texel(whole(map.size()),
                   [&](int x, int y) { dark += !(soft(x, y) == texel_of<Map>::clear()) || map.shadow(x, y, 2.0f) > 0.0f; });
    return dark == 0;
}
template <typename Map> bool same_bits_in(const Map& a, const Map& b) {
    return a.size() == b.size() && differences(a.soft(), b.soft(), whole(a.size())) == 0;
}
/// One caster for certain, a few at random, and a ground where the format has one.
template <typename Map> void populate(Map& map, dice& roll) {
    map.cast({15, 12, 30, 22}, 0.2f + 0.5f * roll.unit());
    for (int n = roll(0, 3); n > 0; --n) map.cast(roll.rect(map.size(), 8), roll.unit());
    if constexpr (requires { map.bound(texel_rect{}, 1.0f); }) map.bound(whole(map.size()), roll.unit());
}

template <typename Backend> void ten_lines(const Backend& run) {
    map_on<gnomon::rg8, Backend> map({.width = 512, .height = 512, .tile = 16}, run);
    map.cast({.x0 = 200, .y0 = 200, .x1 = 300, .y1 = 300}, 0.4f);
    map.filter();
    CHECK(equal(map.shadow(10, 10, 0.9f), 0.0f));
    CHECK(equal(map.shadow(250, 250, 0.9f), 1.0f));
    CHECK(equal(map.shadow(199, 250, 0.9f), 88.0f / 255.0f)); // 22 of 64 taps, of 255
    CHECK(equal(map.shadow(250, 250, 0.2f), 0.0f));
}

/// Maps of nothing, of one texel, of one row, and smaller than their kernel.
template <typename Texel, typename Backend> void maps_of_nothing(const Backend& run) {
    using kernel = gnomon::gaussian<16>;
    for (const extent size : {extent{0, 0}, {0, 9}, {9, 0}, {-5, -7}, {1, 1}, {65, 1}, {1, 65}, {5, 4}})
        for (const int tile : {1, 32, highest}) {
            soft_shadow_map<Texel, kernel, Backend> map({size.width, size.height, tile}, run);
            for (int frame = 0; frame < 2; ++frame) {
                map.clear();
                map.cast({-3, -3, 99, 99}, 0.5f);
                if constexpr (Texel::effects.far_bound) map.bound({-3, -3, 99, 99}, 0.9f);
                map.filter();
                CHECK(map.size() == extent{size.width < 0 ? 0 : size.width, size.height < 0 ? 0 : size.height});
                CHECK(equal(map.shadow(-1, 0, 0.8f), 0.0f));
                CHECK(equal(map.shadow(0, map.size().height, 0.8f), 0.0f));
                gnomon::image<Texel> casters(map.size(), Texel::caster(0.5f));
                if constexpr (Texel::effects.far_bound)
                    for_each_texel(whole(map.size()), [&](int x, int y) { casters(x, y).bound(0.9f); });
                const auto expected = dense<filters_as_kernel<Backend, Texel, kernel>>(casters);
                CHECK(differences<Texel>(map.soft(), expected.view(), whole(map.size())) == 0);
                CHECK(equal(map.shadow_at(0.5f, 0.5f, 0.8f), map.shadow(0, 0, 0.8f)));
                CHECK(map.reaches({0, 0, 1, 1}, {0.7f, 0.8f}) == !size.empty());
                const float z[2] = {0.8f, 0.8f};
                float intensity[2] = {7.0f, 7.0f};
                map.receive_row(-1, z, intensity);
                CHECK(equal(intensity[0] + intensity[1], 0.0f));
            }
        }
}

/// Empty, inverted and far away rectangles.
template <typename Backend> void casting_nothing(const Backend& run) {
    map_on<gnomon::rgba8, Backend> map({.width = 40, .height = 30, .tile = 8}, run);
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
    CHECK(equal(map.shadow(20, 15, 0.6f), 1.0f));
}

/// A caster of no depth, and one beyond the planes.
template <typename Backend> void odd_depths(const Backend& run) {
    struct given {
        float depth, as;
    };
    for (const given g : {given{no_depth, 1.0f}, {inf, 1.0f}, {-inf, 0.0f}, {-3.0f, 0.0f}, {7.0f, 1.0f}}) {
        map_on<gnomon::rg16, Backend> odd({.width = 20, .height = 20, .tile = 8}, run), plain(map_size{20, 20, 8}, run);
        odd.cast({5, 5, 12, 12}, g.depth);
        plain.cast({5, 5, 12, 12}, g.as);
        odd.filter();
        plain.filter();
        CAPTURE(g.depth);
        CHECK(same_bits_in(odd, plain));
        CHECK(equal(odd.shadow(8, 8, 2.0f), 1.0f));
        CHECK(odd.reaches({8, 8, 9, 9}, {2.0f, 2.0f}));
        for (const float z : {no_depth, -inf, -1.0f, 0.0f}) CHECK(equal(odd.shadow(8, 8, z), 0.0f));
    }
}

template <typename Texel, typename Backend> void opacity_is_intensity(const Backend& run) {
    for (const float opacity : {0.0f, 0.25f, 0.5f, 1.0f, 2.0f, -1.0f, no_depth}) {
        map_on<Texel, Backend> map({.width = 40, .height = 30, .tile = 8}, run), opaque(map_size{40, 30, 8}, run);
        map.cast({10, 10, 30, 20}, 0.5f, opacity);
        opaque.cast({10, 10, 30, 20}, 0.5f);
        map.filter();
        opaque.filter();
        float worst = 0.0f;
        for_each_texel(whole(map.size()), [&](int x, int y) {
            const float difference = map.shadow(x, y, 0.9f) - gnomon::saturate(opacity) * opaque.shadow(x, y, 0.9f);
            worst = std::max(worst, difference < 0 ? -difference : difference);
        });
        CAPTURE(opacity);
        CHECK(worst <= 2 * Texel::channel_type::max_error);
    }
}

template <typename Texel, typename Backend> void far_bound_ends_the_shadow(const Backend& run) {
    map_on<Texel, Backend> map({.width = 60, .height = 30, .tile = 8}, run);
    map.cast({5, 5, 50, 25}, 0.3f);
    map.bound({0, 0, 30, 30}, 0.6f);
    map.bound({0, 0, 30, 30}, 0.2f); // before the caster: bounds nothing
    map.bound({0, 0, 30, 30}, 0.8f); // behind the first: too late
    map.filter();
    CHECK(equal(map.shadow(15, 15, 0.2f), 0.0f));
    CHECK(equal(map.shadow(15, 15, 0.45f), 1.0f));
    CHECK(equal(map.shadow(15, 15, 0.6f), 1.0f)); // the receiver itself
    CHECK(equal(map.shadow(15, 15, 0.7f), 0.0f));
    CHECK(equal(map.shadow(44, 15, 0.7f), 1.0f));
    map.decision.fade = 0.5f;
    CHECK(map.shadow(15, 15, 0.7f) > 0.7f);
    CHECK(map.shadow(15, 15, 0.7f) < 0.9f);
}

/// Anything with x, y and depth is a point.
template <typename Backend> void points_of_three_numbers(const Backend& run) {
    struct {
        double x, y, depth;
    } const point{10.25, 4.75, 0.75}; // at a corner, so that neither number does for the other
    map_on<gnomon::rg16, Backend> map({.width = 20, .height = 20, .tile = 8}, run);
    map.cast({10, 5, 15, 15}, 0.5f);
    map.filter();
    CHECK(map.shadow_at(point) > 0.1f);
    CHECK(same_bits(map.shadow_at(point), map.shadow_at(10.25f, 4.75f, 0.75f)));
}

template <typename Backend> void reached_under_a_bias(const Backend& run) {
    map_on<gnomon::rg8, Backend> map({.width = 20, .height = 20, .tile = 8}, run);
    map.cast({5, 5, 15, 15}, 0.5f);
    map.filter();
    for (const gnomon::bias b : {gnomon::towards_light, gnomon::unbiased, gnomon::towards_shadow}) {
        map.decision.caster = b;
        CHECK(map.reaches({8, 8, 9, 9}, {0.3f, 0.4f}) == (b.towards != gnomon::bias_towards::light));
        CHECK(map.reaches({8, 8, 9, 9}, {0.6f, 0.7f}));
    }
    for (const float depth : {-0.25f, 0.0f, 0.25f}) { // nearer by a quarter, a receiver is shadowed before its caster
        map.decision.caster = {.depth = depth};
        CHECK((map.shadow(8, 8, 0.4f) > 0.0f) == (depth < 0.0f));
        CHECK(map.reaches({8, 8, 9, 9}, {0.3f, 0.4f}) == (depth < 0.0f));
    }
}

template <typename Backend> void reaches_asks_tiles(const Backend& run) {
    map_on<gnomon::rg16, Backend> map({.width = 64, .height = 64, .tile = 8}, run);
    map.cast({20, 20, 30, 30}, 0.5f);
    map.filter();
    CHECK(map.reaches({0, 0, 64, 64}));
    CHECK(map.reaches({31, 31, 32, 32}, {0.6f, 0.9f}));
    CHECK_FALSE(map.reaches({31, 31, 32, 32}, {0.1f, 0.5f}));
    CHECK_FALSE(map.reaches({40, 40, 50, 50}));
    CHECK(map.reaches({10, 10, 40, 40}, {0.4f, 0.6f}) == gnomon::casters_reach(map.tiles(), {10, 10, 40, 40}, {0.4f, 0.6f}));
}

/// sample and every receive give the bits of the one-point forms.
template <typename Texel, typename Backend> void many_are_as_one(const Backend& run) {
    dice roll(142);
    map_on<Texel, Backend> map({.width = 50, .height = 40, .tile = 8}, run);
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
        wrong += !same_bits(points[i], map.shadow_at(x[i], y[i], z[i]));
        wrong += !same_bits(points[i], gnomon::shadow(gnomon::sample(map.soft(), x[i], y[i]), z[i], map.decision));
    }
    for (const int line : {-1, 0, 20, 39, 40, lowest, highest}) {
        map.receive_row(line, z, row);
        for (int i = 0; i < 50; ++i)
            wrong += !same_bits(row[static_cast<std::size_t>(i)], map.shadow(i, line, z[static_cast<std::size_t>(i)]));
    }
    gnomon::image<float> depths(map.size()), image_of_rows(map.size(), 7.0f);
    for_each_texel(whole(map.size()), [&](int x_of, int y_of) { depths(x_of, y_of) = roll.unit(); });
    map.receive(depths.view(), image_of_rows.view(), gnomon::sequential{});
    int dark = 0;
    for_each_texel(whole(map.size()), [&](int x_of, int y_of) {
        wrong += !same_bits(image_of_rows(x_of, y_of), map.shadow(x_of, y_of, depths(x_of, y_of)));
        dark += image_of_rows(x_of, y_of) > 0.0f;
    });
    CHECK(dark > 50);
    for (int i = 0; i < 40; ++i)
        wrong += !same_bits(map.shadow(20, i, 0.9f), map.shadow_at(20.5f, static_cast<float>(i) + 0.5f, 0.9f));
    CHECK(wrong == 0);
}

/// What an executor filters as jobs is what is filtered at once.
template <typename Texel, typename Backend> void jobs_are_as_one(const Backend& run) {
    dice roll(145), again(145);
    map_on<Texel, Backend> map({.width = 50, .height = 40, .tile = 8}, run), by_jobs({.width = 50, .height = 40, .tile = 8}, run);
    populate(map, roll);
    populate(by_jobs, again);
    map.filter();
    by_jobs.filter(gnomon::sequential{});
    CHECK(same_bits_in(map, by_jobs));
}

/// The decision can be changed between reads, and acts on all of them.
template <typename Backend> void decision_acts_on_all(const Backend& run) {
    map_on<gnomon::rg8, Backend> map({.width = 40, .height = 30, .tile = 8}, run);
    map.cast({10, 10, 30, 20}, 0.5f);
    map.filter();
    const auto answers = [&](float z) {
        const float x[1] = {20.5f}, y[1] = {15.5f}, depth[1] = {z};
        float points[1];
        map.receive(x, y, depth, points);
        std::vector<float> row(40), depths(40, z);
        map.receive_row(15, depths, row);
        CHECK(equal(map.shadow(20, 15, z), points[0]));
        CHECK(equal(map.shadow(20, 15, z), row[20]));
        return points[0];
    };
    const float just_behind = 0.502f;
    CHECK(equal(answers(just_behind), 0.0f)); // towards light
    map.decision = gnomon::rule{.caster = gnomon::towards_shadow};
    CHECK(equal(answers(just_behind), 1.0f));
    CHECK(equal(answers(1.5f), 1.0f));
    map.decision.lit_beyond = true;
    CHECK(equal(answers(1.5f), 0.0f));
}

/// The filtered map stays readable until the next filter.
template <typename Texel, typename Backend> void clear_forgets(const Backend& run) {
    dice roll(143);
    map_on<Texel, Backend> map({.width = 50, .height = 40, .tile = 8}, run);
    populate(map, roll);
    map.filter();
    gnomon::image<Texel> before(map.size());
    for_each_texel(whole(map.size()), [&](int x, int y) { before(x, y) = map.soft()(x, y); });
    CHECK_FALSE(lit_everywhere(map));
    map.clear();
    CHECK(differences<Texel>(map.soft(), before.view(), whole(map.size())) == 0);
    CHECK(map.tiles().tiles().empty());
    map.filter();
    CHECK(lit_everywhere(map));
    if constexpr (has_casters_on_the_host<decltype(map)>) {
        int left = 0;
        for_each_texel(whole(map.size()), [&](int x, int y) { left += !(map.casters()(x, y) == Texel::clear()); });
        CHECK(left == 0);
    }
}

/// Twice is once, and casting between two adds.
template <typename Texel, typename Backend> void filter_has_no_memory(const Backend& run, int seeds) {
    for (int seed = 0; seed < seeds; ++seed) {
        dice roll(144 + static_cast<std::uint64_t>(seed)), again(144 + static_cast<std::uint64_t>(seed));
        map_on<Texel, Backend> twice({.width = 50, .height = 40, .tile = 8}, run), once(map_size{50, 40, 8}, run);
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

} // namespace test::facade
