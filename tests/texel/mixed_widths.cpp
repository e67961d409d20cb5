// Why a texel has one width: what a 16-bit depth beside an 8-bit mask would be, measured. Nothing here is offered by the library.
// (Un-premultiplied, as depth_ratio, the two would be sound; but aligned they take the 4 bytes of tm16.)
#include <gnomon/texel/texel.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

TEST_CASE("a 16-bit depth beside an 8-bit mask takes 3 bytes to break e <= m and to be farther off than tm8 is with 2") {
    int cases = 0, broken = 0;
    double worst_at[4]{}; // m in (1/2, 1], (1/4, 1/2], (1/8, 1/4], (1/16, 1/8]
    for (int taps : {9, 25, 81, 289, 1089})
        for (int covered = 1; covered <= taps; ++covered)
            for (int i = 0; i <= 512; ++i) {
                const double m = covered * 1.0 / taps, t = i / 512.0;
                const double mask = gnomon::unorm8::encode(m) / 255.0, depth = gnomon::unorm16::encode(t * m) / 65535.0;
                ++cases;
                broken += depth > mask ? 1 : 0;
                const int octave = static_cast<int>(std::floor(-std::log2(m) + 1e-9));
                if (octave < 4 && mask > 0.0)
                    worst_at[octave] = std::max(worst_at[octave], std::abs(std::min(depth, mask) / mask - t)); // forced to e <= m
            }
    CHECK(broken > cases / 300);         // so every store would have to force it
    constexpr double code = 1.0 / 255.0; // all that tm8 gives up, at any mask
    CHECK(worst_at[0] < code);
    CHECK(worst_at[0] > 0.9 * code); // no better even there
    CHECK(worst_at[1] > 1.8 * code);
    CHECK(worst_at[2] > 3.6 * code);
    CHECK(worst_at[3] > 6.5 * code);
}
