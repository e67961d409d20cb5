// gnomon: soft shadow maps. Reconstruction by itself: maps that somebody filtered, receivers in spans, intensities out. Of gnomon it
// needs the texels and the decision, no map, grid or filter.
#pragma once

#include <gnomon/backend/lane_formats.hpp>
#include <gnomon/receive/receive.hpp>
#include <gnomon/simd/isa.hpp>

#include <bit>
#include <concepts>
#include <type_traits>

#define GNOMON_ON on_any
#include <gnomon/backend/simd_receive.hpp>
#include <gnomon/backend/simd_points.hpp>
#undef GNOMON_ON
#if GNOMON_X86
GNOMON_TARGET_BEGIN(GNOMON_AVX2)
#define GNOMON_ON on_avx2
#include <gnomon/backend/simd_receive.hpp>
#include <gnomon/backend/simd_points.hpp>
#undef GNOMON_ON
GNOMON_TARGET_END
GNOMON_TARGET_BEGIN(GNOMON_AVX512)
#define GNOMON_ON on_avx512
#include <gnomon/backend/simd_receive.hpp>
#include <gnomon/backend/simd_points.hpp>
#undef GNOMON_ON
GNOMON_TARGET_END
#endif

namespace gnomon::inline GNOMON_BUILD {

/// The best lanes that the processor has: asked at run time, so no compiler flag is needed.
struct best_isa {};

namespace detail {

/// Does this build have these lanes?
template <typename Isa>
inline constexpr bool has_lanes = GNOMON_X86 + GNOMON_NEON + GNOMON_WASM > 0 || !std::same_as<Isa, best_isa>;

/// Each target's code goes by its own name.
template <typename Isa, texel_format Texel, typename Depth, typename Intensity>
void receive_on(strided_span<const Texel> texels, strided_span<const Depth> z, strided_span<Intensity> intensity,
                const rule& r) noexcept {
#if GNOMON_X86
    if constexpr (std::same_as<Isa, avx512>)
        on_avx512::receive_row<avx512>(texels, z, intensity, r);
    else if constexpr (std::same_as<Isa, avx2>)
        on_avx2::receive_row<avx2>(texels, z, intensity, r);
    else
#endif
        on_any::receive_row<Isa>(texels, z, intensity, r);
}
template <typename Isa, texel_format Texel, typename Depth, typename Intensity>
void receive_points_on(image_view<const Texel> map, strided_span<const float> x, strided_span<const float> y,
                       strided_span<const Depth> z, strided_span<Intensity> intensity, const rule& r) noexcept {
#if GNOMON_X86
    if constexpr (std::same_as<Isa, avx512>)
        on_avx512::receive_points<avx512>(map, x, y, z, intensity, r);
    else if constexpr (std::same_as<Isa, avx2>)
        on_avx2::receive_points<avx2>(map, x, y, z, intensity, r);
    else
#endif
        on_any::receive_points<Isa>(map, x, y, z, intensity, r);
}

/// What a processor must have to run them.
template <typename Isa> inline constexpr cpu_level level_needed = cpu_level::portable;
#if GNOMON_X86
template <> inline constexpr cpu_level level_needed<avx2> = cpu_level::avx2;
template <> inline constexpr cpu_level level_needed<avx512> = cpu_level::avx512;

/// Calls f.template operator()<Isa>() with the lanes of a level.
template <typename F> auto with_lanes(cpu_level level, F&& f) noexcept {
    if (level >= cpu_level::avx512) return f.template operator()<avx512>();
    if (level >= cpu_level::avx2) return f.template operator()<avx2>();
    return f.template operator()<sse2>();
}
#else
#if GNOMON_NEON
using only_lanes = neon;
#elif GNOMON_WASM
using only_lanes = wasm128;
#else // none are known of this processor: has_lanes<best_isa> is false, and nobody asks
using only_lanes = emulated<16>;
#endif
template <typename F> auto with_lanes(cpu_level, F&& f) noexcept { return f.template operator()<only_lanes>(); }
#endif

/// Has the processor the lanes that are named? Those that need no level of it always are.
template <typename Isa> [[nodiscard]] bool lanes_are_there() noexcept {
    const bool there = level_needed<Isa> == cpu_level::portable || best_lanes() >= level_needed<Isa>;
    GNOMON_ASSERT(there, "gnomon: this processor has no such lanes as are named; ask best_lanes(), or take simd<>");
    return there;
}

/// f.template operator()<Lanes>() with the lanes that are named, or the processor's own. False, and nothing done, if f says so, if the
/// processor has no such lanes, or if it is big-endian.
template <typename Isa, typename F> bool in_lanes(F&& f) noexcept {
    if constexpr (std::endian::native == std::endian::big) // lanes take the first byte of a number for its lowest
        return false;
    else if constexpr (std::same_as<Isa, best_isa>)
        return with_lanes(best_lanes(), f);
    else
        return lanes_are_there<Isa>() && f.template operator()<Isa>();
}

} // namespace detail

/// `receive` in lanes: those of the processor, reconstruct(texels, z, intensity), or named ones, reconstruct<avx2>(...). The same bits, but
/// for half and float pairs of e <= -2^24 m, which no caster is, before receivers beyond 2^24. Rows of any stride, in place too, as in
/// receive/receive.hpp.
///
/// In lanes goes a depth_mask with any effects, and a depth_ratio without a far bound, with depths and intensities of any kind. A
/// depth_ratio with one, the paper's pair and channels of a user's go by the scalar loop, and all on a big-endian processor.
/// \pre the processor has the lanes that are named: ask best_lanes(). Without asserts the scalar loop does it if it has not.
template <typename Isa = best_isa, texel_row Row, depth_row Depths, intensity_row Intensities>
void reconstruct(const Row& texels, const Depths& z, Intensities&& intensity, const rule& r = {}) noexcept {
    using Texel = texel_in<Row>;
    using Depth = std::remove_const_t<element_in<const Depths>>;
    const strided_span<const Texel> row{strided_span(texels)};
    const strided_span<const Depth> depths{strided_span(z)};
    const strided_span out(intensity);
    if constexpr (detail::has_lanes<Isa> && decided_in_lanes<Texel>)
        if (detail::in_lanes<Isa>([&]<typename Lanes>() { return detail::receive_on<Lanes>(row, depths, out, r), true; })) return;
    receive(row, depths, out, r);
}

/// The same for receivers anywhere: at (x[i], y[i]) in texels, blended from four.
///
/// In lanes go the same texels, on maps of 2 to 2^21 texels a side and less than 2^31 bytes, pairs of whole codes for rules of at most 128
/// roundings; what does not goes by the scalar loop. Pairs are quickest, of half and float with float intensities; the rest is decided in
/// doubles.
template <typename Isa = best_isa, typename T, depth_row Depths, intensity_row Intensities>
    requires texel_format<std::remove_const_t<T>>
void reconstruct(image_view<T> map, strided_span<const float> x, strided_span<const float> y, const Depths& z,
                 Intensities&& intensity, const rule& r = {}) noexcept {
    using Texel = std::remove_const_t<T>;
    using Depth = std::remove_const_t<element_in<const Depths>>;
    const image_view<const Texel> texels = map;
    const strided_span<const Depth> depths{strided_span(z)};
    const strided_span out(intensity);
    if constexpr (detail::has_lanes<Isa> && decided_in_lanes<Texel>)
        if (detail::blended_on(texels, r) && detail::in_lanes<Isa>([&]<typename Lanes>() {
                return detail::receive_points_on<Lanes>(texels, x, y, depths, out, r), true;
            }))
            return;
    receive(texels, x, y, depths, out, r);
}

} // namespace gnomon::inline GNOMON_BUILD
