// gnomon: soft shadow maps. The decision: is a receiver in shadow, and how much?
#pragma once

#include <gnomon/filter/sample.hpp>
#include <gnomon/receive/bias.hpp>

#include <concepts>
#include <cstdint>

namespace gnomon::inline GNOMON_BUILD {

/// How a filtered texel becomes an intensity. What every receive function uses if nothing else is said, rule{}: no false shadow.
struct rule {
    /// Which way the test against the caster errs.
    bias caster = towards_light;
    /// The same for the far bound, which is a caster of light: towards light keeps the shadow on the receiver that is the bound.
    /// More `depth` pushes the bound away from the light. Ignored without effects{.far_bound = true}.
    bias far_bound = towards_light;
    /// Past the far bound the shadow fades out over this share of the depth range; 0 ends it at once.
    float fade = 0.0f;
    /// What lies beyond the light's far plane, z > 1: false leaves it to the test, which puts it behind every caster; true is lit.
    bool lit_beyond = false;
};

/// What an intensity is stored in: float in [0, 1], or a code of unorm8 or unorm16.
template <typename T>
concept intensity_number = std::same_as<T, float> || std::same_as<T, std::uint8_t> || std::same_as<T, std::uint16_t>;

namespace detail {

/// Lies a receiver where shadow may fall at all?
template <typename Depth, typename Truth> [[nodiscard]] constexpr auto may_be_shadowed(Depth z, Truth lit_beyond) noexcept {
    return both(z > Depth(0), !both(lit_beyond, z > Depth(1)));
}
[[nodiscard]] constexpr bool may_be_shadowed(depth16 z, bool /*lit_beyond*/) noexcept { return z.code > 0; }

template <texel_format Texel, typename Number, typename Real, typename Depth>
[[nodiscard]] constexpr auto behind_caster(const filtered<Texel, Number>& texel, Depth z,
                                           const bias_steps<Texel, Real, Depth>& by) noexcept {
    const auto near_side = apply(by, texel.depth(), texel.mask(), z);
    return Texel::representation_type::behind(near_side.e, near_side.m, static_cast<Number>(near_side.z));
}
template <texel_format Texel>
[[nodiscard]] constexpr bool behind_caster(const filtered<Texel>& texel, float z, const bias& b) noexcept {
    return behind_caster(texel, z, bias_steps<Texel>::of(b));
}

/// e > m (1-z) times 65535. Whole numbers, or of at most 34 and 17 bits, so nothing is rounded, blends of unorm texels and numbers in
/// float included. What a bias moves past an end of its range stays there, (e, m) at nothing, and z before all casters or behind them.
template <texel_format Texel>
[[nodiscard]] constexpr bool behind_caster(const filtered<Texel>& texel, depth16 z, const bias& b) noexcept {
    const biased<> pair = apply<Texel>(b, texel.depth(), texel.mask(), 0.0f);
    const int depth = z.code - codes_towards_light<Texel>(b), rest = depth16::last - depth;
    return rest < 0 || (depth > 0 && greater(0.0, pair.e) * depth16::last > greater(0.0, pair.m) * rest);
}

/// What is left of a shadow at `z`, from 1 before its far bound to 0 behind it; 1 if no receiver bounds it. \pre mask > 0
template <texel_format Texel, typename Number, typename Real, typename Depth>
[[nodiscard]] constexpr Number before_far_bound(const filtered<Texel, Number>& texel, Depth z,
                                                const bias_steps<Texel, Real, Depth>& by, Number fade) noexcept {
    const biased<Number, Depth> bound = apply(by, texel.far_bound(), texel.mask(), z);
    const Number depth = static_cast<Number>(bound.z);
    const Number farther = let("farther", bound.m * depth);             // alone, so that no compiler fuses it
    const Number passed = let("passed", farther - (bound.m - bound.e)); // m (z - far bound)
    const Number share = let("share", bound.m * fade);
    const auto fades = let("fades", both(fade > Number(0), share > Number(0)));
    const Number left = let("left", Number(1) - passed / select(fades, share, Number(1)));
    const auto beyond = Texel::representation_type::behind(bound.e, bound.m, depth);
    return select(let("bounded", both(texel.far_bound() > Number(0), beyond)), select(fades, saturate(left), Number(0)), Number(1));
}
template <texel_format Texel>
[[nodiscard]] constexpr double before_far_bound(const filtered<Texel>& texel, float z, const rule& r) noexcept {
    if constexpr (Texel::effects.far_bound)
        return before_far_bound(texel, z, bias_steps<Texel>::of(r.far_bound), static_cast<double>(r.fade));
    else
        return 1.0;
}
template <texel_format Texel>
[[nodiscard]] constexpr double before_far_bound(const filtered<Texel>& texel, depth16 z, const rule& r) noexcept {
    return before_far_bound(texel, unorm16::decode(z.code), r);
}

/// `left` of a darkness in codes of the texel, as a share.
template <texel_format Texel, typename Number> [[nodiscard]] constexpr Number intensity_of(Number darkness, Number left) noexcept {
    return saturate(let("darkness", darkness / Number(filtered<Texel>::scale))) * left;
}

/// The same as it is stored. Codes are rounded once, halves upwards; those of a unorm texel of as
/// many bits are its own.
template <intensity_number Intensity, texel_format Texel>
[[nodiscard]] constexpr Intensity stored_intensity(double darkness, double left) noexcept {
    if constexpr (std::same_as<Intensity, float>) {
        return static_cast<float>(intensity_of<Texel>(darkness, left));
    } else {
        constexpr double scale = filtered<Texel>::scale;
        constexpr double last = static_cast<double>(unorm<Intensity>::scale);
        return unorm<Intensity>::store(lesser(greater(0.0, darkness), scale) * last / scale * left);
    }
}

} // namespace detail

/// Intensity of the shadow on a receiver at depth `z`, a float or a depth16, stored as `Intensity`: the filtered mask (or
/// contribution) if the receiver lies behind the caster (Salzman 2007, step 4), cut at the far bound if there is one.
///
/// Total: m = 0, negative or NaN is lit; z <= 0 and NaN is lit; z = +inf is behind everything; any bit pattern gives [0, 1].
/// Exact for the stored codes of unorm texels: no rounding happens before the comparison is decided.
template <intensity_number Intensity, texel_format Texel, typename Depth>
[[nodiscard]] constexpr Intensity shadow_as(const filtered<Texel>& texel, Depth z, const rule& r = {}) noexcept {
    if (!(texel.mask() > 0.0) || !detail::may_be_shadowed(z, r.lit_beyond) || !detail::behind_caster(texel, z, r.caster)) return 0;
    return detail::stored_intensity<Intensity, Texel>(texel.contribution(), detail::before_far_bound(texel, z, r));
}

/// The same as a float.
template <texel_format Texel>
[[nodiscard]] constexpr float shadow(const filtered<Texel>& texel, float z, const rule& r = {}) noexcept {
    return shadow_as<float>(texel, z, r);
}

/// The same for a texel as it is stored.
template <texel_format Texel> [[nodiscard]] constexpr float shadow(const Texel& texel, float z, const rule& r = {}) noexcept {
    return shadow(read(texel), z, r);
}

/// Depth of the caster behind a filtered texel, in [0, 1], for tools and pictures: s = 1 - e/m, and 1, the far plane, if m = 0.
///
/// Correctly rounded for stored texels. Exact up to that if one depth was filtered with clear texels, a weighted mean if several
/// were (Salzman 2007, "Disadvantages"). A unorm pair is within (2-s)/(2M) of the depth that was filtered, M the stored mask
/// code: at M = 1 an 8-bit depth carries no information. Decisions never use it.
template <texel_format Texel> [[nodiscard]] constexpr float caster_depth(const filtered<Texel>& texel) noexcept {
    const double e = texel.depth(), m = texel.mask();
    if (!(m > 0.0)) return 1.0f;
    return saturate(static_cast<float>((m - e) / m)); // never so close to a tie of floats that rounding twice would show
}
template <texel_format Texel> [[nodiscard]] constexpr float caster_depth(const Texel& texel) noexcept {
    return caster_depth(read(texel));
}

} // namespace gnomon::inline GNOMON_BUILD
