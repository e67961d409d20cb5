// gnomon: soft shadow maps. In whatever state the host left its context, a pass starts from one that is known; and may leave it as found.
#pragma once

#include <gnomon/gl/saved_state.hpp>

#include <type_traits>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// What becomes of the host's state.
///
/// `dirty`, the default, is for hosts that track their state, as engines do: nothing is asked of GL, nothing put back. Touched are
///     draw and read framebuffer, program, vertex array, the buffers ARRAY, PIXEL_PACK and PIXEL_UNPACK, the active texture unit,
///     TEXTURE_2D and sampler of the first units, pixel store but for its 3D part;
///     viewport, scissor box, depth range, color mask, blend switch, function and equation, of every index; depth function and mask,
///     cull and front face, polygon mode, clip control;
///     and off are BLEND, CULL_FACE, DEPTH_TEST, DITHER, POLYGON_OFFSET_FILL, RASTERIZER_DISCARD, SAMPLE_ALPHA_TO_COVERAGE,
///     SAMPLE_COVERAGE, SAMPLE_MASK, SCISSOR_TEST, STENCIL_TEST; on desktop also COLOR_LOGIC_OP, FRAMEBUFFER_SRGB, POLYGON_SMOOTH,
///     PRIMITIVE_RESTART, SAMPLE_ALPHA_TO_ONE; and where a context has them DEPTH_CLAMP and CLIP_DISTANCEi.
///
/// `dirty` makes 33 calls in OpenGL ES 3.0 and 54 in GL 4.5. `restore` asks for all that first, and puts it back, bit for bit: 49 glGets
/// and 52 more calls in ES 3.0, 187 and 161 in GL 4.5 with its sixteen viewports; 0.25 and 2.1 us on llvmpipe. And it makes a driver
/// that works in another thread wait. Two things cannot be had back: a program, and an object in another context's keeping, that was
/// deleted while it was in use; and the indexed state of OES_draw_buffers_indexed, OES_viewport_array and ARB_draw_buffers_blend, which
/// comes back as that of index 0.
///
/// With both the host sees to it that no conditional rendering is going on and that no query counts what is drawn; with `dirty`, or in
/// GL 3.3, also that transform feedback is inactive or paused. GL has no call that ends these if they are there, and few to ask.
/// Error flags are read where something is made (gl/object.hpp).
enum class state_policy { dirty, restore };

namespace detail {

struct saved_nothing {
    saved_nothing(const context&, int) noexcept {}
};

/// What a new context starts with, but no dither, texels packed byte by byte, and no sampler on the units.
inline void force_state(const context& c, int units) noexcept {
    const functions& gl = *c.gl;
    for_each_switch(c, [&](unsigned what) { gl.Disable(what); });
    gl.Disable(enums::blend);
    gl.Disable(enums::scissor_test);
    gl.BlendEquation(enums::func_add);
    gl.BlendFunc(enums::one, enums::zero);
    gl.ColorMask(1, 1, 1, 1);
    gl.DepthFunc(enums::less);
    gl.DepthMask(1);
    c.es ? gl.DepthRangef(0.0f, 1.0f) : gl.DepthRange(0.0, 1.0);
    gl.CullFace(enums::back_face);
    gl.FrontFace(enums::counter_clockwise);
    if (!c.es) gl.PolygonMode(enums::front_and_back, enums::fill);
    set_clip_control(c, enums::lower_left, enums::negative_one_to_one);
    gl.BindBuffer(enums::pixel_pack_buffer, 0);
    gl.BindBuffer(enums::pixel_unpack_buffer, 0);
    for_each_pixel_store(c, [&](unsigned name, int value) { gl.PixelStorei(name, value); });
    for (int i = 0; i < units; ++i) gl.BindSampler(static_cast<unsigned>(i), 0);
    gl.ActiveTexture(enums::texture0);
}

} // namespace detail

/// While it lives, the state is ours: known when it is made, the host's again, as far as the policy says, when it goes.
///
///     const gl::state_guard guard(context);                                  // dirty
///     const gl::state_guard<gl::state_policy::restore> guard(context, 2);    // draws may use texture units 0 and 1
///
/// Sets what `dirty` lists, framebuffers, program, vertex array, viewport, scissor box and textures excepted: a pass sets these itself.
/// \pre the context is current, and units <= 8
template <state_policy Policy = state_policy::dirty> class [[nodiscard]] state_guard {
  public:
    static constexpr int most_units = detail::saved_units::most;

    explicit state_guard(const context& c, int units = 4) noexcept : saved_(c, units) {
        GNOMON_ASSERT(units >= 0 && units <= most_units, "gnomon: a state guard keeps at most eight texture units");
        detail::force_state(c, lesser(units, most_units));
    }

    state_guard(const state_guard&) = delete;
    state_guard& operator=(const state_guard&) = delete;

  private:
    std::conditional_t<Policy == state_policy::restore, detail::saved_state, detail::saved_nothing> saved_;
};
state_guard(const context&) -> state_guard<>;
state_guard(const context&, int) -> state_guard<>;

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
