// The oracle is a std::vector<bool>. It knows nothing of words.
#include <gnomon/grid/bit_row.hpp>

#include "../support/dice.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstdlib>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace {
using gnomon::bit_word;
using test::dice;

/// A row between two guard words, and the same bits in a vector.
struct twin {
    static constexpr bit_word sentinel = 0xA5A5A5A5A5A5A5A5u;
    std::vector<bit_word> words;
    std::vector<bool> bits;

    twin(int size, dice& roll)
        : words(static_cast<std::size_t>(gnomon::words_for(size)) + 2), bits(static_cast<std::size_t>(size)) {
        words.front() = words.back() = sentinel;
        const int density = roll(1, 6);
        for (int i = 0; i < size; ++i)
            if (roll.one_in(density)) {
                bits[static_cast<std::size_t>(i)] = true;
                row().set(i, i + 1);
            }
    }
    int size() const { return static_cast<int>(bits.size()); }
    gnomon::bit_row row() { return {words.data() + 1, size()}; }
    gnomon::const_bit_row row() const { return {words.data() + 1, size()}; }
    bool bit(int i) const { return bits[static_cast<std::size_t>(i)]; }
    void fill(int first, int last, bool value) {
        for (int i = first; i < last; ++i) bits[static_cast<std::size_t>(i)] = value;
    }
    int count(int first, int last) const {
        int n = 0;
        for (int i = first; i < last; ++i) n += bit(i);
        return n;
    }
    int next(int from, bool value) const {
        while (from < size() && bit(from) != value) ++from;
        return from;
    }
    /// Equal in every bit, and nothing else touched: not the words beside the row, not the bits after its end.
    bool agrees() const {
        if (words.front() != sentinel || words.back() != sentinel) return false;
        for (int i = 0; i < gnomon::words_for(size()) * gnomon::bits_per_word; ++i) {
            const bool set = (words[1 + static_cast<std::size_t>(i / 64)] >> (i % 64) & 1) != 0;
            if (set != (i < size() && bit(i))) return false;
        }
        return true;
    }
};

/// Calls f(first, last) for all spans of a short row, and of a long one for those that begin or end around a word's border.
template <typename F> void for_each_span(int size, F&& f) {
    const auto telling = [size](int i) { return size <= 66 || i <= 1 || i >= size - 1 || (i + 2) % 64 <= 4; };
    for (int first = 0; first <= size; ++first)
        for (int last = first; last <= size; ++last)
            if (telling(first) && telling(last)) f(first, last);
}
} // namespace

TEST_CASE("a span of bits is set and reset in place, whatever words it crosses") {
    dice roll(11);
    for (int size = 0; size <= 200; ++size) {
        twin t(size, roll);
        int wrong = 0;
        for_each_span(size, [&](int first, int last) {
            const bool value = roll.one_in(2);
            t.fill(first, last, value);
            if (value)
                t.row().set(first, last);
            else
                t.row().reset(first, last);
            wrong += !t.agrees();
        });
        CAPTURE(size);
        CHECK(wrong == 0);
    }
}

TEST_CASE("any, all and is_run answer for a span what its bits say one by one") {
    dice roll(12);
    for (int size = 0; size <= 200; ++size) {
        const twin t(size, roll);
        int wrong = 0;
        for_each_span(size, [&](int first, int last) {
            const int set = t.count(first, last);
            const bool maximal = (first == 0 || !t.bit(first - 1)) && (last == size || !t.bit(last));
            wrong += t.row().any(first, last) != (set > 0);
            wrong += t.row().all(first, last) != (set == last - first);
            if (first < last) wrong += t.row().is_run(first, last) != (set == last - first && maximal);
        });
        CAPTURE(size);
        CHECK(wrong == 0);
    }
}

TEST_CASE("the next set or clear bit is found from every place, and runs come whole and from the left") {
    dice roll(13);
    for (int size = 0; size <= 200; ++size) {
        const twin t(size, roll);
        int wrong = 0;
        for (int i = 0; i <= size; ++i) {
            wrong += t.row().next_set(i) != t.next(i, true) || t.row().next_clear(i) != t.next(i, false);
            if (i < size) wrong += t.row().test(i) != t.bit(i);
        }
        std::vector<std::pair<int, int>> runs, expected;
        t.row().for_each_run([&](int first, int last) { runs.emplace_back(first, last); });
        for (int first = t.next(0, true); first < size; first = t.next(expected.back().second, true))
            expected.emplace_back(first, t.next(first, false));
        CAPTURE(size);
        CHECK(wrong == 0);
        CHECK(runs == expected);
    }
}

TEST_CASE("a row repeats another if not one of its bits differs, and equal words beside them do not count") {
    dice roll(14);
    for (int size = 0; size <= 200; ++size) {
        const twin t(size, roll);
        twin other = t;
        int wrong = !t.row().repeats(std::as_const(other).row());
        for (int i = 0; i < size; ++i) {
            other.row().words[i / 64] ^= bit_word{1} << (i % 64);
            wrong += t.row().repeats(std::as_const(other).row());
            other.row().words[i / 64] ^= bit_word{1} << (i % 64);
        }
        CAPTURE(size);
        CHECK(wrong == 0);
    }
}

TEST_CASE("a row of nothing has no bits") {
    constexpr gnomon::bit_row row;
    CHECK(row.size == 0);
    CHECK(row.words == nullptr);
    CHECK(row.next_set(0) == 0);
    CHECK(row.all(0, 0));
    CHECK_FALSE(row.any(0, 0));
}

TEST_CASE("a full and an empty row of any size are one run and none") {
    for (int size = 0; size <= 200; ++size) {
        std::vector<bit_word> words(static_cast<std::size_t>(gnomon::words_for(size)));
        const gnomon::bit_row row{words.data(), size};
        int runs = 0, length = 0;
        const auto count = [&](int first, int last) {
            ++runs;
            length += last - first;
        };
        row.for_each_run(count);
        CHECK(runs == 0);
        row.set(0, size);
        row.for_each_run(count);
        CHECK(runs == (size > 0 ? 1 : 0));
        CHECK(length == size);
    }
}

namespace {
/// In a constant expression undefined behaviour, such as a shift by 64, does not compile.
constexpr int longest_run(int first, int last, int hole) {
    std::array<bit_word, 3> words{};
    const gnomon::bit_row row{words.data(), 192};
    row.set(first, last);
    row.reset(hole, hole + 1);
    int longest = 0;
    row.for_each_run([&](int a, int b) { longest = b - a > longest ? b - a : longest; });
    return longest;
}
static_assert(longest_run(0, 192, 0) == 191);
static_assert(longest_run(0, 192, 191) == 191);
static_assert(longest_run(63, 129, 64) == 64);
static_assert(longest_run(64, 128, 100) == 36);
static_assert(longest_run(5, 5, 5) == 0);
} // namespace

TEST_CASE("a row of as many bits as there are ints is set, reset and searched to its end") {
    constexpr int size = std::numeric_limits<int>::max();
    const auto give_back = [](bit_word* words) { std::free(words); };
    const std::unique_ptr<bit_word[], decltype(give_back)> words( // 256 MiB of zeros, of which nearly all are never looked at
        static_cast<bit_word*>(std::calloc(static_cast<std::size_t>(gnomon::words_for(size)), sizeof(bit_word))), give_back);
    REQUIRE(words);
    const gnomon::bit_row row{words.get(), size};
    row.set(size - 70, size - 1);
    CHECK((row.next_set(size - 200) == size - 70 && row.next_clear(size - 70) == size - 1 && row.next_set(size - 1) == size));
    row.set(size - 1, size);
    CHECK((row.all(size - 70, size) && row.next_clear(size - 70) == size));
    row.reset(size - 70, size);
    CHECK((!row.any(size - 300, size) && row.next_set(size - 300) == size));
}
