// The state of a context as numbers that can be compared, and a host that leaves none of it as a pass would have it.
#pragma once

#include <gnomon/gl/context.hpp>
#include <gnomon/gl/object.hpp>

#include "dice.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace test {

namespace enums = gnomon::gl::enums;

/// Every number that a context answers with, by the constant's value and the index, for what passes may come near. Written apart from
/// gl/saved_state.hpp, and asking for more. Leaves the active texture unit as found.
inline std::map<std::string, double> state_of(const gnomon::gl::context& c, int units) {
    const gnomon::gl::functions& gl = *c.gl;
    std::map<std::string, double> seen;
    const auto note = [&](const char* what, unsigned index, const auto* numbers, int count) {
        for (int i = 0; i < count; ++i)
            seen[std::string(what) + ' ' + std::to_string(index) + ' ' + std::to_string(i)] = static_cast<double>(numbers[i]);
    };
    const auto integer = [&](const char* what, unsigned name) {
        int value[4] = {};
        gl.GetIntegerv(name, value);
        note(what, 0, value, 1);
    };
    const auto enabled = [&](const char* what, unsigned name) {
        const int on = gl.IsEnabled(name);
        note(what, 0, &on, 1);
    };

    integer("active texture", enums::active_texture);
    const double active = seen["active texture 0 0"];
    for (int i = 0; i < units; ++i) {
        gl.ActiveTexture(enums::texture0 + static_cast<unsigned>(i));
        for (const auto& [what, name] : {std::pair{"texture", enums::texture_binding_2d}, {"sampler", enums::sampler_binding}}) {
            int value = 0;
            gl.GetIntegerv(name, &value);
            note(what, static_cast<unsigned>(i), &value, 1);
        }
    }
    gl.ActiveTexture(static_cast<unsigned>(active));

    for (const auto& [what, name] : {std::pair{"program", enums::current_program},
                                     {"vertex array", enums::vertex_array_binding},
                                     {"draw framebuffer", enums::draw_framebuffer_binding},
                                     {"read framebuffer", enums::read_framebuffer_binding},
                                     {"array buffer", enums::array_buffer_binding},
                                     {"pack buffer", enums::pixel_pack_buffer_binding},
                                     {"unpack buffer", enums::pixel_unpack_buffer_binding},
                                     {"unpack alignment", enums::unpack_alignment},
                                     {"unpack row length", enums::unpack_row_length},
                                     {"unpack skip rows", enums::unpack_skip_rows},
                                     {"unpack skip pixels", enums::unpack_skip_pixels},
                                     {"pack alignment", enums::pack_alignment},
                                     {"pack row length", enums::pack_row_length},
                                     {"pack skip rows", enums::pack_skip_rows},
                                     {"pack skip pixels", enums::pack_skip_pixels},
                                     {"depth function", enums::depth_func},
                                     {"depth mask", enums::depth_writemask},
                                     {"cull face mode", enums::cull_face_mode},
                                     {"front face", enums::front_face}})
        integer(what, name);
    for (const auto& [what, name] : {std::pair{"cull face", enums::cull_face},
                                     {"depth test", enums::depth_test},
                                     {"dither", enums::dither},
                                     {"polygon offset", enums::polygon_offset_fill},
                                     {"rasterizer discard", enums::rasterizer_discard},
                                     {"alpha to coverage", enums::sample_alpha_to_coverage},
                                     {"sample coverage", enums::sample_coverage},
                                     {"stencil test", enums::stencil_test}})
        enabled(what, name);
    if (!c.es) {
        for (const auto& [what, name] : {std::pair{"swap bytes", enums::unpack_swap_bytes},
                                         {"lsb first", enums::unpack_lsb_first},
                                         {"pack swap bytes", enums::pack_swap_bytes},
                                         {"pack lsb first", enums::pack_lsb_first}})
            integer(what, name);
        for (const auto& [what, name] : {std::pair{"logic op", enums::color_logic_op},
                                         {"srgb", enums::framebuffer_srgb},
                                         {"polygon smooth", enums::polygon_smooth},
                                         {"primitive restart", enums::primitive_restart},
                                         {"alpha to one", enums::sample_alpha_to_one}})
            enabled(what, name);
        int modes[2] = {};
        gl.GetIntegerv(enums::polygon_mode, modes);
        note("polygon mode", 0, modes, 2);
    }
    if (c.depth_clamp) enabled("depth clamp", enums::depth_clamp);
    for (int i = 0; i < c.max_clip_distances; ++i)
        enabled(("clip distance " + std::to_string(i)).c_str(), enums::clip_distance0 + static_cast<unsigned>(i));
    if (c.since(33, 31)) enabled("sample mask", enums::sample_mask);
    if (c.clip_control != gnomon::gl::clip_control::none) {
        integer("clip origin", enums::clip_origin);
        integer("clip depth", enums::clip_depth_mode);
    }
    if (c.since(40, 30)) {
        integer("feedback active", enums::transform_feedback_active);
        integer("feedback paused", enums::transform_feedback_paused);
    }

    for (unsigned i = 0; i < (c.since(33, 32) ? 8u : 1u); ++i) {
        unsigned char mask[4] = {};
        int on = 0;
        if (c.since(33, 32)) {
            gl.GetBooleani_v(enums::color_writemask, i, mask);
            on = gl.IsEnabledi(enums::blend, i);
        } else {
            gl.GetBooleanv(enums::color_writemask, mask);
            on = gl.IsEnabled(enums::blend);
        }
        note("color mask", i, mask, 4);
        note("blend", i, &on, 1);
        if (i > 0 && !c.since(40, 32)) continue;
        for (const auto& [what, name] : {std::pair{"src rgb", enums::blend_src_rgb},
                                         {"dst rgb", enums::blend_dst_rgb},
                                         {"src alpha", enums::blend_src_alpha},
                                         {"dst alpha", enums::blend_dst_alpha},
                                         {"equation rgb", enums::blend_equation_rgb},
                                         {"equation alpha", enums::blend_equation_alpha}}) {
            int value = 0;
            c.since(40, 32) ? gl.GetIntegeri_v(name, i, &value) : gl.GetIntegerv(name, &value);
            note(what, i, &value, 1);
        }
    }
    for (unsigned i = 0; i < (c.since(41, 99) ? 16u : 1u); ++i) {
        float viewport[4] = {}, range[2] = {};
        double exact[2] = {};
        int box[4] = {}, on = 0;
        if (c.since(41, 99)) {
            gl.GetFloati_v(enums::viewport, i, viewport);
            gl.GetIntegeri_v(enums::scissor_box, i, box);
            gl.GetDoublei_v(enums::depth_range, i, exact);
            on = gl.IsEnabledi(enums::scissor_test, i);
        } else {
            gl.GetFloatv(enums::viewport, viewport);
            gl.GetIntegerv(enums::scissor_box, box);
            gl.GetFloatv(enums::depth_range, range);
            on = gl.IsEnabled(enums::scissor_test);
        }
        note("viewport", i, viewport, 4);
        note("scissor", i, box, 4);
        note("depth range", i, range, 2);
        note("exact depth range", i, exact, 2);
        note("scissor test", i, &on, 1);
    }
    return seen;
}

/// Names of what differs between two of them: "dither 0 0: 1, 0".
inline std::string differing_state(const std::map<std::string, double>& a, const std::map<std::string, double>& b) {
    std::string text;
    for (const auto& [what, value] : a)
        if (const auto other = b.find(what); other == b.end() || value < other->second || value > other->second)
            text += what + ": " + std::to_string(value) + ", " + (other == b.end() ? "none" : std::to_string(other->second)) + "; ";
    return text + (a.size() == b.size() ? "" : "not the same questions");
}

/// An engine that draws in its own way: everything that a guard has to force is set to something else, by the dice where there is a
/// choice. What it owns lives as long as it does; its context must be current when it is made and when it goes.
class hostile_host {
  public:
    /// `program`: one of the host's own to leave in use, or 0.
    hostile_host(const gnomon::gl::context& c, dice& roll, int units, unsigned program) : c_(c) {
        const gnomon::gl::functions& gl = *c.gl;
        bind(units);
        gl.UseProgram(program);
        switches(roll);
        outputs(roll);
        viewports(roll);
        for (const unsigned name : {enums::unpack_row_length, enums::pack_row_length}) gl.PixelStorei(name, roll(5, 500));
        for (const unsigned name :
             {enums::unpack_skip_rows, enums::unpack_skip_pixels, enums::pack_skip_rows, enums::pack_skip_pixels})
            gl.PixelStorei(name, roll(1, 9));
        gl.PixelStorei(enums::unpack_alignment, 8);
        gl.PixelStorei(enums::pack_alignment, 2);
        gl.DepthFunc(enums::gequal);
        gl.DepthMask(0);
        gl.CullFace(roll(0, 1) != 0 ? enums::front : enums::front_and_back);
        gl.FrontFace(enums::clockwise);
        if (!c.es) {
            for (const unsigned name :
                 {enums::unpack_swap_bytes, enums::unpack_lsb_first, enums::pack_swap_bytes, enums::pack_lsb_first})
                gl.PixelStorei(name, 1);
            gl.PolygonMode(enums::front_and_back, enums::line);
        }
        if (c.clip_control == gnomon::gl::clip_control::core) gl.ClipControl(enums::upper_left, enums::zero_to_one);
        if (c.clip_control == gnomon::gl::clip_control::ext) gl.ClipControlEXT(enums::upper_left, enums::zero_to_one);
    }
    ~hostile_host() {
        for (unsigned i = 0; i < 8; ++i) c_.gl->BindSampler(i, 0);
        c_.gl->UseProgram(0);
    }
    hostile_host(const hostile_host&) = delete;
    hostile_host& operator=(const hostile_host&) = delete;

  private:
    using buffer = gnomon::gl::buffer;

    void bind(int units) {
        const gnomon::gl::functions& gl = *c_.gl;
        for (int i = 0; i < units; ++i) {
            textures_.emplace_back(c_);
            samplers_.emplace_back(c_);
            gl.ActiveTexture(enums::texture0 + static_cast<unsigned>(i));
            gl.BindTexture(enums::texture_2d, textures_.back().name());
            gl.BindSampler(static_cast<unsigned>(i), samplers_.back().name());
            gl.SamplerParameteri(samplers_.back().name(), enums::texture_wrap_s, static_cast<int>(enums::repeat));
        }
        gl.BindFramebuffer(enums::draw_framebuffer, drawn_.name());
        gl.BindFramebuffer(enums::read_framebuffer, read_.name());
        gl.BindVertexArray(vertices_.name());
        gl.BindBuffer(enums::array_buffer, array_.name());
        for (const auto& [target, name] :
             {std::pair{enums::pixel_pack_buffer, pack_.name()}, {enums::pixel_unpack_buffer, unpack_.name()}}) {
            gl.BindBuffer(target, name);
            gl.BufferData(target, 1 << 20, nullptr, enums::stream_draw); // so that an offset of 0 is no error, but wrong texels
        }
    }
    void switches(dice& roll) {
        const gnomon::gl::functions& gl = *c_.gl;
        std::vector<unsigned> all{enums::cull_face,           enums::depth_test,         enums::dither,
                                  enums::polygon_offset_fill, enums::rasterizer_discard, enums::sample_alpha_to_coverage,
                                  enums::sample_coverage,     enums::stencil_test};
        if (!c_.es) {
            for (const unsigned what : {enums::color_logic_op, enums::framebuffer_srgb, enums::polygon_smooth,
                                        enums::primitive_restart, enums::sample_alpha_to_one})
                all.push_back(what);
        }
        if (c_.depth_clamp) all.push_back(enums::depth_clamp);
        for (int i = 0; i < c_.max_clip_distances; i += roll(1, 2)) all.push_back(enums::clip_distance0 + static_cast<unsigned>(i));
        if (c_.since(33, 31)) all.push_back(enums::sample_mask);
        for (const unsigned what : all) gl.Enable(what);
    }
    void outputs(dice& roll) {
        const gnomon::gl::functions& gl = *c_.gl;
        const auto bit = [&] { return static_cast<unsigned char>(roll(0, 1)); };
        const auto factor = [&] {
            return 0x0300u + static_cast<unsigned>(roll(0, 7));
        }; // SRC_COLOR to ONE_MINUS_DST_ALPHA, and DST_COLOR
        const auto equation = [&] { return roll(0, 1) != 0 ? enums::blend_min : 0x800Bu; }; // FUNC_REVERSE_SUBTRACT
        gl.ColorMask(0, bit(), bit(), 1);
        gl.Enable(enums::blend);
        gl.BlendFuncSeparate(factor(), factor(), factor(), factor());
        gl.BlendEquationSeparate(equation(), equation());
        for (unsigned i = 0; c_.since(33, 32) && i < 8; ++i) {
            gl.ColorMaski(i, bit(), 0, bit(), bit());
            if (i % 2 != 0) gl.Disablei(enums::blend, i);
            if (!c_.since(40, 32)) continue;
            gl.BlendFuncSeparatei(i, factor(), factor(), factor(), factor());
            gl.BlendEquationSeparatei(i, equation(), equation());
        }
    }
    void viewports(dice& roll) {
        const gnomon::gl::functions& gl = *c_.gl;
        gl.Enable(enums::scissor_test);
        gl.Viewport(roll(0, 9), roll(0, 9), roll(1, 99), roll(1, 99));
        gl.Scissor(roll(0, 9), roll(0, 9), roll(1, 3), roll(1, 3));
        c_.es ? gl.DepthRangef(1.0f, 0.25f) : gl.DepthRange(0.9, 0.1);
        for (unsigned i = 0; c_.since(41, 99) && i < 16; ++i) {
            const auto f = [&] { return 0.5f * static_cast<float>(roll(1, 99)); };
            gl.ViewportIndexedf(i, f(), f(), f(), f());
            gl.ScissorIndexed(i, roll(0, 9), roll(0, 9), roll(1, 99), roll(1, 99));
            gl.DepthRangeIndexed(i, 1.0 / (2 + roll(0, 9)), 1.0 / 3);
            if (i % 3 == 1) gl.Disablei(enums::scissor_test, i);
        }
    }

    const gnomon::gl::context& c_;
    std::vector<gnomon::gl::texture> textures_ = {};
    std::vector<gnomon::gl::sampler> samplers_ = {};
    gnomon::gl::framebuffer drawn_{c_}, read_{c_};
    gnomon::gl::vertex_array vertices_{c_};
    buffer array_{c_}, pack_{c_}, unpack_{c_};
};

} // namespace test
