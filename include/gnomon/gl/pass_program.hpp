// gnomon: soft shadow maps. A program that draws over rectangles of a target.
#pragma once

#include <gnomon/gl/program.hpp>
#include <gnomon/gl/shaders.hpp>
#include <gnomon/rect.hpp>

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// A vertex stage over rectangles (rectangles_vertex_text, surfaces_vertex_text) and a fragment stage, in the context's language.
class pass_program {
  public:
    /// Owns nothing, and must not be used.
    pass_program() = default;

    /// `samplers` are set to texture units 0, 1, ... Leaves the program in use. The problem holds the driver's words.
    [[nodiscard]] static result<pass_program> make(const context& c, std::string_view vertex, const std::string& fragment,
                                                   std::initializer_list<const char*> samplers = {}) {
        const std::string header(glsl_header(glsl_version_of(c)));
        result<program> linked = make_program(c, header + std::string(vertex), header + fragment);
        if (!linked) return linked.error();
        pass_program made;
        made.program_ = *std::move(linked);
        made.size_ = made.location(c, "gnomon_size");
        c.gl->UseProgram(made.name());
        int unit = 0;
        for (const char* each : samplers) c.gl->Uniform1i(made.location(c, each), unit++);
        return made;
    }

    [[nodiscard]] unsigned name() const noexcept { return program_.name(); }
    /// Where a uniform is; -1 if it is none, which GL ignores.
    [[nodiscard]] int location(const context& c, const char* uniform) const noexcept {
        return c.gl->GetUniformLocation(name(), uniform);
    }
    /// The next draws are by this program, over a target of this size.
    void use(const context& c, extent target) const noexcept {
        c.gl->UseProgram(name());
        c.gl->Uniform2i(size_, target.width, target.height);
    }
    void forget() noexcept { program_.forget(); }

  private:
    program program_ = {};
    int size_ = -1;
};

/// What a draw reads: textures for units 0, 1, ... Leaves unit 0 active.
inline void bind_textures(const context& c, std::initializer_list<unsigned> names) noexcept {
    unsigned unit = static_cast<unsigned>(names.size());
    for (const unsigned* name = names.end(); name != names.begin();) {
        c.gl->ActiveTexture(enums::texture0 + --unit);
        c.gl->BindTexture(enums::texture_2d, *--name);
    }
}

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
