// gnomon: soft shadow maps. The passes: clear, cast, bound, blur columns, blur rows; each over rectangles, or around an engine's draws.
#pragma once

#include <gnomon/gl/map_textures.hpp>
#include <gnomon/gl/pass_program.hpp>
#include <gnomon/gl/rectangles.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// What an engine's draws of casters need, set: the framebuffer, its viewport, and the state. After it, draw with programs
/// whose fragment stage ends in gnomon_caster (see caster_text); the nearest surface stays, by its stored depth. Culling is off.
inline void begin_casters(const context& c, const map_targets& map) {
    begin_pass(c, {.framebuffer = map.into_casters, .size = map.size, .depth = depth_use::nearest_stays});
}

/// Which side of a receiver's surfaces bounds, seen from the light. `averted` is what Salzman 2007 advises: what faces away.
enum class faces_drawn { both, facing, averted };

/// The same for receivers that bound, whose fragment stage ends in gnomon_bound: after all casters, over the same depths.
/// Only the far channel is written. `front` is what the engine's matrices make counter-clockwise seen from the light.
template <texel_format Texel>
    requires(Texel::effects.far_bound)
void begin_bounds(const context& c, const map_targets& map, faces_drawn drawn = faces_drawn::both) {
    begin_pass(c, {.framebuffer = map.into_casters,
                   .size = map.size,
                   .depth = depth_use::not_before_stored,
                   .channel = Texel::far_index,
                   .maximum = true,
                   .culled = drawn == faces_drawn::both     ? 0u
                             : drawn == faces_drawn::facing ? enums::back_face
                                                            : enums::front});
}

/// The programs of one texel and kernel, and the passes that use them. Compiled in `make`, and nothing after it allocates.
///
/// Passes are over what walk(f) hands to f(texel_rect) or, of casters and bounds, f(surface); each at most once and clipped to the map.
/// \pre of every pass: a state_guard lives
template <texel_format Texel, kernel Kernel> class passes {
  public:
    using texel_type = Texel;
    using kernel_type = Kernel;

    /// Owns nothing, and must not be drawn with.
    passes() = default;

    /// The problem: a texel that the context does not support, or what the driver says to a shader.
    [[nodiscard]] static result<passes> make(const context& c) {
        if (problem why = supports<Texel>(c)) return why;
        const state_guard<state_policy::restore> kept(c);
        passes made;
        if (problem why = made.make_all(c)) return why;
        return made;
    }

    /// Forgets casters: their colours, and that any surface was there.
    template <typename Walk> void clear_casters(const context& c, const map_targets& map, Walk&& walk) {
        begin_pass(c, {.framebuffer = map.into_casters, .size = map.size, .depth = depth_use::overwritten});
        clear_.use(c, map.size);
        rectangles_.draw(c, walk);
    }
    template <typename Walk> void clear_soft(const context& c, const map_targets& map, Walk&& walk) {
        begin_pass(c, {.framebuffer = map.into_soft, .size = map.size});
        clear_.use(c, map.size);
        rectangles_.draw(c, walk);
    }

    /// Casts rectangles, the nearest on top.
    template <typename Walk> void cast(const context& c, const map_targets& map, Walk&& walk) {
        begin_casters(c, map);
        cast_.use(c, map.size);
        rectangles_.draw(c, walk);
    }
    /// Bounds the shadows of what was cast.
    template <typename Walk>
        requires(Texel::effects.far_bound)
    void bound(const context& c, const map_targets& map, Walk&& walk) {
        begin_bounds<Texel>(c, map);
        bound_.use(c, map.size);
        rectangles_.draw(c, walk);
    }

    /// The first pass: column sums of casters into the scratch, over each rectangle and R columns beside it, which the second reads.
    template <typename Walk>
    void blur_columns(const context& c, const map_targets& map, Walk&& walk, rectangles_by way = rectangles_by::instances) {
        begin_pass(c, {.framebuffer = map.into_scratch, .size = map.size});
        columns_.use(c, map.size);
        bind_textures(c, {map.casters});
        rectangles_.draw(c, way, map.size, [&](auto&& f) {
            walk([&](texel_rect r) { f(clip({r.x0 - Kernel::radius, r.y0, r.x1 + Kernel::radius, r.y1}, map.size)); });
        });
    }
    /// The second pass: rows of sums into the soft map.
    template <typename Walk>
    void blur_rows(const context& c, const map_targets& map, Walk&& walk, rectangles_by way = rectangles_by::instances) {
        begin_pass(c, {.framebuffer = map.into_soft, .size = map.size});
        rows_.use(c, map.size);
        bind_textures(c, {map.scratch});
        rectangles_.draw(c, way, map.size, walk);
    }
    /// Both. The scratch is trusted for nothing: each texel that is read of it was written by the same call.
    template <typename Walk>
    void filter(const context& c, const map_targets& map, Walk&& walk, rectangles_by way = rectangles_by::instances) {
        blur_columns(c, map, walk, way);
        blur_rows(c, map, walk, way);
    }

    /// What the scratch of a map for these passes is.
    [[nodiscard]] static const format& scratch() noexcept {
        constexpr std::uint32_t largest = filter_scratch_largest<Texel, Kernel>;
        return largest == 0 ? format_of<Texel> : scratch_format(Texel::channels, largest);
    }

    void forget() noexcept {
        for (pass_program* each : {&clear_, &cast_, &bound_, &columns_, &rows_}) each->forget();
        rectangles_.forget();
    }

  private:
    [[nodiscard]] problem make_all(const context& c) {
        result<rectangle_list> list = rectangle_list::make(c);
        if (!list) return list.error();
        rectangles_ = *std::move(list);
        problem why;
        const auto take = [&](pass_program& into, std::string_view vertex, const std::string& fragment, auto... samplers) {
            result<pass_program> one = pass_program::make(c, vertex, fragment, {samplers...});
            if (one) into = *std::move(one);
            why = one.error();
            return !why;
        };
        bool all = take(clear_, rectangles_vertex_text, clear_text()) &&
                   take(cast_, surfaces_vertex_text, caster_rectangles_text<Texel>()) &&
                   take(columns_, rectangles_vertex_text, filter_columns_text<Texel, Kernel>(), "gnomon_texels") &&
                   take(rows_, rectangles_vertex_text, filter_rows_text<Texel, Kernel>(), "gnomon_sums");
        if constexpr (Texel::effects.far_bound) all = all && take(bound_, surfaces_vertex_text, bound_rectangles_text<Texel>());
        return all ? problem{} : why;
    }
    [[nodiscard]] static std::string clear_text() {
        return "// gnomon: clear\nlayout(location = 0) out vec4 gnomon_texel;\n\nvoid main() {\n    gl_FragDepth = 0.0;\n    "
               "gnomon_texel = vec4(0.0);\n}\n";
    }
    pass_program clear_, cast_, bound_, columns_, rows_;
    rectangle_list rectangles_;
};

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
