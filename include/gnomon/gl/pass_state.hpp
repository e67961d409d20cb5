// gnomon: soft shadow maps. What one pass wants other than a state guard leaves it: where it draws, and how depths and colours meet.
#pragma once

#include <gnomon/gl/state.hpp>
#include <gnomon/rect.hpp>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// What becomes of a fragment's depth. Depths are as gnomon_caster writes them: more is nearer to the light, and 0 is nothing.
enum class depth_use {
    none,              ///< neither tested nor written
    overwritten,       ///< written, whatever was there
    nearest_stays,     ///< written, if it is nearer than what is there: casters
    not_before_stored, ///< not written; a fragment passes unless it is nearer than what is there: far bounds
};

/// State of a pass.
struct pass_state {
    unsigned framebuffer = 0;
    extent size = {}; ///< of its textures, and of the viewport
    depth_use depth = depth_use::none;
    int channel = -1;     ///< the only one that is written; -1: all
    bool maximum = false; ///< what is written is the larger of old and new
    unsigned culled = 0;  ///< GL_FRONT or GL_BACK; 0: neither
};

/// Sets all of it, so that passes may follow each other under one guard. What lies before the light's near plane still casts, where a
/// context has depth clamping. \pre a state_guard lives
inline void begin_pass(const context& c, const pass_state& s) noexcept {
    const functions& gl = *c.gl;
    gl.BindFramebuffer(enums::framebuffer, s.framebuffer);
    gl.Viewport(0, 0, s.size.width, s.size.height);

    detail::set_switch(gl, enums::depth_test, s.depth != depth_use::none);
    gl.DepthFunc(s.depth == depth_use::nearest_stays ? enums::greater
                                                     : (s.depth == depth_use::not_before_stored ? enums::lequal : enums::always));
    gl.DepthMask(s.depth == depth_use::not_before_stored ? 0 : 1);
    if (c.depth_clamp) detail::set_switch(gl, enums::depth_clamp, s.depth != depth_use::none);

    const auto writes = [&s](int channel) { return static_cast<unsigned char>(s.channel < 0 || s.channel == channel ? 1 : 0); };
    gl.ColorMask(writes(0), writes(1), writes(2), writes(3));
    detail::set_switch(gl, enums::blend, s.maximum);
    gl.BlendEquation(s.maximum ? enums::blend_max : enums::func_add);

    detail::set_switch(gl, enums::cull_face, s.culled != 0);
    if (s.culled != 0) gl.CullFace(s.culled);
}

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
