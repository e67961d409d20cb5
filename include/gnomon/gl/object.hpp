// gnomon: soft shadow maps. Who owns what of GL: textures, framebuffers, buffers, vertex arrays, samplers and programs.
//
// All of it is made and destroyed while its context is current, or one that shares with it. What takes a name, an engine's or ours, takes
// an unsigned: nothing here is needed to draw from or into what somebody else owns.
#pragma once

#include <gnomon/gl/context.hpp>
#include <gnomon/gl/format.hpp>
#include <gnomon/rect.hpp>

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// The owner of one name of a kind; of none when it was made so, moved from, or told to forget. Move-only.
///
/// Deletes the name when it goes. A context that is lost took all names with it: `forget` them then, before another context hands the
/// same numbers out again.
template <typename Kind> class object {
  public:
    object() = default;
    /// Asks GL for a name. Owns none, name() == 0, if GL gave none.
    explicit object(const context& c) : gl_(c.gl), name_(Kind::generate(*c.gl)) {}
    ~object() { reset(); }
    object(object&& from) noexcept : gl_(from.gl_), name_(std::exchange(from.name_, 0u)) {}
    object& operator=(object&& from) noexcept {
        if (this != &from) {
            reset();
            gl_ = from.gl_;
            name_ = std::exchange(from.name_, 0u);
        }
        return *this;
    }

    /// For calls of GL; 0 if nothing is owned.
    [[nodiscard]] unsigned name() const noexcept { return name_; }
    [[nodiscard]] explicit operator bool() const noexcept { return name_ != 0; }
    /// Deletes it now.
    void reset() noexcept {
        if (name_ != 0) Kind::destroy(*gl_, std::exchange(name_, 0u));
    }
    /// Owns nothing any more, and calls nothing: the context is lost, or somebody else owns the name now.
    unsigned forget() noexcept { return std::exchange(name_, 0u); }

  private:
    const functions* gl_ = nullptr;
    unsigned name_ = 0;
};

namespace detail {

template <auto Generate, auto Destroy> struct named_kind {
    [[nodiscard]] static unsigned generate(const functions& gl) noexcept {
        unsigned name = 0;
        (gl.*Generate)(1, &name);
        return name;
    }
    static void destroy(const functions& gl, unsigned name) noexcept { (gl.*Destroy)(1, &name); }
};
struct texture_kind : named_kind<&functions::GenTextures, &functions::DeleteTextures> {};
struct sampler_kind : named_kind<&functions::GenSamplers, &functions::DeleteSamplers> {};
struct framebuffer_kind : named_kind<&functions::GenFramebuffers, &functions::DeleteFramebuffers> {};
struct buffer_kind : named_kind<&functions::GenBuffers, &functions::DeleteBuffers> {};
struct vertex_array_kind : named_kind<&functions::GenVertexArrays, &functions::DeleteVertexArrays> {};
struct program_kind {
    [[nodiscard]] static unsigned generate(const functions& gl) noexcept { return gl.CreateProgram(); }
    static void destroy(const functions& gl, unsigned name) noexcept { gl.DeleteProgram(name); }
};
template <unsigned Stage> struct shader_kind {
    [[nodiscard]] static unsigned generate(const functions& gl) noexcept { return gl.CreateShader(Stage); }
    static void destroy(const functions& gl, unsigned name) noexcept { gl.DeleteShader(name); }
};

[[nodiscard]] inline problem made_none(const char* what) {
    return problem{std::string("gnomon: GL gave no name for a ") + what + "; the context is lost, or another one is current"};
}

} // namespace detail

using texture = object<detail::texture_kind>;
using sampler = object<detail::sampler_kind>;
using framebuffer = object<detail::framebuffer_kind>;
using buffer = object<detail::buffer_kind>;
using vertex_array = object<detail::vertex_array_kind>;
using program = object<detail::program_kind>;

// What follows calls GL under a state guard (gl/state.hpp): a pixel buffer that is bound would be read. It reads GL's error flags, and
// leaves what it made bound.

/// A texture of one level, whose texels are not set; NEAREST and clamped to its edge, so that it is complete and drawable.
/// Each side is at least one texel, also of an empty size. The problem: a size over the limit, or no memory.
[[nodiscard]] inline result<texture> make_texture(const context& c, const format& as, extent size) {
    const int width = size.width > 0 ? size.width : 1, height = size.height > 0 ? size.height : 1;
    if (width > c.max_texture_size || height > c.max_texture_size)
        return problem{"gnomon: a texture of " + std::to_string(width) + " x " + std::to_string(height) +
                       " texels is wanted, this context allows " + std::to_string(c.max_texture_size) + " on a side"};
    c.drop_errors();
    texture made(c);
    if (!made) return detail::made_none("texture");
    c.gl->BindTexture(enums::texture_2d, made.name());
    c.gl->TexImage2D(enums::texture_2d, 0, static_cast<int>(as.internal), width, height, 0, as.upload, as.upload_type, nullptr);
    const auto set = [&](unsigned name, unsigned value) { c.gl->TexParameteri(enums::texture_2d, name, static_cast<int>(value)); };
    set(enums::texture_min_filter, enums::nearest);
    set(enums::texture_mag_filter, enums::nearest);
    set(enums::texture_wrap_s, enums::clamp_to_edge);
    set(enums::texture_wrap_t, enums::clamp_to_edge);
    set(enums::texture_max_level, 0);
    if (problem why = c.problem_while("a texture of " + std::to_string(width) + " x " + std::to_string(height) + " " + as.name))
        return why;
    return made;
}

/// A framebuffer that draws into these textures, by name: color attachment i is the i-th. No depth with `depth` = 0.
/// It reads from the first. The problem: GL calls it incomplete.
/// \pre at most four textures; those beyond are left out
[[nodiscard]] inline result<framebuffer> make_framebuffer(const context& c, std::initializer_list<unsigned> colors,
                                                          unsigned depth = 0) {
    constexpr int most = 4; // of ES 3.0
    GNOMON_ASSERT(colors.size() <= std::size_t{most}, "gnomon: a framebuffer has at most four colour attachments everywhere");
    c.drop_errors();
    framebuffer made(c);
    if (!made) return detail::made_none("framebuffer");
    c.gl->BindFramebuffer(enums::framebuffer, made.name());
    const auto attach = [&](unsigned where, unsigned name) {
        c.gl->FramebufferTexture2D(enums::framebuffer, where, enums::texture_2d, name, 0);
    };
    unsigned buffers[most] = {};
    int count = 0;
    for (const unsigned color : colors) {
        if (count == most) break;
        buffers[count] = enums::color_attachment0 + static_cast<unsigned>(count);
        attach(buffers[count++], color);
    }
    if (depth != 0) attach(enums::depth_attachment, depth);
    c.gl->DrawBuffers(count, buffers);
    c.gl->ReadBuffer(count > 0 ? enums::color_attachment0 : enums::none);
    const unsigned status = c.gl->CheckFramebufferStatus(enums::framebuffer);
    if (problem why = c.problem_while("a framebuffer")) return why;
    if (status != enums::framebuffer_complete)
        return problem{"gnomon: a framebuffer is incomplete, status " + std::to_string(status) +
                       "; these formats cannot be drawn into here"};
    return made;
}

/// A buffer of so many bytes for ARRAY_BUFFER; `data` may be null. The problem: no memory.
[[nodiscard]] inline result<buffer> make_buffer(const context& c, std::ptrdiff_t bytes, const void* data, unsigned usage) {
    c.drop_errors();
    buffer made(c);
    if (!made) return detail::made_none("buffer");
    c.gl->BindBuffer(enums::array_buffer, made.name());
    c.gl->BufferData(enums::array_buffer, bytes, data, usage);
    if (problem why = c.problem_while("a buffer of " + std::to_string(bytes) + " bytes")) return why;
    return made;
}

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
