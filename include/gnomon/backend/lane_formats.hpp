// gnomon: soft shadow maps. What lanes know. The rest goes by the scalar loops, to the same results.
#pragma once

#include <gnomon/receive/decide.hpp>
#include <gnomon/texel/image.hpp>

#include <concepts>
#include <cstddef>

namespace gnomon::inline GNOMON_BUILD {
namespace detail {

/// Lanes read and write these; a channel of a user's goes by the scalar loops.
template <typename Channel>
concept channel_of_lanes = std::same_as<Channel, unorm8> || std::same_as<Channel, unorm16> || std::same_as<Channel, half16> ||
                           std::same_as<Channel, float32>;

/// Premultiplied pairs of two numbers of a channel; and of two bytes.
template <texel_format Texel, typename Channel>
inline constexpr bool pairs_of = std::same_as<typename Texel::representation_type, depth_mask> && Texel::channels == 2 &&
                                 std::same_as<typename Texel::channel_type, Channel>;
template <texel_format Texel> inline constexpr bool byte_pairs = pairs_of<Texel, unorm8>;

/// A depth and a mask of whole codes, not multiplied.
template <texel_format Texel>
inline constexpr bool ratios =
    std::same_as<typename Texel::representation_type, depth_ratio> && Texel::channels == 2 &&
    (std::same_as<typename Texel::channel_type, unorm8> || std::same_as<typename Texel::channel_type, unorm16>);

/// Do lanes blend on a map, for a rule? Offsets are of 32 bits, a row has two texels for a load, and so many roundings move a pair of whole
/// codes by less than floats have room for.
template <texel_format Texel> [[nodiscard]] bool blended_on(image_view<const Texel> map, const rule& r) noexcept {
    constexpr int most = 1 << 21, most_roundings = 128;
    constexpr int bytes = static_cast<int>(sizeof(Texel));
    const std::ptrdiff_t row = map.stride() < 0 ? -map.stride() : map.stride();
    constexpr bool any_rule = !pairs_of<Texel, unorm8> && !pairs_of<Texel, unorm16>;
    return (any_rule || r.caster.roundings <= most_roundings) && map.width() >= 2 && map.height() >= 2 && map.width() <= most &&
           map.height() <= most && row <= (0x7FFFFFFF - bytes * map.width()) / map.height();
}

} // namespace detail

/// Are receivers on these texels decided in lanes, if there are any, in rows and anywhere? A depth_mask's are, whatever its effects; a
/// depth_ratio's without a far bound; neither of a channel of a user's. For a static_assert: all else has the same results at a tenth of
/// the speed.
template <texel_format Texel>
inline constexpr bool decided_in_lanes =
    detail::channel_of_lanes<typename Texel::channel_type> &&
    (std::same_as<typename Texel::representation_type, depth_mask> ||
     (std::same_as<typename Texel::representation_type, depth_ratio> && !Texel::effects.far_bound));

} // namespace gnomon::inline GNOMON_BUILD
