// gnomon: soft shadow maps. A backend: where the loops run. And the stages as free functions that take one.
#pragma once

#include <gnomon/filter/sparse.hpp>
#include <gnomon/grid/tile_grid.hpp>
#include <gnomon/receive/receive.hpp>

#include <type_traits>

namespace gnomon::inline GNOMON_BUILD {

/// Who decides on receivers: a row of them, one to one on texels, and scattered points.
template <typename B, typename Texel>
concept receives = texel_format<Texel> && requires(const B& run, image_view<const Texel> map, strided_span<const Texel> texels,
                                                   strided_span<const float> in, strided_span<float> out, const rule& r) {
    { run.receive(texels, in, out, r) } noexcept;
    { run.receive(map, in, in, in, out, r) } noexcept;
};

/// Where the loops run. A backend receives, and filters a region; it is a value, usually without state.
///
/// Whatever it does, unorm results equal those of `scalar`, bit for bit.
template <typename B, typename Texel, typename Kernel>
concept backend_for = receives<B, Texel> && kernel<Kernel> &&
                      requires(const B& run, image_view<const Texel> from, image_view<Texel> to, texel_rect region,
                               filter_scratch<Texel, Kernel>& scratch) {
                          { run.filter_region(from, to, region, scratch) } noexcept;
                      };

namespace detail {
/// Does the time of a filter not know its radius?
template <typename Backend, typename Kernel, typename Texel>
inline constexpr bool sums_run = [] {
    if constexpr (requires { Backend::template sums_run<Kernel, Texel>; })
        return Backend::template sums_run<Kernel, Texel>;
    else
        return false;
}();
} // namespace detail

/// Filters what the grid marks: filter(scalar{}, casters, soft, tiles, scratch).
/// The scratch says which kernel.
///
/// Equal to filtering the whole map, bit for bit, if every texel of `from` that is not clear lies in a rectangle that was marked,
/// whatever its guard band, and `to` is clear, or was filtered before and rid of what is left of that: see filter/sparse.hpp. Of
/// images that differ in size, what all share is written.
/// Cost: what lies within the kernel's radius of the casters' tiles; never much more than the whole map.
template <kernel Kernel, texel_format Texel, backend_for<Texel, Kernel> Backend>
void filter(const Backend& run, std::type_identity_t<image_view<const Texel>> from, image_view<Texel> to, const tile_grid& tiles,
            filter_scratch<Texel, Kernel>& scratch) noexcept {
    GNOMON_ASSERT(tiles.size().empty() || (tiles.size() == from.size() && tiles.size() == to.size()),
                  "gnomon: the tile grid and both images must have the same size: make all three from one extent");
    const regions_to_filter<Kernel> regions(tiles, false, detail::sums_run<Backend, Kernel, Texel>);
    regions([&](texel_rect r) { run.filter_region(from, to, r, scratch); });
}

/// Receivers one to one on texels: receive(simd<>{}, soft.row_span(y), depths, intensities). See receive/receive.hpp. Depths in codes
/// and intensities in codes are for backends that take them, as gnomon's do; the concept asks for floats alone.
template <typename Backend, texel_row Row, depth_row Depths, intensity_row Intensities>
    requires receives<Backend, texel_in<Row>>
void receive(const Backend& run, const Row& texels, const Depths& z, Intensities&& intensity, const rule& r = {}) noexcept {
    run.receive(strided_span<const texel_in<Row>>(strided_span(texels)),
                strided_span<const std::remove_const_t<element_in<const Depths>>>(strided_span(z)), strided_span(intensity), r);
}

/// A whole image of receivers: receive(simd<>{}, soft, depths, intensities), each an image_view; what the three share is written.
template <typename Backend, typename T, typename Z, intensity_number Intensity>
    requires receives<Backend, std::remove_const_t<T>> && depth_number<std::remove_const_t<Z>>
void receive(const Backend& run, image_view<T> map, image_view<Z> z, image_view<Intensity> intensity, const rule& r = {}) noexcept {
    const int rows = lesser(map.height(), lesser(z.height(), intensity.height()));
    for (int y = 0; y < rows; ++y) gnomon::receive(run, map.row_span(y), z.row_span(y), intensity.row_span(y), r);
}

/// Receivers anywhere: receive(simd<>{}, soft, x, y, depths, intensities), x and y in texels.
template <typename Backend, typename T, depth_row Depths, intensity_row Intensities>
    requires receives<Backend, std::remove_const_t<T>>
void receive(const Backend& run, image_view<T> map, strided_span<const float> x, strided_span<const float> y, const Depths& z,
             Intensities&& intensity, const rule& r = {}) noexcept {
    run.receive(image_view<const std::remove_const_t<T>>(map), x, y,
                strided_span<const std::remove_const_t<element_in<const Depths>>>(strided_span(z)), strided_span(intensity), r);
}

} // namespace gnomon::inline GNOMON_BUILD
