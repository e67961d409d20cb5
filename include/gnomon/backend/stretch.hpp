// gnomon: soft shadow maps. Whole registers of what need not lie side by side.
#pragma once

#include <gnomon/simd/region.hpp>
#include <gnomon/texel/image.hpp>

#include <cstddef>

namespace gnomon::inline GNOMON_BUILD::detail {

/// Spans of any stride, a stretch at a time: `count` elements from `first` on, which are whole registers or the last few. What does not
/// lie side by side is copied, at most `Most` elements, since more of them may not stay in a cache together.
template <int Step, int Most> struct stretch {
    static constexpr int most = greater(Step, Most);
    static constexpr int most_in_place = 1 << 30; ///< so that no count overflows
    template <typename T> using buffer = T[static_cast<std::size_t>(most)];
    int first, count;

    [[nodiscard]] constexpr stretch(int from, int end, bool side_by_side) noexcept
        : first(from), count(lesser(end - from, side_by_side ? most_in_place : most)) {
        if (count > Step) count -= count % Step;
    }
    /// With what fills the last register.
    [[nodiscard]] constexpr int filled() const noexcept { return greater(count, Step); }
    template <typename T> [[nodiscard]] constexpr bool in_place(strided_span<T> span) const noexcept {
        return count >= Step && span.contiguous();
    }
    /// The elements as they lie, or copied, and filled with T{}.
    template <typename T> [[nodiscard]] const T* of(strided_span<const T> span, buffer<T>& copy) const noexcept {
        if (in_place(span)) return &span[first];
        const auto* const from = reinterpret_cast<const std::byte*>(&span[first]);
        GNOMON_UNROLL(4)
        for (int k = 0; k < count; ++k) copy[k] = *reinterpret_cast<const T*>(from + k * span.stride());
        for (int k = count; k < Step; ++k) copy[k] = {};
        return copy;
    }
    /// Where results go: to their place, or to be copied there.
    template <typename T> [[nodiscard]] T* to(strided_span<T> span, buffer<T>& made) const noexcept {
        return in_place(span) ? &span[first] : made;
    }
    template <typename T> void put(strided_span<T> span, const buffer<T>& made) const noexcept {
        if (in_place(span)) return;
        auto* const to = reinterpret_cast<std::byte*>(&span[first]);
        GNOMON_UNROLL(4)
        for (int k = 0; k < count; ++k) *reinterpret_cast<T*>(to + k * span.stride()) = made[k];
    }
};

} // namespace gnomon::inline GNOMON_BUILD::detail
