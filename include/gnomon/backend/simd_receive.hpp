// gnomon: soft shadow maps. The decision in lanes. backend/reconstruct.hpp includes it once for each target, inside its region, so there
// is no #pragma once: GNOMON_ON names the namespace it goes to; without it there is nothing.

#include <gnomon/backend/lane_formats.hpp>
#include <gnomon/backend/simd_decision.hpp>
#include <gnomon/backend/simd_shade.hpp>
#include <gnomon/backend/simd_rows.hpp>
#include <gnomon/backend/simd_codes.hpp>
#include <gnomon/backend/stretch.hpp>
#include <gnomon/receive/receive.hpp>
#include <gnomon/simd/region.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// What decides.
template <typename Isa, texel_format Texel, typename Depth, typename Intensity> consteval auto choose_decision() {
    constexpr bool codes = std::same_as<Depth, std::uint16_t>;
    if constexpr (detail::byte_pairs<Texel> && codes)
        return std::type_identity<byte_decision<Isa, Texel, Intensity>>{};
    else if constexpr (detail::pairs_of<Texel, unorm16> && codes)
        return std::type_identity<word_decision<Isa, Texel, Intensity>>{};
    else if constexpr (detail::ratios<Texel> && codes && sizeof(Intensity) <= sizeof(typename Texel::storage))
        return std::type_identity<ratio_decision<Isa, Texel, Intensity>>{};
    else
        return std::type_identity<decision<Isa, Texel, Depth, Intensity>>{};
}
template <typename Isa, texel_format Texel, typename Depth, typename Intensity>
using decision_for = typename decltype(choose_decision<Isa, Texel, Depth, Intensity>())::type;

/// Receivers one to one on texels. The last few are decided by a register that ends with them, and so others once more, where a result is
/// not what is read.
template <typename Isa, texel_format Texel, typename Depth, typename Intensity>
void receive_row(strided_span<const Texel> texels, strided_span<const Depth> z, strided_span<Intensity> intensity,
                 const rule& r) noexcept {
    using one = decision_for<Isa, Texel, Depth, Intensity>;
    using part = detail::stretch<one::step, 64>;
    const auto decide = one::of(r);
    const int count = lesser(texels.size(), lesser(z.size(), intensity.size()));
    GNOMON_ASSERT(!detail::overtakes(intensity, texels, count) && !detail::overtakes(intensity, z, count), detail::overtaken);
    const bool side_by_side = texels.contiguous() && z.contiguous() && intensity.contiguous();
    const bool once_more = side_by_side && count > one::step && detail::apart(intensity, texels) && detail::apart(intensity, z);
    typename part::template buffer<Texel> texel;
    typename part::template buffer<Depth> depth;
    typename part::template buffer<Intensity> made;
    for (int i = 0; i < count;) {
        if (once_more && count - i < one::step) i = count - one::step;
        const part now(i, count, side_by_side);
        one::rows(decide, now.of(texels, texel), now.of(z, depth), now.to(intensity, made), now.filled());
        now.put(intensity, made);
        i += now.count;
    }
}

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
