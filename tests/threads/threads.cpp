// What several threads may do at once: read what no one writes, and write what no one else touches. Built with the thread sanitizer
// these are race-free; in every build they have the bits of one thread.
#include <gnomon/backend/simd.hpp>
#include <gnomon/grid/reference_grid.hpp>
#include <gnomon/receive/lightmap.hpp>
#include <gnomon/soft_shadow_map.hpp>

#include "../../examples/jthread_pool.hpp"
#include "../support/bits.hpp"
#include "../support/filtering.hpp"
#include "../support/formats.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace {
using gnomon::extent;
using gnomon::image;
using gnomon::texel_rect;

/// Calls work(0) ... work(count - 1), each in a thread of its own.
template <typename F> void at_once(int count, F&& work) {
    std::vector<std::thread> threads;
    for (int i = 0; i < count; ++i) threads.emplace_back([&work, i] { work(i); });
    for (std::thread& each : threads) each.join();
}

/// The i-th of `count` parts of [0, all).
int part(int i, int count, int all) { return all * i / count; }

constexpr extent size{61, 47};

/// A map with a frame in it.
template <typename Texel> gnomon::soft_shadow_map<Texel> filtered_map() {
    test::dice roll(21);
    gnomon::soft_shadow_map<Texel> map({.width = size.width, .height = size.height, .tile = 8});
    for (int i = 0; i < 9; ++i) map.cast(roll.rect(size, 5), roll.unit());
    map.filter();
    return map;
}

/// Everything a reader can ask of a map, as one number.
template <typename Texel> double all_that_is_read(const gnomon::soft_shadow_map<Texel>& map) {
    double sum = 0.0;
    for (int y = -1; y <= size.height; ++y)
        for (int x = -1; x <= size.width; ++x) {
            const float fx = static_cast<float>(x), fy = static_cast<float>(y), z = static_cast<float>((x * 7 + y) % 64) / 64.0f;
            sum = sum * 0.5 + static_cast<double>(map.shadow(x, y, z) + map.shadow_at(fx, fy, z)) +
                  (map.reaches({x, y, x + 3, y + 2}, {z, z}) ? 1.0 : 0.0);
        }
    gnomon::for_each_tile_rect(map.tiles().tiles(), [&sum](gnomon::tile_rect t) { sum = sum * 0.5 + t.x0 + t.y0 * t.x1 + t.y1; });
    gnomon::for_each_region(map.tiles().tiles(), [&sum](texel_rect r) { sum = sum * 0.5 + r.x0 + r.y0 * r.x1 + r.y1; });
    std::vector<float> z(static_cast<std::size_t>(size.width), 0.9f), intensity(z.size()), light(z.size(), 0.8f);
    for (int y = 0; y < size.height; ++y) {
        map.receive_row(y, z, intensity);
        gnomon::mask_light(light, intensity, 0.1f, light);
        for (const float each : light) sum = sum * 0.5 + static_cast<double>(each);
    }
    return sum;
}
} // namespace

TEST_CASE_TEMPLATE("threads may read one map at once and read what one alone does", Texel, gnomon::rg8, gnomon::rg16f) {
    const auto map = filtered_map<Texel>();
    const double alone = all_that_is_read(map);
    for (int count = 1; count <= 4; ++count) {
        std::vector<double> read(static_cast<std::size_t>(count));
        at_once(count, [&](int i) { read[static_cast<std::size_t>(i)] = all_that_is_read(map); });
        for (const double each : read) CHECK(test::same_bits(each, alone));
    }
}

TEST_CASE("threads may ask one reference grid at once") {
    gnomon::reference_grid grid({512, 512}, 2);
    grid.cast({100.5, 40.0, 180.0, 99.0});
    grid.cast({300.0, 300.0, 310.0, 500.0});
    const auto ask = [&grid] {
        int sum = 0;
        grid.for_each_tile_rect([&sum](gnomon::tile_rect t) { sum = sum % 9973 * 31 + t.x0 + t.y0 + t.x1 + t.y1; });
        for (int y = 0; y < 512; y += 16)
            for (int x = 0; x < 512; x += 16) sum += grid.receives({1.0 * x, 1.0 * y, x + 9.0, y + 9.0}) ? x + y : 0;
        return sum + grid.blur_scissor().x0;
    };
    const int alone = ask();
    std::vector<int> answers(4);
    at_once(4, [&](int i) { answers[static_cast<std::size_t>(i)] = ask(); });
    CHECK(answers == std::vector<int>(4, alone));
}

TEST_CASE_TEMPLATE("threads that filter regions of their own, each with its scratch, make the map that one thread makes", Texel,
                   gnomon::rg8, gnomon::rg16, gnomon::rg32f) {
    using kernel = gnomon::gaussian<4>;
    test::dice roll(22);
    const image<Texel> from = test::noise<Texel>(roll, size, 4);
    const image<Texel> alone = test::dense<kernel>(from);
    for (int count = 1; count <= 4; ++count)
        for (const bool columns : {false, true}) {
            image<Texel> to(size, Texel::clear());
            at_once(count, [&](int i) {
                gnomon::filter_scratch<Texel, kernel> scratch(size.width);
                const int all = columns ? size.width : size.height, first = part(i, count, all), last = part(i + 1, count, all);
                const texel_rect mine = columns ? texel_rect{first, 0, last, size.height} : texel_rect{0, first, size.width, last};
                gnomon::filter_region(from.view(), to.view(), mine, scratch);
            });
            CHECK(test::differences(alone, to) == 0);
        }
}

TEST_CASE("threads may cast into rows of their own of one image") {
    using texel = gnomon::rgba16;
    image<texel> alone(size, texel::clear()), together(size, texel::clear());
    const auto draw = [](image<texel>& into, int y0, int y1) {
        for (int y = y0; y < y1; ++y)
            for (int x = 0; x < size.width; ++x) {
                into(x, y).cast(texel::caster(static_cast<float>(x) / 64.0f, static_cast<float>(y) / 64.0f));
                into(x, y).bound(0.75f);
            }
    };
    draw(alone, 0, size.height);
    at_once(4, [&](int i) { draw(together, part(i, 4, size.height), part(i + 1, 4, size.height)); });
    CHECK(test::differences(alone, together) == 0);
}

namespace {
/// An executor that starts its threads anew: each takes the next job until there is none.
struct on_threads {
    int threads;
    template <typename Job> void operator()(int count, const Job& job) const {
        std::atomic<int> next{0};
        at_once(threads, [&](int) {
            for (int i = next++; i < count; i = next++) job(i);
        });
    }
};
constexpr int thread_counts[] = {1, 2, 3, 7};
} // namespace

TEST_CASE_TEMPLATE("frames that are filtered on any number of threads, in any number of bands, have the bits of one thread",
                   Backend, gnomon::scalar, gnomon::simd<>) {
    using kernel = gnomon::binomial<4>;
    constexpr extent large{460, 301};
    for (const int threads : thread_counts) {
        jthread_pool pool(static_cast<unsigned>(threads)); // the example's, which waits for frames
        for (const int bands : {1, 5, 16}) {
            test::dice roll(23);
            gnomon::soft_shadow_map<gnomon::rg8, kernel, Backend> map({large.width, large.height, 16, bands}),
                alone({large.width, large.height, 16, bands});
            for (int frame = 0; frame < 6; ++frame) {
                map.clear();
                alone.clear();
                for (int n = frame == 4 ? 60 : roll(0, 6); n > 0; --n) { // one frame is filtered whole
                    const texel_rect r = roll.rect(large, 20);
                    const float s = roll.unit();
                    map.cast(r, s);
                    alone.cast(r, s);
                }
                if ((frame + bands) % 2 == 0)
                    map.filter(pool);
                else
                    map.filter(on_threads{threads});
                alone.filter();
                CHECK(test::differences<gnomon::rg8>(map.soft(), alone.soft(), whole(large)) == 0);
            }
        }
    }
}

TEST_CASE("a whole map filtered, and an image of receivers decided, on any number of threads have the bits of one") {
    using kernel = gnomon::gaussian<3>;
    constexpr extent large{300, 333};
    test::dice roll(24);
    const image<gnomon::rg16> from = test::noise<gnomon::rg16>(roll, large, 4);
    const image<gnomon::rg16> expected = test::dense<kernel>(from);
    const image<float> z(large, 0.5f);
    image<float> lit(large);
    gnomon::receive(expected.view(), z.view(), lit.view());
    for (const int threads : thread_counts)
        for (const int bands : {2, 7, 16}) {
            image<gnomon::rg16> to(large, gnomon::rg16::clear());
            image<float> made(large);
            gnomon::band_scratch<gnomon::rg16, kernel> scratch(large.width, bands);
            gnomon::filter(gnomon::simd<>{}, from.view(), to.view(), whole(large), scratch, on_threads{threads});
            gnomon::receive(gnomon::simd<>{}, to.view(), z.view(), made.view(), {}, on_threads{threads});
            CHECK(test::differences(to, expected) == 0);
            CHECK(test::differences(made, lit) == 0);
        }
}
