// gnomon: soft shadow maps. What a filter has to write: all texels within its radius of a caster's tile, as disjoint rectangles.
#pragma once

#include <gnomon/grid/tile_grid.hpp>

#include <cstdint>

namespace gnomon {

namespace detail {

/// Disjoint intervals of columns, in order and apart: what a row of texels needs of the 64 tiles of a word. Two lists of at most 34
/// intervals make one of at most 68.
struct span_list {
    struct span {
        int first, last;
    };
    span at[68];
    int count = 0;

    /// What lies left of `from` or right of `to` is cut off; what touches the last span is joined to it.
    void add(std::int64_t first, std::int64_t last, int from, int to) noexcept {
        const span s{static_cast<int>(greater<std::int64_t>(first, from)), static_cast<int>(lesser<std::int64_t>(last, to))};
        if (s.first >= s.last) return;
        if (count > 0 && at[count - 1].last >= s.first)
            at[count - 1].last = greater(at[count - 1].last, s.last);
        else
            at[count++] = s;
    }
    void add_runs(bit_word bits, int column, int tile, std::int64_t grow, int from, int to) noexcept {
        const const_bit_row row{&bits, bits_per_word};
        row.for_each_run([&](int first, int last) {
            add(std::int64_t{column + first} * tile - grow, std::int64_t{column + last} * tile + grow, from, to);
        });
    }
};

[[nodiscard]] inline span_list intersection(const span_list& a, const span_list& b) noexcept {
    span_list both;
    for (int i = 0, j = 0; i < a.count && j < b.count; a.at[i].last < b.at[j].last ? ++i : ++j)
        both.add(a.at[i].first, a.at[i].last, b.at[j].first, b.at[j].last);
    return both;
}

/// What is in `a` and not in `b`.
[[nodiscard]] inline span_list difference(const span_list& a, const span_list& b) noexcept {
    span_list left;
    for (int i = 0, j = 0; i < a.count; ++i) {
        int from = a.at[i].first;
        for (; j < b.count && b.at[j].last <= from; ++j) {
        }
        for (int k = j; k < b.count && b.at[k].first < a.at[i].last; ++k) {
            left.add(from, b.at[k].first, from, a.at[i].last);
            from = b.at[k].last;
        }
        left.add(from, a.at[i].last, from, a.at[i].last);
    }
    return left;
}

/// Rows of texels of a row of tiles that the same rows of tiles grow into: those from `first` to `last`, relative to it.
struct band {
    int offset, first, last;
};

/// The bands of any row of tiles: it changes what grows into a texel `radius` below a tile's first and last one.
struct bands {
    band at[3];
    int count = 0;

    bands(int tile, int radius) noexcept {
        const int below = radius % tile, above = (tile - below) % tile;
        for (const int offset : {0, lesser(below, above), greater(below, above)}) {
            if (count > 0 && at[count - 1].offset == offset) continue;
            const std::int64_t top = std::int64_t{offset} - radius, end = std::int64_t{offset} + radius;
            at[count++] = {offset, static_cast<int>((top - (top < 0 ? tile - 1 : 0)) / tile), static_cast<int>(end / tile)};
        }
    }
};

/// What one word of tiles needs in one band after another.
class grown_word {
  public:
    span_list spans;

    grown_word(const tile_grid& grid, int radius, int word) noexcept
        : grid_(grid), radius_(radius), word_(word), from_(static_cast<int>(std::int64_t{word} * bits_per_word * grid.tile())),
          to_(static_cast<int>(lesser<std::int64_t>(std::int64_t{word + 1} * bits_per_word * grid.tile(), grid.size().width))) {}

    /// Goes to a band; answers whether the spans are others than before.
    bool go_to(int row, const band& b) noexcept {
        first_ = greater(row + b.first, 0);
        last_ = static_cast<int>(lesser(std::int64_t{row} + b.last, std::int64_t{grid_.rows()} - 1));
        // A guard band as wide as the radius marks all that is reached; there is nothing outside it.
        const bit_word reached = grid_.guard() >= radius_ ? grid_.row(row).words[word_] : ~bit_word{0};
        const key now{held(word_), reached, end_of_left(), begin_of_right()};
        if (now == at_) return false;
        at_ = now;
        spans = {};
        spans.add(from_, now.left, from_, to_);
        spans.add_runs(now.held, word_ * bits_per_word, grid_.tile(), radius_, from_, to_);
        spans.add(now.right, to_, from_, to_);
        if (spans.count == 0 || reached == ~bit_word{0}) return true;
        span_list marked;
        marked.add_runs(reached, word_ * bits_per_word, grid_.tile(), 0, from_, to_);
        spans = intersection(spans, marked);
        return true;
    }
    /// Goes where nothing is.
    bool leave() noexcept {
        spans = {};
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

    [[nodiscard]] bit_word held(int word) const noexcept {
        bit_word bits = 0;
        for (int y = first_; y <= last_; ++y) bits |= grid_.held(y).words[word];
        return bits;
    }
    /// Where the tiles of the words to the left and to the right end and begin, grown.
    [[nodiscard]] std::int64_t end_of_left() const noexcept {
        const auto end = [&](int column) { return std::int64_t{column} * grid_.tile() + radius_; };
        for (int w = word_ - 1; w >= 0 && end((w + 1) * bits_per_word) > from_; --w)
            if (const bit_word bits = held(w); bits != 0) return end((w + 1) * bits_per_word - std::countl_zero(bits));
        return from_;
    }
    [[nodiscard]] std::int64_t begin_of_right() const noexcept {
        const auto begin = [&](int column) { return std::int64_t{column} * grid_.tile() - radius_; };
        for (int w = word_ + 1; w < words_for(grid_.columns()) && begin(w * bits_per_word) < to_; ++w)
            if (const bit_word bits = held(w); bits != 0) return begin(w * bits_per_word + std::countr_zero(bits));
        return to_;
    }

    const tile_grid& grid_;
    int radius_, word_, from_, to_, first_ = 0, last_ = 0;
    key at_{};
};

/// Stacks the spans of one band after another into rectangles; a span that stays as it is continues one.
template <typename F> class span_stack {
  public:
    explicit span_stack(F& f) noexcept : f_(f) {}

    void go_to(int y, const span_list& now) {
        int i = 0, n = 0;
        open next[68];
        for (int s = 0; s < now.count; ++s) {
            const span_list::span here = now.at[s];
            while (i < count_ && at_[i].first < here.first) close(at_[i++], y);
            const bool same = i < count_ && at_[i].first == here.first && at_[i].last == here.last;
            next[n++] = same ? at_[i++] : open{here.first, here.last, y};
        }
        while (i < count_) close(at_[i++], y);
        for (count_ = 0; count_ < n; ++count_) at_[count_] = next[count_];
    }

  private:
    struct open {
        int first, last, since;
    };
    void close(const open& o, int y) { f_(texel_rect{o.first, o.since, o.last, y}); }

    F& f_;
    open at_[68];
    int count_ = 0;
};

/// Visits the bands of a word, but for those that no row of `rows` grows into: at(row, y, band), and beyond(y) where these begin.
template <typename At, typename Beyond> void for_each_band_of(const tile_grid& grid, int radius, At&& at, Beyond&& beyond) {
    const bands each(grid.tile(), radius);
    const int reach_up = -each.at[0].first, reach_down = each.at[each.count - 1].last;
    for (int row = 0; row < grid.rows();) {
        const int next = grid.held_rows().next_set(greater(row - reach_up, 0));
        if (next - reach_down > row || next == grid.rows()) {
            beyond(row * grid.tile());
            row = next == grid.rows() ? next : next - reach_down;
            continue;
        }
        for (int b = 0; b < each.count; ++b)
            if (const std::int64_t y = std::int64_t{row} * grid.tile() + each.at[b].offset; y < grid.size().height)
                at(row, static_cast<int>(y), each.at[b]);
        ++row;
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

/// The same for what `before` needs and `now` does not: what has to be cleared. \pre both have the same size and tile
template <typename F> void for_each_region_left(const tile_grid& before, const tile_grid& now, int radius, F&& f) {
    radius = greater(radius, 0);
    for (int w = 0; w < words_for(before.columns()); ++w) {
        detail::grown_word was(before, radius, w), is(now, radius, w);
        detail::span_stack stack(f);
        detail::for_each_band_of(
            before, radius,
            [&](int row, int y, const detail::band& b) {
                const bool other = was.go_to(row, b);
                if (is.go_to(row, b) || other) stack.go_to(y, difference(was.spans, is.spans));
            },
            [&](int y) {
                if (was.leave()) stack.go_to(y, was.spans);
            });
        stack.go_to(before.size().height, {});
    }
}

} // namespace gnomon
