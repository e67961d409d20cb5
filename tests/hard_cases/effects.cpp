// Hard cases of the optional channels: the far bound, which ends a shadow, and the contribution, which thins it.
#include <gnomon/receive/decide.hpp>

#include "hard_cases.hpp"

#include "../support/filtering.hpp"
#include "../support/float_dice.hpp"
#include "../support/sweep.hpp"
#include "../support/threshold.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace gnomon;
using test::sweep;

// --- h11: s < f stays t_f <= t_s in storage, because rounding is monotone ---------------------------------------------------------

TEST_CASE_TEMPLATE("h11_far_bound_keeps_order: a receiver behind its caster is never stored before it", Texel,
                   EVERY_BOUNDED_TEXEL) {
    using representation_type = typename Texel::representation_type;
    test::float_dice dice(11);
    sweep wrong;
    for (int i = 0; i < 300'000; ++i) {
        const float s = i % 2 == 0 ? dice.unit() : dice.any_unit();
        const float step = dice.any_unit() * (i % 3 == 0 ? 1.0f : 0x1p-12f);
        const float f = lesser(s + step, 1.0f);
        Texel t = Texel::caster(s);
        t.bound(f);
        const auto depth = t.stored[Texel::depth_index], bound = t.stored[Texel::far_index];
        const auto receiver = representation_type::template encode<typename Texel::channel_type>(f);
        wrong.unless(!representation_type::nearer(bound, depth), "s", s, "f", f);
        wrong.unless(bound >= receiver && bound <= receiver, "not stored: s", s, "f", f);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("h11_far_bound_keeps_order: nor filtered before it at any share of any footprint once or twice", Texel,
                   EVERY_BOUNDED_TEXEL) {
    test::float_dice dice(12);
    sweep wrong;
    for (int i = 0; i < 300'000; ++i) {
        const float s = dice.unit(), f = lesser(s + dice.any_unit(), 1.0f);
        Texel t = Texel::caster(s);
        t.bound(f);
        const int side = 2 * dice(1, 8) + 1, taps = side * side;
        const Texel once = test::filtered(t, dice(1, taps), taps), twice = test::filtered(once, dice(1, taps), taps);
        for (const auto& soft : {read(once), read(twice)})
            wrong.unless(soft.far_bound() <= soft.depth(), "s", s, "f", f, "taps", taps);
    }
    CHECK(wrong.report() == "");
}

// --- h12: where receivers at two depths share a footprint, the far bound is their mean, and wrong for the farther one --------------

namespace {

/// A caster over a bridge that ends over the ground: the shadow is wanted on whichever of the two is nearest to the light.
struct bridge_end {
    static constexpr int width = 96, height = 17, radius = 8, caster0 = 16, edge = 48, caster1 = 80;
    static constexpr float caster = 0.25f, bridge = 0.5f, ground = 0.875f;

    image<rgb32f> map{{width, height}, rgb32f::clear()};

    bridge_end() {
        for (int y = 0; y < height; ++y)
            for (int x = caster0; x < caster1; ++x) {
                map(x, y).cast(rgb32f::caster(caster));
                map(x, y).bound(x < edge ? bridge : ground);
            }
    }
    /// The share of the footprint of x that is caster over a receiver between `from` and `to`.
    static double share(int x, int from, int to) {
        int n = 0;
        for (int i = x - radius; i <= x + radius; ++i) n += i >= greater(from, caster0) && i < lesser(to, caster1) ? 1 : 0;
        return n / (2.0 * radius + 1.0);
    }
};

struct errors {
    double squares = 0.0, worst = 0.0;
    int count = 0;
    void add(double error) {
        squares += error * error;
        worst = greater(worst, std::abs(error));
        ++count;
    }
    double rms() const { return std::sqrt(squares / count); }
};

} // namespace

TEST_CASE(
    "h12_mixed_far_bounds: at the end of a bridge the mean bound takes the shadow off the ground below and off nothing else") {
    const bridge_end scene;
    const image<rgb32f> soft = test::dense<box<bridge_end::radius>>(scene.map);
    errors none, mean, hull, on_bridge;
    double most_missing = 0.0, most_false = 0.0;
    for (int x = 0; x < bridge_end::width; ++x) {
        const rgb32f texel = soft(x, bridge_end::height / 2);
        const double truth = bridge_end::share(x, bridge_end::edge, bridge_end::caster1),
                     all = bridge_end::share(x, 0, bridge_end::width);
        const double now = static_cast<double>(shadow(texel, bridge_end::ground));
        none.add(all - truth);
        mean.add(now - truth);
        most_missing = greater(most_missing, truth - now);
        most_false = greater(most_false, now - truth);
        if (x < bridge_end::edge) on_bridge.add(static_cast<double>(shadow(texel, bridge_end::bridge)) - all);

        // What would be exact, for two: of the mask, (fmax - mean)/(fmax - fmin) ends at fmin, the rest at fmax.
        const auto f = read(texel);
        const double bound = f.mask() > 0.0 ? 1.0 - f.far_bound() / f.mask() : 1.0;
        const auto fmin = static_cast<double>(bridge_end::bridge), fmax = static_cast<double>(bridge_end::ground);
        hull.add(f.mask() * (1.0 - lesser((fmax - bound) / (fmax - fmin), 1.0)) - truth);
    }
    CHECK(none.rms() > 0.3); // without a bound, the shadow goes through the bridge
    CHECK(mean.rms() > 0.1); // with it
    CHECK(mean.rms() < none.rms() / 2);
    CHECK(most_missing > 0.9);     // right beside the edge, all but one tap of 17 is ground, and none of it is dark
    CHECK(most_false < 1e-6);      // it errs towards light
    CHECK(on_bridge.worst < 1e-6); // the nearest receiver has all of its shadow
    CHECK(hull.worst < 1e-6);      // waiting
}

// --- h13: the contribution is filtered with the weights of the mask, and is exact behind all casters of a footprint ----------------

TEST_CASE_TEMPLATE(
    "h13_translucent_layers_over: behind all casters of a footprint the shadow is the weighted sum of their opacities", Texel,
    EVERY_TRANSLUCENT_TEXEL, test::paper_rgba8, test::paper_rgba16, test::paper_rgba16f, test::paper_rgba32f) {
    using blur = binomial<3>;
    test::dice roll(13);
    const test::taps k = test::taps_of<blur>();
    image<Texel> casters({20, 16}, Texel::clear()); // at any depth, of any opacity
    test::for_each_texel(whole(casters.size()), [&](int x, int y) {
        if (roll.one_in(2)) casters(x, y) = Texel::caster(roll.unit(), roll.unit());
    });
    const image<Texel> soft = test::dense<blur>(casters);
    sweep wrong;
    test::for_each_texel(whole(casters.size()), [&](int x, int y) {
        const double codes = test::convolved<double>(casters, k, x, y, Texel::contribution_index) / k.total / k.total;
        const double expected = codes / static_cast<double>(Texel::channel_type::scale);
        const double found = static_cast<double>(shadow(soft(x, y), 2.0f, {.caster = towards_shadow}));
        wrong.unless(std::abs(found - expected) <= static_cast<double>(Texel::channel_type::max_error), "x", x, "y", y, "found",
                     found, "expected", expected);
    });
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("h13_translucent_layers_over: opacity moves no depth", Texel, EVERY_TRANSLUCENT_TEXEL) {
    for (int covered = 1; covered <= 25; ++covered)
        for (const float opacity : {0.0f, 0.25f, 1.0f}) {
            const Texel faint = test::filtered(Texel::caster(0.375f, opacity), covered, 25),
                        opaque = test::filtered(Texel::caster(0.375f), covered, 25);
            CHECK(test::same_bits(caster_depth(faint), caster_depth(opaque)));
        }
}

TEST_CASE_TEMPLATE("h13_translucent_layers_over: of two layers the nearer alone is kept where over would be exact behind both",
                   Texel, rga8, rga32f, rgba16, rgba16f) {
    constexpr double a1 = 0.25, a2 = 0.5, t1 = 0.75, t2 = 0.25;
    constexpr double m = a1 + (1.0 - a1) * a2, e = a1 * t1 + (1.0 - a1) * a2 * t2; // premultiplied over
    Texel kept = Texel::caster(static_cast<float>(1.0 - t2), static_cast<float>(a2));
    kept.cast(Texel::caster(static_cast<float>(1.0 - t1), static_cast<float>(a1)));
    CHECK(kept == Texel::caster(0.25f, 0.25f));
    CHECK(std::abs(static_cast<double>(shadow(kept, 0.9f)) - a1) <= static_cast<double>(Texel::channel_type::max_error));
    CHECK(test::equal(shadow(filtered<rg32f>{{e, m}}, 0.9f), static_cast<float>(m))); // 1 - (1 - a1)(1 - a2): waiting
    CHECK(test::lit(filtered<rg32f>{{e, m}}, 0.25f));
}
