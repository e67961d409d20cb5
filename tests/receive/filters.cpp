// The promises of bias.hpp behind real filters: box, tent and gaussian, by the library, exactly and fast, and rounded twice by the definition.
#include <gnomon/receive/decide.hpp>

#include "../support/bits.hpp"
#include "../support/filtering.hpp"
#include "../support/formats.hpp"
#include "../support/scan.hpp"
#include "../support/sweep.hpp"
#include "../support/threshold.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

using namespace gnomon;
using test::sweep;

#define EVERY_PLAIN_TEXEL rg8, rg16, rg16f, rg32f, test::paper8, test::paper16, test::paper16f, test::paper32f

namespace {

/// A filter of the library, as a function, and its kernel, as numbers: so that only the filter itself is compiled for each.
template <typename Texel> struct filter {
    image<Texel> (*filtered)(const image<Texel>&);
    int roundings;
    test::taps kernel;
};

/// These kernels, with this texel.
template <typename Texel, kernel... Kernels> std::vector<filter<Texel>> filters(test::kernels<Kernels...>) {
    return {{&test::dense<Kernels, Texel>, filter_roundings<Texel, Kernels>, test::taps_of<Kernels>()}...};
}

/// No false shadow at `nearest(x, y)` and no false light behind `farthest(x, y)`, after the library's filter and after two roundings.
template <typename Texel, typename Nearest, typename Farthest>
void try_map(const filter<Texel>& f, const image<Texel>& map, const Nearest& nearest, const Farthest& farthest, sweep& wrong) {
    const std::pair<image<Texel>, int> results[] = {{f.filtered(map), f.roundings}, {test::twice_rounded(map, f.kernel), 2}};
    for (const auto& result : results)
        test::for_each_texel(whole(map.size()), [&](int x, int y) {
            const auto& filtered = result.first;
            const int roundings = result.second;
            const Texel& texel = filtered(x, y);
            if (!texel.occupied()) return;
            const auto shadowed = [&](float z, bias_towards towards) {
                return shadow(texel, z, {.caster = {.towards = towards, .roundings = roundings}}) > 0.0f;
            };
            const float before = nearest(x, y), behind = test::up(farthest(x, y));
            wrong.unless(!shadowed(before, bias_towards::light), "false shadow: radius", f.kernel.radius, "x", x, "y", y, "z",
                         before, "roundings", roundings, "from", texel.stored[0], texel.stored[1]);
            wrong.unless(shadowed(behind, bias_towards::shadow), "false light: radius", f.kernel.radius, "x", x, "y", y, "z",
                         behind, "roundings", roundings, "from", texel.stored[0], texel.stored[1]);
        });
}

/// The corner of a large caster, which gives every share that a rectangle's corner can; and the smallest caster there is.
template <typename Texel> void try_depth(const filter<Texel>& f, float s, sweep& wrong) {
    const int middle = f.kernel.radius + 1, side = 2 * middle + 1;
    image<Texel> corner({side, side}, Texel::clear()), dot = corner;
    test::for_each_texel({middle, middle, side, side}, [&](int x, int y) { corner(x, y) = Texel::caster(s); });
    dot(middle, middle) = Texel::caster(s);
    const auto here = [s](int, int) { return s; };
    try_map(f, corner, here, here, wrong);
    try_map(f, dot, here, here, wrong);
}

/// Casters at all depths beside each other: the nearest and the farthest of a footprint are looked for.
template <typename Texel> void try_crowd(const filter<Texel>& f, test::dice& dice, sweep& wrong) {
    const int r = f.kernel.radius, side = 2 * r + 8;
    image<Texel> map({side, side}, Texel::clear());
    image<depth_interval> depth(map.size());
    const float near = dice.unit(), range = dice.one_in(2) ? 1.0f - near : (1.0f - near) * 0x1p-9f;
    const int sparseness = dice(1, 40);
    test::for_each_texel(whole(map.size()), [&](int x, int y) {
        if (!dice.one_in(sparseness)) return;
        const float s = near + range * dice.unit();
        depth(x, y) = {s, s};
        map(x, y) = Texel::caster(s);
    });
    image<depth_interval> footprint(map.size());
    test::for_each_texel(whole(map.size()), [&](int x, int y) {
        test::for_each_texel(clip({x - r, y - r, x + r + 1, y + r + 1}, map.size()),
                             [&](int i, int j) { footprint(x, y).include(depth(i, j)); });
    });
    try_map(
        f, map, [&](int x, int y) { return footprint(x, y).nearest; }, [&](int x, int y) { return footprint(x, y).farthest; },
        wrong);
}

/// Depths on both sides of what the format can tell apart: `count` of its codes from 0 to 1.
template <typename Texel> test::depths_of_code some_depths(int i, int count) {
    using channel_type = typename Texel::channel_type;
    return test::depths_stored_as<Texel>(channel_type::encode(static_cast<double>(i) / std::max(count - 1, 1)));
}

} // namespace

TEST_CASE_TEMPLATE(
    "behind a filter no receiver at or before the nearest caster is shadowed and towards shadow none behind the farthest is lit",
    Texel, EVERY_PLAIN_TEXEL, tm8, tm16) {
    test::dice dice(20);
    sweep wrong;
    for (const auto& f : filters<Texel>(test::kernels<box<1>, tent<4>, gaussian<1>, gaussian<4>, gaussian<16>, fast<box<4>>,
                                                      fast<tent<1>>, fast<gaussian<4>>, fast<gaussian<16>>>{}))
        for (int i = 0; i < 6; ++i) {
            const auto depths = some_depths<Texel>(i, 6);
            try_depth(f, i % 2 == 0 ? depths.first : depths.last, wrong);
            try_crowd(f, dice, wrong);
        }
    CHECK(wrong.report() == "");
}

#ifdef GNOMON_EXHAUSTIVE // takes long to compile
namespace {
/// Three shapes at each radius from 1 on.
template <typename Texel, int... Radii> std::vector<filter<Texel>> shapes(std::integer_sequence<int, Radii...>) {
    return filters<Texel>(test::kernels<box<Radii + 1>..., tent<Radii + 1>..., gaussian<Radii + 1>...>{});
}
} // namespace

TEST_CASE_TEMPLATE("exhaustive: behind every filter of radius 1 to 16 no receiver at or before the nearest caster is shadowed" *
                       doctest::skip(),
                   Texel, rg8, rg16, rg16f, rg32f, tm8, tm16) {
    constexpr int depths = 256; // all the codes of 8 bits
    const auto every_filter = shapes<Texel>(std::make_integer_sequence<int, 16>{});
    const sweep wrong = test::scan(depths, [&](int i, sweep& part) {
        test::dice dice(static_cast<std::uint64_t>(i));
        const auto depth = some_depths<Texel>(i, depths);
        for (const auto& f : every_filter) {
            for (const float s : {depth.first, depth.own, depth.last}) try_depth(f, s, part);
            try_crowd(f, dice, part);
        }
    });
    CHECK(wrong.report() == "");
}
#endif
