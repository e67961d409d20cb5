// gnomon: soft shadow maps. What the two numbers of a texel mean in Salzman 2007, to the letter: kept for comparison.
#pragma once

#include <gnomon/texel/channel.hpp>

namespace gnomon::inline GNOMON_BUILD {

/// The depth channel holds d = p (s-1) + 1, cleared to 1; the mask holds m = p, cleared to 0.
///
/// A named baseline, in every table beside depth_mask, to show what the complement is for: the clear value survives a filter
/// only if the weights sum to one in the arithmetic used; in floats d keeps an absolute, not a relative precision, which the
/// division by m then magnifies (half at m = 1/100: 0.059 of the depth range against 0.001); unorm formats are equal, ties apart.
struct paper_depth_mask {
    static constexpr bool premultiplied = true;
    /// What an empty texel holds in its depth and far-bound channels.
    static constexpr double clear_depth = 1.0;

    /// What a surface at depth `z` holds in them, to nearest. NaN counts as the far plane.
    template <channel Channel> [[nodiscard]] static constexpr typename Channel::storage encode(float z) noexcept {
        const bool number = same(z, z); // not z < 1: of that clang 19 for AArch64 makes a minimum, which keeps a signalling NaN
        return Channel::encode(number ? static_cast<double>(z) : 1.0);
    }

    /// Is a surface stored as `a` nearer to the light than one stored as `b`?
    template <typename Code> [[nodiscard]] static constexpr bool nearer(Code a, Code b) noexcept { return a < b; }

    /// How far a rounded depth code may be from its exact value: near d = 1 a relative error is an absolute one.
    template <channel Channel> [[nodiscard]] static constexpr rounding_error depth_rounding() noexcept {
        return Channel::whole_codes ? Channel::rounding : rounding_error{.relative = 0.0f, .absolute = Channel::max_error};
    }
    template <channel Channel> [[nodiscard]] static constexpr rounding_error mask_rounding() noexcept { return Channel::rounding; }
    template <channel Channel> [[nodiscard]] static constexpr caster_rounding depth_of_caster() noexcept {
        return {.nearer = Channel::max_error, .farther = Channel::max_error};
    }

    /// Premultiplied reversed depth e = 1 - d from the filtered depth code, in codes.
    template <typename Real> [[nodiscard]] static constexpr Real complement(Real depth_code, Real scale) noexcept {
        return scale - depth_code;
    }

    /// Is a receiver at depth `z` behind the caster of a filtered pair?   z > s = (d-1)/m + 1
    ///
    /// The paper's own division, in the paper's own single precision. It needs a case that depth_mask does not: a bias towards
    /// shadow may leave m <= 0, where everything is behind a caster that has any depth.
    template <typename Real> [[nodiscard]] static constexpr bool behind(Real e, Real m, Real z) noexcept {
        return select(m > Real(0), static_cast<float>(z) > static_cast<float>(-e) / static_cast<float>(m) + 1.0f, e > Real(0));
    }
};

} // namespace gnomon::inline GNOMON_BUILD
