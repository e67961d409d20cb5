// gnomon: soft shadow maps. What the two numbers of a texel mean where 8 bits have to do: the depth itself beside its mask.
#pragma once

#include <gnomon/texel/depth_mask.hpp>

namespace gnomon::inline GNOMON_BUILD {

/// The depth channel holds t = e/m, the mean reversed depth of the casters, rounded down; the mask holds m, to nearest. Made after
/// the blur, from its exact sums. Clear, and whatever rounds to an empty mask, is all zero.
///
/// In a premultiplied pair the error of a depth grows as 1/m; here that of a lone caster is in [0, 1/scale) at every mask but 0, from
/// its depth to what is read. A mean of casters as they are stored loses less than a code each time it is rounded. All of it errs
/// towards the light. So 8 bits decide as 16 bits do wherever a receiver is 1/255 of the light's range behind its casters. The price: a
/// texture unit must not filter it, for t has to be multiplied by m first, as `sample` and the filters
/// here do; and one division for every filtered texel. For whole codes; half and float have no such error to cure.
struct depth_ratio {
    static constexpr bool premultiplied = false;
    static constexpr double clear_depth = 0.0;

    /// What a surface at depth `z` holds in its depth and far-bound channels: the largest code that is not nearer to the light.
    /// NaN counts as the far plane.
    template <channel Channel> [[nodiscard]] static constexpr typename Channel::storage encode(float z) noexcept {
        const double codes = z < 1.0f ? static_cast<double>(saturate(z)) * static_cast<double>(Channel::scale)
                                      : static_cast<double>(Channel::scale); // exact
        const int down = static_cast<int>(codes), up = static_cast<double>(down) < codes ? down + 1 : down;
        return static_cast<typename Channel::storage>(static_cast<int>(Channel::scale) - up);
    }

    template <typename Code> [[nodiscard]] static constexpr bool nearer(Code a, Code b) noexcept { return a > b; }

    /// A mean of casters' codes, rounded down, is still no smaller than the farthest one: nothing that a filter rounds can take a
    /// shadow away or add one. What is left is the rounding of the casters themselves, which goes one way.
    template <channel Channel> [[nodiscard]] static constexpr rounding_error depth_rounding() noexcept { return {0.0f, 0.0f}; }
    template <channel Channel> [[nodiscard]] static constexpr rounding_error mask_rounding() noexcept { return {0.0f, 0.0f}; }
    template <channel Channel> [[nodiscard]] static constexpr caster_rounding depth_of_caster() noexcept {
        return {.nearer = 0.0f, .farther = 1.0f / Channel::scale};
    }

    template <typename Real> [[nodiscard]] static constexpr Real complement(Real depth_code, Real /*scale*/) noexcept {
        return depth_code;
    }

    /// e > m (1-z), with e = t m. What the products of 16-bit codes round errs towards the light too: both sides round to the
    /// nearest double, and one of them is one.
    template <typename Real> [[nodiscard]] static constexpr auto behind(Real e, Real m, Real z) noexcept {
        return depth_mask::behind(e, m, z);
    }
};

} // namespace gnomon::inline GNOMON_BUILD
