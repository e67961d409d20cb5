// gnomon: soft shadow maps. The facade on a GPU: the same map, frame after frame, in textures of a GL context.
//
//     const gl::functions functions = gl::load(glfwGetProcAddress);
//     const auto context = gl::context::of(functions);
//     if (!context) return give_up(context.error().sentence);
//     soft_shadow_map<rg16, binomial<3>, gl::backend> map({.width = 1024, .height = 1024}, gl::backend(*context));
//     if (map.problem()) return give_up(map.problem().sentence);              // a map of simd<> still works
//     each frame:
//         map.clear();
//         map.cast([&](const auto& target) { return draw(casters, target); }); // your draws, gnomon_caster(s) in the fragment stage
//         map.filter();
//         bind map.soft_texture(), and draw what receives
#pragma once

#include <gnomon/gl/backend.hpp>
#include <gnomon/soft_shadow_map.hpp>

#include <concepts>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::inline GNOMON_BUILD {

/// A soft shadow map in textures. Members are those of the primary template, with the same results; and those that take and return
/// names of GL. What `draw` is called with is a gl::map_targets; the framebuffer is bound, and the state is set.
///
/// All but size, tiles, reaches and mark is called while its context is current. The constructor leaves all state as found; what the
/// others leave is said by the backend's state_policy. Nothing of GL is allocated after construction. A map that has a problem() does
/// nothing and is lit everywhere. Move-only.
///
/// Rectangles are collected, and drawn by as few calls as order allows. shadow, receive and soft read the filtered map back, once for
/// each filter, which waits for the GPU: for tools and tests; an engine's shader reads soft_texture(). Once one of them was called, any
/// number of threads may read until the next filter.
template <texel_format Texel, kernel Kernel, gl::state_policy Policy>
class soft_shadow_map<Texel, Kernel, gl::backend_of<Policy>>
    : public asked_for_shadow<soft_shadow_map<Texel, Kernel, gl::backend_of<Policy>>> {
  public:
    using backend_type = gl::backend_of<Policy>;

    explicit soft_shadow_map(map_size size, backend_type run, const gl::lent_textures& lent = {})
        : run_(std::move(run)), tiles_({size.width, size.height}, size.tile), filtered_(tiles_.tiles()),
          read_(tiles_.tiles().size(), Texel::clear()), reader_(tiles_.tiles().size()) {
        pending_.reserve(gl::rectangle_list::capacity);
        problem_ = make(lent);
    }

    /// How `shadow` and `receive` decide, and what the receiver's uniforms should say.
    rule decision{.caster = {.roundings = filter_roundings<Texel, gl::kernel_in_gl<Texel, Kernel>>},
                  .far_bound = {.roundings = filter_roundings<Texel, gl::kernel_in_gl<Texel, Kernel>>}};

    /// Why there is no map; empty if there is one.
    [[nodiscard]] const gl::problem& problem() const noexcept { return problem_; }

    [[nodiscard]] extent size() const noexcept { return tiles_.tiles().size(); }
    [[nodiscard]] const depth_tiles& tiles() const noexcept { return tiles_; }
    /// The filtered map, read back if it was not yet.
    [[nodiscard]] image_view<const Texel> soft() const noexcept {
        read_back();
        return std::as_const(read_).view();
    }

    void clear() noexcept {
        pending_.clear(); // in tiles that are forgotten
        if (works() && !tiles_.tiles().empty()) {
            const gl::state_guard<Policy> forced(run_.context());
            passes_->clear_casters(run_.context(), targets(), [this](auto&& f) { for_each_region_within(tiles_.tiles(), 0, f); });
        }
        tiles_.clear();
    }

    void cast(texel_rect r, float s) noexcept { add(false, {.where = r, .depth = s}); }
    void cast(texel_rect r, float s, float opacity) noexcept
        requires(Texel::effects.translucency)
    {
        add(false, {.where = r, .depth = s, .opacity = opacity});
    }
    /// Casts what `draw` draws, whose fragment stage calls gnomon_caster of gl::caster_text<Texel>(); it returns what it touched, at
    /// least: `texels` and `depth`.
    template <typename Draw>
        requires requires(Draw& draw, const gl::map_targets& target) {
            { draw(target).texels } -> std::convertible_to<texel_rect>;
            { draw(target).depth } -> std::convertible_to<depth_interval>;
        }
    void cast(Draw&& draw) {
        if (!works()) return;
        flush();
        const gl::state_guard<Policy> forced(run_.context());
        gl::begin_casters(run_.context(), targets());
        const auto touched = draw(targets());
        mark(touched.texels, touched.depth);
    }
    /// For an engine that draws in an order of its own, into caster_framebuffer().
    void mark(texel_rect r, depth_interval depth) noexcept { tiles_.mark(r, depth, Kernel::radius); }

    void bound(texel_rect r, float z) noexcept
        requires(Texel::effects.far_bound)
    {
        if (!tiles_.tiles().empty()) add(true, {.where = r, .depth = z});
    }
    /// The same for what `draw` draws, whose fragment stage calls gnomon_bound.
    template <typename Draw>
        requires(Texel::effects.far_bound) && std::invocable<Draw&, const gl::map_targets&>
    void bound(Draw&& draw, gl::faces_drawn drawn = gl::faces_drawn::both) {
        if (!works() || tiles_.tiles().empty()) return;
        flush();
        const gl::state_guard<Policy> forced(run_.context());
        gl::begin_bounds<Texel>(run_.context(), targets(), drawn);
        draw(targets());
    }

    /// Blurs what was cast. An empty frame after an empty frame calls no function of GL.
    void filter(gl::rectangles_by way = gl::rectangles_by::instances) noexcept {
        flush();
        const tile_grid& now = tiles_.tiles();
        if (works() && !(now.empty() && filtered_.empty())) {
            const gl::state_guard<Policy> forced(run_.context());
            passes_->clear_soft(run_.context(), targets(),
                                [&](auto&& f) { for_each_region_left(filtered_, now, Kernel::radius, f); });
            if (!now.empty()) passes_->filter(run_.context(), targets(), regions_to_filter<Kernel>(now), way);
            is_read_ = false;
        }
        filtered_ = now;
    }

    /// The same: there is nothing for an executor to do.
    template <executor On> void filter(On&&) noexcept { filter(); }

    void receive(strided_span<const float> x, strided_span<const float> y, strided_span<const float> z,
                 strided_span<float> intensity) const noexcept {
        gnomon::receive(soft(), x, y, z, intensity, decision);
    }
    void receive_row(int y, strided_span<const float> z, strided_span<float> intensity) const noexcept {
        if (y >= 0 && y < size().height) return gnomon::receive(soft().row_span(y), z, intensity, decision);
        for (int i = 0; i < intensity.size(); ++i) intensity[i] = 0.0f;
    }

    template <typename Z, typename Intensity, typename On>
    void receive(image_view<Z> z, image_view<Intensity> intensity, On&& on) const {
        gnomon::receive(scalar{}, soft(), z, intensity, decision, on);
    }

    /// @name Names of GL; 0 where there is a problem, or no texel.
    /// @{
    /// What receivers read, valid after `filter`: texel (x, y) is texel (x, y), row 0 first; NEAREST, clamped to its edge.
    [[nodiscard]] unsigned soft_texture() const noexcept { return targets().soft; }
    /// What casters are drawn into, with all rectangles in it.
    [[nodiscard]] unsigned caster_framebuffer() noexcept {
        flush();
        return targets().into_casters;
    }
    [[nodiscard]] const gl::map_targets& targets() const noexcept { return textures_.targets(); }
    /// @}

    /// The context is lost: calls nothing of GL, now or when the map goes. Make another map, with another
    /// backend. What maps of the same backend share is forgotten with it; each of them has to be told.
    void forget() {
        textures_.forget();
        run_.forget();
        passes_.reset();
        pending_.clear();
        problem_ = {"gnomon: the map's context was lost"};
    }

  private:
    [[nodiscard]] gl::problem make(const gl::lent_textures& lent) {
        auto programs = run_.template passes_of<Texel, Kernel>();
        if (!programs) return programs.error();
        auto textures = gl::map_textures::make(run_.context(), size(), gl::format_of<Texel>, (*programs)->scratch(), lent);
        if (!textures) return textures.error();
        passes_ = *std::move(programs);
        textures_ = *std::move(textures);
        return {};
    }
    [[nodiscard]] bool works() const noexcept { return passes_ != nullptr && !size().empty(); }

    void add(bool bounds, gl::surface s) noexcept {
        s.where = clip(s.where, size());
        if (!bounds) mark(s.where, {saturate(s.depth), saturate(s.depth)});
        if (s.where.empty() || !works()) return;
        if (bounds != pending_bounds_ || static_cast<int>(pending_.size()) == gl::rectangle_list::capacity) flush();
        pending_bounds_ = bounds;
        pending_.push_back(s);
    }
    void flush() noexcept {
        if (pending_.empty()) return;
        const gl::state_guard<Policy> forced(run_.context());
        const auto walk = [this](auto&& f) {
            for (const gl::surface& each : pending_) f(each);
        };
        if constexpr (Texel::effects.far_bound)
            if (pending_bounds_) passes_->bound(run_.context(), targets(), walk);
        if (!pending_bounds_) passes_->cast(run_.context(), targets(), walk);
        pending_.clear();
    }
    void read_back() const noexcept {
        if (is_read_ || !works()) return;
        const gl::state_guard<Policy> forced(run_.context());
        reader_.read(run_.context(), targets().into_soft, read_.view(), whole(size()));
        is_read_ = true;
    }

    backend_type run_;
    std::shared_ptr<gl::passes<Texel, Kernel>> passes_{};
    gl::map_textures textures_{};
    gl::problem problem_{};
    depth_tiles tiles_;
    tile_grid filtered_;
    std::vector<gl::surface> pending_{};
    bool pending_bounds_ = false;
    mutable image<Texel> read_;
    mutable gl::texel_reader<Texel> reader_;
    mutable bool is_read_ = true; // clear, as the texture is
};

} // namespace gnomon::inline GNOMON_BUILD
