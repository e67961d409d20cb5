// gnomon: soft shadow maps. Spending a texel's codes on the part of the light's depth range in which casters are.
#pragma once

#include <gnomon/unit.hpp>

namespace gnomon::inline GNOMON_BUILD {

/// Moves depths so that those of the casters, `nearest` to `farthest`, become 0 to 1. Give it the casters of a light, or of a
/// region that is sampled by itself; store Texel::caster(shear(s)) and ask shadow(texel, shear(z)).
///
/// Receivers need not lie between: before the casters they are below 0, and lit; beyond them above 1, and behind every caster. So
/// each error and each band of a bias shrinks by `span`: 8 bits over a sixteenth of the range are 12 bits. It is linear, hence
/// commutes with every filter, e' = (e - t m) / span with t = 1 - farthest, and never changes the order of two depths: what lies at
/// its caster's depth stays lit.
///
/// What else is a depth shrinks too. A far bound is stored, so the interval has to reach over the receivers that bound; beyond it
/// none bounds. bias::depth and rule::fade are shares of `span`, and rule::lit_beyond lights whatever is behind the interval.
///
/// An empty interval and an infinite one change nothing; a narrower one than 2^-16 is taken to be that wide.
struct depth_shear {
    depth_interval casters{0.0f, 1.0f};

    /// How much of the light's range is stored, in (0, 1] for casters in the light's range.
    [[nodiscard]] constexpr float span() const noexcept {
        return cuts() ? greater(casters.farthest - casters.nearest, 0x1p-16f) : 1.0f;
    }
    /// The depth that is stored as 0.
    [[nodiscard]] constexpr float nearest() const noexcept { return cuts() ? casters.nearest : 0.0f; }
    /// A depth of the light as a depth of the texels; NaN stays NaN. Within 3 * 2^-24 of it, relatively, and monotone.
    [[nodiscard]] constexpr float operator()(float z) const noexcept { return (z - nearest()) / span(); }
    /// And back, for tools. Rounded to float from a double.
    [[nodiscard]] constexpr float inverse(float z) const noexcept {
        return static_cast<float>(static_cast<double>(nearest()) +
                                  static_cast<double>(z) * static_cast<double>(span())); // no product to fuse
    }

  private:
    [[nodiscard]] constexpr bool cuts() const noexcept {
        return !casters.empty() && casters.farthest - casters.nearest < 0x1p60f; // neither end is infinite
    }
};

} // namespace gnomon::inline GNOMON_BUILD
