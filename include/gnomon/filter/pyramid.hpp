// gnomon: soft shadow maps. Mip levels of a filtered map, and a sample blended from two of them (Salzman 2007: trilinear filtering).
#pragma once

#include <gnomon/filter/sample.hpp>
#include <gnomon/filter/separable.hpp>
#include <gnomon/grid/regions.hpp>

#include <concepts>
#include <type_traits>
#include <vector>

namespace gnomon::inline GNOMON_BUILD {

/// The size of the next mip level: half, rounded up, so that no caster at an odd edge is lost. A texel of level l covers 2^l x 2^l
/// texels of the map, also where part of them lies off the map, and counts as clear. For a square map whose side is a power of two
/// these are the levels of every graphics API.
[[nodiscard]] constexpr extent half_size(extent size) noexcept {
    return size.empty() ? extent{} : extent{size.width - size.width / 2, size.height - size.height / 2};
}

/// Halves the texels of `region` of one level into the next: each is the mean of 2 x 2, exact before its one rounding. Beyond the
/// map's edge lies clear. Returns what it wrote, in texels of `to`, which is clipped to it; everything else is left alone.
template <typename T, texel_format Texel>
    requires std::same_as<std::remove_const_t<T>, Texel>
texel_rect halve_region(image_view<T> from, image_view<Texel> to, texel_rect region) noexcept {
    region = clip(region, from.size());
    region = clip(texel_rect{region.x0 / 2, region.y0 / 2, region.x1 - region.x1 / 2, region.y1 - region.y1 / 2}, to.size());
    using wide = typename Texel::linear_sum;
    const auto mean = [](const Texel& a, const Texel& b, const Texel& c, const Texel& d) {
        wide sums[static_cast<std::size_t>(Texel::channels)];
        for (int i = 0; i < Texel::channels; ++i)
            sums[i] = wide{} + a.template linear<wide>(i) + b.template linear<wide>(i) + c.template linear<wide>(i) +
                      d.template linear<wide>(i); // from a zero without a sign
        return Texel::from_linear(sums, static_cast<wide>(4));
    };
    constexpr Texel clear = Texel::clear();
    const int whole_pairs = lesser(region.x1, from.width() / 2); // the last column may have none beside it
    for (int y = region.y0; y < region.y1; ++y) {
        const bool last = 2 * y + 1 == from.height(); // nor has the last row
        const auto* const first = from.row(2 * y);
        const auto* const second = last ? first : from.row(2 * y + 1);
        Texel* const made = to.row(y);
        const auto of_second = [&](int x) -> const Texel& { return last ? clear : second[x]; };
        for (int x = region.x0; x < whole_pairs; ++x)
            made[x] = mean(first[2 * x], first[2 * x + 1], of_second(2 * x), of_second(2 * x + 1));
        for (int x = whole_pairs; x < region.x1; ++x) made[x] = mean(first[2 * x], clear, of_second(2 * x), clear);
    }
    return region;
}

/// How often the numbers of a mip level were rounded, if those of level 0 were `roundings` times: what `bias` wants to know.
[[nodiscard]] constexpr int mip_roundings(int level, int roundings = 1) noexcept { return level + roundings; }

/// The mip levels above a filtered map, down to one texel. Level 0 is the map itself; it stays the host's, and no view of it is kept.
///
/// Level l is rounded l times more than level 0: its depths are within depth_error(texel, mip_roundings(l)), in whole codes
/// (l+1)(1+t)/(2M), and a decision on it takes bias{.roundings = mip_roundings(l)}, then still gives no false shadow. Masks of
/// whole codes drift upwards by an eighth of a code a level at most on average, for halves are rounded up. Clear stays clear, and
/// e <= m holds as it does in a filter.
/// Allocates in its constructor and never again.
template <texel_format Texel> class pyramid {
  public:
    pyramid() = default;
    /// For maps of `size` texels that are marked in tiles of `tile` x `tile`. All levels are clear.
    pyramid(extent size, int tile) : built_(size, tile) {
        for (size = built_.size(); !size.empty() && (size.width > 1 || size.height > 1);)
            levels_.emplace_back(size = half_size(size), Texel::clear());
    }

    /// The size of level 0.
    [[nodiscard]] extent size() const noexcept { return built_.size(); }
    /// The last level; 0 where there is none but the map.
    [[nodiscard]] int coarsest() const noexcept { return static_cast<int>(levels_.size()); }
    /// \pre 1 <= l <= coarsest()
    [[nodiscard]] image_view<const Texel> level(int l) const noexcept { return levels_[static_cast<std::size_t>(l) - 1].view(); }

    /// Makes all levels from a map.
    ///
    /// Reads its marked tiles alone, and those of the last build: the same bits as from the whole map, if the map is clear where
    /// nothing is marked. \pre the map and its grid have the size and the tiles of the constructor; from others nothing is built.
    /// Cost: 4 reads a texel, for a third of the area that is marked or was; and a texel a level for each region of the grid.
    void build(image_view<const Texel> map, const tile_grid& tiles) noexcept {
        if (levels_.empty()) return; // nothing, or one texel
        const bool fits = map.size() == size() && same_tiles(tiles, built_);
        GNOMON_ASSERT(fits, "gnomon: a pyramid is built for one size of map and of tile: make it anew for another");
        if (!fits) return;
        // A texel of a coarse level may lie under several regions. The last of them finds everything below it done.
        const auto halve = [this, map](texel_rect region) {
            region = halve_region(map, levels_.front().view(), region);
            for (int l = 2; l <= coarsest(); ++l)
                region = halve_region(level(l - 1), levels_[static_cast<std::size_t>(l) - 1].view(), region);
        };
        for_each_tile_rect(built_, [&](tile_rect t) {
            for (int y = t.y0; y < t.y1; ++y)
                for (int x = t.x0; x < t.x1; ++x)
                    if (!tiles.test(x, y)) halve(tiles.texels_of({x, y, x + 1, y + 1})); // what was marked, and is not
        });
        for_each_region(tiles, halve);
        built_ = tiles;
    }

  private:
    std::vector<image<Texel>> levels_;
    tile_grid built_;
};

/// Blended from the two levels around `lod`, four texels of each: at (x, y) in texels of the map. Level l is taken whole at lod = l.
///
/// \pre the pyramid was built from this map; of one of another size nothing is read.
/// `lod` is limited to the levels there are, NaN is 0, and is taken to 1/256. Off the map lies clear. Exact for unorm and half; float
/// and 16-bit ratios to 2^-45; keeps e <= m. A decision takes the roundings of the coarser level.
template <typename T, texel_format Texel>
    requires std::same_as<std::remove_const_t<T>, Texel>
[[nodiscard]] filtered<Texel> sample(image_view<T> map, const pyramid<Texel>& mips, float x, float y, float lod) noexcept {
    GNOMON_ASSERT(mips.coarsest() == 0 || mips.size() == map.size(),
                  "gnomon: a pyramid is sampled together with the map it was built from");
    constexpr int steps = 256;
    const double bounded =
        lod > 0.0f && mips.size() == map.size() ? lesser(static_cast<double>(lod), static_cast<double>(mips.coarsest())) : 0.0;
    const int fixed = detail::floor_to_int(bounded * steps + 0.5), fine = fixed / steps, part = fixed % steps;
    const auto at = [&](int l) {
        const float size = 1.0f / static_cast<float>(1 << l); // a power of two: scales exactly
        return l == 0 ? sample(map, x, y) : sample(mips.level(l), x * size, y * size);
    };
    filtered<Texel> blend = at(fine);
    if (part == 0) return blend;
    const filtered<Texel> coarse = at(fine + 1);
    constexpr auto cut = [](double code) { return detail::to_bits<45>(code); }; // 8 bits are left for the weight
    for (int c = 0; c < Texel::channels; ++c)
        blend.code[c] = ((steps - part) * cut(blend.code[c]) + part * cut(coarse.code[c])) / steps;
    return blend;
}

} // namespace gnomon::inline GNOMON_BUILD
