// Four texels blended, against whole numbers: a position is a whole number of 1/256 texel, so a blend of codes is one of 1/65536 code.
#include <gnomon/filter/sample.hpp>

#include "../support/bits.hpp"
#include "../support/float_dice.hpp"
#include "../support/formats.hpp"
#include "../support/images.hpp"
#include "../support/sweep.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

using namespace gnomon;
using test::sweep;

namespace {

/// 65536 times the blend at (column / 256, row / 256) texels: every texel weighs what is left of its 256 x 256 tent.
template <typename Texel> std::int64_t blend(const image<Texel>& map, int column, int row, int channel) {
    const auto tent = [](int at, int texel) { return std::int64_t{greater(0, 256 - std::abs(at - (256 * texel + 128)))}; };
    std::int64_t sum = 0;
    test::for_each_texel(grow(whole(map.size()), 2), [&](int x, int y) {
        const Texel& t = whole(map.size()).contains(x, y) ? map(x, y) : Texel::clear();
        sum += tent(column, x) * tent(row, y) * t.stored[channel];
    });
    return sum;
}

template <typename Texel> bool is_clear(const filtered<Texel>& f) {
    for (int c = 0; c < Texel::channels; ++c)
        if (!test::same_bits(f.code[c], read(Texel::clear()).code[c])) return false;
    return true;
}

} // namespace

TEST_CASE_TEMPLATE("reading a stored texel gives its codes and the complement of the depths", Texel, rg8, rgba16, rgba16f, rgba32f,
                   test::paper8, test::paper_rgba16) {
    using channel_type = typename Texel::channel_type;
    test::float_dice dice(94);
    const bool complement = std::is_same_v<typename Texel::representation_type, depth_mask>;
    const double scale = static_cast<double>(channel_type::scale);
    for (int i = 0; i < 100; ++i) {
        const Texel t = test::any_caster<Texel>(dice);
        const filtered<Texel> f = read(t);
        const auto code = [&](int index) { return static_cast<double>(channel_type::code(t.stored[index])); };
        CHECK(test::equal(f.depth(), complement ? code(0) : scale - code(0)));
        CHECK(test::equal(f.mask(), code(1)));
        if constexpr (Texel::effects.far_bound)
            CHECK(test::equal(f.far_bound(), complement ? code(Texel::far_index) : scale - code(Texel::far_index)));
        CHECK(test::equal(f.contribution(), code(Texel::effects.translucency ? Texel::contribution_index : 1)));
    }
}

TEST_CASE_TEMPLATE("a blend of four unorm texels is exact at every 1/256 texel on and around the map", Texel, rg8, rgba16,
                   test::paper8, test::paper_rgba16) {
    test::dice dice(95);
    const image<Texel> map = test::noise<Texel>(dice, {3, 2}, 2);
    sweep wrong;
    for (int row = -300; row < 2 * 256 + 300; row += 5)
        for (int column = -300; column < 3 * 256 + 300; column += 7) {
            const filtered<Texel> f =
                sample(image_view<const Texel>(map.view()), static_cast<float>(column) / 256.0f, static_cast<float>(row) / 256.0f);
            for (int c = 0; c < Texel::channels; ++c)
                wrong.unless(test::equal(f.code[c] * 65536.0, static_cast<double>(blend(map, column, row, c))), "column", column,
                             "row", row, "channel", c);
        }
    CHECK(wrong.report() == "");
}

TEST_CASE("a position is taken to the nearest 1/256 texel and halves go up") {
    test::dice dice(96);
    const image<rg16> map = test::noise<rg16>(dice, {3, 2}, 1);
    sweep wrong;
    for (int eighths = -200 * 8; eighths < 3 * 256 * 8; ++eighths) { // of 1/256 texel
        const int column = static_cast<int>(std::floor(eighths / 8.0 + 0.5));
        const filtered<rg16> f = sample(map.view(), static_cast<float>(eighths) / 2048.0f, 0.5f);
        wrong.unless(test::equal(f.code[0] * 65536.0, static_cast<double>(blend(map, column, 128, 0))), "eighths", eighths);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("the centre of a texel gives the texel", Texel, rg8, rgba16f, rgba32f, test::ratio_rgba8, test::paper_rgba32f) {
    test::dice dice(97);
    image<Texel> map = test::noise<Texel>(dice, {6, 5}, 2);
    sweep wrong;
    test::for_each_texel(whole(map.size()), [&](int x, int y) {
        const filtered<Texel> f = sample(map.view(), static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f),
                              stored = read(map(x, y));
        for (int c = 0; c < Texel::channels; ++c)
            wrong.unless(test::same_bits(f.code[c], stored.code[c]), "x", x, "y", y, "channel", c);
    });
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("half a texel off the map and farther all is clear as it is at NaN and infinity", Texel, rgba8, rg32f, tm8,
                   test::paper8, test::paper32f) {
    const image<Texel> map({4, 3}, Texel::caster(0.25f));
    const auto at = [&](float x, float y) { return sample(map.view(), x, y); };
    for (const float off : {-0.5f, -0.75f, -1.0f, -100.0f, -0x1p31f, -0x1p127f, 4.5f, 5.0f, 0x1p31f, 0x1p127f,
                            test::infinity<float>, -test::infinity<float>, test::nan<float>}) {
        CHECK(is_clear(at(off, 1.0f)));
        CHECK(is_clear(at(1.0f, off > 4.0f ? off - 1.0f : off)));
        CHECK(is_clear(at(off, off)));
    }
    CHECK(!is_clear(at(-0.49f, 1.0f)));
    CHECK(!is_clear(at(4.49f, 3.49f)));
    for (const float x : test::hostile_floats) {
        CHECK(is_clear(sample(image_view<const Texel>(), x, 0.0f)));
        CHECK(is_clear(sample(image<Texel>({0, 3}).view(), x, 1.0f)));
    }
}

TEST_CASE_TEMPLATE("a blend keeps e at or below m and both in range", Texel, rg8, rg16f, rg32f, tm8, tm16) {
    test::float_dice dice(98);
    image<Texel> map({8, 8});
    sweep wrong;
    for (int round = 0; round < 50; ++round) {
        test::for_each_texel(whole(map.size()), [&](int x, int y) {
            using channel_type = typename Texel::channel_type;
            auto m = channel_type::encode(static_cast<double>(dice.any_unit())),
                 e = dice.one_in(2) ? m : channel_type::encode(static_cast<double>(dice.any_unit()));
            if (e > m) e = m;
            map(x, y) = {{e, m}};
        });
        for (int i = 0; i < 2'000; ++i) {
            const float x = dice.unit() * 9.0f - 0.5f, y = dice.unit() * 9.0f - 0.5f;
            const filtered<Texel> f = sample(map.view(), x, y);
            wrong.unless(f.depth() >= 0.0 && f.depth() <= f.mask() && f.mask() <= filtered<Texel>::scale, "x", x, "y", y, "e",
                         f.depth(), "m", f.mask());
        }
    }
    CHECK(wrong.report() == "");
}
