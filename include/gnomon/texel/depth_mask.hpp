// gnomon: soft shadow maps. What the two numbers of a texel mean: the premultiplied complement, which is the default.
#pragma once

#include <gnomon/texel/channel.hpp>

namespace gnomon::inline GNOMON_BUILD {

/// The depth channel holds e = p (1-s), the mask holds m = p, where p is the share of the footprint that is caster.
///
/// (e, m) is premultiplied alpha whose colour is reversed depth. Clear is all zero and stays zero under every linear filter;
/// e/m does not depend on the sum of the weights; floats keep their relative precision in the penumbra; e <= m always.
/// Salzman 2007 writes the same pair as d = 1 - e; see paper_depth_mask.
struct depth_mask {
    /// The depth is stored times the mask, so any linear filter may take the channels one by one: a texture unit's, too.
    static constexpr bool premultiplied = true;
    /// What an empty texel holds in its depth and far-bound channels.
    static constexpr double clear_depth = 0.0;

    /// What a surface at depth `z` holds in them, to nearest. NaN counts as the far plane.
    template <channel Channel> [[nodiscard]] static constexpr typename Channel::storage encode(float z) noexcept {
        return Channel::encode(1.0 - static_cast<double>(z));
    }

    /// Is a surface stored as `a` nearer to the light than one stored as `b`?
    template <typename Code> [[nodiscard]] static constexpr bool nearer(Code a, Code b) noexcept { return a > b; }

    /// How far a rounded code may be from its exact value, and a caster's stored depth from its own.
    template <channel Channel> [[nodiscard]] static constexpr rounding_error depth_rounding() noexcept { return Channel::rounding; }
    template <channel Channel> [[nodiscard]] static constexpr rounding_error mask_rounding() noexcept { return Channel::rounding; }
    template <channel Channel> [[nodiscard]] static constexpr caster_rounding depth_of_caster() noexcept {
        return {.nearer = Channel::max_error, .farther = Channel::max_error};
    }

    /// Premultiplied reversed depth e from the filtered depth code, in codes: here, itself.
    template <typename Real> [[nodiscard]] static constexpr Real complement(Real depth_code, Real /*scale*/) noexcept {
        return depth_code;
    }

    /// Is a receiver at depth `z` behind the caster of a filtered pair (e, m)?   e > m (1-z)
    ///
    /// No division, so m = 0 is lit by construction. Both sides are homogeneous: e and m may be codes. Evaluated in double
    /// the comparison is exact for every e and m with up to 24 significant bits and e <= m, and every float `z`: the first
    /// form rounds nothing when z >= 1/2, the second rounds m - e only where that cannot change the answer.
    /// In single precision too, if only the comparison with the product is exact, which is how it is written in GLSL.
    /// NaN anywhere compares false: lit. z = +inf counts as behind everything, z = -inf as before everything.
    template <typename Real> [[nodiscard]] static constexpr auto behind(Real e, Real m, Real z) noexcept {
        return select((z < Real(0.5)), m * z > m - e, e > m * (Real(1) - z));
    }
};

} // namespace gnomon::inline GNOMON_BUILD
