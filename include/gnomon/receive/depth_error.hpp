// gnomon: soft shadow maps. How far to trust the depth of a filtered texel: for tools, for adaptive bias, for choosing a format.
#pragma once

#include <gnomon/receive/decide.hpp>

namespace gnomon::inline GNOMON_BUILD {

/// How far the depth that was filtered may be from caster_depth(texel), in [0, 1], if its numbers were rounded `roundings` times.
///
/// Whole codes: k (1+t)/(2M), M the stored mask code, at the largest reversed depth t that this pair can come from, which is
/// k (1+e/m)/(2M-k); half and float: 2^-10 t and 2^-23 t, while m is not subnormal; depth_ratio: k codes, also of
/// a mean of casters as they are stored. 1 at an empty mask or NaN, which know nothing. Never exceeded by a footprint that holds one
/// depth, and reached. What a caster's depth lost when it was stored comes on top, caster_depth_error; only the code of a
/// depth_ratio has it in it, for a lone caster. A blended sample is as good as the texels it is blended from.
template <texel_format Texel> [[nodiscard]] constexpr float depth_error(const filtered<Texel>& texel, int roundings = 1) noexcept {
    constexpr rounding_error depth = Texel::depth_rounding, mask = Texel::mask_rounding;
    constexpr double code = Texel::representation_type::premultiplied ? 0.0 : 1.0 / static_cast<double>(Texel::channel_type::scale);
    const double e = texel.depth(), m = texel.mask(), k = greater(roundings, 0);
    const auto least = [k](double v, rounding_error r) {
        return (v - k * static_cast<double>(r.absolute)) / (1.0 + k * static_cast<double>(r.relative));
    };
    const auto most = [k](double v, rounding_error r) {
        return (v + k * static_cast<double>(r.absolute)) / (1.0 - k * static_cast<double>(r.relative));
    };
    if (!(e >= 0.0 && least(m, mask) > 0.0)) return 1.0f;
    const double t = saturate(e / m);
    const double nearest = lesser(1.0, most(e, depth) / least(m, mask)), farthest = greater(0.0, least(e, depth) / most(m, mask));
    const double error = greater(nearest - t, t - farthest) + k * code;
    return static_cast<float>(lesser(1.0, error + 0x1p-24)); // 2^-24: caster_depth and this are rounded to float
}
template <texel_format Texel> [[nodiscard]] constexpr float depth_error(const Texel& texel, int roundings = 1) noexcept {
    return depth_error(read(texel), roundings);
}

namespace detail {
template <texel_format Texel, int Steps> struct depth_steps {
    static_assert(Steps >= 1,
                  "gnomon: mask_threshold<Texel, Steps>: Steps is into how many depths the light's range is told, 1 or more");
    static constexpr rounding_error depth = Texel::depth_rounding, mask = Texel::mask_rounding;
    static constexpr float scale = Texel::channel_type::scale;
    static constexpr bool pair = Texel::representation_type::premultiplied;
    /// A depth is in doubt by this at a full mask, by more at less; by one code at every mask if the texel is a ratio.
    static constexpr float doubt = (pair ? depth.absolute + mask.absolute : 1.0f) / scale;
    /// What 1/Steps leaves for it.
    static constexpr float left = 1.0f / static_cast<float>(Steps) - depth.relative - mask.relative;
    static constexpr bool told = doubt <= left;

    static consteval float threshold() {
        static_assert(
            told, "gnomon: no mask is enough to tell so many depths apart in this texel; take one of more bits, or fewer depths");
        return pair ? doubt / left : Texel::channel_type::rounding.absolute / scale;
    }
};
} // namespace detail

/// The smallest mask at which this texel, rounded once, tells depths 1/Steps of the light's range apart: from there on no depth_error
/// is more, but for the 2^-24 of its own. 1/64 takes a quarter of a footprint in 8 bits and a thousandth in 16; 1/256 no 8-bit mask
/// is enough for, and that does not compile.
template <texel_format Texel, int Steps> inline constexpr float mask_threshold = detail::depth_steps<Texel, Steps>::threshold();

} // namespace gnomon::inline GNOMON_BUILD
