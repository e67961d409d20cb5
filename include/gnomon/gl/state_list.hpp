// gnomon: soft shadow maps. Which switches and pixel stores of a context can spoil a pass: the list that is forced, and saved.
#pragma once

#include <gnomon/gl/context.hpp>

namespace gnomon::inline GNOMON_BUILD {
namespace gl::detail {

/// Calls f(what) for everything that Enable takes, may be on, and has to be off; but for blending and the scissor test, which
/// have one switch for each draw buffer and each viewport.
template <typename F> void for_each_switch(const context& c, F&& f) {
    for (const unsigned what :
         {enums::cull_face, enums::depth_test, enums::dither, enums::polygon_offset_fill, enums::rasterizer_discard,
          enums::sample_alpha_to_coverage, enums::sample_coverage, enums::stencil_test})
        f(what);
    if (!c.es)
        for (const unsigned what : {enums::color_logic_op, enums::framebuffer_srgb, enums::polygon_smooth, enums::primitive_restart,
                                    enums::sample_alpha_to_one})
            f(what);
    if (c.since(33, 31)) f(enums::sample_mask);
    if (c.depth_clamp) f(enums::depth_clamp);
    for (int i = 0; i < c.max_clip_distances; ++i) f(enums::clip_distance0 + static_cast<unsigned>(i));
}

/// Calls f(name, value) for how a pass wants its texels to lie in the host's memory: row after row, nothing between.
template <typename F> void for_each_pixel_store(const context& c, F&& f) {
    for (const unsigned name : {enums::unpack_alignment, enums::pack_alignment}) f(name, 1);
    for (const unsigned name : {enums::unpack_row_length, enums::unpack_skip_rows, enums::unpack_skip_pixels,
                                enums::pack_row_length, enums::pack_skip_rows, enums::pack_skip_pixels})
        f(name, 0);
    if (!c.es)
        for (const unsigned name :
             {enums::unpack_swap_bytes, enums::unpack_lsb_first, enums::pack_swap_bytes, enums::pack_lsb_first})
            f(name, 0);
}

inline void set_switch(const functions& gl, unsigned what, bool on) noexcept { on ? gl.Enable(what) : gl.Disable(what); }
inline void set_switch(const functions& gl, unsigned what, unsigned index, bool on) noexcept {
    on ? gl.Enablei(what, index) : gl.Disablei(what, index);
}

inline void set_clip_control(const context& c, unsigned origin, unsigned depth) noexcept {
    if (c.clip_control == clip_control::core) c.gl->ClipControl(origin, depth);
    if (c.clip_control == clip_control::ext) c.gl->ClipControlEXT(origin, depth);
}

} // namespace gl::detail
} // namespace gnomon::inline GNOMON_BUILD
