// Kernels, filters and samples.
#include "golden.hpp"

#include "../support/filtering.hpp"

#include <gnomon/filter/pyramid.hpp>

#include <array>
#include <type_traits>

namespace golden {
namespace {

/// Nearly all of its weight is in the middle, so that sums of halves as well have more digits than a double.
struct needle {
    static constexpr int radius = 2;
    static constexpr int total = 65535;
    static constexpr std::array weights{1, 255, 65023, 255, 1};
};

/// Maps that are balanced on an edge. A rounding to 11 or 24 bits hides what a fused multiply-add does to the last of a double's 53,
/// unless the sum lies just where that rounding turns over. So the texels on a stair from the middle of the map to its corner, one
/// after the other, are made as large as they can be without tipping the result in the middle: their bits then hold its every digit.
template <texel_format Texel, kernel Kernel> std::uint64_t hash_of_edges() {
    using storage = typename Texel::storage;
    using word = std::conditional_t<sizeof(storage) == 2, std::uint16_t, std::uint32_t>; // ordered as what they stand for
    constexpr int r = Kernel::radius, binade = sizeof(storage) == 2 ? 1 << 10 : 1 << 23;
    constexpr auto bits_of = [](double v) { return std::bit_cast<word>(Texel::channel_type::encode(v)); };
    constexpr word one = bits_of(1.0), half = bits_of(0.5), small = bits_of(0x1p-14);
    test::dice roll(82);
    filter_scratch<Texel, Kernel> scratch(1);
    std::uint64_t together = 0;
    for (int picture = 0; picture < 40; ++picture) {
        image<Texel> map({2 * r + 1, 2 * r + 1}, Texel::clear()), soft = map;
        const auto set = [&](int x, int y, word bits) { map(x, y).stored[0] = std::bit_cast<storage>(bits); };
        const auto middle = [&] {
            filter_region(map.view(), soft.view(), {r, r, r + 1, r + 1}, scratch);
            return soft(r, r).stored[0];
        };
        test::for_each_texel(whole(map.size()), [&](int x, int y) {
            const word least = (x == r && y == r) || roll.one_in(2) ? half : small;
            set(x, y, static_cast<word>(least + static_cast<word>(roll(0, binade - 1))));
        });
        for (int step = 2 * r - 1; step >= 0; --step) set(step / 2, (step + 1) / 2, 0);
        const storage before = middle();
        for (int step = 2 * r - 1; step >= 0; --step) { // from the texel that counts most to the one that counts least
            word stays = 0, tips = one;
            while (tips - stays > 1) {
                const auto tried = static_cast<word>(stays + (tips - stays) / 2);
                set(step / 2, (step + 1) / 2, tried);
                (middle() > before ? tips : stays) = tried;
            }
            set(step / 2, (step + 1) / 2, stays);
        }
        together = together * 31 + test::hash(map);
    }
    return together;
}

} // namespace

void print_filter() {
    const auto weights = []<kernel K>(named<K>) {
        hash h;
        h.add(K::radius, K::total);
        for (const int w : K::weights) h.add(w);
        return h;
    };
    print("weights", kernels, weights);
    print("weights",
          std::tuple{named<box<0>>{"box<0>"}, named<tent<255>>{"tent<255>"}, named<binomial<30>>{"binomial<30>"},
                     named<gaussian<64, 33>>{"gaussian<64,33>"}, named<gaussian<256>>{"gaussian<256>"}},
          weights);

    print("filter", filtered_texels, kernels, []<texel_format T, kernel K>(named<T>, named<K>) {
        test::dice roll(81);
        return test::hash(test::dense<K>(test::noise<T>(roll, {61, 47}, 3)));
    });
    print("filter_on_edge", "rg16f", "needle", hash_of_edges<rg16f, needle>());
    print("filter_on_edge", "rg32f", "needle", hash_of_edges<rg32f, needle>());
    print("filter_on_edge", "rg32f", "gaussian<8>", hash_of_edges<rg32f, gaussian<8>>());

    print("mips", filtered_texels, []<texel_format T>(named<T>) {
        test::dice roll(84);
        const image<T> map = test::noise<T>(roll, {61, 47}, 3);
        tile_grid tiles(map.size(), 16);
        tiles.mark(whole(map.size()));
        pyramid<T> mips(map.size(), 16);
        mips.build(map.view(), tiles);
        hash h;
        for (int l = 1; l <= mips.coarsest(); ++l)
            test::for_each_texel(whole(mips.level(l).size()), [&](int x, int y) { h.add(mips.level(l)(x, y)); });
        for (int i = 0; i < 2'000; ++i) {
            const float x = roll.unit() * 64.0f, y = roll.unit() * 64.0f, lod = roll.unit() * 8.0f; // exact products
            for (const double code : sample(map.view(), mips, x, y, lod).code) h.add(code);
        }
        return h;
    });

    print("sample", texels, []<texel_format T>(named<T>) {
        test::dice roll(83);
        const image<T> map = test::noise<T>(roll, {61, 47}, 2);
        hash h;
        const auto add = [&](float x, float y) {
            const filtered<T> f = sample(map.view(), x, y);
            for (const double code : f.code) h.add(code);
            h.add(f.depth(), f.contribution());
        };
        for (int i = 0; i < 5'000; ++i) {
            const float x = roll.unit() * 64.0f, y = roll.unit() * 64.0f; // exact products
            add(x, y);
        }
        for (const float v : test::hostile_floats) add(v, 7.25f);
        return h;
    });
}

} // namespace golden
