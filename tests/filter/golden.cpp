// One number for each format and kernel: the same on every compiler, at every level of optimisation, with and without fused
// multiply-adds, on either endianness. Found by g++ 12 and clang 14, which agreed.
#include "../support/filtering.hpp"

#include <doctest/doctest.h>

#include <array>

namespace {
template <typename Texel>
std::array<std::uint64_t, 4> hashes() {
    test::dice roll(81);
    const auto from = test::noise<Texel>(roll, {61, 47}, 3);
    return {test::hash(test::dense<gnomon::box<2>>(from)), test::hash(test::dense<gnomon::tent<4>>(from)),
            test::hash(test::dense<gnomon::binomial<3>>(from)), test::hash(test::dense<gnomon::gaussian<8>>(from))};
}
void check(const std::array<std::uint64_t, 4>& found, const std::array<std::uint64_t, 4>& golden) {
    for (std::size_t i = 0; i < golden.size(); ++i)
        CHECK(found[i] == golden[i]);
}
} // namespace

TEST_CASE("a filtered map has the same bits everywhere") { // box<2>, tent<4>, binomial<3>, gaussian<8>
    check(hashes<gnomon::rgba8>(), {0x18D1B57239B0661B, 0x3F4C4F962AAB0552, 0x1919CD23071BC514, 0xBE15F1878FABAE6E});
    check(hashes<gnomon::rgba16>(), {0x58E40AA7DFF11723, 0x011615326BA5A675, 0x634E23B74ECFD3BF, 0xD4D246368635D1D1});
    check(hashes<gnomon::rgba16f>(), {0x89CA26D80A5206B7, 0x0DAA04070A0C67E8, 0x4BF7985CB0194D3F, 0xC9D7F685DE3D97D1});
    check(hashes<gnomon::rgba32f>(), {0x3EE755EAB6C0ECBE, 0x276DEC7EE4093703, 0xEE00452EDB154B6B, 0x59506C03F2D08B77});
}
