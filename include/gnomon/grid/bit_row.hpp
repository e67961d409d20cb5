// gnomon: soft shadow maps. One row of a tile grid: bits packed into 64-bit words, least significant bit leftmost.
#pragma once

#include <gnomon/unit.hpp>

#include <bit>
#include <cstdint>

namespace gnomon::inline GNOMON_BUILD {

using bit_word = std::uint64_t;
inline constexpr int bits_per_word = 64;

/// Words that hold `bits` bits.
[[nodiscard]] constexpr int words_for(int bits) noexcept { return bits / bits_per_word + (bits % bits_per_word != 0 ? 1 : 0); }

/// A view of `size` bits somewhere in memory. Bits past `size` in the last word stay zero.
/// Spans are half-open and inside the row: \pre 0 <= first <= last <= size. An empty span does nothing and holds nothing.
template <typename Word> struct basic_bit_row {
    Word* words = nullptr;
    int size = 0;

    [[nodiscard]] constexpr bool test(int i) const noexcept { return (words[i / bits_per_word] >> (i % bits_per_word) & 1) != 0; }

    constexpr void set(int first, int last) const noexcept {
        for_each_word(first, last, [this](int w, bit_word mask) {
            words[w] |= mask;
            return true;
        });
    }
    constexpr void reset(int first, int last) const noexcept {
        for_each_word(first, last, [this](int w, bit_word mask) {
            words[w] &= ~mask;
            return true;
        });
    }
    [[nodiscard]] constexpr bool any(int first, int last) const noexcept {
        return !for_each_word(first, last, [this](int w, bit_word mask) { return (words[w] & mask) == 0; });
    }
    [[nodiscard]] constexpr bool all(int first, int last) const noexcept {
        return for_each_word(first, last, [this](int w, bit_word mask) { return (words[w] & mask) == mask; });
    }

    /// The first set (or clear) bit at or after `from`; `size` if there is none.
    [[nodiscard]] constexpr int next_set(int from) const noexcept { return next(from, 0); }
    [[nodiscard]] constexpr int next_clear(int from) const noexcept { return next(from, ~bit_word{0}); }

    /// Calls f(first, last) for every maximal run of set bits, from the left.
    template <typename F> constexpr void for_each_run(F&& f) const {
        for (int first = next_set(0); first < size;) {
            const int last = next_clear(first);
            f(first, last);
            first = next_set(last);
        }
    }

    /// Is [first, last) exactly one maximal run?
    [[nodiscard]] constexpr bool is_run(int first, int last) const noexcept {
        return next_clear(first) == last && (first == 0 || !test(first - 1));
    }

    /// Holds it the same bits as another? \pre both are as long
    [[nodiscard]] constexpr bool repeats(basic_bit_row other) const noexcept {
        int w = 0;
        while (w < words_for(size) && words[w] == other.words[w]) ++w;
        return w == words_for(size);
    }

  private:
    /// Calls f(word index, mask) for the words of a span until f answers false; answers whether none did.
    template <typename F> constexpr bool for_each_word(int first, int last, F&& f) const {
        for (int begin = first; begin < last;) {
            const int at = begin % bits_per_word, count = lesser(last - begin, bits_per_word - at);
            if (!f(begin / bits_per_word, ~bit_word{0} >> (bits_per_word - count) << at)) return false;
            begin += count;
        }
        return true;
    }
    [[nodiscard]] constexpr int next(int from, bit_word flip) const noexcept {
        if (from >= size) return size;
        const int first = from / bits_per_word, count = words_for(size);
        bit_word left = (words[first] ^ flip) >> (from % bits_per_word) << (from % bits_per_word);
        int w = first;
        while (left == 0 && ++w < count) left = words[w] ^ flip;
        return left == 0 ? size : w * bits_per_word + std::countr_zero(left);
    }
};

using bit_row = basic_bit_row<bit_word>;
using const_bit_row = basic_bit_row<const bit_word>;

} // namespace gnomon::inline GNOMON_BUILD
