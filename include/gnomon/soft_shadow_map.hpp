// gnomon: soft shadow maps. The facade: one map, frame after frame. Everything it does is a stage you can also take alone.
#pragma once

#include <gnomon/backend/executor.hpp>
#include <gnomon/backend/simd.hpp>
#include <gnomon/receive/cull.hpp>

#include <concepts>
#include <cstdint>

namespace gnomon::inline GNOMON_BUILD {

/// The size of a soft_shadow_map, in texels. Tiles of 16 to 64 texels serve most maps. An empty map is lit everywhere.
struct map_size {
    int width = 0;
    int height = 0;
    int tile = 32;
    int bands = 32; ///< jobs that filter(executor) hands out at most; each has a scratch
};

/// What draws casters: a callable that writes into the image it is given and returns what it touched, `texels` and `depth`.
template <typename Draw, typename Texel>
concept draws_casters = requires(Draw& draw, image_view<Texel> into) {
    { draw(into).texels } -> std::convertible_to<texel_rect>;
    { draw(into).depth } -> std::convertible_to<depth_interval>;
};

/// Marks what casters cover, for who draws several that lie apart: marks(texels, depth).
struct caster_marks {
    depth_tiles& tiles;
    int radius;
    void operator()(texel_rect texels, depth_interval depth) const noexcept { tiles.mark(texels, depth, radius); }
};

/// What any soft shadow map is asked, whatever it lives in: from its size(), tiles(), soft() and decision.
template <typename Map> class asked_for_shadow {
  public:
    /// Intensity at the centre of texel (x, y), for a receiver at depth `z`; 0 off the map.
    [[nodiscard]] float shadow(int x, int y, float z) const noexcept {
        return whole(self().size()).contains(x, y) ? gnomon::shadow(self().soft()(x, y), z, self().decision) : 0.0f;
    }
    template <typename X, typename Y>
        requires(std::floating_point<X> || std::floating_point<Y>)
    float shadow(X x, Y y, float z) const = delete; // a position is no texel: ask shadow_at(x, y, z)
    /// Intensity at a position in texels, blended from four; 0 off the map.
    [[nodiscard]] float shadow_at(float x, float y, float z) const noexcept {
        return gnomon::shadow(sample(self().soft(), x, y), z, self().decision);
    }
    /// The same for a map_point or anything else with x, y and depth.
    template <typename Point>
        requires requires(const Point& p) { static_cast<float>(p.x + p.y + p.depth); }
    [[nodiscard]] float shadow_at(const Point& p) const noexcept {
        return shadow_at(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.depth));
    }
    /// Could a receiver with these texels and depths be shadowed at all? If not, draw it without shadow code.
    [[nodiscard]] bool reaches(texel_rect footprint, depth_interval depth = {}) const noexcept {
        return casters_reach(self().tiles(), footprint, depth, self().decision.caster);
    }

  private:
    [[nodiscard]] const Map& self() const noexcept { return static_cast<const Map&>(*this); }
};

/// A soft shadow map: clear, cast, bound, filter, shadow; and the next frame the same (Salzman 2007).
///
///     soft_shadow_map<rg8, binomial<3>> map({.width = 512, .height = 512});
///     each frame:  map.clear();  map.cast(...);  map.filter();  ... map.shadow(x, y, z) ...
///
/// Casting and filtering cost what the casters cover, not what the map measures. Allocates in its constructor and never again.
/// Between `filter` and the next `clear` any number of threads may read. One that was moved from may only be assigned to or destroyed.
template <texel_format Texel, kernel Kernel = binomial<3>, backend_for<Texel, Kernel> Backend = simd<>>
class soft_shadow_map : public asked_for_shadow<soft_shadow_map<Texel, Kernel, Backend>> {
  public:
    explicit soft_shadow_map(map_size size, Backend run = {})
        : run_(run), casters_({size.width, size.height}, Texel::clear()), soft_({size.width, size.height}, Texel::clear()),
          tiles_({size.width, size.height}, size.tile), filtered_(tiles_.tiles()),
          scratch_(size.width, detail::band_count(std::int64_t{casters_.size().width} * casters_.size().height, size.bands)) {}

    /// How `shadow` and `receive` decide; no false shadow unless you say otherwise. It knows how often the filter rounds.
    rule decision{.caster = {.roundings = filter_roundings<Texel, Kernel>},
                  .far_bound = {.roundings = filter_roundings<Texel, Kernel>}};

    [[nodiscard]] extent size() const noexcept { return casters_.size(); }
    /// Where shadows may lie, this frame.
    [[nodiscard]] const depth_tiles& tiles() const noexcept { return tiles_; }
    /// The filtered map, for an engine that reads it itself. Valid after `filter`.
    [[nodiscard]] image_view<const Texel> soft() const noexcept { return soft_.view(); }

    /// Begins a frame: forgets every caster. The filtered map stays readable until the next `filter`.
    void clear() noexcept {
        clear_casters(casters_.view(), tiles_.tiles());
        tiles_.clear();
    }

    /// Casts a rectangle at depth `s`, where nothing nearer is.
    void cast(texel_rect r, float s) noexcept { cast_texel(r, s, Texel::caster(s)); }
    /// The same, letting 1 - opacity of the light through.
    void cast(texel_rect r, float s, float opacity) noexcept
        requires(Texel::effects.translucency)
    {
        cast_texel(r, s, Texel::caster(s, opacity));
    }

    /// Casts what `draw` writes into the image it is given, with Texel::cast; it returns what it touched, as cast_triangles does:
    ///     map.cast([&](auto texels) { return cast_triangles(texels, mesh, light); });
    template <draws_casters<Texel> Draw> void cast(Draw&& draw) {
        const auto touched = draw(casters());
        mark(touched.texels, touched.depth);
    }
    /// The same where `draw` marks by itself, piece by piece: a mesh of many things that lie apart then costs what these cover.
    ///     map.cast([&](auto texels, const auto& marks) { cast_triangles(texels, mesh, light, faces::both, marks); });
    template <std::invocable<image_view<Texel>, const caster_marks&> Draw> void cast(Draw&& draw) {
        draw(casters(), caster_marks{tiles_, Kernel::radius});
    }

    /// The map of casters, for an engine that keeps its own order. What it writes and does not mark is neither filtered nor
    /// cleared.
    [[nodiscard]] image_view<Texel> casters() noexcept { return casters_.view(); }
    /// Says that `r` now holds casters in `depth`.
    void mark(texel_rect r, depth_interval depth) noexcept { tiles_.mark(r, depth, Kernel::radius); }

    /// A receiver at depth `z` ends the shadow of the casters before it. After all casters, before `filter`.
    void bound(texel_rect r, float z) noexcept
        requires(Texel::effects.far_bound)
    {
        for_each_region(tiles_.tiles(), [&](texel_rect tile) { edit(intersection(r, tile), [z](Texel& t) { t.bound(z); }); });
    }
    /// The same for what `draw` bounds in the image it is given, with Texel::bound:
    ///     map.bound([&](auto texels) { bound_triangles(texels, ground, light, faces::both, map.tiles()); });
    template <typename Draw>
        requires(Texel::effects.far_bound) && std::invocable<Draw&, image_view<Texel>>
    void bound(Draw&& draw) {
        draw(casters());
    }

    /// Blurs what was cast into the map that `shadow` reads.
    void filter() noexcept {
        clear_what_is_left<Kernel>(soft_.view(), filtered_, tiles_.tiles());
        gnomon::filter(run_, casters_.view(), soft_.view(), tiles_, scratch_[0]);
        filtered_ = tiles_.tiles();
    }
    /// The same as jobs of an executor, on(count, job); see backend/executor.hpp.
    template <typename On> void filter(On&& on) {
        refilter(run_, casters_.view(), soft_.view(), filtered_, tiles_.tiles(), scratch_, on);
        filtered_ = tiles_.tiles();
    }

    /// Many points at once.
    void receive(strided_span<const float> x, strided_span<const float> y, strided_span<const float> z,
                 strided_span<float> intensity) const noexcept {
        run_.receive(soft(), x, y, z, intensity, decision);
    }
    /// One row of receivers, one to one on the texels of row `y`; all lit off the map.
    void receive_row(int y, strided_span<const float> z, strided_span<float> intensity) const noexcept {
        if (y >= 0 && y < size().height) return run_.receive(soft().row_span(y), z, intensity, decision);
        for (int i = 0; i < intensity.size(); ++i) intensity[i] = 0.0f;
    }
    /// An image of receivers, one to one on the texels of the map, as jobs of an executor; what both have is written.
    template <typename Z, typename Intensity, typename On>
    void receive(image_view<Z> z, image_view<Intensity> intensity, On&& on) const {
        gnomon::receive(run_, soft(), z, intensity, decision, on);
    }

  private:
    template <typename F> void edit(texel_rect r, F&& f) noexcept {
        r = clip(r, size());
        for (int y = r.y0; y < r.y1; ++y)
            for (int x = r.x0; x < r.x1; ++x) f(casters_(x, y));
    }
    void cast_texel(texel_rect r, float s, const Texel& caster) noexcept {
        edit(r, [&caster](Texel& t) { t.cast(caster); });
        const float depth = same(s, s) ? saturate(s) : 1.0f; // of NaN too what it is stored as
        mark(clip(r, size()), {depth, depth});
    }

    [[no_unique_address]] Backend run_;
    image<Texel> casters_;
    image<Texel> soft_;
    depth_tiles tiles_;
    tile_grid filtered_;
    band_scratch<Texel, Kernel> scratch_;
};

} // namespace gnomon::inline GNOMON_BUILD
