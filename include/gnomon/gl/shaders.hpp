// gnomon: soft shadow maps. Every shader text of gnomon, and which language a context speaks.
//
//     header + surfaces_vertex_text       with    header + caster_rectangles_text<Texel>(), bound_rectangles_text<Texel>()
//     header + rectangles_vertex_text     with    header + filter_columns_text<Texel, Kernel>(), filter_rows_text<Texel, Kernel>()
//     header + rectangles_vertex_text     with    header + receive_text<Texel>(rule) + receive_texels_main_text, or another main
#pragma once

#include <gnomon/gl/context.hpp>
#include <gnomon/gl/shader_caster.hpp>
#include <gnomon/gl/shader_filter.hpp>
#include <gnomon/gl/shader_receive.hpp>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// The latest language of those gnomon writes that a context is sure to compile.
[[nodiscard]] inline glsl_version glsl_version_of(const context& c) noexcept {
    if (c.es) return c.version >= 32 ? glsl_version::es_320 : glsl_version::es_300;
    return c.version >= 40 ? glsl_version::desktop_400 : glsl_version::desktop_330;
}

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
