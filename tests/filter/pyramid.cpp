// Mip levels: each texel by the definition, sparse equals dense, and how far the roundings add up (h16).
#include <gnomon/backend/scalar.hpp>
#include <gnomon/filter/pyramid.hpp>
#include <gnomon/receive/depth_error.hpp>

#include "../support/bits.hpp"
#include "../support/filtering.hpp"
#include "../support/formats.hpp"
#include "../support/sweep.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

using namespace gnomon;
using test::dice;
using test::sweep;

#define EVERY_KIND                                                                                                                 \
    rg8, rg16, rg16f, rg32f, tm8, tm16, rgba8, rgba16f, test::ratio_rgba16, test::paper8, test::paper16f, test::paper_rgba32f

namespace {

template <typename Texel> pyramid<Texel> built(const image<Texel>& base, const tile_grid& tiles) {
    pyramid<Texel> mips(base.size(), tiles.tile());
    mips.build(base.view(), tiles);
    return mips;
}
template <typename Texel> pyramid<Texel> built(const image<Texel>& base) { // of the whole map
    tile_grid all(base.size(), 8);
    all.mark(whole(base.size()));
    return built(base, all);
}

template <typename Texel> image_view<const Texel> level(const image<Texel>& base, const pyramid<Texel>& mips, int l) {
    return l == 0 ? base.view() : mips.level(l);
}

template <typename Texel> int differences(const pyramid<Texel>& a, const pyramid<Texel>& b) {
    if (a.coarsest() != b.coarsest()) return -1;
    int n = 0;
    for (int l = 1; l <= a.coarsest(); ++l) n += test::differences(a.level(l), b.level(l), whole(a.level(l).size()));
    return n;
}

} // namespace

TEST_CASE("a level has half the texels of the one below rounded up until there is one") {
    CHECK(half_size({1024, 512}) == extent{512, 256});
    CHECK(half_size({5, 1}) == extent{3, 1});
    CHECK(half_size({1, 1}) == extent{1, 1});
    CHECK(half_size({0, 7}) == extent{});
    CHECK(half_size({-4, 4}) == extent{});
    CHECK(half_size({2147483647, 2}) == extent{1073741824, 1});

    CHECK(pyramid<rg8>({1024, 1}, 8).coarsest() == 10);
    CHECK(pyramid<rg8>({5, 9}, 8).coarsest() == 4); // 5x9 3x5 2x3 1x2 1x1
    CHECK(pyramid<rg8>({5, 9}, 8).size() == extent{5, 9});
    CHECK(pyramid<rg8>({1, 1}, 8).coarsest() == 0);
    CHECK(pyramid<rg8>({7, 0}, 8).coarsest() == 0);
    CHECK(pyramid<rg8>({-7, 7}, 8).coarsest() == 0);
    CHECK(pyramid<rg8>().coarsest() == 0);
}

TEST_CASE_TEMPLATE("a texel of a level is the mean of four below - exact and rounded once - and beyond an odd edge lies clear",
                   Texel, EVERY_KIND) {
    dice roll(61);
    sweep wrong;
    for (int round = 0; round < 30; ++round) {
        image<Texel> base = test::noise<Texel>(roll, {roll(1, 33), roll(1, 21)}, 2);
        if (round % 2 == 0) base = test::dense<binomial<2>>(base);
        const pyramid<Texel> mips = built(base);
        for (int l = 1; l <= mips.coarsest(); ++l) {
            const image_view<const Texel> below = level(base, mips, l - 1), here = mips.level(l);
            test::for_each_texel(whole(here.size()), [&](int x, int y) {
                // box<1> cannot say "2 x 2", so the definition stands here once more, in double: exact for all of these numbers
                double sums[static_cast<std::size_t>(Texel::channels)]{};
                for (const int i : {0, 1})
                    for (const int j : {0, 1}) {
                        const bool inside = whole(below.size()).contains(2 * x + i, 2 * y + j);
                        const Texel t = inside ? below(2 * x + i, 2 * y + j) : Texel::clear();
                        for (int c = 0; c < Texel::channels; ++c) {
                            const double code = static_cast<double>(Texel::channel_type::code(t.stored[c]));
                            const bool depth = c == Texel::depth_index || c == Texel::far_index;
                            const bool weighted = !Texel::representation_type::premultiplied && depth;
                            sums[c] += code * (weighted ? static_cast<double>(Texel::channel_type::code(t.stored[1])) : 1.0);
                        }
                    }
                Texel expected{};
                const double mask = sums[1];
                for (int c = 0; c < Texel::channels; ++c) {
                    const bool depth = c == Texel::depth_index || c == Texel::far_index;
                    if (Texel::representation_type::premultiplied || !depth)
                        expected.stored[c] = Texel::channel_type::store(sums[c] / 4.0);
                    else
                        expected.stored[c] = static_cast<typename Texel::storage>(mask > 0.0 ? std::floor(sums[c] / mask) : 0.0);
                }
                if (!Texel::representation_type::premultiplied && !expected.occupied()) expected = Texel::clear();
                wrong.unless(here(x, y) == expected, "level", l, "at", x, y);
            });
        }
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("levels built from the marked tiles have the bits of those built from the whole map, frame after frame", Texel,
                   EVERY_KIND) {
    dice roll(62);
    for (int map = 0; map < 6; ++map) {
        const extent size{roll(1, 90), roll(1, 70)};
        const int tile = roll(1, 20);
        pyramid<Texel> sparse(size, tile);
        for (int frame = 0; frame < 12; ++frame) {
            image<Texel> base(size, Texel::clear());
            tile_grid tiles(size, tile);
            for (int n = roll(0, 3); n > 0; --n) {
                const texel_rect r = clip(roll.rect(size, 4), size);
                base.view().fill(r, test::any_caster<Texel>(roll));
                tiles.mark(r);
            }
            sparse.build(base.view(), tiles);
            CHECK(differences(sparse, built(base)) == 0);
        }
    }
}

TEST_CASE_TEMPLATE("clear stays clear and a full map full, to the last level", Texel, EVERY_KIND) {
    for (const Texel& texel : {Texel::clear(), Texel::caster(0.375f)}) {
        const pyramid<Texel> mips = built(image<Texel>({64, 64}, texel));
        for (int l = 1; l <= mips.coarsest(); ++l)
            test::for_each_texel(whole(mips.level(l).size()), [&](int x, int y) { CHECK(mips.level(l)(x, y) == texel); });
    }
}

TEST_CASE("the mean of four zeros that have a sign has none") {
    using half_pair = gnomon::rg16f;
    const gnomon::image<half_pair> below({2, 2}, {{0x8000, 0x8000}});
    gnomon::image<half_pair> above({1, 1}, {{1, 1}});
    gnomon::halve_region(below.view(), above.view(), {0, 0, 2, 2});
    CHECK(above(0, 0) == half_pair{{0, 0}});
}

TEST_CASE("a region off the level halves to nothing and writes nothing") {
    const image<rg8> from({4, 4}, rg8::caster(0.5f));
    image<rg8> to({2, 2}, rg8::clear());
    for (const texel_rect off : {texel_rect{4, 0, 9, 4}, {-3, 0, 0, 4}, {2, 2, 2, 2}, {3, 0, 1, 4}})
        CHECK(halve_region(from.view(), to.view(), off).empty());
    CHECK(test::differences(to, image<rg8>({2, 2}, rg8::clear())) == 0);
    CHECK(halve_region(from.view(), to.view(), {3, 3, 9, 9}) == texel_rect{1, 1, 2, 2});
}

TEST_CASE("halving a region writes the texels that lie over its texels and no other") {
    dice roll(67);
    int written = 0;
    for (int round = 0; round < 3000; ++round) {
        const extent size{roll(1, 19), roll(1, 19)};
        const image<rg8> from(size, rg8::caster(0.0f));
        image<rg8> to({roll(0, 12), roll(0, 12)}, rg8::clear()), expected = to;
        const texel_rect region = roll.rect(size, 3);
        test::for_each_texel(clip(region, size), [&](int x, int y) {
            if (whole(to.size()).contains(x / 2, y / 2)) expected(x / 2, y / 2) = rg8::caster(0.0f);
        });
        const texel_rect wrote = halve_region(from.view(), to.view(), region);
        int differences = 0;
        test::for_each_texel(whole(to.size()), [&](int x, int y) {
            const bool over = expected(x, y).occupied();
            differences += to(x, y).occupied() != over || wrote.contains(x, y) != over;
            written += over;
        });
        CHECK(differences == 0);
    }
    CHECK(written > 2000);
}

TEST_CASE("a map without texels on either side builds nothing and samples as clear") {
    for (const extent size : {extent{0, 7}, {7, 0}, {0, 0}, {-3, 5}}) {
        pyramid<rg8> mips(size, 4);
        const image<rg8> map(size);
        mips.build(map.view(), tile_grid(size, 4));
        CHECK(mips.coarsest() == 0);
        CHECK(test::same_bits(sample(map.view(), mips, 0.5f, 0.5f, 1.0f).mask(), 0.0));
    }
}

#ifdef NDEBUG
TEST_CASE("without asserts, a pyramid of another size than the map is not read") {
    const image<rg8> map({5, 3}, rg8::caster(0.5f));
    CHECK(test::same_bits(sample(map.view(), pyramid<rg8>({64, 64}, 8), 2.5f, 1.5f, 2.0f).mask(), 255.0));
}

TEST_CASE("without asserts, a map of another size or with other tiles builds nothing") {
    pyramid<rg8> mips({32, 32}, 8);
    const image<rg8> full({32, 32}, rg8::caster(0.5f)), smaller({32, 31}, rg8::caster(0.5f));
    const auto marked = [](extent size, int tile) {
        tile_grid tiles(size, tile);
        tiles.mark(whole(size));
        return tiles;
    };
    mips.build(smaller.view(), marked({32, 32}, 8));
    mips.build(full.view(), marked({32, 31}, 8));
    mips.build(full.view(), marked({32, 32}, 4));
    CHECK(mips.level(5)(0, 0) == rg8::clear());
    mips.build(full.view(), marked({32, 32}, 8));
    CHECK(mips.level(5)(0, 0) == rg8::caster(0.5f));
}
#endif

TEST_CASE("h16_mip_chain_drift: l levels keep the mask within l/2 codes and the worst map reaches that exactly") {
    // Top down: a texel v of level l is the mean of two of v and two of v - 1 below it, which is v - 1/2 and rounds up.
    constexpr int levels = 7, side = 1 << levels;
    for (const int top : {20, 200}) {
        image<rg8> base({side, side});
        double exact = 0.0;
        test::for_each_texel(whole(base.size()), [&](int x, int y) {
            int v = top;
            for (int l = 0; l < levels; ++l) v -= ((x >> l) ^ (y >> l)) & 1;
            base(x, y) = rg8{{static_cast<std::uint8_t>(v / 2), static_cast<std::uint8_t>(v)}};
            exact += v;
        });
        exact /= side * side;
        const pyramid<rg8> mips = built(base);
        CHECK(mips.coarsest() == levels);
        CHECK(mips.level(levels)(0, 0).stored[1] == top);
        CHECK(exact == doctest::Approx(top - levels / 2.0));
    }
}

TEST_CASE_TEMPLATE("h16_mip_chain_drift: l levels keep the depth within (l+1)(1+t)/(2M) and no receiver before it is shadowed",
                   Texel, rg8, rg16, rg16f, rg32f, tm8, tm16) {
    using channel_type = typename Texel::channel_type;
    dice roll(63);
    sweep depth, shadowed;
    double worst = 0.0, drift = 0.0;
    int texels = 0;
    for (int round = 0; round < 120; ++round) {
        const extent size{64, 64};
        image<Texel> casters(size, Texel::clear());
        const float s = roll.unit();
        for (int n = roll(1, 40); n > 0; --n) casters.view().fill(roll.rect(size, 0), Texel::caster(s));
        image<double> exact(size); // the mask without any rounding
        const test::taps k = test::taps_of<binomial<3>>();
        test::for_each_texel(whole(size), [&](int x, int y) {
            exact(x, y) = test::convolved<double>(casters, k, x, y, 1) / (k.total * static_cast<double>(k.total));
        });
        const double t = read(Texel::caster(s)).depth() / filtered<Texel>::scale;
        const image<Texel> soft = test::dense<binomial<3>>(casters);
        const pyramid<Texel> mips = built(soft);
        for (int l = 0; l <= mips.coarsest(); ++l) {
            const int side = 1 << l;
            test::for_each_texel(whole(level(soft, mips, l).size()), [&](int x, int y) {
                const Texel texel = level(soft, mips, l)(x, y);
                if (!texel.occupied()) return;
                double mask = 0.0;
                test::for_each_texel({x * side, y * side, (x + 1) * side, (y + 1) * side},
                                     [&](int i, int j) { mask += exact(i, j); });
                mask /= side * side;
                const double error = std::abs(static_cast<double>(caster_depth(texel)) - (1.0 - t));
                const double bound = static_cast<double>(depth_error(texel, mip_roundings(l)));
                depth.unless(error <= bound, "level", l, "at", x, y, "error", error, "bound", bound);
                if (bound < 0.5) worst = greater(worst, error / bound);
                const rule careful{.caster = {.roundings = mip_roundings(l)}};
                shadowed.unless(test::same_bits(shadow(texel, s, careful), 0.0f), "level", l, "at", x, y, "s", s);
                if (channel_type::whole_codes && l == 6) {
                    drift += static_cast<double>(channel_type::code(texel.stored[1])) - mask;
                    ++texels;
                }
            });
        }
    }
    CHECK(depth.report() == "");
    CHECK(shadowed.report() == "");
    MESSAGE("largest share of the bound: " << worst << ", mean drift of the mask at level 6: " << drift / greater(texels, 1));
    if (Texel::representation_type::premultiplied)
        CHECK(worst > (channel_type::whole_codes ? 0.98 : 0.35)); // few floats come near it
    if (channel_type::whole_codes) {
        CHECK(drift / texels > 0.0); // halves go up
        CHECK(drift / texels < 6.0 / 8.0);
    }
}

TEST_CASE_TEMPLATE("a level of ratios loses less than a code a level of the mean depth below it and says so", Texel, tm8, tm16) {
    dice roll(66);
    const double code = 1.0 / static_cast<double>(Texel::channel_type::scale);
    sweep wrong;
    double worst = 0.0;
    for (int round = 0; round < 400; ++round) {
        image<Texel> base({32, 32});
        const int depth = roll(0, 200);
        test::for_each_texel(whole(base.size()), [&](int x, int y) {
            base(x, y) =
                Texel::caster(static_cast<float>(1.0 - (depth + (roll.one_in(4) ? 0 : 1)) * code)); // 3/4 are lost each time
        });
        const pyramid<Texel> mips = built(base);
        for (int l = 1; l <= mips.coarsest(); ++l)
            test::for_each_texel(whole(mips.level(l).size()), [&](int x, int y) {
                double exact = 0.0;
                const int side = 1 << l;
                test::for_each_texel({x * side, y * side, (x + 1) * side, (y + 1) * side},
                                     [&](int i, int j) { exact += static_cast<double>(caster_depth(base(i, j))) / (side * side); });
                const double error = static_cast<double>(caster_depth(mips.level(l)(x, y))) - exact; // away from the light
                wrong.unless(error >= -0x1p-24 && error <= static_cast<double>(depth_error(mips.level(l)(x, y), l)), "level", l,
                             error);
                worst = greater(worst, error / code);
            });
    }
    CHECK(wrong.report() == "");
    CHECK(worst > 0.7);
}

TEST_CASE_TEMPLATE("at a whole lod a sample is the sample of that level and between two it is their blend, exactly", Texel, rg8,
                   rgba16, rg16f, tm8) {
    dice roll(64);
    const image<Texel> base = test::dense<binomial<2>>(test::noise<Texel>(roll, {40, 24}, 2));
    const pyramid<Texel> mips = built(base);
    sweep wrong;
    for (int i = 0; i < 20'000; ++i) {
        const float x = 48.0f * roll.unit() - 4.0f, y = 32.0f * roll.unit() - 4.0f;
        const int part = roll.one_in(3) ? 0 : roll(0, 255), l = roll(0, mips.coarsest() - 1);
        const float size = std::ldexp(1.0f, -l), beside = (roll.unit() - 0.5f) * 0.99f; // to the nearest 1/256
        const filtered<Texel> f =
            sample(base.view(), mips, x, y, static_cast<float>(l) + (static_cast<float>(part) + beside) / 256.0f);
        const filtered<Texel> fine = sample(level(base, mips, l), x * size, y * size),
                              coarse = sample(level(base, mips, l + 1), x * size / 2.0f, y * size / 2.0f);
        for (int c = 0; c < Texel::channels; ++c) {
            const double expected = fine.code[c] + part * (coarse.code[c] - fine.code[c]) / 256.0; // exact: these are short numbers
            wrong.unless(test::same_bits(f.code[c], expected), "level", l, "part", part, "at", x, y, "channel", c);
        }
        wrong.unless(f.depth() >= 0.0 && f.depth() <= f.mask(), "e > m at", x, y);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("a blend of float levels is within 2^-45 of the exact one and most of that is reached") {
    dice roll(68);
    image<rg32f> base({16, 16});
    test::for_each_texel(whole(base.size()), [&](int x, int y) { // digits of many magnitudes: a sample has all 53 bits
        base(x, y).stored[1] = roll.one_in(2) ? 0.5f : roll.unit() * std::ldexp(1.0f, -roll(8, 20));
    });
    const pyramid<rg32f> mips = built(base);
    long double worst = 0.0L;
    for (int i = 0; i < 100'000; ++i) {
        const float x = 16.0f * roll.unit(), y = 16.0f * roll.unit();
        const int part = roll(1, 255);
        const long double fine = static_cast<long double>(sample(base.view(), x, y).mask()),
                          coarse = static_cast<long double>(sample(mips.level(1), x / 2.0f, y / 2.0f).mask()),
                          exact = ((256 - part) * fine + part * coarse) / 256.0L;
        const double found = sample(base.view(), mips, x, y, static_cast<float>(part) / 256.0f).mask();
        worst = std::max(worst, std::fabs(static_cast<long double>(found) - exact) / exact);
    }
    CHECK(worst <= 0x1p-45L);
    CHECK(worst > 0x1p-45L * 0.9L);
}

TEST_CASE("a lod below 0 or NaN is level 0 and one beyond the last is the last") {
    dice roll(65);
    const image<rg8> base = test::noise<rg8>(roll, {32, 32}, 2);
    const pyramid<rg8> mips = built(base);
    const auto same = [](const filtered<rg8>& a, const filtered<rg8>& b) {
        return test::same_bits(a.code[0], b.code[0]) && test::same_bits(a.code[1], b.code[1]);
    };
    for (const float lod : {-1.0f, -0.0f, -test::infinity<float>, test::nan<float>})
        CHECK(same(sample(base.view(), mips, 7.3f, 9.1f, lod), sample(base.view(), 7.3f, 9.1f)));
    for (const float lod : {5.0f, 5.5f, 1e9f, test::infinity<float>})
        CHECK(same(sample(base.view(), mips, 7.3f, 9.1f, lod), sample(mips.level(5), 7.3f / 32.0f, 9.1f / 32.0f)));
    CHECK(same(sample(base.view(), mips, test::nan<float>, 9.1f, 1.0f), read(rg8::clear())));
    CHECK(same(sample(base.view(), pyramid<rg8>(), 3.3f, 3.3f, 4.0f), sample(base.view(), 3.3f, 3.3f)));
}
