// gnomon: soft shadow maps. Sizes and half-open rectangles in whole texels.
#pragma once

#include <gnomon/unit.hpp>

namespace gnomon::inline GNOMON_BUILD {

/// The size of a map in texels. Either side may be zero; a negative side counts as zero.
struct extent {
    int width = 0;
    int height = 0;

    [[nodiscard]] constexpr bool empty() const noexcept { return width <= 0 || height <= 0; }
    friend constexpr bool operator==(extent, extent) = default;
};

/// Half-open rectangle of texels, [x0, x1) x [y0, y1). Inverted or touching sides make it empty.
struct texel_rect {
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;

    [[nodiscard]] constexpr bool empty() const noexcept { return x0 >= x1 || y0 >= y1; }
    /// Number of columns and rows; meaningful for rectangles inside a map, where nothing can overflow.
    [[nodiscard]] constexpr int width() const noexcept { return empty() ? 0 : x1 - x0; }
    [[nodiscard]] constexpr int height() const noexcept { return empty() ? 0 : y1 - y0; }
    [[nodiscard]] constexpr bool contains(int x, int y) const noexcept { return x >= x0 && x < x1 && y >= y0 && y < y1; }
    friend constexpr bool operator==(texel_rect, texel_rect) = default;
};

/// The same shape in whole tiles: what a tile grid merges its marks into.
struct tile_rect {
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;

    [[nodiscard]] constexpr bool empty() const noexcept { return x0 >= x1 || y0 >= y1; }
    friend constexpr bool operator==(tile_rect, tile_rect) = default;
};

/// The whole map as a rectangle.
[[nodiscard]] constexpr texel_rect whole(extent size) noexcept { return {0, 0, greater(size.width, 0), greater(size.height, 0)}; }

/// What two rectangles share; an empty rectangle, all zero, if nothing.
[[nodiscard]] constexpr texel_rect intersection(texel_rect a, texel_rect b) noexcept {
    const texel_rect both{greater(a.x0, b.x0), greater(a.y0, b.y0), lesser(a.x1, b.x1), lesser(a.y1, b.y1)};
    return both.empty() ? texel_rect{} : both;
}

[[nodiscard]] constexpr texel_rect clip(texel_rect r, extent size) noexcept { return intersection(r, whole(size)); }

/// The smallest rectangle that holds both; an empty one adds nothing.
[[nodiscard]] constexpr texel_rect union_box(texel_rect a, texel_rect b) noexcept {
    if (a.empty()) return b.empty() ? texel_rect{} : b;
    if (b.empty()) return a;
    return {lesser(a.x0, b.x0), lesser(a.y0, b.y0), greater(a.x1, b.x1), greater(a.y1, b.y1)};
}

namespace detail {
inline constexpr int int_max = 2147483647;

/// a + b, or the end of int that it would pass.
[[nodiscard]] constexpr int saturating_add(int a, int b) noexcept {
    constexpr long long most = int_max;
    return static_cast<int>(lesser(greater(1ll * a + b, -most - 1), most));
}

/// `v` no farther out than a map can reach: 2^30, so that a guard band cannot overflow.
[[nodiscard]] constexpr double within_reach(double v) noexcept {
    constexpr double reach = 1073741824.0;
    return lesser(greater(-reach, v), reach);
}

[[nodiscard]] constexpr int floor_to_int(double v) noexcept {
    const double bounded = within_reach(v);
    const int i = static_cast<int>(bounded);
    return static_cast<double>(i) > bounded ? i - 1 : i;
}

[[nodiscard]] constexpr int ceil_to_int(double v) noexcept { return -floor_to_int(-v); }
} // namespace detail

/// Every side moved outwards by `texels`, without overflow. An empty rectangle stays empty: a caster that is not there has
/// no penumbra. A negative `texels` counts as zero.
[[nodiscard]] constexpr texel_rect grow(texel_rect r, int texels) noexcept {
    if (r.empty()) return {};
    const int g = greater(texels, 0);
    return {detail::saturating_add(r.x0, -g), detail::saturating_add(r.y0, -g), detail::saturating_add(r.x1, g),
            detail::saturating_add(r.y1, g)};
}

/// The texels that a rectangle with real sides touches, rounded outwards: [floor(x0), ceil(x1)) x [floor(y0), ceil(y1)).
///
/// Inverted, zero-sized or NaN sides give an empty rectangle; sides beyond 2^30 are moved to 2^30.
[[nodiscard]] constexpr texel_rect enclosing_texels(double x0, double y0, double x1, double y1) noexcept {
    if (!(x0 < x1) || !(y0 < y1)) return {};
    return {detail::floor_to_int(x0), detail::floor_to_int(y0), detail::ceil_to_int(x1), detail::ceil_to_int(y1)};
}

} // namespace gnomon::inline GNOMON_BUILD
