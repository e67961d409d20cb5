// gnomon: soft shadow maps. Many receivers at once: spans in, spans out, no map object needed.
#pragma once

#include <gnomon/receive/decide.hpp>

#include <type_traits>
#include <utility>

namespace gnomon::inline GNOMON_BUILD {

/// The texel format of a row of texels: of a strided_span, std::span, std::vector or anything else with data() and size().
template <typename Row>
using texel_in = std::remove_const_t<typename decltype(strided_span(std::declval<const Row&>()))::element_type>;

template <typename Row>
concept texel_row = texel_format<texel_in<Row>>;

/// Receivers that lie one to one on texels: intensity[i] = shadow(texels[i], z[i]). The shortest of the three spans counts.
/// A row, a column, or a field of an array of structures: any stride that keeps the elements aligned. Nothing is allocated.
template <texel_row Row>
void receive(const Row& texels, strided_span<const float> z, strided_span<float> intensity, const rule& r = {}) noexcept {
    const strided_span row(texels);
    const int count = lesser(row.size(), lesser(z.size(), intensity.size()));
    for (int i = 0; i < count; ++i) intensity[i] = shadow(row[i], z[i], r);
}

/// A whole image of receivers, one to one on the texels of the map; what the three images share is written.
template <typename T>
    requires texel_format<std::remove_const_t<T>>
void receive(image_view<T> map, image_view<const float> z, image_view<float> intensity, const rule& r = {}) noexcept {
    const int rows = lesser(map.height(), lesser(z.height(), intensity.height()));
    for (int y = 0; y < rows; ++y) receive(map.row_span(y), z.row_span(y), intensity.row_span(y), r);
}

/// Receivers anywhere: at (x[i], y[i]) in texels, blended from four. Off the map is lit. The shortest span counts.
template <typename T>
    requires texel_format<std::remove_const_t<T>>
void receive(image_view<T> map, strided_span<const float> x, strided_span<const float> y, strided_span<const float> z,
             strided_span<float> intensity, const rule& r = {}) noexcept {
    const int count = lesser(lesser(x.size(), y.size()), lesser(z.size(), intensity.size()));
    for (int i = 0; i < count; ++i) intensity[i] = shadow(sample(map, x[i], y[i]), z[i], r);
}

} // namespace gnomon::inline GNOMON_BUILD
