// gnomon: soft shadow maps. Which texels a polygon covers, in exact integers.
//
// A triangle owns the texels whose centres it holds. Corners are first snapped to 1/256 texel; from there on nothing is rounded.
// On every row that it crosses, an edge names one integer: the first column whose centre is not left of it. A polygon is the
// columns between its edges' integers. So two triangles that share an edge share the integers, and no gap and no double write can
// be expressed. It is also the top-left rule: a centre on a left or top edge is in, on a right or bottom edge it is out (top:
// small y).
#pragma once

#include <gnomon/rect.hpp>

#include <cstdint>

namespace gnomon::inline GNOMON_BUILD::detail {

/// A position on the map in 1/256 texel, within +-2^28 (2^20 texels): products of two differences stay below 2^60.
struct fixed_point {
    static constexpr int bits = 8;
    static constexpr std::int64_t one = 1 << bits, half = one / 2;
    static constexpr double reach = 1048576.0; ///< in texels

    std::int64_t x = 0;
    std::int64_t y = 0;

    /// The nearest one, halves upwards; on the border if beyond reach, on its lower side if NaN.
    [[nodiscard]] static constexpr fixed_point nearest(double x, double y) noexcept { return {nearest(x), nearest(y)}; }

  private:
    [[nodiscard]] static constexpr std::int64_t nearest(double v) noexcept {
        constexpr std::int64_t bias = 1 << 30; // above zero, truncating is rounding down
        constexpr double per_texel = static_cast<double>(one), rounding = static_cast<double>(bias) + 0.5;
        return static_cast<std::int64_t>(lesser(greater(-reach, v), reach) * per_texel + rounding) - bias;
    }
};

/// The first column or row whose centre is at `v` or after it.
[[nodiscard]] constexpr int first_centre(std::int64_t v) noexcept {
    return static_cast<int>((v - fixed_point::half + fixed_point::one - 1) >> fixed_point::bits);
}

/// The texels whose centres the bounding box of `count` corners holds.
[[nodiscard]] constexpr texel_rect centres_in(const fixed_point* corners, int count) noexcept {
    fixed_point lower = corners[0], upper = corners[0];
    for (int i = 1; i < count; ++i) {
        lower = {lesser(lower.x, corners[i].x), lesser(lower.y, corners[i].y)};
        upper = {greater(upper.x, corners[i].x), greater(upper.y, corners[i].y)};
    }
    return {first_centre(lower.x), first_centre(lower.y), first_centre(upper.x), first_centre(upper.y)};
}

/// Walks down one edge of a polygon, row by row.
class edge_walk {
  public:
    edge_walk() = default;
    /// From either end: the same edge gives the same walk. Starts on the first of its rows that is not above `top`.
    constexpr edge_walk(fixed_point a, fixed_point b, int top) noexcept
        : row_{}, end_{}, column_{}, rest_{}, step_{}, step_rest_{}, unit_{} {
        if (b.y < a.y) {
            const fixed_point swapped = a;
            a = b;
            b = swapped;
        }
        row_ = greater(first_centre(a.y), top);
        end_ = first_centre(b.y);
        if (row_ >= end_) return;
        // The least column with 256 column + 128 >= a.x + (y - a.y) dx / dy, where y = 256 row + 128.
        const std::int64_t dx = b.x - a.x, dy = b.y - a.y, y = row_ * fixed_point::one + fixed_point::half;
        unit_ = dy * fixed_point::one;
        column_ = divide_down((a.x - fixed_point::half) * dy + (y - a.y) * dx + unit_ - 1, unit_, rest_);
        rest_ = unit_ - 1 - rest_; // how far the centre is to the right of the edge, in 1/unit column
        if (row_ + 1 == end_) return;
        step_ = divide_down(dx * fixed_point::one, unit_, step_rest_);
    }

    /// The column on `row`, to be asked for in order. \pre crosses(row)
    [[nodiscard]] constexpr int column_then_step() noexcept {
        const auto here = static_cast<int>(column_);
        column_ += step_;
        rest_ -= step_rest_;
        if (rest_ < 0) {
            ++column_;
            rest_ += unit_;
        }
        return here;
    }
    [[nodiscard]] constexpr bool crosses(int row) const noexcept { return row >= row_ && row < end_; }

  private:
    [[nodiscard]] static constexpr std::int64_t divide_down(std::int64_t a, std::int64_t b, std::int64_t& rest) noexcept {
        const std::int64_t quotient = a / b - (a % b < 0 ? 1 : 0);
        rest = a - quotient * b;
        return quotient;
    }

    int row_, end_;
    std::int64_t column_, rest_, step_, step_rest_, unit_;
};

/// The most corners of a triangle that five planes have cut. Exactly cut it has 8 at most; but by rounding a plane may find every other
/// corner below it, and put two in the place of each: of 3 corners it makes 4, then 6, 9, 13, 19.
inline constexpr int most_corners = 19;

/// Calls `span(y, x0, x1)` for every run of texels of `target` that a polygon of 3 to `most_corners` corners covers. Even-odd
/// where it crosses itself, as a convex one may after snapping, by a texel's fraction.
template <typename Span> constexpr void scan(const fixed_point* corners, int count, texel_rect target, Span&& span) {
    target = intersection(target, centres_in(corners, count));
    if (target.empty()) return;
    edge_walk edges[most_corners];
    for (int i = 0; i < count; ++i) edges[i] = edge_walk(corners[i], corners[i + 1 < count ? i + 1 : 0], target.y0);

    for (int y = target.y0; y < target.y1; ++y) {
        int columns[most_corners], crossings = 0;
        for (int i = 0; i < count; ++i) {
            if (!edges[i].crosses(y)) continue;
            const int column = edges[i].column_then_step();
            int place = crossings++;
            for (; place > 0 && columns[place - 1] > column; --place) columns[place] = columns[place - 1];
            columns[place] = column;
        }
        for (int i = 0; i + 1 < crossings; i += 2)
            if (const int x0 = greater(columns[i], target.x0), x1 = lesser(columns[i + 1], target.x1); x0 < x1) span(y, x0, x1);
    }
}

} // namespace gnomon::inline GNOMON_BUILD::detail
