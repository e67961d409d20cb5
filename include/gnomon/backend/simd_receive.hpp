// gnomon: soft shadow maps. The decision in lanes. backend/reconstruct.hpp includes it once for each target, inside its region, so there
// is no #pragma once: GNOMON_ON names the namespace it goes to; without it there is nothing.

#include <gnomon/backend/simd_decision.hpp>
#include <gnomon/backend/simd_codes.hpp>
#include <gnomon/receive/receive.hpp>
#include <gnomon/simd/region.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// What lanes decide: whole codes, with a contribution too; of half and float pairs with float intensities.
template <texel_format Texel, typename Depth, typename Intensity>
inline constexpr bool decided_in_lanes =
    decidable_pairs<Texel> && (Texel::channel_type::whole_codes || (Texel::channels == 2 && std::same_as<Intensity, float>));

/// And what decides.
template <typename Isa, texel_format Texel, typename Depth, typename Intensity> consteval auto choose_decision() {
    constexpr bool codes = std::same_as<Depth, std::uint16_t>;
    if constexpr (byte_pairs<Texel> && codes && std::same_as<Intensity, std::uint8_t>)
        return std::type_identity<byte_decision<Isa, Texel>>{};
    else if constexpr (pairs_of<Texel, unorm16> && codes && !std::same_as<Intensity, float>)
        return std::type_identity<word_decision<Isa, Texel, Intensity>>{};
    else
        return std::type_identity<decision<Isa, Texel, Depth, Intensity>>{};
}
template <typename Isa, texel_format Texel, typename Depth, typename Intensity>
using decision_for = typename decltype(choose_decision<Isa, Texel, Depth, Intensity>())::type;

/// Receivers one to one on texels. Spans of any stride; what is not side by side, and the last few, go through a register's worth of
/// memory.
template <typename Isa, texel_format Texel, typename Depth, typename Intensity>
void receive_row(strided_span<const Texel> texels, strided_span<const Depth> z, strided_span<Intensity> intensity,
                 const rule& r) noexcept {
    using one = decision_for<Isa, Texel, Depth, Intensity>;
    const auto decide = one::of(r);
    const int count = lesser(texels.size(), lesser(z.size(), intensity.size()));
    const bool side_by_side = texels.contiguous() && z.contiguous() && intensity.contiguous();
    const int whole = side_by_side ? count - count % one::step : 0;
    if (whole > 0) one::rows(decide, &texels[0], &z[0], &intensity[0], whole);
    for (int i = whole, some; i < count; i += some) {
        some = lesser(one::step, count - i);
        Texel texel[static_cast<std::size_t>(one::step)]{};
        Depth depth[static_cast<std::size_t>(one::step)]{};
        Intensity made[static_cast<std::size_t>(one::step)];
        for (int k = 0; k < some; ++k) texel[k] = texels[i + k], depth[k] = z[i + k];
        one::rows(decide, texel, depth, made, one::step);
        for (int k = 0; k < some; ++k) intensity[i + k] = made[k];
    }
}

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
