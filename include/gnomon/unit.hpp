// gnomon: soft shadow maps. The conventions, in one page; and the smallest helpers that speak them.
//
//   depth z      unit depth along the light, linear in distance: 0 at the light's near plane, 1 at its far plane.
//   s            depth of a caster;  t = 1 - s and r = 1 - z are the reversed depths that the map really holds.
//   mask m       the share of a filter footprint that is caster, in [0, 1]. It is also how dark the shadow is.
//   intensity    what receive/ answers: 0 is lit, 1 is full shadow.
//   texel (x, y) covers [x, x+1) x [y, y+1) of the map; its centre is at (x + 0.5, y + 0.5). Row 0 is the first in memory,
//                and y grows with memory. Whether that is up or down on a screen is the host's affair.
//   rectangles   half-open, [x0, x1) x [y0, y1), in int. An inverted rectangle is an empty one.
//   code         the integer a unorm channel stores, 0..scale; for half and float the number itself, and scale is 1.
//   totality     NaN, infinities, values outside [0, 1] and rectangles off the map have written results everywhere.
#pragma once

#include <gnomon/config.hpp>

namespace gnomon::inline GNOMON_BUILD {

/// The smaller and the larger of two; `a` if they are equal or unordered. (No <algorithm>, whose price is 20,000 lines.)
template <typename T> [[nodiscard]] constexpr T lesser(T a, T b) noexcept { return b < a ? b : a; }
template <typename T> [[nodiscard]] constexpr T greater(T a, T b) noexcept { return a < b ? b : a; }

/// @name What formulas use that are shared with numbers of other kinds, instead of ?:, && and a declaration.
/// @{
/// `a` if the condition holds, else `b`; both are evaluated.
template <typename T> [[nodiscard]] constexpr T select(bool condition, T a, T b) noexcept { return condition ? a : b; }
/// Do both hold? Both are evaluated.
[[nodiscard]] constexpr bool both(bool a, bool b) noexcept { return a && b; }
/// A temporary: the value itself, and its name where formulas are written down.
template <typename T> [[nodiscard]] constexpr T let(const char* /*name*/, T value) noexcept { return value; }
/// @}

/// `v` limited to [0, 1]; NaN becomes 0.
template <typename Real> [[nodiscard]] constexpr Real saturate(Real v) noexcept {
    return select(v > Real(0), select(v < Real(1), v, Real(1)), Real(0));
}

/// a == b, for storage that may be float, without the warning that engines rightly switch on for it.
template <typename T> [[nodiscard]] constexpr auto same(T a, T b) noexcept { return both(a <= b, a >= b); }

/// A closed interval of depths, by default empty: including a depth in it makes it non-empty.
struct depth_interval {
    float nearest = 1.0f;
    float farthest = 0.0f;

    [[nodiscard]] constexpr bool empty() const noexcept { return !(nearest <= farthest); }
    constexpr void include(depth_interval other) noexcept {
        if (other.empty()) return;
        *this = empty() ? other : depth_interval{lesser(nearest, other.nearest), greater(farthest, other.farthest)};
    }
    friend constexpr bool operator==(depth_interval a, depth_interval b) noexcept {
        return same(a.nearest, b.nearest) && same(a.farthest, b.farthest);
    }
};

} // namespace gnomon::inline GNOMON_BUILD
