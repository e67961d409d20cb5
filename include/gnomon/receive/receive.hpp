// gnomon: soft shadow maps. Many receivers at once: spans in, spans out, no map object needed.
#pragma once

#include <gnomon/receive/decide.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace gnomon::inline GNOMON_BUILD {

/// What lies in a row: in a strided_span, std::span, std::vector, array or anything else with data() and size().
template <typename Row> using element_in = typename decltype(strided_span(std::declval<Row&>()))::element_type;

/// The texel format of a row of texels.
template <typename Row> using texel_in = std::remove_const_t<element_in<const Row>>;

template <typename Row>
concept texel_row = texel_format<texel_in<Row>>;

/// What a depth is stored in: float, or std::uint16_t for a code of unorm16, z = code / 65535.
template <typename T>
concept depth_number = std::same_as<T, float> || std::same_as<T, std::uint16_t>;

template <typename Row>
concept depth_row = depth_number<std::remove_const_t<element_in<const Row>>>;

template <typename Row>
concept intensity_row = intensity_number<element_in<std::remove_reference_t<Row>>>;

namespace detail {
[[nodiscard]] constexpr float as_depth(float z) noexcept { return z; }
[[nodiscard]] constexpr depth16 as_depth(std::uint16_t code) noexcept { return {code}; }

/// Does a result lie within what is read of a later receiver? Told of spans of one stride, as those of a structure's fields are.
template <typename To, typename From>
[[nodiscard]] bool overtakes(strided_span<To> to, strided_span<From> from, int count) noexcept {
    const std::ptrdiff_t stride = to.stride() < 0 ? -to.stride() : to.stride();
    if (to.stride() != from.stride() || stride == 0 || count < 2) return false;
    const auto a = reinterpret_cast<std::uintptr_t>(&to[0]), b = reinterpret_cast<std::uintptr_t>(&from[0]);
    const std::ptrdiff_t apart = a > b ? static_cast<std::ptrdiff_t>(a - b) : -static_cast<std::ptrdiff_t>(b - a);
    // Result i and what receiver i + k reads overlap if least < k stride < least + both sizes.
    const auto to_size = static_cast<std::ptrdiff_t>(sizeof(To)), from_size = static_cast<std::ptrdiff_t>(sizeof(From));
    const std::ptrdiff_t least = to.stride() > 0 ? apart - from_size : -apart - to_size;
    const std::ptrdiff_t k = least < 0 ? 1 : least / stride + 1;
    return k < count && k * stride < least + to_size + from_size;
}
/// Have two spans no byte in common? \pre both are contiguous, and not empty
template <typename A, typename B> [[nodiscard]] bool apart(strided_span<A> a, strided_span<B> b) noexcept {
    const auto first_a = reinterpret_cast<std::uintptr_t>(&a[0]), first_b = reinterpret_cast<std::uintptr_t>(&b[0]);
    return first_a + static_cast<std::size_t>(a.size()) * sizeof(A) <= first_b ||
           first_b + static_cast<std::size_t>(b.size()) * sizeof(B) <= first_a;
}
inline constexpr const char* overtaken =
    "gnomon: results of receivers lie on what is read of later ones: write in place, or elsewhere";
} // namespace detail

/// Receivers that lie one to one on texels: intensity[i] = shadow(texels[i], z[i]). The shortest of the three spans counts.
///
///     std::vector<std::uint16_t> z(width);        // unorm16; or float
///     std::vector<std::uint8_t> intensity(width); // unorm8; or std::uint16_t, unorm16; or float
///     receive(texels, z, intensity);
///
/// A row, a column, or a field of an array of structures: any stride that keeps the elements aligned. Nothing is allocated. In place
/// too: where element i of the result lies within texel i or depth i and no later one, or apart from all that is read after it. \pre No
/// other overlap, which is asserted of spans of one stride: lanes read hundreds of receivers before they write the first.
template <texel_row Row, depth_row Depths, intensity_row Intensities>
void receive(const Row& texels, const Depths& z, Intensities&& intensity, const rule& r = {}) noexcept {
    const strided_span row(texels);
    const strided_span depths(z);
    const strided_span out(intensity);
    using number = typename decltype(out)::element_type;
    const int count = lesser(row.size(), lesser(depths.size(), out.size()));
    GNOMON_ASSERT(!detail::overtakes(out, row, count) && !detail::overtakes(out, depths, count), detail::overtaken);
    for (int i = 0; i < count; ++i) out[i] = shadow_as<number>(read(row[i]), detail::as_depth(depths[i]), r);
}

/// A whole image of receivers, one to one on the texels of the map; the part that all three have is written.
template <typename T, typename Z, intensity_number Intensity>
    requires texel_format<std::remove_const_t<T>> && depth_number<std::remove_const_t<Z>>
void receive(image_view<T> map, image_view<Z> z, image_view<Intensity> intensity, const rule& r = {}) noexcept {
    const int rows = lesser(map.height(), lesser(z.height(), intensity.height()));
    for (int y = 0; y < rows; ++y) receive(map.row_span(y), z.row_span(y), intensity.row_span(y), r);
}

/// Receivers anywhere: at (x[i], y[i]) in texels, blended from four. Off the map is lit. The shortest span counts. In place too, where
/// element i of the result lies within x[i], y[i] or z[i] and no later one. \pre No other overlap, the map's texels included.
template <typename T, depth_row Depths, intensity_row Intensities>
    requires texel_format<std::remove_const_t<T>>
void receive(image_view<T> map, strided_span<const float> x, strided_span<const float> y, const Depths& z, Intensities&& intensity,
             const rule& r = {}) noexcept {
    const strided_span depths(z);
    const strided_span out(intensity);
    using number = typename decltype(out)::element_type;
    const int count = lesser(lesser(x.size(), y.size()), lesser(depths.size(), out.size()));
    GNOMON_ASSERT(!detail::overtakes(out, x, count) && !detail::overtakes(out, y, count) && !detail::overtakes(out, depths, count),
                  detail::overtaken);
    for (int i = 0; i < count; ++i) out[i] = shadow_as<number>(sample(map, x[i], y[i]), detail::as_depth(depths[i]), r);
}

} // namespace gnomon::inline GNOMON_BUILD
