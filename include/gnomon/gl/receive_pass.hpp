// gnomon: soft shadow maps. The decision as a pass: a shadow mask out of depths, on texels of the map, at points, or on the screen.
#pragma once

#include <gnomon/gl/pass_program.hpp>
#include <gnomon/gl/pass_state.hpp>
#include <gnomon/gl/rectangles.hpp>

#include <string>
#include <utility>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// Where intensities go: the first channel of a framebuffer's first colour. The others stay as they are.
struct mask_target {
    unsigned framebuffer = 0;
    extent size = {};
};

/// What receivers are one to one with.
enum class receivers {
    texels, ///< texels of the map: a texture as large as the map, unit depth in its first channel
    points, ///< points of the map: a texture of x and y in texels, and unit depth
    screen, ///< pixels of a camera: its depth texture, and a matrix that takes it to the map
};

/// Draws shadow masks, for maps of one texel. Compiled in `make`, and nothing after it allocates. \pre of its passes: a state_guard lives
///
/// Receivers are decided as by the scalar functions; receive_text says where in every bit. What is read is `target.size` texels of the
/// receivers' texture, one for each pixel; all textures are read texel by texel, so their filters do not matter.
template <texel_format Texel> class receive_pass {
  public:
    /// Owns nothing, and must not be drawn with.
    receive_pass() = default;

    [[nodiscard]] static result<receive_pass> make(const context& c, receivers of) {
        const char* const texture_of = of == receivers::points ? "gnomon_points" : "gnomon_depths";
        const std::string_view main = of == receivers::texels   ? receive_texels_main_text
                                      : of == receivers::points ? receive_points_main_text
                                                                : receive_screen_main_text;
        return make(c, std::string(main), texture_of);
    }
    /// The same with a main of the caller's, after receive_text<Texel>: sampler2D `gnomon_map`, and another by the name given.
    [[nodiscard]] static result<receive_pass> make(const context& c, const std::string& main, const char* receivers_texture) {
        const state_guard<state_policy::restore> kept(c);
        result<rectangle_list> list = rectangle_list::make(c);
        if (!list) return list.error();
        result<pass_program> linked =
            pass_program::make(c, rectangles_vertex_text, receive_text<Texel>(shader_rule<Texel>::uniforms()) + main,
                               {"gnomon_map", receivers_texture});
        if (!linked) return linked.error();
        receive_pass made;
        made.rectangles_ = *std::move(list);
        made.program_ = *std::move(linked);
        const auto at = [&made, &c](const char* uniform) { return made.program_.location(c, uniform); };
        made.at_ = {.caster_bias = at("gnomon_caster_bias"),
                    .caster_nearer = at("gnomon_caster_nearer"),
                    .lit_beyond = at("gnomon_lit_beyond"),
                    .bound_bias = at("gnomon_bound_bias"),
                    .bound_nearer = at("gnomon_bound_nearer"),
                    .fade = at("gnomon_fade"),
                    .to_map = at("gnomon_to_map")};
        return made;
    }

    /// The mask for a map's soft texture and the receivers' texture.
    void draw(const context& c, const mask_target& target, unsigned soft, unsigned receivers_texture, const rule& by) {
        begin_pass(c, {.framebuffer = target.framebuffer, .size = target.size, .channel = 0});
        program_.use(c, target.size);
        set(c, by);
        bind_textures(c, {soft, receivers_texture});
        rectangles_.draw(c, [&target](auto&& f) { f(whole(target.size)); });
    }
    /// The same for the screen. `to_map`, column after column, takes (x, y, depth, 1), x and y in pixels of the target and the depth
    /// as its texture holds it, to x and y in texels of the map and unit depth, each times w.
    void draw(const context& c, const mask_target& target, unsigned soft, unsigned depths, const rule& by,
              const float (&to_map)[16]) {
        program_.use(c, target.size);
        c.gl->UniformMatrix4fv(at_.to_map, 1, 0, to_map);
        draw(c, target, soft, depths, by);
    }

    void forget() noexcept {
        rectangles_.forget();
        program_.forget();
    }

  private:
    /// Where uniforms are; -1 of those that the shader has not, which GL ignores.
    struct places {
        int caster_bias, caster_nearer, lit_beyond, bound_bias, bound_nearer, fade, to_map;
    };
    void set(const context& c, const rule& by) const {
        const auto set_bias = [&c](int bias_at, int nearer_at, const bias& b) {
            const auto steps = bias_steps<Texel, float>::of(b);
            c.gl->Uniform4f(bias_at, steps.depth_less, steps.depth_share, steps.mask_more, steps.mask_share);
            c.gl->Uniform1f(nearer_at, steps.nearer);
        };
        set_bias(at_.caster_bias, at_.caster_nearer, by.caster);
        c.gl->Uniform1i(at_.lit_beyond, by.lit_beyond);
        if constexpr (Texel::effects.far_bound) {
            set_bias(at_.bound_bias, at_.bound_nearer, by.far_bound);
            c.gl->Uniform1f(at_.fade, by.fade);
        }
    }

    rectangle_list rectangles_;
    pass_program program_;
    places at_ = {};
};

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
