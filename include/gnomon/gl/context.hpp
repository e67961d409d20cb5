// gnomon: soft shadow maps. A GL context as gl/ sees it: the functions, and what its version and extensions promise.
#pragma once

#include <gnomon/gl/enums.hpp>
#include <gnomon/gl/functions.hpp>
#include <gnomon/gl/problem.hpp>

#include <string>
#include <string_view>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// 10 * major + minor of GL_VERSION's string, and whether it is OpenGL ES; 0 where no number is found.
struct version_number {
    bool es = false;
    int number = 0;
};

/// "4.5 (Core Profile) Mesa 22.3.6" is {false, 45}; "OpenGL ES 3.0 (WebGL 2.0)" and "WebGL 2.0 (OpenGL ES 3.0)" are {true, 30}.
/// A minor version of two digits counts as 9.
[[nodiscard]] constexpr version_number parse_version(std::string_view text) noexcept {
    version_number found;
    const auto digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
    std::size_t i = 0;
    if (const auto es = text.find("OpenGL ES"); es != std::string_view::npos) {
        found.es = true;
        i = es;
    }
    while (i < text.size() && !digit(i)) ++i;
    int major = 0;
    for (; digit(i) && major < 100; ++i) major = 10 * major + (text[i] - '0');
    if (major == 0 || i >= text.size() || text[i] != '.' || !digit(i + 1)) return found;
    found.number = 10 * major + (digit(i + 2) ? 9 : text[i + 1] - '0');
    return found;
}

/// Which function, if any, turns the clip volume: glClipControl of GL 4.5 and ARB_clip_control, or glClipControlEXT.
enum class clip_control { none, core, ext };

/// A version that no context has.
inline constexpr int never = 99;

/// What may be called, and what may be asked for. Made by `of`, passed by const&; each of a host's GL contexts has its own.
///
/// Holds a pointer to the host's `functions`, nothing of GL: it may be copied, kept and thrown away while no context is current.
struct context {
    const functions* gl = nullptr;
    bool es = false;
    /// 10 * major + minor: 33 and up for GL, 30 and up for OpenGL ES.
    int version = 0;

    bool norm16 = false;             ///< RG16 and RGBA16 exist and can be drawn into
    bool color_buffer_half = false;  ///< RG16F and RGBA16F can be drawn into
    bool color_buffer_float = false; ///< RG32F and RGBA32F can be drawn into
    bool float_blend = false;        ///< and blended into: the far bound's pass needs it
    bool float_linear = false;       ///< RG32F and RGBA32F can be sampled with GL_LINEAR
    bool depth_clamp = false;        ///< GL_DEPTH_CLAMP is there to be set
    enum clip_control clip_control = clip_control::none;

    int max_texture_size = 0;   ///< of either side, in texels
    int max_draw_buffers = 0;   ///< 1 where state cannot be set for each
    int max_viewports = 0;      ///< 1 where there is no array of them
    int max_clip_distances = 0; ///< 0 where GL_CLIP_DISTANCE0 is not there to be set

    /// Is the version at least `desktop` on GL, `embedded` on OpenGL ES?
    [[nodiscard]] bool since(int desktop, int embedded) const noexcept { return version >= (es ? embedded : desktop); }

    /// Asks the context that is current. The functions must outlive what is returned, and all that is made with it.
    ///
    /// GL 3.3 or OpenGL ES 3.0 at least (WebGL2 is ES 3.0); or the problem: no context, too old a one, functions missing by name.
    [[nodiscard]] static result<context> of(const functions& table);
    static result<context> of(const functions&&) = delete;

    /// Has the GPU forgotten everything? Then names mean nothing any more: `forget()` objects, and make them anew in a new context.
    /// False where a context cannot tell (GL before 4.5, ES before 3.2, but for WebGL); drawing there just goes nowhere.
    /// Reads an error flag in OpenGL ES.
    [[nodiscard]] bool lost() const noexcept;

    /// Reads GL's error flags, all of them, and says what `doing` met. Empty if no flag was set.
    [[nodiscard]] problem problem_while(std::string_view doing) const;
    /// Reads GL's error flags, so that what another left there is not taken for ours. Returns the first.
    unsigned drop_errors() const noexcept;
};

namespace detail {

/// The extensions of the current context; a name is asked without GL_, for WebGL leaves it out.
class extension_list {
  public:
    explicit extension_list(const functions& gl) {
        int count = 0;
        gl.GetIntegerv(enums::num_extensions, &count);
        for (int i = 0; i < count; ++i)
            if (const unsigned char* name = gl.GetStringi(enums::extensions, static_cast<unsigned>(i)))
                names_ += std::string(bare(reinterpret_cast<const char*>(name))) + ' ';
    }
    [[nodiscard]] bool has(std::string_view name) const { return names_.find(' ' + std::string(name) + ' ') != std::string::npos; }

  private:
    [[nodiscard]] static constexpr std::string_view bare(std::string_view name) noexcept {
        return name.substr(0, 3) == "GL_" ? name.substr(3) : name;
    }
    std::string names_ = " ";
};

[[nodiscard]] inline int integer(const functions& gl, unsigned name, int otherwise = 0) noexcept {
    int value = otherwise;
    gl.GetIntegerv(name, &value);
    return value;
}

[[nodiscard]] constexpr const char* error_name(unsigned error) noexcept {
    switch (error) {
    case enums::invalid_enum: return "GL_INVALID_ENUM";
    case enums::invalid_value: return "GL_INVALID_VALUE";
    case enums::invalid_operation: return "GL_INVALID_OPERATION";
    case enums::out_of_memory: return "GL_OUT_OF_MEMORY";
    case enums::invalid_framebuffer_operation: return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case enums::context_lost:
    case enums::context_lost_webgl: return "GL_CONTEXT_LOST";
    default: return "an error that GL does not name";
    }
}

/// Fills what extensions and limits say; the version is known and the functions are there.
inline void read_capabilities(context& c) {
    const functions& gl = *c.gl;
    const extension_list extensions(gl);
    const auto es_needs = [&](int core_since, std::string_view extension) {
        return !c.es || c.version >= core_since || extensions.has(extension);
    };
    c.norm16 = es_needs(never, "EXT_texture_norm16");
    c.color_buffer_float = es_needs(32, "EXT_color_buffer_float");
    c.color_buffer_half = c.color_buffer_float || extensions.has("EXT_color_buffer_half_float");
    c.float_blend = c.color_buffer_float && es_needs(never, "EXT_float_blend");
    c.float_linear = es_needs(never, "OES_texture_float_linear");
    c.depth_clamp = es_needs(never, "EXT_depth_clamp");
    if ((c.since(45, never) || (!c.es && extensions.has("ARB_clip_control"))) && gl.ClipControl != nullptr)
        c.clip_control = clip_control::core;
    else if (c.es && extensions.has("EXT_clip_control") && gl.ClipControlEXT != nullptr)
        c.clip_control = clip_control::ext;

    c.max_texture_size = integer(gl, enums::max_texture_size);
    c.max_draw_buffers = c.since(33, 32) ? integer(gl, enums::max_draw_buffers, 1) : 1;
    c.max_viewports = c.since(41, never) ? integer(gl, enums::max_viewports, 1) : 1;
    c.max_clip_distances = es_needs(never, "EXT_clip_cull_distance") ? integer(gl, enums::max_clip_distances) : 0;
}

} // namespace detail

inline result<context> context::of(const functions& table) {
    if (table.GetString == nullptr) return problem{"gnomon: the loader found no glGetString; is a GL context current?"};
    const auto* text = reinterpret_cast<const char*>(table.GetString(enums::version));
    if (text == nullptr) return problem{"gnomon: glGetString(GL_VERSION) is null; no GL context is current, or it is lost"};
    const version_number found = parse_version(text);
    if (found.number < (found.es ? 30 : 33))
        return problem{"gnomon: GL 3.3 or OpenGL ES 3.0 is needed, this context is \"" + std::string(text) + '"'};
    if (const std::string names = missing_functions(table, found.es, found.number); !names.empty())
        return problem{"gnomon: the context is \"" + std::string(text) + "\", but its loader lacks " + names};
    context c;
    c.gl = &table;
    c.es = found.es;
    c.version = found.number;
    detail::read_capabilities(c);
    return c;
}

inline bool context::lost() const noexcept {
    if (since(45, 32)) return gl->GetGraphicsResetStatus() != enums::no_error;
    if (!es) return false;
    const unsigned error = gl->GetError();
    return error == enums::context_lost || error == enums::context_lost_webgl;
}

inline unsigned context::drop_errors() const noexcept {
    unsigned first = enums::no_error;
    for (int flags = 0; flags < 16; ++flags) { // a lost context may answer with errors for ever
        const unsigned error = gl->GetError();
        if (error == enums::no_error) break;
        if (first == enums::no_error) first = error;
    }
    return first;
}

inline problem context::problem_while(std::string_view doing) const {
    const unsigned error = drop_errors();
    if (error == enums::no_error) return {};
    return problem{"gnomon: " + std::string(doing) + ": " + detail::error_name(error)};
}

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
