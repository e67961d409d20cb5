// gnomon: soft shadow maps. Which optional channels a texel has at all.
#pragma once

namespace gnomon::inline GNOMON_BUILD {

/// Simulate only what the scene calls for: an effect that is off costs no byte of a texel and no instruction.
struct effects {
    /// A third number that ends the shadow at the first receiver behind the caster (Salzman 2007, "Integrating with Single-pass
    /// Lightmaps").
    bool far_bound = false;
    /// A contribution that replaces the mask as intensity, so that a caster may be translucent (Salzman 2007, "Possible
    /// Extensions").
    bool translucency = false;

    friend constexpr bool operator==(effects, effects) = default;
};

} // namespace gnomon::inline GNOMON_BUILD
