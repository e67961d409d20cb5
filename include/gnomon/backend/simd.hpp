// gnomon: soft shadow maps. The backend of lanes: the bits of `scalar`, at the speed of the processor the program finds itself on.
#pragma once

#include <gnomon/backend/reconstruct.hpp>
#include <gnomon/backend/scalar.hpp>
#include <gnomon/simd/isa.hpp>

#include <concepts>
#include <span>
#include <type_traits>

#define GNOMON_ON on_any
#include <gnomon/backend/simd_filter.hpp>
#include <gnomon/backend/simd_box.hpp>
#undef GNOMON_ON
#if GNOMON_X86
GNOMON_TARGET_BEGIN(GNOMON_AVX2)
#define GNOMON_ON on_avx2
#include <gnomon/backend/simd_filter.hpp>
#include <gnomon/backend/simd_box.hpp>
#undef GNOMON_ON
GNOMON_TARGET_END
GNOMON_TARGET_BEGIN(GNOMON_AVX512)
#define GNOMON_ON on_avx512
#include <gnomon/backend/simd_filter.hpp>
#include <gnomon/backend/simd_box.hpp>
#undef GNOMON_ON
GNOMON_TARGET_END
#endif

namespace gnomon::inline GNOMON_BUILD {

namespace detail {

/// Each target's code goes by its own name. Rows too short for a register go to the next narrower lanes.
template <typename Isa, kernel Kernel, texel_format Texel>
bool filter_on(image_view<const Texel> from, image_view<Texel> to, texel_rect region,
               std::span<line_element<Texel>> scratch) noexcept {
#if GNOMON_X86
    if constexpr (std::same_as<Isa, avx512>)
        return on_avx512::filter<avx512, Kernel, Texel>(from, to, region, scratch) ||
               filter_on<avx2, Kernel, Texel>(from, to, region, scratch);
    else if constexpr (std::same_as<Isa, avx2>)
        return on_avx2::filter<avx2, Kernel, Texel>(from, to, region, scratch) ||
               on_any::filter<sse2, Kernel, Texel>(from, to, region, scratch);
    else
#endif
        return on_any::filter<Isa, Kernel, Texel>(from, to, region, scratch);
}

} // namespace detail

/// Filters and receives in lanes: simd<> in those the processor has, simd<avx2> and the like in none beyond these, simd<Yours> in a
/// simd_isa of your own, which is compiled for what the file is, and not asked whether the processor has it. A name is there on its
/// own processors: neon on ARM, wasm128 in WebAssembly, the others but emulated on x86. Results are those of `scalar`, bit for bit;
/// of a NaN in half or float texels only that it is one, and but for half and float pairs of e <= -2^24 m, which no caster is, before
/// receivers beyond 2^24.
///
/// What lanes do not know is left to `scalar`: channels of a user's, `narrow` kernels but of floats, radii beyond 256, maps whose rows
/// are shorter than a register (of SSE2 on x86, 8 pairs at most; of Yours) or with what kernels reach beyond have 2^31 channels, and of
/// ratios far bounds, contributions and what is not exact in double; of decisions see backend/reconstruct.hpp. Too narrow a scratch
/// only cuts a region into strips. A filter takes up to 48 kB of the stack.
/// \pre the processor has the lanes that are named: ask best_lanes(). Without asserts all is left to `scalar` if it has not. simd<>
/// has no such condition.
template <typename Isa = best_isa> struct simd {
    static_assert(std::same_as<Isa, best_isa> || simd_isa<Isa>,
                  "gnomon: simd<Isa> takes sse2, avx2, avx512, neon, wasm128, emulated<Bytes> or lanes of your own that model "
                  "simd_isa; simd<> takes the best there are");

    /// Does this filter go in lanes, where rows are as long as a register? For a static_assert: `scalar` takes ten times as long.
    template <kernel Kernel, texel_format Texel>
    static constexpr bool filters_in_lanes = detail::has_lanes<Isa> && detail::channel_of_lanes<typename Texel::channel_type> &&
                                             on_any::filtered_in_lanes<Kernel, Texel>;
    /// Is this a box whose sums run, so that its time does not know its radius? Parts of a map are weighed by that.
    template <kernel Kernel, texel_format Texel>
    static constexpr bool sums_run = filters_in_lanes<Kernel, Texel> && on_any::sums_of_box_run<Kernel, Texel>;

    template <texel_format Texel, kernel Kernel>
    void filter_region(std::type_identity_t<image_view<const Texel>> from, image_view<Texel> to, texel_rect region,
                       filter_scratch<Texel, Kernel>& scratch) const noexcept {
        static_assert(kernel_is_sound<Kernel>());
        if constexpr (filters_in_lanes<Kernel, Texel>) {
            const texel_rect part = clip(clip(region, to.size()), from.size());
            const auto filtered_by = [&]<typename Lanes>() {
                return detail::filter_on<Lanes, Kernel>(from, to, part, scratch.line());
            };
            if (!part.empty() && !share_texels<Texel>(from, to) && detail::in_lanes<Isa>(filtered_by)) return;
        }
        gnomon::filter_region(from, to, region, scratch);
    }
    template <texel_format Texel, depth_number Depth, intensity_number Intensity>
    void receive(strided_span<const Texel> texels, strided_span<const Depth> z, strided_span<Intensity> intensity,
                 const rule& r) const noexcept {
        reconstruct<Isa>(texels, z, intensity, r);
    }
    template <texel_format Texel, depth_number Depth, intensity_number Intensity>
    void receive(image_view<const Texel> map, strided_span<const float> x, strided_span<const float> y, strided_span<const Depth> z,
                 strided_span<Intensity> intensity, const rule& r) const noexcept {
        reconstruct<Isa>(map, x, y, z, intensity, r);
    }
};

static_assert(backend_for<simd<>, rg8, box<1>>);

} // namespace gnomon::inline GNOMON_BUILD
