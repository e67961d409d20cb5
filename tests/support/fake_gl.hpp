// A GL that draws nothing: it remembers state as the specification says, counts what is alive, and fails on demand.
//
//     test::fake_gl fake("3.3 (Core Profile)");
//     const auto context = gnomon::gl::context::of(fake.table);
//     ...
//     CHECK(fake.alive() == 0);       // textures, framebuffers, buffers, vertex arrays, samplers, shaders, programs
//     CHECK(fake.wrong == "");        // calls of what this version has not, and names that are not alive
//     CHECK(fake.calls["Scissor"] == 4);
//
// Several may live at once; `use` makes one current, as does its making.
#pragma once

#include <gnomon/gl/context.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace test {

class fake_gl {
  public:
    using key = std::pair<unsigned, unsigned>; ///< name, and index of draw buffer, viewport or texture unit
    using values = std::array<double, 4>;

    explicit fake_gl(std::string version, std::vector<std::string> extensions = {});
    ~fake_gl() {
        if (current() == this) current() = nullptr;
    }
    fake_gl(const fake_gl&) = delete;
    fake_gl& operator=(const fake_gl&) = delete;

    void use() { current() = this; }
    static fake_gl*& current() {
        static fake_gl* now = nullptr;
        return now;
    }

    gnomon::gl::functions table = {};
    std::map<std::string, void (*)()> entries = {}; ///< "glBindTexture"; erase one to lose it
    std::map<std::string, int> calls = {};          ///< "BindTexture", how often
    std::vector<std::string> order = {};            ///< names in the order of the calls
    std::string wrong = {};

    std::string version;
    std::vector<std::string> extensions;
    std::map<key, values> state = {};
    std::map<std::string, std::set<unsigned>> objects = {}; ///< "texture", names alive
    std::vector<unsigned> errors = {};                      ///< answers of GetError to come
    bool lost = false;                                      ///< every call answers with nothing, GetError with CONTEXT_LOST
    std::map<std::string, int> failing = {}; ///< "GenBuffers", 2: after two it does nothing, and leaves GL_OUT_OF_MEMORY
    unsigned framebuffer_status = gnomon::gl::enums::framebuffer_complete;
    std::string shader_log = {}; ///< a shader that is compiled while this is set is rejected
    std::string link_log = {};
    std::vector<std::string> sources = {}; ///< of shaders
    std::set<std::string> uniforms = {};   ///< whose locations were asked for
    unsigned read_buffer = 0;              ///< that was set last

    /// As a loader: fake.loader()("glClear").
    [[nodiscard]] auto loader() const {
        return [this](const char* name) -> void (*)() {
            const auto found = entries.find(name);
            return found == entries.end() ? nullptr : found->second;
        };
    }
    [[nodiscard]] std::size_t alive() const {
        std::size_t sum = 0;
        for (const auto& [kind, names] : objects) sum += names.size();
        return sum;
    }
    template <typename... Numbers> void put(unsigned name, unsigned index, Numbers... numbers) {
        state[{name, index}] = values{static_cast<double>(numbers)...};
    }
    [[nodiscard]] values get(unsigned name, unsigned index = 0) const {
        const auto found = state.find({name, index});
        return found == state.end() ? values{} : found->second;
    }

    static constexpr unsigned draw_buffers = 8, viewports = 16, units = 32, clip_distances = 8;

  private:
    template <auto Member> static inline const char* name_of = "";

    /// Puts a lambda (fake_gl&, arguments...) where a function belongs.
    template <auto Member, typename Body> void on(const char* name, Body) {
        name_of<Member> = name;
        table.*Member = wrapped<Member, Body>(table.*Member);
        entries[std::string("gl") + name] = std::bit_cast<void (*)()>(table.*Member);
    }
    template <auto Member, typename Body, typename Result, typename... Arguments> static auto wrapped(Result (*)(Arguments...)) {
        return +[](Arguments... arguments) -> Result {
            fake_gl& fake = *current();
            const bool answers = fake.note(name_of<Member>);
            if constexpr (std::is_void_v<Result>) {
                if (answers) Body{}(fake, arguments...);
            } else {
                return answers ? static_cast<Result>(Body{}(fake, arguments...)) : Result{};
            }
        };
    }
    /// A function that is counted, and does nothing.
    template <auto... Members> void ignore(std::initializer_list<const char*> names) {
        auto name = names.begin();
        (on<Members>(*name++, [](fake_gl&, auto...) { return 0; }), ...);
    }
    /// Counts the call. Does it go through? That it is lost is the one thing that a lost context says.
    bool note(const std::string& name) {
        ++calls[name];
        order.push_back(name);
        if (allowed_.find(" gl" + name + ",") == std::string::npos) wrong += name + " is not in this version; ";
        if (const auto found = failing.find(name); found != failing.end() && found->second-- <= 0) {
            errors.push_back(gnomon::gl::enums::out_of_memory);
            return false;
        }
        return !lost || name == "GetError" || name == "GetGraphicsResetStatus";
    }

    /// Objects that are made and deleted by the array, and bound to a name of state.
    template <auto Generate, auto Delete> void named(const char* kind, const char* generate, const char* destroy) {
        static std::string what;
        what = kind;
        on<Generate>(generate, [](fake_gl& f, int count, unsigned* names) {
            for (int i = 0; i < count; ++i) f.objects[what].insert(names[i] = ++f.last_name_);
        });
        on<Delete>(destroy, [](fake_gl& f, int count, const unsigned* names) {
            for (int i = 0; i < count; ++i) {
                if (f.objects[what].erase(names[i]) == 0) f.wrong += "deletes a " + what + " that is not alive; ";
                f.unbind(what, names[i]);
            }
        });
    }
    void unbind(const std::string& kind, unsigned name);
    void bind(const std::string& kind, unsigned binding, unsigned index, unsigned name) {
        if (name != 0 && objects[kind].count(name) == 0) wrong += "binds a " + kind + " that is not alive; ";
        put(binding, index, name);
    }
    [[nodiscard]] static unsigned number_of_values(unsigned name) {
        using namespace gnomon::gl;
        if (name == enums::viewport || name == enums::scissor_box || name == enums::color_writemask) return 4;
        return name == enums::depth_range || name == enums::polygon_mode ? 2 : 1;
    }
    template <typename Number> void answer(unsigned name, unsigned index, Number* to) const {
        const values v = get(name, index);
        for (unsigned i = 0; i < number_of_values(name); ++i) to[i] = static_cast<Number>(v[i]);
    }
    template <typename Number> void answer(unsigned name, Number* to) const {
        using namespace gnomon::gl;
        const bool of_unit = name == enums::texture_binding_2d || name == enums::sampler_binding;
        answer(name, of_unit ? static_cast<unsigned>(get(enums::active_texture)[0]) - enums::texture0 : 0, to);
    }
    template <typename... Numbers> void for_all(unsigned name, unsigned count, Numbers... numbers) {
        for (unsigned i = 0; i < count; ++i) put(name, i, numbers...);
    }
    [[nodiscard]] static unsigned switches_of(unsigned what) {
        using namespace gnomon::gl;
        return what == enums::blend ? draw_buffers : what == enums::scissor_test ? viewports : 1;
    }

    void start();
    void answers();
    void things();
    void programs();
    void fixed_state();
    void indexed_state();

    std::string allowed_ = {};
    unsigned last_name_ = 0;
};

inline fake_gl::fake_gl(std::string version_text, std::vector<std::string> extension_names)
    : version(std::move(version_text)), extensions(std::move(extension_names)) {
    const auto v = gnomon::gl::parse_version(version);
    allowed_ = " " + gnomon::gl::missing_functions({}, v.es, v.number) + ",";
    for (const std::string& e : extensions) {
        if (e == "GL_ARB_clip_control") allowed_ += " glClipControl,";
        if (e == "GL_EXT_clip_control") allowed_ += " glClipControlEXT,";
    }
    start();
    answers();
    things();
    programs();
    fixed_state();
    indexed_state();
    use();
}

/// What a new context holds.
inline void fake_gl::start() {
    using namespace gnomon::gl;
    for (const auto& [name, value] :
         std::initializer_list<std::pair<unsigned, unsigned>>{{enums::active_texture, enums::texture0},
                                                              {enums::max_texture_size, 4096},
                                                              {enums::max_draw_buffers, draw_buffers},
                                                              {enums::max_viewports, viewports},
                                                              {enums::max_clip_distances, clip_distances},
                                                              {enums::num_extensions, static_cast<unsigned>(extensions.size())},
                                                              {enums::dither, 1},
                                                              {enums::depth_func, enums::less},
                                                              {enums::depth_writemask, 1},
                                                              {enums::cull_face_mode, enums::back_face},
                                                              {enums::front_face, enums::counter_clockwise},
                                                              {enums::clip_origin, enums::lower_left},
                                                              {enums::clip_depth_mode, enums::negative_one_to_one},
                                                              {enums::pack_alignment, 4},
                                                              {enums::unpack_alignment, 4}})
        put(name, 0, value);
    put(enums::polygon_mode, 0, enums::fill, enums::fill);
    for_all(enums::color_writemask, draw_buffers, 1, 1, 1, 1);
    for_all(enums::blend_src_rgb, draw_buffers, enums::one);
    for_all(enums::blend_src_alpha, draw_buffers, enums::one);
    for_all(enums::blend_equation_rgb, draw_buffers, enums::func_add);
    for_all(enums::blend_equation_alpha, draw_buffers, enums::func_add);
    for_all(enums::viewport, viewports, 0, 0, 640, 480);
    for_all(enums::scissor_box, viewports, 0, 0, 640, 480);
    for_all(enums::depth_range, viewports, 0, 1);
}

inline void fake_gl::answers() {
    using namespace gnomon::gl;
    using f = functions;
    on<&f::GetString>("GetString", [](fake_gl& gl, unsigned name) {
        const char* text = name == enums::version ? gl.version.c_str() : "fake";
        return reinterpret_cast<const unsigned char*>(text);
    });
    on<&f::GetStringi>("GetStringi", [](fake_gl& gl, unsigned, unsigned i) {
        return reinterpret_cast<const unsigned char*>(i < gl.extensions.size() ? gl.extensions[i].c_str() : nullptr);
    });
    on<&f::GetError>("GetError", [](fake_gl& gl) {
        if (gl.lost) return enums::context_lost;
        if (gl.errors.empty()) return enums::no_error;
        const unsigned first = gl.errors.front();
        gl.errors.erase(gl.errors.begin());
        return first;
    });
    on<&f::GetGraphicsResetStatus>("GetGraphicsResetStatus", [](fake_gl& gl) {
        constexpr unsigned guilty = 0x8253;
        return gl.lost ? guilty : enums::no_error;
    });
    on<&f::GetIntegerv>("GetIntegerv", [](fake_gl& gl, unsigned name, int* to) { gl.answer(name, to); });
    on<&f::GetFloatv>("GetFloatv", [](fake_gl& gl, unsigned name, float* to) { gl.answer(name, to); });
    on<&f::GetDoublev>("GetDoublev", [](fake_gl& gl, unsigned name, double* to) { gl.answer(name, to); });
    on<&f::GetBooleanv>("GetBooleanv", [](fake_gl& gl, unsigned name, unsigned char* to) { gl.answer(name, to); });
    on<&f::GetIntegeri_v>("GetIntegeri_v", [](fake_gl& gl, unsigned name, unsigned i, int* to) { gl.answer(name, i, to); });
    on<&f::GetBooleani_v>("GetBooleani_v",
                          [](fake_gl& gl, unsigned name, unsigned i, unsigned char* to) { gl.answer(name, i, to); });
    on<&f::GetFloati_v>("GetFloati_v", [](fake_gl& gl, unsigned name, unsigned i, float* to) { gl.answer(name, i, to); });
    on<&f::GetDoublei_v>("GetDoublei_v", [](fake_gl& gl, unsigned name, unsigned i, double* to) { gl.answer(name, i, to); });
    on<&f::IsEnabled>("IsEnabled", [](fake_gl& gl, unsigned what) { return gl.get(what)[0] > 0; });
    on<&f::IsEnabledi>("IsEnabledi", [](fake_gl& gl, unsigned what, unsigned i) { return gl.get(what, i)[0] > 0; });
    ignore<&f::Finish, &f::Flush>({"Finish", "Flush"});
}

inline void fake_gl::unbind(const std::string& kind, unsigned name) {
    using namespace gnomon::gl;
    const std::map<std::string, std::vector<unsigned>> bindings{
        {"texture", {enums::texture_binding_2d}},
        {"sampler", {enums::sampler_binding}},
        {"framebuffer", {enums::draw_framebuffer_binding, enums::read_framebuffer_binding}},
        {"buffer", {enums::array_buffer_binding, enums::pixel_pack_buffer_binding, enums::pixel_unpack_buffer_binding}},
        {"vertex array", {enums::vertex_array_binding}}};
    for (const unsigned binding : bindings.at(kind))
        for (auto& [where, bound] : state)
            if (where.first == binding && static_cast<unsigned>(bound[0]) == name) bound[0] = 0;
}

inline void fake_gl::things() {
    using namespace gnomon::gl;
    using f = functions;
    named<&f::GenTextures, &f::DeleteTextures>("texture", "GenTextures", "DeleteTextures");
    named<&f::GenSamplers, &f::DeleteSamplers>("sampler", "GenSamplers", "DeleteSamplers");
    named<&f::GenFramebuffers, &f::DeleteFramebuffers>("framebuffer", "GenFramebuffers", "DeleteFramebuffers");
    named<&f::GenBuffers, &f::DeleteBuffers>("buffer", "GenBuffers", "DeleteBuffers");
    named<&f::GenVertexArrays, &f::DeleteVertexArrays>("vertex array", "GenVertexArrays", "DeleteVertexArrays");
    on<&f::ActiveTexture>("ActiveTexture", [](fake_gl& gl, unsigned unit) { gl.put(enums::active_texture, 0, unit); });
    on<&f::BindTexture>("BindTexture", [](fake_gl& gl, unsigned, unsigned name) {
        gl.bind("texture", enums::texture_binding_2d, static_cast<unsigned>(gl.get(enums::active_texture)[0]) - enums::texture0,
                name);
    });
    on<&f::BindSampler>("BindSampler",
                        [](fake_gl& gl, unsigned unit, unsigned name) { gl.bind("sampler", enums::sampler_binding, unit, name); });
    on<&f::BindFramebuffer>("BindFramebuffer", [](fake_gl& gl, unsigned target, unsigned name) {
        if (target != enums::read_framebuffer) gl.bind("framebuffer", enums::draw_framebuffer_binding, 0, name);
        if (target != enums::draw_framebuffer) gl.bind("framebuffer", enums::read_framebuffer_binding, 0, name);
    });
    on<&f::BindBuffer>("BindBuffer", [](fake_gl& gl, unsigned target, unsigned name) {
        if (target == enums::array_buffer) gl.bind("buffer", enums::array_buffer_binding, 0, name);
        if (target == enums::pixel_pack_buffer) gl.bind("buffer", enums::pixel_pack_buffer_binding, 0, name);
        if (target == enums::pixel_unpack_buffer) gl.bind("buffer", enums::pixel_unpack_buffer_binding, 0, name);
    });
    on<&f::BindVertexArray>("BindVertexArray",
                            [](fake_gl& gl, unsigned name) { gl.bind("vertex array", enums::vertex_array_binding, 0, name); });
    on<&f::CheckFramebufferStatus>("CheckFramebufferStatus", [](fake_gl& gl, unsigned) { return gl.framebuffer_status; });
    on<&f::ReadBuffer>("ReadBuffer", [](fake_gl& gl, unsigned from) { gl.read_buffer = from; });
    on<&f::PixelStorei>("PixelStorei", [](fake_gl& gl, unsigned name, int value) { gl.put(name, 0, value); });
    ignore<&f::TexImage2D, &f::TexSubImage2D, &f::TexParameteri, &f::SamplerParameteri, &f::FramebufferTexture2D, &f::DrawBuffers,
           &f::BlitFramebuffer, &f::InvalidateFramebuffer, &f::ClearBufferfv, &f::ClearBufferiv, &f::ClearBufferuiv,
           &f::ClearBufferfi, &f::ReadPixels>({"TexImage2D", "TexSubImage2D", "TexParameteri", "SamplerParameteri",
                                               "FramebufferTexture2D", "DrawBuffers", "BlitFramebuffer", "InvalidateFramebuffer",
                                               "ClearBufferfv", "ClearBufferiv", "ClearBufferuiv", "ClearBufferfi", "ReadPixels"});
    ignore<&f::BufferData, &f::BufferSubData, &f::EnableVertexAttribArray, &f::DisableVertexAttribArray, &f::VertexAttribPointer,
           &f::VertexAttribIPointer, &f::VertexAttribDivisor, &f::DrawArrays, &f::DrawArraysInstanced, &f::DrawElements,
           &f::DrawElementsInstanced>({"BufferData", "BufferSubData", "EnableVertexAttribArray", "DisableVertexAttribArray",
                                       "VertexAttribPointer", "VertexAttribIPointer", "VertexAttribDivisor", "DrawArrays",
                                       "DrawArraysInstanced", "DrawElements", "DrawElementsInstanced"});
}

inline void fake_gl::programs() {
    using namespace gnomon::gl;
    using f = functions;
    on<&f::CreateShader>("CreateShader", [](fake_gl& gl, unsigned) { return *gl.objects["shader"].insert(++gl.last_name_).first; });
    on<&f::CreateProgram>("CreateProgram", [](fake_gl& gl) { return *gl.objects["program"].insert(++gl.last_name_).first; });
    on<&f::DeleteShader>("DeleteShader", [](fake_gl& gl, unsigned name) {
        if (gl.objects["shader"].erase(name) == 0) gl.wrong += "deletes a shader that is not alive; ";
    });
    on<&f::DeleteProgram>("DeleteProgram", [](fake_gl& gl, unsigned name) {
        if (gl.objects["program"].erase(name) == 0) gl.wrong += "deletes a program that is not alive; ";
    });
    on<&f::UseProgram>("UseProgram", [](fake_gl& gl, unsigned name) { gl.bind("program", enums::current_program, 0, name); });
    on<&f::GetShaderiv>("GetShaderiv", [](fake_gl& gl, unsigned, unsigned name, int* to) {
        *to = name == enums::compile_status ? gl.shader_log.empty() : static_cast<int>(gl.shader_log.size()) + 1;
    });
    on<&f::GetProgramiv>("GetProgramiv", [](fake_gl& gl, unsigned, unsigned name, int* to) {
        *to = name == enums::link_status ? gl.link_log.empty() : static_cast<int>(gl.link_log.size()) + 1;
    });
    on<&f::GetShaderInfoLog>("GetShaderInfoLog", [](fake_gl& gl, unsigned, int capacity, int*, char* to) {
        to[gl.shader_log.copy(to, static_cast<std::size_t>(capacity - 1))] = '\0';
    });
    on<&f::GetProgramInfoLog>("GetProgramInfoLog", [](fake_gl& gl, unsigned, int capacity, int*, char* to) {
        to[gl.link_log.copy(to, static_cast<std::size_t>(capacity - 1))] = '\0';
    });
    on<&f::ShaderSource>("ShaderSource", [](fake_gl& gl, unsigned, int, const char* const* text, const int* length) {
        gl.sources.emplace_back(*text, static_cast<std::size_t>(*length));
    });
    on<&f::GetUniformLocation>("GetUniformLocation", [](fake_gl& gl, unsigned, const char* name) {
        gl.uniforms.insert(name);
        return 0;
    });
    ignore<&f::CompileShader, &f::AttachShader, &f::DetachShader, &f::BindAttribLocation, &f::LinkProgram, &f::Uniform1i,
           &f::Uniform2i, &f::Uniform4i, &f::Uniform1ui, &f::Uniform1f, &f::Uniform2f, &f::Uniform3f, &f::Uniform4f, &f::Uniform1fv,
           &f::Uniform1uiv, &f::UniformMatrix4fv>({"CompileShader", "AttachShader", "DetachShader", "BindAttribLocation",
                                                   "LinkProgram", "Uniform1i", "Uniform2i", "Uniform4i", "Uniform1ui", "Uniform1f",
                                                   "Uniform2f", "Uniform3f", "Uniform4f", "Uniform1fv", "Uniform1uiv",
                                                   "UniformMatrix4fv"});
}

inline void fake_gl::fixed_state() {
    using namespace gnomon::gl;
    using f = functions;
    on<&f::DepthFunc>("DepthFunc", [](fake_gl& gl, unsigned function) { gl.put(enums::depth_func, 0, function); });
    on<&f::DepthMask>("DepthMask", [](fake_gl& gl, unsigned char write) { gl.put(enums::depth_writemask, 0, write); });
    on<&f::CullFace>("CullFace", [](fake_gl& gl, unsigned face) { gl.put(enums::cull_face_mode, 0, face); });
    on<&f::FrontFace>("FrontFace", [](fake_gl& gl, unsigned winding) { gl.put(enums::front_face, 0, winding); });
    on<&f::PolygonMode>("PolygonMode", [](fake_gl& gl, unsigned face, unsigned mode) {
        values now = gl.get(enums::polygon_mode);
        if (face != enums::back_face) now[0] = mode;
        if (face != enums::front) now[1] = mode;
        gl.put(enums::polygon_mode, 0, now[0], now[1]);
    });
    constexpr auto clip = [](fake_gl& gl, unsigned origin, unsigned depth) {
        gl.put(enums::clip_origin, 0, origin);
        gl.put(enums::clip_depth_mode, 0, depth);
    };
    on<&f::ClipControl>("ClipControl", clip);
    on<&f::ClipControlEXT>("ClipControlEXT", clip);
    on<&f::PauseTransformFeedback>("PauseTransformFeedback", [](fake_gl& gl) {
        if (gl.get(enums::transform_feedback_active)[0] < 1) gl.wrong += "pauses transform feedback that is not active; ";
        gl.put(enums::transform_feedback_paused, 0, 1);
    });
    on<&f::ResumeTransformFeedback>("ResumeTransformFeedback", [](fake_gl& gl) { gl.put(enums::transform_feedback_paused, 0, 0); });
}

/// State that one call sets for every draw buffer or viewport, and another for one.
inline void fake_gl::indexed_state() {
    using namespace gnomon::gl;
    using f = functions;
    on<&f::Enable>("Enable", [](fake_gl& gl, unsigned what) { gl.for_all(what, switches_of(what), 1); });
    on<&f::Disable>("Disable", [](fake_gl& gl, unsigned what) { gl.for_all(what, switches_of(what), 0); });
    on<&f::Enablei>("Enablei", [](fake_gl& gl, unsigned what, unsigned i) { gl.put(what, i, 1); });
    on<&f::Disablei>("Disablei", [](fake_gl& gl, unsigned what, unsigned i) { gl.put(what, i, 0); });
    on<&f::Viewport>("Viewport",
                     [](fake_gl& gl, int x, int y, int w, int h) { gl.for_all(enums::viewport, viewports, x, y, w, h); });
    on<&f::ViewportIndexedf>("ViewportIndexedf", [](fake_gl& gl, unsigned i, float x, float y, float w, float h) {
        gl.put(enums::viewport, i, x, y, w, h);
    });
    on<&f::Scissor>("Scissor",
                    [](fake_gl& gl, int x, int y, int w, int h) { gl.for_all(enums::scissor_box, viewports, x, y, w, h); });
    on<&f::ScissorIndexed>("ScissorIndexed",
                           [](fake_gl& gl, unsigned i, int x, int y, int w, int h) { gl.put(enums::scissor_box, i, x, y, w, h); });
    on<&f::DepthRange>("DepthRange", [](fake_gl& gl, double n, double o) { gl.for_all(enums::depth_range, viewports, n, o); });
    on<&f::DepthRangef>("DepthRangef", [](fake_gl& gl, float n, float o) { gl.for_all(enums::depth_range, viewports, n, o); });
    on<&f::DepthRangeIndexed>("DepthRangeIndexed",
                              [](fake_gl& gl, unsigned i, double n, double o) { gl.put(enums::depth_range, i, n, o); });
    on<&f::ColorMask>("ColorMask", [](fake_gl& gl, unsigned char r, unsigned char g, unsigned char b, unsigned char a) {
        gl.for_all(enums::color_writemask, draw_buffers, r, g, b, a);
    });
    on<&f::ColorMaski>("ColorMaski", [](fake_gl& gl, unsigned i, unsigned char r, unsigned char g, unsigned char b,
                                        unsigned char a) { gl.put(enums::color_writemask, i, r, g, b, a); });
    on<&f::BlendEquation>("BlendEquation", [](fake_gl& gl, unsigned mode) {
        gl.for_all(enums::blend_equation_rgb, draw_buffers, mode);
        gl.for_all(enums::blend_equation_alpha, draw_buffers, mode);
    });
    on<&f::BlendEquationSeparate>("BlendEquationSeparate", [](fake_gl& gl, unsigned color, unsigned alpha) {
        gl.for_all(enums::blend_equation_rgb, draw_buffers, color);
        gl.for_all(enums::blend_equation_alpha, draw_buffers, alpha);
    });
    on<&f::BlendEquationSeparatei>("BlendEquationSeparatei", [](fake_gl& gl, unsigned i, unsigned color, unsigned alpha) {
        gl.put(enums::blend_equation_rgb, i, color);
        gl.put(enums::blend_equation_alpha, i, alpha);
    });
    on<&f::BlendFunc>("BlendFunc", [](fake_gl& gl, unsigned s, unsigned d) {
        for (const unsigned name : {enums::blend_src_rgb, enums::blend_src_alpha}) gl.for_all(name, draw_buffers, s);
        for (const unsigned name : {enums::blend_dst_rgb, enums::blend_dst_alpha}) gl.for_all(name, draw_buffers, d);
    });
    on<&f::BlendFuncSeparate>("BlendFuncSeparate", [](fake_gl& gl, unsigned s, unsigned d, unsigned sa, unsigned da) {
        gl.for_all(enums::blend_src_rgb, draw_buffers, s);
        gl.for_all(enums::blend_dst_rgb, draw_buffers, d);
        gl.for_all(enums::blend_src_alpha, draw_buffers, sa);
        gl.for_all(enums::blend_dst_alpha, draw_buffers, da);
    });
    on<&f::BlendFuncSeparatei>("BlendFuncSeparatei", [](fake_gl& gl, unsigned i, unsigned s, unsigned d, unsigned sa, unsigned da) {
        gl.put(enums::blend_src_rgb, i, s);
        gl.put(enums::blend_dst_rgb, i, d);
        gl.put(enums::blend_src_alpha, i, sa);
        gl.put(enums::blend_dst_alpha, i, da);
    });
}

} // namespace test
