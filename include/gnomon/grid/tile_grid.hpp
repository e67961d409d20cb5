// gnomon: soft shadow maps. The tile-grid bit-vector manager: where on the map anything is (Salzman 2007, "Efficient Blurring").
#pragma once

#include <gnomon/grid/bit_row.hpp>
#include <gnomon/rect.hpp>

#include <cstddef>
#include <vector>

namespace gnomon::inline GNOMON_BUILD {

namespace detail {

/// Rows of bits, and one bit a row: does it hold any? Allocates in its constructor and never again.
class bit_grid {
  public:
    bit_grid() = default;
    bit_grid(int columns, int rows)
        : columns_(columns), rows_(rows), words_(offset(rows)), occupied_(static_cast<std::size_t>(words_for(rows))) {}

    [[nodiscard]] const_bit_row row(int y) const noexcept { return {words_.data() + offset(y), columns_}; }
    [[nodiscard]] bit_row row(int y) noexcept { return {words_.data() + offset(y), columns_}; }
    [[nodiscard]] const_bit_row occupied_rows() const noexcept { return {occupied_.data(), rows_}; }
    [[nodiscard]] bit_row occupied_rows() noexcept { return {occupied_.data(), rows_}; }
    [[nodiscard]] int count() const noexcept {
        int n = 0;
        for_each_occupied_word([&](std::size_t w) { n += std::popcount(words_[w]); });
        return n;
    }
    void set(tile_rect r) noexcept {
        for (int y = r.y0; y < r.y1; ++y) row(y).set(r.x0, r.x1);
        occupied_rows().set(r.y0, r.y1);
    }
    void clear() noexcept {
        for_each_occupied_word([this](std::size_t w) { words_[w] = 0; });
        for (bit_word& w : occupied_) w = 0;
    }

  private:
    [[nodiscard]] std::size_t offset(int y) const noexcept {
        return static_cast<std::size_t>(words_for(columns_)) * static_cast<std::size_t>(y);
    }
    template <typename F> void for_each_occupied_word(F&& f) const {
        occupied_rows().for_each_run([&](int first, int last) {
            for (std::size_t w = offset(first); w < offset(last); ++w) f(w);
        });
    }

    int columns_ = 0, rows_ = 0;
    std::vector<bit_word> words_;
    std::vector<bit_word> occupied_;
};

} // namespace detail

/// A map cut into square tiles, one bit a tile, set where a caster's shadow may lie.
///
/// Casters mark their rectangles with a guard band as wide as the filter's radius; then the set tiles hold everything that the
/// filter can make non-clear, and a receiver whose rectangle touches none of them is lit. The tiles of the casters themselves are
/// kept beside them: a filter writes within its radius of these, which is less than the tiles it reaches. Any map size and any tile size: a map
/// that is no multiple of the tile has narrower tiles at its right and last edge. Texels map to tiles by integer division.
/// Allocates in its constructor and never again. One that was moved from may only be assigned to or destroyed.
class tile_grid {
  public:
    tile_grid() = default;

    /// A map of `size` texels in tiles of `tile` x `tile`. An empty map has no tiles; a tile below 1 counts as 1.
    tile_grid(extent size, int tile)
        : size_{greater(size.width, 0), greater(size.height, 0)}, tile_(greater(tile, 1)), columns_(tiles_along(size_.width)),
          rows_(tiles_along(size_.height)), reached_(columns_, rows_), held_(columns_, rows_) {
        GNOMON_ASSERT(tile >= 1, "gnomon: a tile is at least one texel wide; 16 to 64 serve most maps");
    }

    [[nodiscard]] extent size() const noexcept { return size_; }
    [[nodiscard]] int tile() const noexcept { return tile_; }
    [[nodiscard]] int columns() const noexcept { return columns_; }
    [[nodiscard]] int rows() const noexcept { return rows_; }

    /// The bits of one row of tiles. \pre 0 <= y < rows
    [[nodiscard]] const_bit_row row(int y) const noexcept { return reached_.row(y); }
    /// One bit a row: does the row hold a mark?
    [[nodiscard]] const_bit_row occupied_rows() const noexcept { return reached_.occupied_rows(); }
    /// The tiles that marked rectangles touch without their guard bands: where casters themselves are. \pre 0 <= y < rows
    [[nodiscard]] const_bit_row held(int y) const noexcept { return held_.row(y); }
    [[nodiscard]] const_bit_row held_rows() const noexcept { return held_.occupied_rows(); }
    [[nodiscard]] int held_count() const noexcept { return held_.count(); }
    /// \pre the tile lies in the grid
    [[nodiscard]] bool test(int column, int row_index) const noexcept { return row(row_index).test(column); }
    /// Is nothing marked?
    [[nodiscard]] bool empty() const noexcept { return bounds_.empty(); }
    /// Number of tiles set.
    [[nodiscard]] int count() const noexcept { return reached_.count(); }

    /// The union of all marks in texels, guard bands included, clipped to the map: never wider than the set tiles.
    [[nodiscard]] texel_rect bounds() const noexcept { return bounds_; }
    /// The narrowest guard band used since `clear`: the widest filter whose result the set tiles are sure to hold.
    [[nodiscard]] int guard() const noexcept { return guard_; }

    /// The tiles that `r` touches, after clipping it to the map.
    [[nodiscard]] tile_rect tiles_of(texel_rect r) const noexcept {
        r = clip(r, size_);
        if (r.empty()) return {};
        return {r.x0 / tile_, r.y0 / tile_, (r.x1 - 1) / tile_ + 1, (r.y1 - 1) / tile_ + 1};
    }
    /// The texels of a rectangle of tiles; those at the map's edge may be narrower. \pre the tiles lie in the grid
    [[nodiscard]] texel_rect texels_of(tile_rect t) const noexcept {
        return {t.x0 * tile_, t.y0 * tile_, last_texel(t.x1, columns_, size_.width), last_texel(t.y1, rows_, size_.height)};
    }

    /// Sets the tiles that `r` grown by `guard` texels touches; returns them.
    ///
    /// `r` holds the casters: a filter looks for them nowhere else.
    /// The rectangle is grown before it is clipped, so a caster just off the map still marks where its penumbra enters.
    /// An empty or inverted one marks nothing. Cost: the rows it spans.
    tile_rect mark(texel_rect r, int guard = 0) noexcept {
        const texel_rect reach = clip(grow(r, guard), size_);
        const tile_rect tiles = tiles_of(reach);
        if (tiles.empty()) return {};
        reached_.set(tiles);
        held_.set(tiles_of(r));
        bounds_ = union_box(bounds_, reach);
        guard_ = lesser(guard_, greater(guard, 0));
        return tiles;
    }

    /// Does `r`, cut to the union of all marks, touch a set tile? False for an empty rectangle and for one off the map.
    /// Cost: the rows it spans, ending at the first hit.
    [[nodiscard]] bool touches(texel_rect r) const noexcept {
        const tile_rect tiles = tiles_of(intersection(r, bounds_));
        for (int y = tiles.y0; y < tiles.y1; ++y)
            if (row(y).any(tiles.x0, tiles.x1)) return true;
        return false;
    }

    /// Sets every tile within `tiles` steps, diagonals included, of a set one. The guard grows with it.
    void dilate(int tiles) noexcept {
        if (empty() || tiles <= 0) return;
        const int steps = lesser(tiles, greater(columns_, rows_)); // more would change nothing
        for (int step = 0; step < steps; ++step) {
            occupied_rows().for_each_run([this](int first, int last) {
                for (int y = first; y < last; ++y) widen(reached_.row(y));
            });
            for (int y = rows_ - 1; y > 0; --y) merge(y, y - 1);
            for (int y = 0; y + 1 < rows_; ++y) merge(y, y + 1);
            widen(reached_.occupied_rows());
        }
        const int texels = tiles > detail::int_max / tile_ ? detail::int_max : tiles * tile_;
        bounds_ = clip(grow(bounds_, texels), size_);
        guard_ = detail::saturating_add(guard_, texels);
    }

    /// Forgets every mark. Cost: the rows that hold one.
    void clear() noexcept {
        reached_.clear();
        held_.clear();
        bounds_ = {};
        guard_ = detail::int_max;
    }

  private:
    [[nodiscard]] int tiles_along(int texels) const noexcept { return texels == 0 ? 0 : (texels - 1) / tile_ + 1; }
    [[nodiscard]] int last_texel(int tiles, int all, int texels) const noexcept { return tiles >= all ? texels : tiles * tile_; }
    void merge(int into, int from) noexcept {
        for (int w = 0; w < words_for(columns_); ++w) reached_.row(into).words[w] |= reached_.row(from).words[w];
    }
    /// Sets the neighbours of every set bit.
    static void widen(bit_row bits) noexcept {
        bit_word left = 0;
        for (int w = 0; w < words_for(bits.size); ++w) {
            const bit_word here = bits.words[w];
            const bit_word right = w + 1 < words_for(bits.size) ? bits.words[w + 1] : 0;
            bits.words[w] = here | here << 1 | here >> 1 | left >> (bits_per_word - 1) | right << (bits_per_word - 1);
            left = here;
        }
        if (bits.size % bits_per_word != 0)
            bits.words[bits.size / bits_per_word] &= (bit_word{1} << (bits.size % bits_per_word)) - 1;
    }

    extent size_{};
    int tile_ = 1;
    int columns_ = 0;
    int rows_ = 0;
    int guard_ = detail::int_max;
    texel_rect bounds_{};
    detail::bit_grid reached_; ///< by marks with their guard bands
    detail::bit_grid held_;    ///< by marks without
};

/// Are two maps of one size cut into the same tiles?
[[nodiscard]] inline bool same_tiles(const tile_grid& a, const tile_grid& b) noexcept {
    return a.size() == b.size() && a.tile() == b.tile();
}

} // namespace gnomon::inline GNOMON_BUILD
