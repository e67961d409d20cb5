// gnomon: soft shadow maps. How far to trust the depth of a filtered texel: for tools, for adaptive bias, for choosing a format.
#pragma once

#include <gnomon/receive/decide.hpp>

namespace gnomon {

/// How far the depth that was filtered may be from caster_depth(texel), in [0, 1], if its numbers were rounded `roundings` times.
///
/// Whole codes: k (1+t)/(2M), M the stored mask code, at the largest reversed depth t that this pair can come from, which is
/// k (1+e/m)/(2M-k); half and float: 2^-10 t and 2^-23 t, while m is not subnormal; depth_ratio: one code. 1 at an empty mask or
/// NaN, which know nothing. Never exceeded by a footprint that holds one depth, and reached. What a caster's depth lost when it was
/// stored comes on top, caster_depth_error; only the code of a depth_ratio has it in it, for a lone caster. A blended sample is as
/// good as the texels it is blended from.
template <texel_format Texel> [[nodiscard]] constexpr float depth_error(const filtered<Texel>& texel, int roundings = 1) noexcept {
    using representation_type = typename Texel::representation_type;
    using channel_type = typename Texel::channel_type;
    constexpr rounding_error depth = representation_type::template depth_rounding<channel_type>();
    constexpr rounding_error mask = representation_type::template mask_rounding<channel_type>();
    constexpr auto own =
        representation_type::premultiplied ? 0.0f : representation_type::template depth_of_caster<channel_type>().farther;
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
    const double error = greater(nearest - t, t - farthest) + static_cast<double>(own);
    return static_cast<float>(lesser(1.0, error + 0x1p-24)); // 2^-24: caster_depth and this are rounded to float
}
template <texel_format Texel> [[nodiscard]] constexpr float depth_error(const Texel& texel, int roundings = 1) noexcept {
    return depth_error(read(texel), roundings);
}

namespace detail {
template <texel_format Texel, int Steps> consteval float mask_for_steps() {
    using representation_type = typename Texel::representation_type;
    using channel_type = typename Texel::channel_type;
    static_assert(Steps >= 1,
                  "gnomon: mask_threshold<Texel, Steps>: Steps is into how many depths the light's range is told, 1 or more");
    constexpr rounding_error depth = representation_type::template depth_rounding<channel_type>();
    constexpr rounding_error mask = representation_type::template mask_rounding<channel_type>();
    constexpr auto own =
        representation_type::premultiplied ? 0.0f : representation_type::template depth_of_caster<channel_type>().farther;
    constexpr float left = 1.0f / static_cast<float>(Steps) - depth.relative - mask.relative - own;
    constexpr float least = channel_type::rounding.absolute / channel_type::scale; // the mask that is not lost
    constexpr float threshold =
        representation_type::premultiplied && left > 0.0f ? (depth.absolute + mask.absolute) / channel_type::scale / left : least;
    static_assert(
        (representation_type::premultiplied ? left > 0.0f : left >= 0.0f) && threshold <= 1.0f,
        "gnomon: no mask is enough to tell so many depths apart in this texel; take unorm16, float32 or depth_ratio, or fewer");
    return threshold;
}
} // namespace detail

/// The smallest mask at which this texel, rounded once, tells depths 1/Steps of the light's range apart: depth_error at the near
/// plane, its worst, is 1/Steps there. 1/64 takes a quarter of a footprint in 8 bits and a thousandth in 16; 1/256 no 8-bit mask is
/// enough for, and that does not compile.
template <texel_format Texel, int Steps> inline constexpr float mask_threshold = detail::mask_for_steps<Texel, Steps>();

} // namespace gnomon
