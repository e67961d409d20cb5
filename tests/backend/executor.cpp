// Executors: what models one, what jobs they are given, and that no result depends on them. tests/threads has them on threads.
#include <gnomon/backend/executor.hpp>
#include <gnomon/backend/simd.hpp>
#include <gnomon/soft_shadow_map.hpp>

#include "../support/bits.hpp"
#include "../support/filtering.hpp"
#include "../support/formats.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace {
using gnomon::band_scratch;
using gnomon::box;
using gnomon::executor;
using gnomon::extent;
using gnomon::gaussian;
using gnomon::image;
using gnomon::rg8;
using gnomon::scalar;
using gnomon::simd;
using gnomon::texel_rect;
using gnomon::tile_grid;
using test::dice;

/// Calls the last job first, and remembers how many there were.
struct backwards {
    int* count;
    template <typename Job> void operator()(int jobs, const Job& job) const {
        *count = jobs;
        for (int i = jobs; i-- > 0;) job(i);
    }
};

/// A backend that also counts how often each texel is written.
struct painter : gnomon::scalar {
    image<int>* times = nullptr;
    template <typename Texel, typename Kernel>
    void filter_region(gnomon::image_view<const Texel> from, gnomon::image_view<Texel> to, texel_rect region,
                       gnomon::filter_scratch<Texel, Kernel>& scratch) const noexcept {
        test::for_each_texel(region, [&](int x, int y) { ++(*times)(x, y); });
        scalar::filter_region(from, to, region, scratch);
    }
};

constexpr extent size{300, 261};

/// A map with a few casters in it, and their marks.
template <typename Texel> struct scene {
    image<Texel> casters{size, Texel::clear()};
    tile_grid tiles{size, 16};

    scene(dice& roll, int count, int radius) {
        for (; count > 0; --count) {
            const texel_rect r = roll.rect(size, 10);
            casters.view().fill(r, test::any_caster<Texel>(roll));
            tiles.mark(r, radius);
        }
    }
};
} // namespace

namespace near_miss {
struct no_count {
    void operator()(const std::function<void(int)>& job) const;
};
struct no_job {
    void operator()(int count) const;
};
struct job_without_number {
    void operator()(int count, void (*job)()) const;
};
struct by_pointer {
    void operator()(int count, void (*job)(int)) const;
};
} // namespace near_miss

static_assert(executor<gnomon::sequential> && executor<const gnomon::sequential&> && executor<backwards>);
static_assert(executor<std::function<void(int, std::function<void(int)>)>>); // what a host may have already
static_assert(!executor<near_miss::no_count> && !executor<near_miss::no_job> && !executor<near_miss::job_without_number> &&
              !executor<near_miss::by_pointer> && !executor<int>);

TEST_CASE(
    "bands of rows are disjoint, in order, and make up all rows, and there are no more than asked for, and none without rows") {
    for (const int rows : {0, 1, 2, 63, 64, 65, 1000})
        for (const int most : {-1, 0, 1, 2, 3, 7, 64}) {
            int next = 0, calls = 0, empty = 0, unordered = 0;
            gnomon::in_bands(
                gnomon::sequential{}, rows,
                [&](int y0, int y1) {
                    unordered += y0 != next;
                    empty += y0 >= y1;
                    next = y1;
                    ++calls;
                },
                most);
            CHECK(next == rows);
            CHECK(empty + unordered == 0);
            CHECK(calls <= (most < 1 ? 1 : most));
        }
    int count = 0;
    gnomon::in_bands(backwards{&count}, 1000, [](int, int) {});
    CHECK(count == 64);
    gnomon::in_bands(backwards{&count}, 0, [](int, int) {});
    gnomon::in_bands(backwards{&count}, -5, [](int, int) {});
    CHECK(count == 64); // it was not called
}

TEST_CASE_TEMPLATE("filtered in any number of bands, in any order, a map has the bits of one filtered at once", Texel, rg8,
                   gnomon::rgba16, gnomon::rg32f, test::paper8) {
    dice roll(511);
    using kernel = gaussian<4>;
    for (const int casters : {0, 1, 9, 40}) {
        const scene<Texel> s(roll, casters, kernel::radius);
        const image<Texel> expected = test::dense<kernel>(s.casters);
        for (const int bands : {-1, 1, 2, 3, 5, 16, 61}) {
            int count = 0;
            band_scratch<Texel, kernel> scratch(size.width, bands);
            image<Texel> sparse(size, Texel::clear()), whole_map(size, Texel::caster(0.25f)), in_lanes(size, Texel::clear());
            gnomon::filter(gnomon::scalar{}, s.casters.view(), sparse.view(), s.tiles, scratch, backwards{&count});
            CHECK(count <= scratch.size());
            gnomon::filter(gnomon::scalar{}, s.casters.view(), whole_map.view(), whole(size), scratch, backwards{&count});
            CHECK(count == gnomon::lesser(scratch.size(), 300 * 261 / (1 << 14) + 1));
            gnomon::filter(gnomon::simd<>{}, s.casters.view(), in_lanes.view(), s.tiles, scratch, backwards{&count});
            CHECK(test::differences(sparse, expected) == 0);
            CHECK(test::differences(whole_map, expected) == 0);
            CHECK(test::differences(in_lanes, expected) == 0);
        }
    }
}

TEST_CASE("each texel that has to be written is written by one job, once") {
    dice roll(512);
    using kernel = gnomon::binomial<3>;
    for (int round = 0; round < 40; ++round) {
        const scene<rg8> s(roll, roll(1, 12), kernel::radius);
        image<int> times(size, 0), expected(size, 0);
        painter run;
        run.times = &times;
        image<rg8> soft(size, rg8::clear());
        int count = 0;
        band_scratch<rg8, kernel> scratch(size.width, roll(1, 9));
        gnomon::filter(run, s.casters.view(), soft.view(), s.tiles, scratch, backwards{&count});
        gnomon::for_each_region_to_filter<kernel>(s.tiles, [&](texel_rect r) { expected.view().fill(r, 1); });
        CHECK(test::differences(times, expected) == 0);
    }
}

TEST_CASE("of a region that no texel of both images lies in there is no job, and nothing is written") {
    const image<rg8> casters(size, rg8::caster(0.5f)), before({size.width, 20}, rg8::caster(0.25f));
    image<rg8> soft = before;
    band_scratch<rg8, gaussian<4>> scratch(size.width, 3);
    for (const texel_rect r : {texel_rect{}, {7, 7, 7, 9}, {9, 7, 7, 9}, {400, 0, 500, 90}, {0, 20, 300, 261}}) {
        int count = 0;
        gnomon::filter(gnomon::scalar{}, casters.view(), soft.view(), r, scratch, backwards{&count});
        CHECK(count == 0);
    }
    CHECK(test::differences(soft, before) == 0);
}

TEST_CASE("what marks with depths hold is filtered by an executor as by the same marks without") {
    dice roll(517);
    using kernel = gnomon::binomial<3>;
    image<rg8> casters(size, rg8::clear()), made(size, rg8::clear()), expected(size, rg8::clear());
    gnomon::depth_tiles marked(size, 16);
    for (int n = 0; n < 9; ++n) {
        const texel_rect r = roll.rect(size, 10);
        const float depth = roll.unit();
        casters.view().fill(r, rg8::caster(depth));
        marked.mark(r, {depth, depth}, kernel::radius);
    }
    int count = 0;
    band_scratch<rg8, kernel> scratch(size.width, 5);
    gnomon::filter(gnomon::simd<>{}, casters.view(), made.view(), marked, scratch, backwards{&count});
    gnomon::filter(gnomon::scalar{}, casters.view(), expected.view(), marked.tiles(), scratch[0]);
    CHECK(test::differences(made, expected) == 0);
    CHECK(test::differences(made, image<rg8>(size, rg8::clear())) > 0);
}

TEST_CASE("bands are shared out by area, in eights of rows: none takes more than its part and a few rows") {
    dice roll(513);
    for (int round = 0; round < 40; ++round) {
        std::vector<texel_rect> regions{{7, 9, 8, 10}}; // a single texel too
        std::int64_t all = 1;
        for (int n = roll(0, 11); n > 0; --n) {
            const int x = roll(0, 900), y = roll(0, 900);
            regions.push_back({x, y, x + roll(1, 900), y + roll(1, 900)});
            all += std::int64_t{regions.back().width()} * regions.back().height();
        }
        const auto walk = [&regions](auto&& f) {
            for (const texel_rect r : regions) f(r);
        };
        const gnomon::detail::band_cut cut(walk, round % 2 == 0 ? 7 : 256);
        std::int64_t sum = 0, most = 0;
        int wrong = 0;
        for (int band = 0; band < cut.size() + 3; ++band) {
            std::int64_t mine = 0;
            cut.for_each(band, [&](texel_rect r) {
                mine += std::int64_t{r.width()} * r.height();
                const auto is_cut = [r](texel_rect of) {
                    return of.x0 == r.x0 && of.x1 == r.x1 && (r.y0 - of.y0) % 8 == 0 && (r.y1 == of.y1 || (r.y1 - of.y0) % 8 == 0);
                };
                wrong += band >= cut.size() || r.empty() || std::none_of(regions.begin(), regions.end(), is_cut);
            });
            sum += mine;
            most = gnomon::greater(most, mine);
        }
        CHECK(wrong == 0);
        CHECK(sum == all);
        CHECK(most <= all / cut.size() + 2 * 8 * 900);
    }
}

TEST_CASE_TEMPLATE("frames that are filtered over the last one by an executor are those of a map made from scratch", Texel, rg8,
                   gnomon::rgb16f) {
    dice roll(514);
    using kernel = gnomon::eight_bit<gaussian<5>>;
    int count = 0, most = 0;
    tile_grid before(size, 16);
    image<Texel> soft(size, Texel::clear());
    band_scratch<Texel, kernel> scratch(size.width, 5);
    for (int frame = 0; frame < 30; ++frame) {
        const scene<Texel> s(roll, frame % 10 == 9 ? 60 : roll(0, 5), kernel::radius);
        gnomon::refilter(gnomon::simd<>{}, s.casters.view(), soft.view(), before, s.tiles, scratch, backwards{&count});
        CHECK(test::differences(soft, test::dense<kernel>(s.casters)) == 0);
        most = gnomon::greater(most, count);
        before = s.tiles;
    }
    CHECK(most == 5);
}

TEST_CASE(
    "a frame of more regions than are handed out at once is filtered, and its last one cleared, by several calls, an empty one by "
    "none") {
    constexpr extent scattered{400, 300};
    using kernel = gaussian<1>;
    image<rg8> soft(scattered, rg8::clear());
    band_scratch<rg8, kernel> scratch(scattered.width, 3);
    tile_grid before(scattered, 4);
    int calls = 0;
    const auto on = [&calls](int count, const auto& job) {
        ++calls;
        gnomon::sequential{}(count, job);
    };
    for (const int offset : {0, 6, 0, -1}) { // every third tile in every third row of these; at last none
        image<rg8> casters(scattered, rg8::clear());
        tile_grid now(scattered, 4);
        for (int y = 0; offset >= 0 && y + 12 <= scattered.height; y += 12)
            for (int x = 0; x + 12 <= scattered.width; x += 12) {
                const texel_rect r{x + offset, y + offset, x + offset + 2, y + offset + 2};
                casters.view().fill(r, rg8::caster(0.25f));
                now.mark(r, kernel::radius);
            }
        calls = 0;
        gnomon::refilter(gnomon::simd<>{}, casters.view(), soft.view(), before, now, scratch, on);
        CHECK(calls >= 2); // 825 regions
        CHECK(test::differences(soft, test::dense<kernel>(casters)) == 0);
        before = now;
    }
    calls = 0;
    gnomon::refilter(gnomon::simd<>{}, image<rg8>(scattered, rg8::clear()).view(), soft.view(), before, before, scratch, on);
    CHECK(calls == 0);
}

TEST_CASE("after a frame whose map was cut otherwise the next one is filtered whole, unless one of them is empty") {
    dice roll(518);
    using kernel = gaussian<4>;
    int count = 0;
    band_scratch<rg8, kernel> scratch(size.width, 5);
    for (int round = 0; round < 24; ++round) {
        const scene<rg8> s(roll, round % 4, kernel::radius);
        const image<rg8> expected = test::dense<kernel>(s.casters);
        image<int> times(size, 0), needed(size, 0);
        gnomon::for_each_region_to_filter<kernel>(s.tiles, [&](texel_rect r) { needed.view().fill(r, 1); });
        painter run;
        run.times = &times;
        tile_grid before(round % 3 == 0 ? extent{400, 261} : size, round % 2 == 0 ? 4 : 64);
        image<rg8> soft(size, rg8::clear());
        gnomon::refilter(run, s.casters.view(), soft.view(), before, s.tiles, scratch, backwards{&count});
        CHECK(test::differences(soft, expected) == 0);
        CHECK(test::differences(times, needed) == 0);

        before.mark({-20, -20, 900, 900}, kernel::radius); // whatever it left may be anywhere
        soft = test::noise<rg8>(roll, size, 2);
        times.view().fill(0);
        needed.view().fill(s.tiles.empty() ? 0 : 1);
        gnomon::refilter(run, s.casters.view(), soft.view(), before, s.tiles, scratch, backwards{&count});
        CHECK(test::differences(soft, expected) == 0);
        CHECK(test::differences(times, needed) == 0);
    }
    image<rg8> soft(size, rg8::caster(0.5f));
    tile_grid before(size, 16);
    before.mark(whole(size));
    gnomon::refilter(gnomon::scalar{}, soft.view().part({0, 0, 1, 1}), soft.view(), before, tile_grid{}, scratch,
                     backwards{&count});
    CHECK(test::differences(soft, image<rg8>(size, rg8::clear())) == 0);
}

TEST_CASE("bands of a box whose sums run have three quarters of the rows that these are made of, or more, and those of parts too") {
    const image<rg8> map({512, 600}, rg8::caster(0.5f));
    image<rg8> to(map.size());
    gnomon::tile_grid all(map.size(), 16);
    all.mark(whole(map.size()), 100);
    const auto jobs_of = [&]<typename Kernel, typename Backend>(Kernel, const Backend& run, bool parts) {
        band_scratch<rg8, Kernel> scratch(512);
        int jobs = 0;
        const auto on = [&jobs](int count, const auto&) { jobs = count; }; // nobody asks what they would do
        if (parts)
            gnomon::filter(run, map.view(), to.view(), all, scratch, on);
        else
            gnomon::filter(run, map.view(), to.view(), whole(map.size()), scratch, on);
        return jobs;
    };
    for (const bool parts : {false, true}) {
        CHECK(jobs_of(box<100>{}, simd<gnomon::emulated<16>>{}, parts) == 4); // of 600 rows, where sums are made of 200
        CHECK(jobs_of(box<4>{}, simd<gnomon::emulated<16>>{}, parts) == 19);
        CHECK(jobs_of(box<100>{}, scalar{}, parts) == 19);
        CHECK(jobs_of(gnomon::tent<10>{}, simd<gnomon::emulated<16>>{}, parts) == 19);
    }
}

TEST_CASE("an image of receivers in bands is decided as row by row, where all three images are") {
    dice roll(515);
    const gnomon::rule distant{.caster = {.depth = 0.25f}};
    for (const auto& [of_map, of_z, of_answers] : {std::array{66, 70, 71}, {71, 66, 70}, {70, 71, 66}}) { // each is the lowest once
        const image<rg8> soft = test::noise<rg8>(roll, {90, of_map}, 2);
        image<float> z({80, of_z}), made({85, of_answers}, -1.0f), expected = made;
        test::for_each_texel(whole(z.size()), [&](int x, int y) { z(x, y) = roll.unit(); });
        int count = 0;
        gnomon::receive(gnomon::simd<>{}, soft.view(), z.view(), made.view(), distant, backwards{&count});
        gnomon::receive(soft.view(), z.view(), expected.view(), distant);
        CHECK(test::differences(made, expected) == 0);
        CHECK(count == 64);
    }
}

TEST_CASE("depths and intensities in codes go through an executor as they go row by row") {
    dice roll(516);
    const image<rg8> soft = test::noise<rg8>(roll, {70, 65}, 2);
    image<std::uint16_t> z(soft.size());
    test::for_each_texel(whole(z.size()), [&](int x, int y) { z(x, y) = static_cast<std::uint16_t>(roll(0, 65535)); });
    image<std::uint8_t> made(soft.size()), expected(soft.size());
    int count = 0;
    gnomon::receive(gnomon::simd<>{}, soft.view(), z.view(), made.view(), {}, backwards{&count});
    for (int y = 0; y < 65; ++y) gnomon::receive(soft.view().row_span(y), z.view().row_span(y), expected.view().row_span(y));
    CHECK(test::differences(made, expected) == 0);
}

TEST_CASE("a scratch is for 32 bands, or for as many as are asked for") {
    CHECK(band_scratch<rg8, gaussian<4>>(10).size() == 32);
    CHECK(band_scratch<rg8, gaussian<4>>(10, 7).size() == 7);
    CHECK(band_scratch<rg8, gaussian<4>>(10, 0).size() == 1);
}

TEST_CASE("a soft_shadow_map hands out as many jobs as its size is worth, and no more than it was told") {
    const auto jobs = [](gnomon::map_size of) {
        gnomon::soft_shadow_map<rg8> map(of);
        map.cast({0, 0, of.width, of.height}, 0.5f);
        int count = 0;
        map.filter(backwards{&count});
        return count;
    };
    CHECK(jobs({.width = 128, .height = 127}) == 1);
    CHECK(jobs({.width = 128, .height = 128}) == 2);
    CHECK(jobs({.width = 1024, .height = 64}) == 5);
    CHECK(jobs({.width = 64, .height = 1024}) == 5);
    CHECK(jobs({.width = 1024, .height = 1024}) == 32);
    CHECK(jobs({.width = 1024, .height = 1024, .bands = 7}) == 7);
    CHECK(jobs({.width = 1024, .height = 1024, .bands = 0}) == 1);
}
