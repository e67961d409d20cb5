// gnomon: soft shadow maps. The scalar backend: the formulas as they stand in the papers. Every other backend is measured by it.
#pragma once

#include <gnomon/backend/backend.hpp>

#include <type_traits>

namespace gnomon::inline GNOMON_BUILD {

/// The oracle: plain loops over plain numbers, the same bits on every machine and compiler.
struct scalar {
    template <texel_format Texel, kernel Kernel>
    void filter_region(std::type_identity_t<image_view<const Texel>> from, image_view<Texel> to, texel_rect region,
                       filter_scratch<Texel, Kernel>& scratch) const noexcept {
        gnomon::filter_region(from, to, region, scratch);
    }
    template <texel_format Texel, depth_number Depth, intensity_number Intensity>
    void receive(strided_span<const Texel> texels, strided_span<const Depth> z, strided_span<Intensity> intensity,
                 const rule& r) const noexcept {
        gnomon::receive(texels, z, intensity, r);
    }
    template <texel_format Texel, depth_number Depth, intensity_number Intensity>
    void receive(image_view<const Texel> map, strided_span<const float> x, strided_span<const float> y, strided_span<const Depth> z,
                 strided_span<Intensity> intensity, const rule& r) const noexcept {
        gnomon::receive(map, x, y, z, intensity, r);
    }
};

static_assert(backend_for<scalar, rg8, box<1>>);

} // namespace gnomon::inline GNOMON_BUILD
