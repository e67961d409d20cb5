// Filtering the un-premultiplied pair: against whole numbers, and what is left of a depth behind any mask.
#include <gnomon/receive/depth_error.hpp>

#include "../support/bits.hpp"
#include "../support/filtering.hpp"
#include "../support/formats.hpp"
#include "../support/sweep.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

using namespace gnomon;
using test::dice;
using test::sweep;

namespace {

/// What a filter must leave of the footprint around (x, y), by the definition: sums of t m and of m in 128 bits.
template <typename Texel> Texel by_definition(const image<Texel>& from, const test::taps& k, int x, int y) {
    __extension__ using wide = unsigned __int128;
    const auto sum = [&](auto number) {
        wide s = 0;
        for (int j = -k.radius; j <= k.radius; ++j)
            for (int i = -k.radius; i <= k.radius; ++i)
                if (whole(from.size()).contains(x + i, y + j))
                    s += static_cast<wide>(k.at(i)) * static_cast<wide>(k.at(j)) * static_cast<wide>(number(from(x + i, y + j)));
        return s;
    };
    using number = std::uint64_t;
    const wide total = static_cast<wide>(k.total) * static_cast<wide>(k.total);
    const auto nearest = [total](wide s) { return static_cast<typename Texel::storage>((2 * s + total) / (2 * total)); };
    const wide mask = sum([](const Texel& t) { return number{t.stored[1]}; });
    Texel result{};
    result.stored[1] = nearest(mask);
    if (result.stored[1] == 0) return Texel::clear();
    const auto mean = [&](int c) {
        return static_cast<typename Texel::storage>(sum([c](const Texel& t) { return number{t.stored[c]} * t.stored[1]; }) / mask);
    };
    result.stored[0] = mean(0);
    if constexpr (Texel::effects.far_bound) result.stored[Texel::far_index] = mean(Texel::far_index);
    if constexpr (Texel::effects.translucency)
        result.stored[Texel::contribution_index] =
            nearest(sum([](const Texel& t) { return number{t.stored[Texel::contribution_index]}; }));
    return result;
}

} // namespace

TEST_CASE_TEMPLATE(
    "a filtered ratio is the exact mean depth of the casters rounded down beside their exact share rounded to nearest", Texel, tm8,
    tm16, test::ratio_rgba8, test::ratio_rgba16) {
    dice roll(51);
    test::for_each_kernel(test::kernels<box<0>, box<1>, tent<2>, binomial<9>, gaussian<5>>{}, [&]<typename Kernel>() {
        const test::taps k = test::taps_of<Kernel>();
        sweep wrong;
        for (const int sparseness : {1, 3, 40, 400}) {
            const extent size{roll(1, 30), roll(1, 24)};
            image<Texel> map = test::noise<Texel>(roll, size, sparseness);
            for (int pass = 0; pass < 2; ++pass) { // the second filters what has masks of every size
                const image<Texel> soft = test::dense<Kernel>(map);
                test::for_each_texel(whole(size), [&](int x, int y) {
                    wrong.unless(soft(x, y) == by_definition(map, k, x, y), "pass", pass, "at", x, y, "radius", k.radius);
                });
                map = soft;
            }
        }
        CHECK(wrong.report() == "");
    });
}

TEST_CASE_TEMPLATE("one caster's depth comes back to the code from every penumbra that is not empty", Texel, tm8, tm16) {
    dice roll(52);
    test::for_each_kernel(test::kernels<box<0>, box<1>, box<7>, box<16>, tent<5>, binomial<9>, gaussian<16>>{},
                          [&]<typename Kernel>() {
                              const Texel caster = Texel::caster(roll.unit());
                              image<Texel> map({3 * Kernel::radius + 5, 3}, Texel::clear());
                              map.view().fill({Kernel::radius, 1, Kernel::radius + 3, 2}, caster);
                              const image<Texel> soft = test::dense<Kernel>(map);
                              int occupied = 0;
                              sweep wrong;
                              test::for_each_texel(whole(map.size()), [&](int x, int y) {
                                  const Texel t = soft(x, y);
                                  occupied += t.occupied() ? 1 : 0;
                                  wrong.unless(t.occupied() ? t.stored[0] == caster.stored[0] : t == Texel::clear(), "at", x, y);
                              });
                              CHECK(wrong.report() == "");
                              CHECK(occupied > 0);
                          });
}

TEST_CASE(
    "where the premultiplied pair has lost the depth the ratio still has it: rms over the faint masks of numerics section 2") {
    double ratio_square = 0.0, pair_square = 0.0;
    int cases = 0;
    for (int radius = 1; radius <= 16; ++radius)
        for (int covered = 1, taps = (2 * radius + 1) * (2 * radius + 1); covered <= taps; ++covered) {
            const std::uint64_t whole = static_cast<std::uint64_t>(taps), m = static_cast<std::uint64_t>(covered) * 255;
            const std::uint64_t mask = (2 * m + whole) / (2 * whole);
            if (mask < 16 || mask > 31) continue;
            for (int i = 0; i < 64; ++i) {
                const double s = (i + 0.37) / 64.0;
                const tm8 caster = tm8::caster(static_cast<float>(s));
                const std::uint64_t sums[] = {static_cast<std::uint64_t>(covered) * caster.linear<std::uint64_t>(0),
                                              static_cast<std::uint64_t>(covered) * caster.linear<std::uint64_t>(1)};
                const rg8 flat = rg8::caster(static_cast<float>(s));
                const std::uint64_t pair[] = {static_cast<std::uint64_t>(covered) * flat.stored[0], m};
                const double a = static_cast<double>(caster_depth(tm8::from_linear(sums, whole))) - s,
                             b = static_cast<double>(caster_depth(rg8::from_linear(pair, whole))) - s;
                ratio_square += a * a;
                pair_square += b * b;
                ++cases;
            }
        }
    const double ratio = std::sqrt(ratio_square / cases), pair = std::sqrt(pair_square / cases);
    CHECK(ratio < 0.0024); // 1/255/sqrt 3 = .00226
    CHECK(ratio > 0.0021);
    CHECK(pair > 0.014); // the table's .0150
    CHECK(pair < 0.016);
}

TEST_CASE_TEMPLATE("a sample multiplies before it blends: depths count by their masks", Texel, tm8, tm16) {
    dice roll(53);
    sweep wrong;
    for (int i = 0; i < 20'000; ++i) {
        image<Texel> map({2, 2}, Texel::clear());
        test::for_each_texel(whole(map.size()), [&](int x, int y) {
            const auto most = static_cast<int>(Texel::channel_type::scale);
            map(x, y).stored[1] = static_cast<typename Texel::storage>(roll.one_in(3) ? roll(0, 3) : roll(0, most));
            if (map(x, y).stored[1] != 0) map(x, y).stored[0] = static_cast<typename Texel::storage>(roll(0, most));
        });
        const int u = roll(0, 256), v = roll(0, 256);
        const filtered<Texel> f = sample(map.view(), 0.5f + static_cast<float>(u) / 256.0f, 0.5f + static_cast<float>(v) / 256.0f);
        std::uint64_t e = 0, m = 0;
        test::for_each_texel(whole(map.size()), [&](int x, int y) {
            const auto weight = static_cast<std::uint64_t>((x == 0 ? 256 - u : u) * (y == 0 ? 256 - v : v));
            e += weight * map(x, y).stored[0] * map(x, y).stored[1];
            m += weight * map(x, y).stored[1];
        });
        const double scale = static_cast<double>(Texel::channel_type::scale);
        wrong.unless(test::same_bits(f.depth(), static_cast<double>(e) / 65536.0) &&
                         test::same_bits(f.mask(), static_cast<double>(m) * scale / 65536.0),
                     "at", u, v, "of 256");
    }
    CHECK(wrong.report() == "");
}
