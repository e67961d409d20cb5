// gnomon: soft shadow maps. Whole registers of what need not lie side by side.
#pragma once

#include <gnomon/simd/region.hpp>
#include <gnomon/texel/image.hpp>

#include <cstddef>

namespace gnomon::inline GNOMON_BUILD::detail {

/// Spans of any stride, a stretch at a time: `count` elements from `first` on, which are whole registers or the last few.
template <int Step> struct stretch {
    static constexpr int most_copied = greater(Step, 256); ///< of spans that are not side by side
    static constexpr int most = 1 << 30;                   ///< of others, so that no number of registers overflows
    template <typename T> using copy = T[static_cast<std::size_t>(most_copied)];
    int first, count;

    [[nodiscard]] constexpr stretch(int from, int end, bool side_by_side) noexcept
        : first(from), count(lesser(end - from, side_by_side ? most : most_copied)) {
        if (count > Step) count -= count % Step;
    }
    /// In whole registers.
    [[nodiscard]] constexpr int rounded() const noexcept { return greater(count, Step); }
    template <typename T> [[nodiscard]] constexpr bool in_place(strided_span<T> span) const noexcept {
        return count >= Step && span.contiguous();
    }
    /// The elements as they lie, or copied, with nothing behind them up to a register.
    template <typename T> [[nodiscard]] const T* of(strided_span<const T> span, copy<T>& elements) const noexcept {
        if (in_place(span)) return &span[first];
        const auto* from = reinterpret_cast<const std::byte*>(&span[first]);
        GNOMON_UNROLL(4)
        for (int k = 0; k < count; ++k, from += span.stride()) elements[k] = *reinterpret_cast<const T*>(from);
        for (int k = count; k < Step; ++k) elements[k] = {};
        return elements;
    }
    /// Where results go: to their place, or to be copied there.
    template <typename T> [[nodiscard]] T* to(strided_span<T> span, copy<T>& made) const noexcept {
        return in_place(span) ? &span[first] : made;
    }
    template <typename T> void put(strided_span<T> span, const copy<T>& made) const noexcept {
        if (in_place(span)) return;
        auto* to = reinterpret_cast<std::byte*>(&span[first]);
        GNOMON_UNROLL(4)
        for (int k = 0; k < count; ++k, to += span.stride()) *reinterpret_cast<T*>(to) = made[k];
    }
};

} // namespace gnomon::inline GNOMON_BUILD::detail
