// gnomon: soft shadow maps. A program of GL from its texts, or the driver's words why not.
#pragma once

#include <gnomon/gl/object.hpp>

#include <initializer_list>
#include <string>
#include <string_view>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

namespace detail {

/// The log of a shader or program, without what ends it.
template <auto Get, auto GetLog> [[nodiscard]] std::string log_of(const functions& gl, unsigned name) {
    int length = 0;
    (gl.*Get)(name, enums::info_log_length, &length);
    if (length <= 1) return "the driver says nothing";
    std::string text(static_cast<std::size_t>(length), '\0');
    (gl.*GetLog)(name, length, nullptr, text.data());
    text = text.c_str();
    while (text.ends_with('\n') || text.ends_with(' ')) text.pop_back();
    return text;
}

/// Empty if it compiled. The text need not end with a zero.
[[nodiscard]] inline problem compile(const functions& gl, unsigned shader, std::string_view text, const char* stage) {
    const char* const start = text.data();
    const int length = static_cast<int>(text.size());
    gl.ShaderSource(shader, 1, &start, &length);
    gl.CompileShader(shader);
    int compiled = 0;
    gl.GetShaderiv(shader, enums::compile_status, &compiled);
    if (compiled != 0) return {};
    return problem{std::string("gnomon: the driver rejects the ") + stage +
                   " shader: " + log_of<&functions::GetShaderiv, &functions::GetShaderInfoLog>(gl, shader)};
}

} // namespace detail

/// Where a vertex attribute is found, for texts that do not say.
struct attribute {
    unsigned index;
    const char* name;
};

/// Compiles and links. The problem holds the driver's log. Uses no program, and leaves that in use alone.
[[nodiscard]] inline result<program> make_program(const context& c, std::string_view vertex, std::string_view fragment,
                                                  std::initializer_list<attribute> attributes = {}) {
    const functions& gl = *c.gl;
    const object<detail::shader_kind<enums::vertex_shader>> first(c);
    const object<detail::shader_kind<enums::fragment_shader>> second(c);
    program made(c);
    if (!first || !second || !made) return detail::made_none("program");
    if (problem why = detail::compile(gl, first.name(), vertex, "vertex")) return why;
    if (problem why = detail::compile(gl, second.name(), fragment, "fragment")) return why;
    gl.AttachShader(made.name(), first.name());
    gl.AttachShader(made.name(), second.name());
    for (const attribute& a : attributes) gl.BindAttribLocation(made.name(), a.index, a.name);
    gl.LinkProgram(made.name());
    gl.DetachShader(made.name(), first.name()); // else they live as long as the program
    gl.DetachShader(made.name(), second.name());
    int linked = 0;
    gl.GetProgramiv(made.name(), enums::link_status, &linked);
    if (linked == 0)
        return problem{"gnomon: the driver does not link the program: " +
                       detail::log_of<&functions::GetProgramiv, &functions::GetProgramInfoLog>(gl, made.name())};
    return made;
}

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
