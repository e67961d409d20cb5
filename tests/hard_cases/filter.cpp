// Hard cases of a filter: sums of weights, what trails behind a caster, borders, tiles.
#include <gnomon/backend/scalar.hpp>

#include "hard_cases.hpp"

#include "../support/filtering.hpp"
#include "../support/sweep.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

using namespace gnomon;
using test::dense;
using test::dice;
using test::for_each_kernel;
using test::for_each_texel;
using test::kernels;

namespace {

using some_kernels = kernels<box<1>, tent<2>, gaussian<5>>; // few, because they meet every format

/// The bell that everybody writes first: sampled, standard deviation R/2, divided by its own sum. Real says in which arithmetic.
template <typename Real> std::vector<Real> naive_bell(int radius) {
    std::vector<Real> w;
    Real sum = 0;
    for (int i = -radius; i <= radius; ++i) {
        w.push_back(static_cast<Real>(std::exp(-2.0 * i * i / (1.0 * radius * radius))));
        sum += w.back();
    }
    for (Real& each : w) each /= sum;
    return w;
}

/// What a numeric type makes of every intermediate result.
float half_rounded(float v) { return half_to_float(half_from(static_cast<double>(v))); }
float unrounded(float v) { return v; }

/// The paper's clear depth of 1 after some passes of float weights, every product and sum rounded by `round`.
float clear_depth_after(int passes, const std::vector<float>& weights, float (*round)(float)) {
    float d = 1.0f;
    for (; passes > 0; --passes) {
        float sum = 0.0f;
        for (const float w : weights) {
            const volatile float product = round(round(w) * d); // volatile: not fused
            sum = round(sum + product);
        }
        d = sum;
    }
    return d;
}

} // namespace

// --- h03: clear is a fixed point, to the bit, for every format and kernel --------------------------------------------------------

TEST_CASE_TEMPLATE("h03_clear_is_fixed_point: of every kernel and after 1000 passes too", Texel, EVERY_FILTERED_TEXEL) {
    const image<Texel> clear({7, 5}, Texel::clear());
    for_each_kernel(some_kernels{}, [&]<typename Kernel>() {
        image<Texel> map = clear;
        for (int pass = 0; pass < 1000; ++pass) map = dense<Kernel>(map);
        CHECK(test::differences(map, clear) == 0);
    });
}

TEST_CASE("h03_clear_is_fixed_point: a clear depth of 1 under float weights is none") {
    int moved = 0;
    float farthest = 0.0f, farthest_100 = 0.0f, farthest_half = 0.0f, farthest_half_10 = 0.0f;
    for (int radius = 1; radius <= 32; ++radius) {
        const auto bell = naive_bell<float>(radius);
        const auto off = [&](int passes, float (*round)(float)) { return std::abs(clear_depth_after(passes, bell, round) - 1.0f); };
        moved += off(1, unrounded) > 0.0f;
        farthest = greater(farthest, off(1, unrounded));
        farthest_100 = greater(farthest_100, off(100, unrounded));
        if (radius > 16) continue;
        farthest_half = greater(farthest_half, off(1, half_rounded));
        farthest_half_10 = greater(farthest_half_10, off(10, half_rounded));
    }
    CHECK(moved >= 20); // of 32 radii
    CHECK(farthest > 2e-7f);
    CHECK(farthest < 4e-7f);
    CHECK(farthest_100 > 2e-6f);
    CHECK(farthest_half > 0.0014f);
    CHECK(farthest_half_10 > 0.008f); // 2 codes of 8 bits, after 10 passes
}

TEST_CASE("h03_clear_is_fixed_point: nor is 255 under weights that were each rounded to a 256th") {
    int off = 0, darkest = 255;
    for (int radius = 1; radius <= 16; ++radius) {
        int sum = 0, white = 255;
        for (const double w : naive_bell<double>(radius)) sum += static_cast<int>(w * 256.0 + 0.5);
        off += sum != 256;
        for (int pass = 0; pass < 2; ++pass) white = (sum * white + 128) / 256;
        darkest = lesser(darkest, white);
    }
    CHECK(off == 14); // of 16 radii
    CHECK(darkest == 249);
}

// --- h04: a sum of weights that is not one scales m and cancels in s --------------------

TEST_CASE_TEMPLATE("h04_weight_sum_cancels: a uniform region stays exactly itself whatever it holds", Channel, unorm8, unorm16,
                   half16, float32) {
    using Texel = texel<Channel>;
    dice roll(66);
    for_each_kernel(kernels<box<1>, tent<2>, tent<6>, binomial<9>, gaussian<5>, gaussian<9, 33>>{}, [&]<typename Kernel>() {
        int wrong = 0;
        constexpr int r = Kernel::radius, side = 2 * r + 3; // leaves 3 x 3 texels that see no edge
        for (int i = 0; i < (r < 5 ? 1500 : 300); ++i) {
            const Texel value = i < 256 ? Texel::caster(static_cast<float>(i) / 255.0f) : test::any_caster<Texel>(roll);
            const image<Texel> from({side, side}, value), to = dense<Kernel>(from);
            wrong += test::differences<Texel>(from.view(), to.view(), {r, r, side - r, side - r});
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE_TEMPLATE("h04_weight_sum_cancels: the depth of a lone caster comes back from its whole penumbra whatever the total",
                   Texel, rg8, rg16, rg16f, rg32f) {
    dice roll(67);
    for_each_kernel(kernels<box<2>, tent<3>, binomial<4>, gaussian<5>>{}, [&]<typename Kernel>() {
        int wrong = 0;
        for (int i = 0; i < 40; ++i) {
            image<Texel> from({24, 20}, Texel::clear());
            const Texel caster = Texel::caster(roll.unit());
            const double t = read(caster).depth() / static_cast<double>(Texel::channel_type::scale);
            from.view().fill({8, 7, 15, 12}, caster);
            const image<Texel> to = dense<Kernel>(from);
            for_each_texel(whole(to.size()), [&](int x, int y) {
                const auto f = read(to(x, y));
                if (!(f.mask() > 0.0)) return;
                constexpr rounding_error own = Texel::channel_type::rounding; // of e and of m, each
                const double bound = Texel::channel_type::whole_codes ? (1.0 + t) / (2.0 * f.mask())
                                                                      : t * 4.0 * static_cast<double>(own.relative) +
                                                                            2.0 * static_cast<double>(own.absolute) / f.mask();
                wrong += std::fabs(f.depth() / f.mask() - t) > bound * (1.0 + 1e-12);
            });
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE("h04_weight_sum_cancels: weights that lack a 256th move the paper's depth by h/((1+h)m) and ours not at all") {
    struct {
        double mask, moved;
    } const cases[]{{0.5, 0.008}, {0.1, 0.039}, {0.02, 0.20}};
    constexpr double h = -1.0 / 256.0, s = 0.625;
    for (const auto [mask, moved] : cases) {
        const double covered = mask * (1.0 + h), clear = (1.0 - mask) * (1.0 + h);
        const filtered<test::paper32f> paper{{covered * s + clear * 1.0, covered}};
        const filtered<rg32f> ours{{covered * (1.0 - s), covered}};
        CHECK(test::equal(caster_depth(ours), static_cast<float>(s)));
        CHECK(std::abs(static_cast<double>(caster_depth(paper)) - s - h / covered) < 1e-6);
        CHECK(std::abs(static_cast<double>(caster_depth(paper)) - s + moved) < 0.04 * moved); // the two digits of the table
        const auto before = static_cast<float>(s - moved / 2.0); // a receiver that is before the caster
        CHECK(test::lit(ours, before));
        CHECK_FALSE(test::lit(paper, before));
        CHECK(test::equal(shadow(ours, 0.75f), static_cast<float>(covered))); // m is scaled, and that is all
    }
}

// --- h06: nothing trails behind a caster ---------------------------------------------------------------------------------------

TEST_CASE_TEMPLATE("h06_running_sum_returns_to_zero: where no caster is in the footprint the result is clear to the bit", Texel,
                   EVERY_FILTERED_TEXEL) {
    dice roll(68);
    for (int i = 0; i < 10; ++i) {
        const auto from = test::noise<Texel>(roll, {30, 12}, 60);
        for_each_kernel(some_kernels{}, [&]<typename Kernel>() {
            constexpr int r = Kernel::radius;
            const image<Texel> to = dense<Kernel>(from);
            int wrong = 0, without = 0;
            for_each_texel(whole(to.size()), [&](int x, int y) {
                bool any = false;
                for_each_texel(clip({x - r, y - r, x + r + 1, y + r + 1}, to.size()),
                               [&](int i2, int j2) { any = any || from(i2, j2).occupied(); });
                if (any) return;
                ++without;
                wrong += !(to(x, y) == Texel::clear());
            });
            CHECK(wrong == 0);
            CHECK(without + r * 40 > 20);
        });
    }
}

TEST_CASE(
    "h06_running_sum_returns_to_zero: a running sum of floats leaves a residue to the end of the row and of whole numbers none") {
    constexpr std::size_t width = 200, radius = 8;
    const auto sums = [](const auto& row) { // of the 2 radius + 1 texels around x: one comes in, one goes out
        auto sum = row[0];
        auto result = row;
        for (std::size_t x = 1; x < width; ++x) {
            sum += x + radius < width ? row[x + radius] : row[0];
            sum -= x > radius ? row[x - radius - 1] : row[0];
            result[x] = sum;
        }
        return result;
    };
    float largest = 0.0f;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        dice roll(seed);
        std::array<float, width> depths{};
        std::array<std::uint32_t, width> codes{};
        for (std::size_t x = 60; x < 80; ++x) {
            depths[x] = roll.unit();
            codes[x] = static_cast<std::uint32_t>(roll(0, 65535));
        }
        const auto floats = sums(depths);
        const auto integers = sums(codes);
        for (std::size_t x = 80 + radius; x < width; ++x) {
            CHECK(test::same_bits(floats[x], floats[80 + radius]));
            CHECK(integers[x] == 0);
        }
        largest = greater(largest, std::abs(floats[80 + radius]));
    }
    CHECK(largest / (2 * radius + 1) > 1.2e-7f); // of a mask of 1
    CHECK(largest / (2 * radius + 1) < 3e-7f);
}

// --- h14: beyond the border lies clear: the footprint is clipped, not renormalised, and no edge is repeated -----------------------

TEST_CASE_TEMPLATE("h14_map_border_is_clear: a map equals the middle of a larger one with a clear margin", Texel,
                   EVERY_FILTERED_TEXEL) {
    dice roll(69);
    for (const extent size : {extent{0, 0}, {0, 4}, {5, 0}, {1, 1}, {1, 19}, {23, 1}, {3, 2}, {19, 13}}) {
        const auto from = test::noise<Texel>(roll, size, 2);
        for_each_kernel(some_kernels{}, [&]<typename Kernel>() {
            constexpr int r = Kernel::radius;
            image<Texel> larger({size.width + 2 * r, size.height + 2 * r}, Texel::clear());
            for_each_texel(whole(size), [&](int x, int y) { larger(x + r, y + r) = from(x, y); });
            const image<Texel> expected = dense<Kernel>(larger), to = dense<Kernel>(from);
            int wrong = 0;
            for_each_texel(whole(size), [&](int x, int y) { wrong += !(to(x, y) == expected(x + r, y + r)); });
            CHECK(wrong == 0);
        });
    }
}

TEST_CASE("h14_map_border_is_clear: a caster on the border is as soft there as anywhere and not 6/7 or 3/4 of one") {
    image<rg32f> from({16, 7}, rg32f::clear());
    from.view().fill({0, 0, 3, 7}, rg32f::caster(0.5f)); // three columns of it, of which the first texel's seven taps see three
    const image<rg32f> to = dense<box<3>>(from);
    CHECK(test::equal(to(0, 3).stored[1], 3.0f / 7.0f)); // a repeated edge counts 6 of 7; a clipped footprint made whole, 3 of 4
    CHECK(test::equal(to(0, 0).stored[1], 12.0f / 49.0f));
    CHECK(test::equal(to(3, 3).stored[1], 3.0f / 7.0f));
}

// --- h15: what is filtered tile by tile has the bits of the whole map filtered from scratch ----------------------------------------

TEST_CASE_TEMPLATE("h15_sparse_equals_dense: for random casters in partly covered tiles of every size", Texel,
                   EVERY_FILTERED_TEXEL) {
    dice roll(15);
    for (int round = 0; round < 40; ++round) {
        const extent size{roll(1, 50), roll(1, 40)};
        image<Texel> casters(size, Texel::clear());
        std::vector<texel_rect> drawn;
        for (int n = roll(0, 4); n > 0; --n) {
            drawn.push_back(roll.rect(size, 6));
            casters.view().fill(drawn.back(), test::any_caster<Texel>(roll));
        }
        for_each_kernel(some_kernels{}, [&]<typename Kernel>() {
            tile_grid tiles(size, roll(1, 20));
            for (const texel_rect r : drawn) tiles.mark(clip(r, size), Kernel::radius);
            image<Texel> soft(size, Texel::clear());
            filter_scratch<Texel, Kernel> scratch(size.width);
            filter(scalar{}, casters.view(), soft.view(), tiles, scratch);
            CHECK(test::differences(soft, dense<Kernel>(casters)) == 0);
        });
    }
}

TEST_CASE("h15_sparse_equals_dense: tiles that were merged before they grew by the kernel's radius cut the penumbra off") {
    image<rg16> casters({64, 64}, rg16::clear());
    constexpr texel_rect caster{16, 16, 32, 32}; // ends on the border of its tiles
    casters.view().fill(caster, rg16::caster(0.5f));
    tile_grid tiles(casters.size(), 16);
    tiles.mark(caster);
    image<rg16> soft(casters.size(), rg16::clear());
    filter_scratch<rg16, box<4>> scratch(64);
    for_each_region(tiles, [&](texel_rect r) { filter_region(casters.view(), soft.view(), r, scratch); });
    const image<rg16> expected = dense<box<4>>(casters);
    CHECK(test::differences(soft, expected) == 24 * 24 - 16 * 16); // all of the penumbra that lies outside
    CHECK(expected(32, 24).stored[1] == 29127);                    // 4/9
    CHECK(soft(32, 24) == rg16::clear());
}
