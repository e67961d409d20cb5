// gnomon: soft shadow maps. Bias: which way a decision errs where the stored numbers leave it open, and by how much.
#pragma once

#include <gnomon/rect.hpp>
#include <gnomon/texel/texel.hpp>

#include <cstdint>
#include <type_traits>

namespace gnomon::inline GNOMON_BUILD {

/// Which side gets the benefit of the doubt.
enum class bias_towards {
    light,  ///< No false shadow: for casters that also receive. Contact shadows lose their faint rim.
    none,   ///< The stored pair taken at its word. A receiver exactly at its caster's depth is shadowed in about half of all cases.
    shadow, ///< No holes in the penumbra: for casters that never receive, the paper's case.
};

/// A bias lives in the multiplied domain, e > m (1-z), where a rounding has the same size at every m; so it grows as 1/m in depth,
/// just as the doubt does, and no constant depth offset could do the same work. How much it is follows from the texel's channel.
///
/// `towards_light`, which is also `bias{}`, `unbiased` and `towards_shadow` are the three to use. In words of unorm codes: with k
/// roundings and h = 1/2 code, what a caster's own depth was rounded by, towards light shadows iff E - k/2 > (M + k/2) (1 - (z - h)).
/// No smaller one does: (E - k/2) / (M + k/2) is the least depth that such a pair can come from. A depth_ratio rounds towards the
/// light by itself and is left as it is.
struct bias {
    bias_towards towards = bias_towards::light;
    /// How often a filtered number was rounded to storage: 1 for gnomon's filters, 2 for a two-pass filter that stores between, one
    /// more for each mip level. \pre 0 to 1,000
    int roundings = 1;
    /// Moves the receiver this much more of the depth range to the favoured side: towards the light with `light`, away from it with
    /// `shadow`, and not at all with `none`. A host's own bias in world units over the light's range goes here.
    float depth = 0.0f;
    /// The caster's depth was a code of the channel before it was stored, so storing it rounded nothing: h is 0, and the bias is
    /// the least there is without false shadow.
    bool caster_is_code = false;
};

/// No false shadow for any caster depth s and receiver z <= s. With q = 2 max_error, t = 1-s and m the exact share of the footprint,
/// shadow is kept for every z beyond
///     unorm         s + q (1+t)/m + q
///     half          s + q (1+4t) + (q/2)^2 (1+t)/m
///     float         s + 14 q
///     depth_ratio   s + q, at every mask that is not empty
/// and for none much nearer: 99 % of each band are needed.
inline constexpr bias towards_light{};

/// Exactly what is stored.
inline constexpr bias unbiased{.towards = bias_towards::none};

/// No light for any z > s. Shadow may begin before the caster, by as much as towards_light loses behind it.
inline constexpr bias towards_shadow{.towards = bias_towards::shadow};

/// A receiver's depth as a code of unorm16: z = code / 65535, so a decision about it is one of whole numbers.
struct depth16 {
    static constexpr int last = 65535;
    std::uint16_t code;
};

/// What the rounding of a caster's own depth can do on either side, and 2^-24 for the sums in float that apply it.
template <texel_format Texel>
inline constexpr caster_rounding caster_depth_error = [] {
    constexpr auto applied = [](float error) { return error > 0.0f ? error + 0x1p-24f : 0.0f; };
    return caster_rounding{.nearer = applied(Texel::depth_of_caster.nearer), .farther = applied(Texel::depth_of_caster.farther)};
}();

/// The pair (e, m) and the receiver z, each moved to the favoured end of what it may have been before it was rounded.
template <typename Number = double, typename Depth = float> struct biased {
    Number e;
    Number m;
    Depth z;
};

/// What a bias does to a pair and to a float depth: ((e - depth_less) depth_share, (m + mask_more) mask_share, z - nearer).
template <texel_format Texel, typename Real = std::conditional_t<Texel::channel_type::whole_codes, double, float>,
          typename Depth = float>
struct bias_steps {
    Real depth_less, depth_share;
    Real mask_more, mask_share;
    Depth nearer;

    [[nodiscard]] static constexpr bias_steps of(const bias& b) noexcept {
        constexpr rounding_error depth = Texel::depth_rounding, mask = Texel::mask_rounding;
        constexpr float own =
            Texel::channel_type::whole_codes ? 0.0f : 0x1p-22f; // two operations, the conversion of a blended sample
        const float towards = b.towards == bias_towards::light ? 1.0f : (b.towards == bias_towards::shadow ? -1.0f : 0.0f);
        const float k = towards * static_cast<float>(b.roundings);
        const float rounded = towards > 0.0f ? caster_depth_error<Texel>.nearer : caster_depth_error<Texel>.farther;
        const float caster = b.caster_is_code ? 0.0f : rounded;
        const float nearer = b.towards == bias_towards::none ? 0.0f : towards * (b.depth + caster); // also of an infinite depth
        return {static_cast<Real>(k * depth.absolute), static_cast<Real>(1.0f - (k * depth.relative + towards * own)),
                static_cast<Real>(k * mask.absolute), static_cast<Real>(1.0f + (k * mask.relative + towards * own)),
                static_cast<Depth>(nearer)};
    }
};

/// Applies a bias to codes. Exact for unorm. For half and float in single precision, one operation at a time, so that any ISA can
/// give the same bits; what that rounds is part of the bias.
template <texel_format Texel, typename Real, typename Depth, typename Number>
[[nodiscard]] constexpr biased<Number, Depth> apply(const bias_steps<Texel, Real, Depth>& by, Number e, Number m,
                                                    Depth z) noexcept {
    const Real lower = let("e", (static_cast<Real>(e) - by.depth_less) * by.depth_share);
    const Real upper = let("m", (static_cast<Real>(m) + by.mask_more) * by.mask_share);
    return {static_cast<Number>(lower), static_cast<Number>(upper), let("nearer_z", z - by.nearer)};
}
template <texel_format Texel> [[nodiscard]] constexpr biased<> apply(const bias& b, double e, double m, float z) noexcept {
    return apply(bias_steps<Texel>::of(b), e, m, z);
}

/// How many codes nearer to the light a bias moves a depth16; fewer than none are away from it. It makes up for the caster's own
/// rounding, and for the receiver's to its code, half a code; whole codes, rounded up but for 1/256 of one. For a unorm8 depth that
/// is 129 = 257/2 + 1/2, for a unorm16 one 1. Of a `depth` beyond the range it is the range; of NaN too, so that all is lit.
template <texel_format Texel> [[nodiscard]] constexpr int codes_towards_light(const bias& b) noexcept {
    if (b.towards == bias_towards::none) return 0;
    const bool light = b.towards == bias_towards::light;
    const float caster = light ? Texel::depth_of_caster.nearer : Texel::depth_of_caster.farther;
    const double own = b.caster_is_code ? 0.0 : static_cast<double>(caster) * depth16::last + 0.5;
    const double up = static_cast<double>(b.depth) * depth16::last + own + (1.0 - 0x1p-8);
    const int codes = up < depth16::last ? (up > -depth16::last ? detail::floor_to_int(up) : -depth16::last) : depth16::last;
    return light || !same(up, up) ? codes : -codes;
}

} // namespace gnomon::inline GNOMON_BUILD
