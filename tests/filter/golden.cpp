// One number for each format and kernel: the same on every compiler, at every level of optimisation, with and without fused
// multiply-adds, on either endianness. Found by g++ 12 and clang 14, which agreed.
#include "../support/filtering.hpp"

#include <doctest/doctest.h>

#include <array>

namespace {
template <typename Texel> std::array<std::uint64_t, 4> hashes() {
    test::dice roll(81);
    const auto from = test::noise<Texel>(roll, {61, 47}, 3);
    return {test::hash(test::dense<gnomon::box<2>>(from)), test::hash(test::dense<gnomon::tent<4>>(from)),
            test::hash(test::dense<gnomon::binomial<3>>(from)), test::hash(test::dense<gnomon::gaussian<8>>(from))};
}
void check(const std::array<std::uint64_t, 4>& found, const std::array<std::uint64_t, 4>& golden) {
    for (std::size_t i = 0; i < golden.size(); ++i) CHECK(found[i] == golden[i]);
}

/// Nearly all of its weight is in the middle, so that sums of halves as well have more digits than a double.
struct needle {
    static constexpr int radius = 2;
    static constexpr int total = 65535;
    static constexpr std::array weights{1, 255, 65023, 255, 1};
};

/// Maps that are balanced on an edge. A rounding to 11 or 24 bits hides what a fused multiply-add does to the last of a double's 53,
/// unless the sum lies just where that rounding turns over. So the texels on a stair from the middle of the map to its corner, one
/// after the other, are made as large as they can be without tipping the result in the middle: their bits then hold its every digit.
template <typename Texel, gnomon::kernel Kernel> std::uint64_t hash_of_edges() {
    using storage = typename Texel::storage;
    using word = std::conditional_t<sizeof(storage) == 2, std::uint16_t, std::uint32_t>; // ordered as what they stand for
    constexpr int r = Kernel::radius, binade = sizeof(storage) == 2 ? 1 << 10 : 1 << 23;
    constexpr auto bits_of = [](double v) { return std::bit_cast<word>(Texel::channel_type::encode(v)); };
    constexpr word one = bits_of(1.0), half = bits_of(0.5), small = bits_of(0x1p-14);
    test::dice roll(82);
    gnomon::filter_scratch<Texel, Kernel> scratch(1);
    std::uint64_t together = 0;
    for (int picture = 0; picture < 40; ++picture) {
        gnomon::image<Texel> map({2 * r + 1, 2 * r + 1}, Texel::clear()), soft = map;
        const auto set = [&](int x, int y, word bits) { map(x, y).stored[0] = std::bit_cast<storage>(bits); };
        const auto middle = [&] {
            gnomon::filter_region(map.view(), soft.view(), {r, r, r + 1, r + 1}, scratch);
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

TEST_CASE("a filtered map has the same bits everywhere") { // box<2>, tent<4>, binomial<3>, gaussian<8>
    check(hashes<gnomon::rgba8>(), {0x18D1B57239B0661B, 0x3F4C4F962AAB0552, 0x1919CD23071BC514, 0xBE15F1878FABAE6E});
    check(hashes<gnomon::rgba16>(), {0x58E40AA7DFF11723, 0x011615326BA5A675, 0x634E23B74ECFD3BF, 0xD4D246368635D1D1});
    check(hashes<gnomon::rgba16f>(), {0x89CA26D80A5206B7, 0x0DAA04070A0C67E8, 0x4BF7985CB0194D3F, 0xC9D7F685DE3D97D1});
    check(hashes<gnomon::rgba32f>(), {0x3EE755EAB6C0ECBE, 0x276DEC7EE4093703, 0xEE00452EDB154B6B, 0x59506C03F2D08B77});
}

TEST_CASE("no digit of a half or float sum depends on fused multiply-adds") {
    CHECK(hash_of_edges<gnomon::rg16f, needle>() == 0xCD6DABD5F7C92D4B);
    CHECK(hash_of_edges<gnomon::rg32f, needle>() == 0x8E46827843D9AB08);
    CHECK(hash_of_edges<gnomon::rg32f, gnomon::gaussian<8>>() == 0x5AD722253ED426CF);
}
