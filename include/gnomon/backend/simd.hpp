// gnomon: soft shadow maps. The backend of lanes: the bits of `scalar`, at the speed of the processor the program finds itself on.
#pragma once

#include <gnomon/backend/scalar.hpp>
#include <gnomon/simd/isa.hpp>

#include <concepts>

#define GNOMON_ON on_any
#include <gnomon/backend/simd_filter.hpp>
#include <gnomon/backend/simd_box.hpp>
#include <gnomon/backend/simd_receive.hpp>
#undef GNOMON_ON
#if GNOMON_X86
GNOMON_TARGET_BEGIN(GNOMON_AVX2)
#define GNOMON_ON on_avx2
#include <gnomon/backend/simd_filter.hpp>
#include <gnomon/backend/simd_box.hpp>
#include <gnomon/backend/simd_receive.hpp>
#undef GNOMON_ON
GNOMON_TARGET_END
GNOMON_TARGET_BEGIN(GNOMON_AVX512)
#define GNOMON_ON on_avx512
#include <gnomon/backend/simd_filter.hpp>
#include <gnomon/backend/simd_box.hpp>
#include <gnomon/backend/simd_receive.hpp>
#undef GNOMON_ON
GNOMON_TARGET_END
#endif

namespace gnomon::inline GNOMON_BUILD {

/// The best lanes that the processor has: asked at run time, so no compiler flag is needed.
struct best_isa {};

namespace detail {

/// Lanes read and write these; a channel of a user's goes by the scalar loops.
template <typename Channel>
concept channel_of_lanes = std::same_as<Channel, unorm8> || std::same_as<Channel, unorm16> || std::same_as<Channel, half16> ||
                           std::same_as<Channel, float32>;

/// Does this build have these lanes?
template <typename Isa>
inline constexpr bool has_lanes = GNOMON_X86 + GNOMON_NEON + GNOMON_WASM > 0 || !std::same_as<Isa, best_isa>;

/// What a processor must have to run them.
template <typename Isa> inline constexpr cpu_level level_needed = cpu_level::portable;
#if GNOMON_X86
template <> inline constexpr cpu_level level_needed<avx2> = cpu_level::avx2;
template <> inline constexpr cpu_level level_needed<avx512> = cpu_level::avx512;

/// Each target's code goes by its own name.
template <typename Isa, kernel Kernel, texel_format Texel>
bool filter_on(image_view<const Texel> from, image_view<Texel> to, texel_rect region) noexcept {
    if constexpr (std::same_as<Isa, avx512>)
        return on_avx512::filter<avx512, Kernel, Texel>(from, to, region);
    else if constexpr (std::same_as<Isa, avx2>)
        return on_avx2::filter<avx2, Kernel, Texel>(from, to, region);
    else
        return on_any::filter<Isa, Kernel, Texel>(from, to, region);
}
template <typename Isa, texel_format Texel, typename Depth, typename Intensity>
void receive_on(strided_span<const Texel> texels, strided_span<const Depth> z, strided_span<Intensity> intensity,
                const rule& r) noexcept {
    if constexpr (std::same_as<Isa, avx512>)
        on_avx512::receive_row<avx512>(texels, z, intensity, r);
    else if constexpr (std::same_as<Isa, avx2>)
        on_avx2::receive_row<avx2>(texels, z, intensity, r);
    else
        on_any::receive_row<Isa>(texels, z, intensity, r);
}
template <typename Isa, texel_format Texel, typename Depth, typename Intensity>
bool receive_points_on(image_view<const Texel> map, strided_span<const float> x, strided_span<const float> y,
                       strided_span<const Depth> z, strided_span<Intensity> intensity, const rule& r) noexcept {
    if constexpr (std::same_as<Isa, avx512>)
        return on_avx512::receive_points<avx512>(map, x, y, z, intensity, r);
    else if constexpr (std::same_as<Isa, avx2>)
        return on_avx2::receive_points<avx2>(map, x, y, z, intensity, r);
    else
        return on_any::receive_points<Isa>(map, x, y, z, intensity, r);
}

/// Calls f.template operator()<Isa>() with the lanes of a level.
template <typename F> auto with_lanes(cpu_level level, F&& f) noexcept {
    if (level >= cpu_level::avx512) return f.template operator()<avx512>();
    if (level >= cpu_level::avx2) return f.template operator()<avx2>();
    return f.template operator()<sse2>();
}
#else
template <typename Isa, kernel Kernel, texel_format Texel>
bool filter_on(image_view<const Texel> from, image_view<Texel> to, texel_rect region) noexcept {
    return on_any::filter<Isa, Kernel, Texel>(from, to, region);
}
template <typename Isa, texel_format Texel, typename Depth, typename Intensity>
void receive_on(strided_span<const Texel> texels, strided_span<const Depth> z, strided_span<Intensity> intensity,
                const rule& r) noexcept {
    on_any::receive_row<Isa>(texels, z, intensity, r);
}
template <typename Isa, texel_format Texel, typename Depth, typename Intensity>
bool receive_points_on(image_view<const Texel> map, strided_span<const float> x, strided_span<const float> y,
                       strided_span<const Depth> z, strided_span<Intensity> intensity, const rule& r) noexcept {
    return on_any::receive_points<Isa>(map, x, y, z, intensity, r);
}

#if GNOMON_NEON
using only_lanes = neon;
#elif GNOMON_WASM
using only_lanes = wasm128;
#else // none are known of this processor: has_lanes<best_isa> is false, and nobody asks
using only_lanes = emulated<16>;
#endif
template <typename F> auto with_lanes(cpu_level, F&& f) noexcept { return f.template operator()<only_lanes>(); }
#endif

} // namespace detail

/// Filters and receives in lanes: simd<> in those the processor has, simd<avx2> and the like in these alone, simd<Yours> in a
/// simd_isa of your own. Results are those of `scalar`, bit for bit; of a NaN in half or float texels only that it is one.
///
/// What lanes do not know is left to `scalar`: depth_ratio, channels of a user's, radii beyond 256, maps narrower than a register;
/// and in `receive` half and float texels, the paper's pair, far bounds, and positions. Needs no scratch for what it does itself.
/// \pre the processor has the lanes that are named: ask best_lanes(). Without asserts all is left to `scalar` if it has not. simd<>
/// has no such condition.
template <typename Isa = best_isa> struct simd {
    static_assert(std::same_as<Isa, best_isa> || simd_isa<Isa>,
                  "gnomon: simd<Isa> takes sse2, avx2, avx512, neon, wasm128, emulated<Bytes> or lanes of your own that model "
                  "simd_isa; simd<> takes the best there are");

    template <texel_format Texel, kernel Kernel>
    void filter_region(std::type_identity_t<image_view<const Texel>> from, image_view<Texel> to, texel_rect region,
                       filter_scratch<Texel, Kernel>& scratch) const noexcept {
        static_assert(kernel_is_sound<Kernel>());
        if constexpr (detail::has_lanes<Isa> && detail::channel_of_lanes<typename Texel::channel_type> &&
                      on_any::filtered_in_lanes<Kernel, Texel>) {
            const texel_rect part = clip(clip(region, to.size()), from.size());
            const auto filtered_by = [&]<typename Lanes>() { return detail::filter_on<Lanes, Kernel>(from, to, part); };
            if (!part.empty() && from.data() != to.data() && call(filtered_by)) return;
        }
        gnomon::filter_region(from, to, region, scratch);
    }
    template <texel_format Texel, depth_number Depth, intensity_number Intensity>
    void receive(strided_span<const Texel> texels, strided_span<const Depth> z, strided_span<Intensity> intensity,
                 const rule& r) const noexcept {
        if constexpr (detail::has_lanes<Isa> && detail::channel_of_lanes<typename Texel::channel_type> &&
                      on_any::decided_in_lanes<Texel, Depth, Intensity>)
            if (call([&]<typename Lanes>() { return detail::receive_on<Lanes>(texels, z, intensity, r), true; })) return;
        gnomon::receive(texels, z, intensity, r);
    }
    template <texel_format Texel, depth_number Depth, intensity_number Intensity>
    void receive(image_view<const Texel> map, strided_span<const float> x, strided_span<const float> y, strided_span<const Depth> z,
                 strided_span<Intensity> intensity, const rule& r) const noexcept {
        if constexpr (detail::has_lanes<Isa> && detail::channel_of_lanes<typename Texel::channel_type> &&
                      on_any::blended_in_lanes<Texel, Depth, Intensity>)
            if (call([&]<typename Lanes>() { return detail::receive_points_on<Lanes>(map, x, y, z, intensity, r); })) return;
        gnomon::receive(map, x, y, z, intensity, r);
    }

  private:
    /// False, and nothing done, if f says so or the processor has no such lanes.
    template <typename F> static bool call(F&& f) noexcept {
        if constexpr (std::same_as<Isa, best_isa>) {
            return detail::with_lanes(best_lanes(), f);
        } else {
            const bool there = best_lanes() >= detail::level_needed<Isa>;
            GNOMON_ASSERT(there, "gnomon: this processor has no such lanes as simd<Isa> names; ask best_lanes(), or take simd<>");
            return there && f.template operator()<Isa>();
        }
    }
};

static_assert(backend_for<simd<>, rg8, box<1>>);

} // namespace gnomon::inline GNOMON_BUILD
