// gnomon: soft shadow maps. What state_policy::restore remembers of a context, and puts back.
#pragma once

#include <gnomon/gl/state_list.hpp>
#include <gnomon/unit.hpp>

#include <cstddef>

namespace gnomon::inline GNOMON_BUILD {
namespace gl::detail {

/// Texture and sampler of a unit, for the units that passes use.
class saved_units {
  public:
    static constexpr int most = 8;

    saved_units(const context& c, int units) noexcept
        : count_(lesser(units, most)), active_(integer(*c.gl, enums::active_texture)) {
        for (int i = 0; i < count_; ++i) {
            c.gl->ActiveTexture(enums::texture0 + static_cast<unsigned>(i));
            textures_[i] = integer(*c.gl, enums::texture_binding_2d);
            samplers_[i] = integer(*c.gl, enums::sampler_binding);
        }
    }
    void restore(const context& c) const noexcept {
        for (int i = 0; i < count_; ++i) {
            c.gl->ActiveTexture(enums::texture0 + static_cast<unsigned>(i));
            c.gl->BindTexture(enums::texture_2d, static_cast<unsigned>(textures_[i]));
            c.gl->BindSampler(static_cast<unsigned>(i), static_cast<unsigned>(samplers_[i]));
        }
        c.gl->ActiveTexture(static_cast<unsigned>(active_));
    }

  private:
    int count_;
    int active_;
    int textures_[most] = {};
    int samplers_[most] = {};
};

/// What is bound, and how texels lie in memory.
class saved_bindings {
  public:
    explicit saved_bindings(const context& c) noexcept {
        for (int i = 0; i < bindings; ++i) bound_[i] = integer(*c.gl, names[i]);
        int* value = stores_;
        for_each_pixel_store(c, [&](unsigned name, int) { c.gl->GetIntegerv(name, value++); });
    }
    void restore(const context& c) const noexcept {
        const auto bound = [this](int i) { return static_cast<unsigned>(bound_[i]); };
        c.gl->UseProgram(bound(0));
        c.gl->BindVertexArray(bound(1));
        c.gl->BindFramebuffer(enums::draw_framebuffer, bound(2));
        c.gl->BindFramebuffer(enums::read_framebuffer, bound(3));
        c.gl->BindBuffer(enums::array_buffer, bound(4));
        c.gl->BindBuffer(enums::pixel_pack_buffer, bound(5));
        c.gl->BindBuffer(enums::pixel_unpack_buffer, bound(6));
        const int* value = stores_;
        for_each_pixel_store(c, [&](unsigned name, int) { c.gl->PixelStorei(name, *value++); });
    }

  private:
    static constexpr int bindings = 7;
    static constexpr unsigned names[bindings] = {enums::current_program,
                                                 enums::vertex_array_binding,
                                                 enums::draw_framebuffer_binding,
                                                 enums::read_framebuffer_binding,
                                                 enums::array_buffer_binding,
                                                 enums::pixel_pack_buffer_binding,
                                                 enums::pixel_unpack_buffer_binding};
    int bound_[bindings] = {};
    int stores_[12] = {};
};

/// Color mask and blending of every draw buffer that can have its own.
class saved_outputs {
  public:
    explicit saved_outputs(const context& c) noexcept : count_(lesser(c.max_draw_buffers, most)) {
        const functions& gl = *c.gl;
        const bool blend_indexed = c.since(40, 32);
        for (int i = 0; i < count_; ++i) {
            output& o = outputs_[i];
            const auto index = static_cast<unsigned>(i);
            o.blend = (count_ > 1 ? gl.IsEnabledi(enums::blend, index) : gl.IsEnabled(enums::blend)) != 0;
            if (count_ > 1)
                gl.GetBooleani_v(enums::color_writemask, index, o.mask);
            else
                gl.GetBooleanv(enums::color_writemask, o.mask);
            for (int k = 0; k < numbers; ++k)
                blend_indexed ? gl.GetIntegeri_v(names[k], index, &o.blending[k]) : gl.GetIntegerv(names[k], &o.blending[k]);
        }
    }
    void restore(const context& c) const noexcept {
        const functions& gl = *c.gl;
        for (int i = 0; i < count_; ++i) {
            const output& o = outputs_[i];
            const auto index = static_cast<unsigned>(i);
            const auto b = [&](int k) { return static_cast<unsigned>(o.blending[k]); };
            if (count_ > 1) {
                set_switch(gl, enums::blend, index, o.blend);
                gl.ColorMaski(index, o.mask[0], o.mask[1], o.mask[2], o.mask[3]);
            } else {
                set_switch(gl, enums::blend, o.blend);
                gl.ColorMask(o.mask[0], o.mask[1], o.mask[2], o.mask[3]);
            }
            if (c.since(40, 32)) {
                gl.BlendFuncSeparatei(index, b(0), b(1), b(2), b(3));
                gl.BlendEquationSeparatei(index, b(4), b(5));
            } else {
                gl.BlendFuncSeparate(b(0), b(1), b(2), b(3));
                gl.BlendEquationSeparate(b(4), b(5));
            }
        }
    }

  private:
    static constexpr int most = 16, numbers = 6;
    static constexpr unsigned names[numbers] = {enums::blend_src_rgb,   enums::blend_dst_rgb,      enums::blend_src_alpha,
                                                enums::blend_dst_alpha, enums::blend_equation_rgb, enums::blend_equation_alpha};
    struct output {
        bool blend = {};
        unsigned char mask[4] = {};
        int blending[numbers] = {};
    };
    int count_;
    output outputs_[most] = {};
};

/// Viewport, scissor and depth range: one, or the array of them that a single call sets all of.
class saved_viewports {
  public:
    explicit saved_viewports(const context& c) noexcept : count_(lesser(c.max_viewports, most)) {
        const functions& gl = *c.gl;
        if (count_ <= 1) {
            only_.scissor_test = gl.IsEnabled(enums::scissor_test) != 0;
            gl.GetIntegerv(enums::viewport, only_viewport_);
            gl.GetIntegerv(enums::scissor_box, only_.scissor);
            c.es ? gl.GetFloatv(enums::depth_range, only_range_) : gl.GetDoublev(enums::depth_range, only_.range);
        }
        for (int i = 0; count_ > 1 && i < count_; ++i) {
            const auto index = static_cast<unsigned>(i);
            all_[i].scissor_test = gl.IsEnabledi(enums::scissor_test, index) != 0;
            gl.GetFloati_v(enums::viewport, index, all_[i].viewport);
            gl.GetIntegeri_v(enums::scissor_box, index, all_[i].scissor);
            gl.GetDoublei_v(enums::depth_range, index, all_[i].range);
        }
    }
    void restore(const context& c) const noexcept {
        const functions& gl = *c.gl;
        if (count_ <= 1) {
            set_switch(gl, enums::scissor_test, only_.scissor_test);
            gl.Viewport(only_viewport_[0], only_viewport_[1], only_viewport_[2], only_viewport_[3]);
            gl.Scissor(only_.scissor[0], only_.scissor[1], only_.scissor[2], only_.scissor[3]);
            c.es ? gl.DepthRangef(only_range_[0], only_range_[1]) : gl.DepthRange(only_.range[0], only_.range[1]);
        }
        for (int i = 0; count_ > 1 && i < count_; ++i) {
            const auto index = static_cast<unsigned>(i);
            const one& v = all_[i];
            set_switch(gl, enums::scissor_test, index, v.scissor_test);
            gl.ViewportIndexedf(index, v.viewport[0], v.viewport[1], v.viewport[2], v.viewport[3]);
            gl.ScissorIndexed(index, v.scissor[0], v.scissor[1], v.scissor[2], v.scissor[3]);
            gl.DepthRangeIndexed(index, v.range[0], v.range[1]);
        }
    }

  private:
    static constexpr int most = 16;
    struct one {
        bool scissor_test = {};
        float viewport[4] = {};
        int scissor[4] = {};
        double range[2] = {};
    };
    int count_;
    one only_ = {};
    int only_viewport_[4] = {};
    float only_range_[2] = {};
    one all_[most] = {};
};

/// Switches, and how fragments come about and are tested.
class saved_raster {
  public:
    explicit saved_raster(const context& c) noexcept {
        const functions& gl = *c.gl;
        bool* on = switches_;
        for_each_switch(c, [&](unsigned what) {
            if (on != switches_ + most) *on++ = gl.IsEnabled(what) != 0;
        });
        for (int i = 0; i < numbers; ++i) numbers_[i] = integer(gl, names[i]);
        if (!c.es) gl.GetIntegerv(enums::polygon_mode, polygon_modes_);
        if (c.clip_control != clip_control::none) {
            clip_[0] = integer(gl, enums::clip_origin);
            clip_[1] = integer(gl, enums::clip_depth_mode);
        }
    }
    void restore(const context& c) const noexcept {
        const functions& gl = *c.gl;
        const bool* on = switches_;
        for_each_switch(c, [&](unsigned what) {
            if (on != switches_ + most) set_switch(gl, what, *on++);
        });
        gl.DepthFunc(static_cast<unsigned>(numbers_[0]));
        gl.DepthMask(numbers_[1] != 0);
        gl.CullFace(static_cast<unsigned>(numbers_[2]));
        gl.FrontFace(static_cast<unsigned>(numbers_[3]));
        if (!c.es) restore_polygon_modes(gl);
        set_clip_control(c, static_cast<unsigned>(clip_[0]), static_cast<unsigned>(clip_[1]));
    }

  private:
    /// A core profile has one mode for both faces, and may answer with that alone.
    void restore_polygon_modes(const functions& gl) const noexcept {
        const auto first = static_cast<unsigned>(polygon_modes_[0]), second = static_cast<unsigned>(polygon_modes_[1]);
        if (second == 0 || second == first) return gl.PolygonMode(enums::front_and_back, first);
        gl.PolygonMode(enums::front, first);
        gl.PolygonMode(enums::back_face, second);
    }

    static constexpr int most = 40, numbers = 4; // 15 switches, and a clip distance each
    static constexpr unsigned names[numbers] = {enums::depth_func, enums::depth_writemask, enums::cull_face_mode,
                                                enums::front_face};
    bool switches_[most] = {};
    int polygon_modes_[2] = {};
    int clip_[2] = {};
    int numbers_[numbers] = {};
};

/// Transform feedback that is active would record our vertices, and forbids another program: it is paused meanwhile.
class paused_feedback {
  public:
    explicit paused_feedback(const context& c) noexcept {
        if (!c.since(40, 30)) return;
        paused_ = integer(*c.gl, enums::transform_feedback_active) != 0 && integer(*c.gl, enums::transform_feedback_paused) == 0;
        if (paused_) c.gl->PauseTransformFeedback();
    }
    /// After the program that it records is back.
    void restore(const context& c) const noexcept {
        if (paused_) c.gl->ResumeTransformFeedback();
    }

  private:
    bool paused_ = false;
};

/// All of it: found when made, back when it goes.
class saved_state {
  public:
    saved_state(const context& c, int units) noexcept
        : context_(c), feedback_(c), units_(c, units), bindings_(c), outputs_(c), viewports_(c), raster_(c) {}
    ~saved_state() {
        raster_.restore(context_);
        viewports_.restore(context_);
        outputs_.restore(context_);
        bindings_.restore(context_);
        units_.restore(context_);
        feedback_.restore(context_);
    }
    saved_state(const saved_state&) = delete;
    saved_state& operator=(const saved_state&) = delete;

  private:
    context context_;
    paused_feedback feedback_;
    saved_units units_;
    saved_bindings bindings_;
    saved_outputs outputs_;
    saved_viewports viewports_;
    saved_raster raster_;
};

} // namespace gl::detail
} // namespace gnomon::inline GNOMON_BUILD
