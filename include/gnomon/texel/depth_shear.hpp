// gnomon: soft shadow maps. Spending a texel's codes on the part of the light's depth range in which casters are.
#pragma once

#include <gnomon/unit.hpp>

namespace gnomon {

/// Moves depths so that those of the casters, `nearest` to `farthest`, become 0 to 1. Give it the casters of a light, or of a
/// region that is sampled by itself; store Texel::caster(shear(s)) and ask shadow(texel, shear(z)).
///
/// Receivers need not lie between: before the casters they are below 0, and lit; beyond them above 1, and behind every caster. So
/// each error and each band of a bias shrinks by `span`: 8 bits over a sixteenth of the range are 12 bits. It is linear, hence
/// commutes with every filter, e' = (e - t m) / span with t = 1 - farthest, and never changes the order of two depths: what lies at
/// its caster's depth stays lit. An empty interval changes nothing; a narrower one than 2^-16 is taken to be that wide.
struct depth_shear {
    depth_interval casters{0.0f, 1.0f};

    /// How much of the light's range is stored, in (0, 1] for casters in the light's range.
    [[nodiscard]] constexpr float span() const noexcept {
        return casters.empty() ? 1.0f : greater(casters.farthest - casters.nearest, 0x1p-16f);
    }
    /// A depth of the light as a depth of the texels; NaN stays NaN. Within 3 * 2^-24 of it, relatively, and monotone.
    [[nodiscard]] constexpr float operator()(float z) const noexcept { return (z - first()) / span(); }
    /// And back, for tools. Correctly rounded.
    [[nodiscard]] constexpr float inverse(float z) const noexcept {
        return static_cast<float>(static_cast<double>(first()) +
                                  static_cast<double>(z) * static_cast<double>(span())); // no product to fuse
    }

  private:
    [[nodiscard]] constexpr float first() const noexcept { return casters.empty() ? 0.0f : casters.nearest; }
};

} // namespace gnomon
