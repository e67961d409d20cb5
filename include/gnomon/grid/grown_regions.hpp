// gnomon: soft shadow maps. What a filter has to write: all texels within its radius of a caster's tile, as disjoint rectangles.
#pragma once

#include <gnomon/grid/tile_grid.hpp>

#include <array>
#include <cstdint>

namespace gnomon::inline GNOMON_BUILD {

namespace detail {

/// Disjoint intervals of columns, in order and apart: what a row of texels needs of the 64 tiles of a word. Those are at most 34, and
/// the difference of two lists at most 68. First and last columns lie apart in memory: what is written one by one and read as a pair
/// is slow to read.
struct span_list {
    int first[68], last[68]; ///< what they hold beyond `count` is nobody's
    int count = 0;

    span_list() noexcept {} // not = default, which lets {} fill them

    /// What lies left of `from` or right of `to` is cut off; what touches the last span, which ends no later, is joined to it.
    void add(std::int64_t begin, std::int64_t end, int from, int to) noexcept {
        const int x0 = static_cast<int>(greater<std::int64_t>(begin, from)), x1 = static_cast<int>(lesser<std::int64_t>(end, to));
        if (x0 >= x1) return;
        const bool joined = count > 0 && last[count - 1] >= x0;
        count += joined ? 0 : 1;
        if (!joined) first[count - 1] = x0;
        last[count - 1] = x1;
    }
};

/// What is in `a` and not in `b`.
inline void subtract(const span_list& a, const span_list& b, span_list& left) noexcept {
    left.count = 0;
    for (int i = 0, j = 0; i < a.count; ++i) {
        int from = a.first[i];
        while (j < b.count && b.last[j] <= from) ++j;
        for (int k = j; k < b.count && b.first[k] < a.last[i]; ++k) {
            left.add(from, b.first[k], from, a.last[i]);
            from = b.last[k];
        }
        left.add(from, a.last[i], from, a.last[i]);
    }
}

/// Rows of texels of a row of tiles that the same rows of tiles grow into: those from `first` to `last`, relative to it.
struct band {
    int offset, first, last;
};

/// The bands of any row of tiles: it changes what grows into a texel `radius` below a tile's first and last one.
[[nodiscard]] inline std::array<band, 3> bands_of(int tile, int radius) noexcept {
    const int below = radius % tile, above = (tile - below) % tile;
    const auto band_at = [&](int offset) {
        const std::int64_t top = std::int64_t{offset} - radius,
                           end = std::int64_t{offset} + radius; // top < tile: it is rounded down
        return band{offset, static_cast<int>((top - (tile - 1)) / tile), static_cast<int>(end / tile)};
    };
    return {band_at(0), band_at(lesser(below, above)), band_at(greater(below, above))};
}

/// What one word of tiles needs in one band after another.
class grown_word {
  public:
    span_list spans;

    grown_word(const tile_grid& grid, int radius, int word) noexcept
        : grid_(grid), radius_(radius), word_(word), from_(static_cast<int>(std::int64_t{word} * bits_per_word * grid.tile())),
          to_(static_cast<int>(lesser<std::int64_t>(std::int64_t{word + 1} * bits_per_word * grid.tile(), grid.size().width))),
          is_reached_(grid.guard() >= radius && grid.tile() >= radius) {}

    /// Goes to a band; answers whether the spans are others than before.
    bool go_to(int row, const band& b) noexcept {
        reached_ = reached(row, word_);
        row_ = row;
        first_ = greater(row + b.first, 0);
        last_ = static_cast<int>(lesser(std::int64_t{row} + b.last, std::int64_t{grid_.rows()} - 1));
        const key now{held(word_) & reached_, reached_, end_of_left(), begin_of_right()};
        if (now == at_) return false;
        at_ = now;
        find_spans();
        return true;
    }
    /// Goes where nothing is.
    bool leave() noexcept {
        spans.count = 0;
        const bool was = at_ != key{};
        at_ = {};
        return was;
    }

  private:
    struct key {
        bit_word held = 0, reached = 0;
        std::int64_t left = 0, right = 0;
        friend bool operator==(const key&, const key&) = default;
    };

    void find_spans() noexcept {
        const std::int64_t tile = grid_.tile();
        spans.count = 0;
        spans.add(from_, at_.left, from_, to_);
        for (bit_word left = at_.held; left != 0;) {
            const int first = std::countr_zero(left), last = first + std::countr_one(left >> first);
            left = last == bits_per_word ? 0 : left >> last << last;
            // Where no guard band reached a neighbour, no radius does.
            const bool before = first == 0 || (at_.reached >> (first - 1) & 1) != 0;
            const bool after = last == bits_per_word || (at_.reached >> last & 1) != 0;
            spans.add(from_ + first * tile - (before ? radius_ : 0), from_ + last * tile + (after ? radius_ : 0), from_, to_);
        }
        spans.add(at_.right, to_, from_, to_);
    }
    /// The tiles of a word that a guard band reached in this row; all, if that tells nothing about the radius.
    [[nodiscard]] bit_word reached(int row, int word) const noexcept {
        return is_reached_ ? grid_.row(row).words[word] : ~bit_word{0};
    }
    /// The tiles that grow into this band.
    [[nodiscard]] bit_word held(int word) const noexcept {
        bit_word bits = 0;
        for (int y = first_; y <= last_; ++y) bits |= grid_.held(y).words[word];
        return bits;
    }
    /// Where the tiles of the words to the left and to the right end and begin, grown.
    [[nodiscard]] std::int64_t end_of_left() const noexcept {
        if ((reached_ & 1) == 0) return from_;
        const auto end = [&](int column) { return std::int64_t{column} * grid_.tile() + radius_; };
        for (int w = word_ - 1; w >= 0 && end((w + 1) * bits_per_word) > from_; --w)
            if (const bit_word bits = held(w) & reached(row_, w); bits != 0)
                return end((w + 1) * bits_per_word - std::countl_zero(bits));
        return from_;
    }
    [[nodiscard]] std::int64_t begin_of_right() const noexcept {
        if (reached_ >> (bits_per_word - 1) == 0) return to_;
        const auto begin = [&](int column) { return std::int64_t{column} * grid_.tile() - radius_; };
        for (int w = word_ + 1; w < words_for(grid_.columns()) && begin(w * bits_per_word) < to_; ++w)
            if (const bit_word bits = held(w) & reached(row_, w); bits != 0)
                return begin(w * bits_per_word + std::countr_zero(bits));
        return to_;
    }

    const tile_grid& grid_;
    int radius_, word_, from_, to_, row_ = 0, first_ = 0, last_ = 0;
    bool is_reached_;
    bit_word reached_ = 0;
    key at_{};
};

/// Stacks the spans of one band after another into rectangles; a span that stays as it is continues one.
template <typename F> class span_stack {
  public:
    explicit span_stack(F& f) noexcept : f_(f) {}

    void go_to(int y, const span_list& now) {
        const columns& before = at_[current_];
        columns& after = at_[1 - current_];
        int i = 0;
        for (after.count = 0; after.count < now.count; ++after.count) {
            const int first = now.first[after.count], last = now.last[after.count];
            for (; i < before.count && before.first[i] < first; ++i) close(before, i, y);
            const bool same = i < before.count && before.first[i] == first && before.last[i] == last;
            after.first[after.count] = first;
            after.last[after.count] = last;
            after.since[after.count] = same ? before.since[i++] : y;
        }
        for (; i < before.count; ++i) close(before, i, y);
        current_ = 1 - current_;
    }

  private:
    struct columns {
        int first[68], last[68], since[68];
        int count = 0;
        columns() noexcept {}
    };
    void close(const columns& open, int i, int y) { f_(texel_rect{open.first[i], open.since[i], open.last[i], y}); }

    F& f_;
    columns at_[2];
    int current_ = 0;
};
template <typename F> span_stack(F&) -> span_stack<F>;

/// Calls at(row, y, band) for the bands that rows with marks grow into, from row 0 upwards, and beyond(y) where others follow.
template <typename At, typename Beyond> void for_each_band_of(const tile_grid& grid, int radius, At&& at, Beyond&& beyond) {
    const std::array<band, 3> bands = bands_of(grid.tile(), radius);
    const int reach_up = -bands.front().first, reach_down = bands.back().last;
    for (int row = 0; row < grid.rows(); ++row) {
        const int next = grid.held_rows().next_set(greater(row - reach_up, 0));
        if (next - reach_down > row || next == grid.rows()) {
            beyond(row * grid.tile());
            row = next == grid.rows() ? next : next - reach_down;
        }
        for (const band& b : bands)
            if (const std::int64_t y = std::int64_t{row} * grid.tile() + b.offset; y < grid.size().height)
                at(row, static_cast<int>(y), b);
    }
}

} // namespace detail

/// Calls f(texel_rect) for disjoint rectangles that hold, clipped to the map, every texel within `radius` of a mark, guard bands not
/// counted, and nothing farther than `radius` from the tiles of one. A tile that no guard band reached is left out if all were as
/// wide as `radius`. Keeps no state. In no promised order. Cost: the rows of tiles that the marks reach.
template <typename F> void for_each_region_within(const tile_grid& grid, int radius, F&& f) {
    radius = greater(radius, 0);
    for (int w = 0; w < words_for(grid.columns()); ++w) {
        detail::grown_word needed(grid, radius, w);
        detail::span_stack stack(f);
        detail::for_each_band_of(
            grid, radius,
            [&](int row, int y, const detail::band& b) {
                if (needed.go_to(row, b)) stack.go_to(y, needed.spans);
            },
            [&](int y) {
                if (needed.leave()) stack.go_to(y, needed.spans);
            });
        stack.go_to(grid.size().height, {});
    }
}

/// The same for what `before` needs and `now` does not: what has to be cleared. If `now` has another size or tile, all that `before`
/// needs.
template <typename F> void for_each_region_left(const tile_grid& before, const tile_grid& now, int radius, F&& f) {
    if (!same_tiles(before, now)) return for_each_region_within(before, radius, f);
    radius = greater(radius, 0);
    for (int w = 0; w < words_for(before.columns()); ++w) {
        detail::grown_word was(before, radius, w), is(now, radius, w);
        detail::span_list left;
        detail::span_stack stack(f);
        detail::for_each_band_of(
            before, radius,
            [&](int row, int y, const detail::band& b) {
                const bool other = was.go_to(row, b);
                if (!is.go_to(row, b) && !other) return;
                subtract(was.spans, is.spans, left);
                stack.go_to(y, left);
            },
            [&](int y) {
                if (was.leave()) stack.go_to(y, was.spans);
            });
        stack.go_to(before.size().height, {});
    }
}

} // namespace gnomon::inline GNOMON_BUILD
