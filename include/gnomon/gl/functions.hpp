// gnomon: soft shadow maps. The GL functions that gl/ calls, as a table which the host fills with its own loader.
//
// No GL header, no loader, nothing to link: the types are C++'s own, and no name begins with gl, so that this stands before or after
// glad, epoxy, GLEW and Khronos' headers, which define macros of those names.
#pragma once

#include <gnomon/config.hpp>

#include <bit>
#include <cstddef>
#include <string>
#include <type_traits>

#if defined(_WIN32) && !defined(_WIN64)
#define GNOMON_GL_CALL __stdcall
#else
#define GNOMON_GL_CALL
#endif

// clang-format off
// X(first GL version that has it, first OpenGL ES version, result, name without gl, parameters); 99 is a version that never comes.
#define GNOMON_GL_FUNCTIONS(X) \
    /* what there is */ \
    X(33, 30, const unsigned char*, GetString, (unsigned name)) \
    X(33, 30, const unsigned char*, GetStringi, (unsigned name, unsigned index)) \
    X(33, 30, unsigned, GetError, ()) \
    X(33, 30, void, GetIntegerv, (unsigned name, int* values)) \
    X(33, 30, void, GetFloatv, (unsigned name, float* values)) \
    X(33, 30, void, GetBooleanv, (unsigned name, unsigned char* values)) \
    X(33, 30, void, GetIntegeri_v, (unsigned name, unsigned index, int* values)) \
    X(33, 31, void, GetBooleani_v, (unsigned name, unsigned index, unsigned char* values)) \
    X(41, 99, void, GetFloati_v, (unsigned name, unsigned index, float* values)) \
    X(33, 30, unsigned char, IsEnabled, (unsigned what)) \
    X(33, 32, unsigned char, IsEnabledi, (unsigned what, unsigned index)) \
    X(45, 32, unsigned, GetGraphicsResetStatus, ()) \
    X(33, 30, void, Finish, ()) \
    X(33, 30, void, Flush, ()) \
    /* textures and samplers */ \
    X(33, 30, void, GenTextures, (int count, unsigned* names)) \
    X(33, 30, void, DeleteTextures, (int count, const unsigned* names)) \
    X(33, 30, void, ActiveTexture, (unsigned unit)) \
    X(33, 30, void, BindTexture, (unsigned target, unsigned name)) \
    X(33, 30, void, TexImage2D, (unsigned target, int level, int internal, int width, int height, int border, unsigned format, \
                                 unsigned type, const void* texels)) \
    X(33, 30, void, TexSubImage2D, (unsigned target, int level, int x, int y, int width, int height, unsigned format, unsigned type, \
                                    const void* texels)) \
    X(33, 30, void, TexParameteri, (unsigned target, unsigned name, int value)) \
    X(33, 30, void, PixelStorei, (unsigned name, int value)) \
    X(33, 30, void, GenSamplers, (int count, unsigned* names)) \
    X(33, 30, void, DeleteSamplers, (int count, const unsigned* names)) \
    X(33, 30, void, BindSampler, (unsigned unit, unsigned name)) \
    X(33, 30, void, SamplerParameteri, (unsigned sampler, unsigned name, int value)) \
    /* framebuffers */ \
    X(33, 30, void, GenFramebuffers, (int count, unsigned* names)) \
    X(33, 30, void, DeleteFramebuffers, (int count, const unsigned* names)) \
    X(33, 30, void, BindFramebuffer, (unsigned target, unsigned name)) \
    X(33, 30, void, FramebufferTexture2D, (unsigned target, unsigned attachment, unsigned texture_target, unsigned texture, int level)) \
    X(33, 30, unsigned, CheckFramebufferStatus, (unsigned target)) \
    X(33, 30, void, DrawBuffers, (int count, const unsigned* buffers)) \
    X(33, 30, void, ReadBuffer, (unsigned buffer)) \
    X(33, 30, void, BlitFramebuffer, (int x0, int y0, int x1, int y1, int to_x0, int to_y0, int to_x1, int to_y1, unsigned mask, \
                                      unsigned filter)) \
    X(43, 30, void, InvalidateFramebuffer, (unsigned target, int count, const unsigned* attachments)) \
    X(33, 30, void, ClearBufferfv, (unsigned buffer, int index, const float* value)) \
    X(33, 30, void, ClearBufferiv, (unsigned buffer, int index, const int* value)) \
    X(33, 30, void, ClearBufferuiv, (unsigned buffer, int index, const unsigned* value)) \
    X(33, 30, void, ClearBufferfi, (unsigned buffer, int index, float depth, int stencil)) \
    X(33, 30, void, ReadPixels, (int x, int y, int width, int height, unsigned format, unsigned type, void* texels)) \
    /* buffers and vertex arrays */ \
    X(33, 30, void, GenBuffers, (int count, unsigned* names)) \
    X(33, 30, void, DeleteBuffers, (int count, const unsigned* names)) \
    X(33, 30, void, BindBuffer, (unsigned target, unsigned name)) \
    X(33, 30, void, BufferData, (unsigned target, std::ptrdiff_t bytes, const void* data, unsigned usage)) \
    X(33, 30, void, BufferSubData, (unsigned target, std::ptrdiff_t offset, std::ptrdiff_t bytes, const void* data)) \
    X(33, 30, void, GenVertexArrays, (int count, unsigned* names)) \
    X(33, 30, void, DeleteVertexArrays, (int count, const unsigned* names)) \
    X(33, 30, void, BindVertexArray, (unsigned name)) \
    X(33, 30, void, EnableVertexAttribArray, (unsigned index)) \
    X(33, 30, void, DisableVertexAttribArray, (unsigned index)) \
    X(33, 30, void, VertexAttribPointer, (unsigned index, int size, unsigned type, unsigned char normalized, int stride, const void* offset)) \
    X(33, 30, void, VertexAttribIPointer, (unsigned index, int size, unsigned type, int stride, const void* offset)) \
    X(33, 30, void, VertexAttribDivisor, (unsigned index, unsigned divisor)) \
    X(33, 30, void, DrawArrays, (unsigned mode, int first, int count)) \
    X(33, 30, void, DrawArraysInstanced, (unsigned mode, int first, int count, int instances)) \
    X(33, 30, void, DrawElements, (unsigned mode, int count, unsigned type, const void* offset)) \
    X(33, 30, void, DrawElementsInstanced, (unsigned mode, int count, unsigned type, const void* offset, int instances)) \
    /* programs */ \
    X(33, 30, unsigned, CreateShader, (unsigned type)) \
    X(33, 30, void, DeleteShader, (unsigned shader)) \
    X(33, 30, void, ShaderSource, (unsigned shader, int count, const char* const* texts, const int* lengths)) \
    X(33, 30, void, CompileShader, (unsigned shader)) \
    X(33, 30, void, GetShaderiv, (unsigned shader, unsigned name, int* values)) \
    X(33, 30, void, GetShaderInfoLog, (unsigned shader, int capacity, int* length, char* text)) \
    X(33, 30, unsigned, CreateProgram, ()) \
    X(33, 30, void, DeleteProgram, (unsigned program)) \
    X(33, 30, void, AttachShader, (unsigned program, unsigned shader)) \
    X(33, 30, void, DetachShader, (unsigned program, unsigned shader)) \
    X(33, 30, void, BindAttribLocation, (unsigned program, unsigned index, const char* name)) \
    X(33, 30, void, LinkProgram, (unsigned program)) \
    X(33, 30, void, GetProgramiv, (unsigned program, unsigned name, int* values)) \
    X(33, 30, void, GetProgramInfoLog, (unsigned program, int capacity, int* length, char* text)) \
    X(33, 30, void, UseProgram, (unsigned program)) \
    X(33, 30, int, GetUniformLocation, (unsigned program, const char* name)) \
    X(33, 30, void, Uniform1i, (int location, int x)) \
    X(33, 30, void, Uniform2i, (int location, int x, int y)) \
    X(33, 30, void, Uniform4i, (int location, int x, int y, int z, int w)) \
    X(33, 30, void, Uniform1ui, (int location, unsigned x)) \
    X(33, 30, void, Uniform1f, (int location, float x)) \
    X(33, 30, void, Uniform2f, (int location, float x, float y)) \
    X(33, 30, void, Uniform3f, (int location, float x, float y, float z)) \
    X(33, 30, void, Uniform4f, (int location, float x, float y, float z, float w)) \
    X(33, 30, void, Uniform1fv, (int location, int count, const float* values)) \
    X(33, 30, void, Uniform1uiv, (int location, int count, const unsigned* values)) \
    X(33, 30, void, UniformMatrix4fv, (int location, int count, unsigned char transpose, const float* values)) \
    /* state */ \
    X(33, 30, void, Enable, (unsigned what)) \
    X(33, 30, void, Disable, (unsigned what)) \
    X(33, 32, void, Enablei, (unsigned what, unsigned index)) \
    X(33, 32, void, Disablei, (unsigned what, unsigned index)) \
    X(33, 30, void, Viewport, (int x, int y, int width, int height)) \
    X(41, 99, void, ViewportIndexedf, (unsigned index, float x, float y, float width, float height)) \
    X(33, 30, void, Scissor, (int x, int y, int width, int height)) \
    X(41, 99, void, ScissorIndexed, (unsigned index, int x, int y, int width, int height)) \
    X(33, 99, void, DepthRange, (double nearest, double farthest)) \
    X(41, 30, void, DepthRangef, (float nearest, float farthest)) \
    X(41, 99, void, DepthRangeIndexed, (unsigned index, double nearest, double farthest)) \
    X(41, 99, void, GetDoublei_v, (unsigned name, unsigned index, double* values)) \
    X(33, 99, void, GetDoublev, (unsigned name, double* values)) \
    X(33, 30, void, DepthFunc, (unsigned function)) \
    X(33, 30, void, DepthMask, (unsigned char write)) \
    X(33, 30, void, ColorMask, (unsigned char red, unsigned char green, unsigned char blue, unsigned char alpha)) \
    X(33, 32, void, ColorMaski, (unsigned index, unsigned char red, unsigned char green, unsigned char blue, unsigned char alpha)) \
    X(33, 30, void, BlendEquation, (unsigned mode)) \
    X(33, 30, void, BlendEquationSeparate, (unsigned color, unsigned alpha)) \
    X(40, 32, void, BlendEquationSeparatei, (unsigned index, unsigned color, unsigned alpha)) \
    X(33, 30, void, BlendFunc, (unsigned source, unsigned destination)) \
    X(33, 30, void, BlendFuncSeparate, (unsigned source, unsigned destination, unsigned source_alpha, unsigned destination_alpha)) \
    X(40, 32, void, BlendFuncSeparatei, (unsigned index, unsigned source, unsigned destination, unsigned source_alpha, \
                                         unsigned destination_alpha)) \
    X(33, 30, void, CullFace, (unsigned face)) \
    X(33, 30, void, FrontFace, (unsigned winding)) \
    X(33, 99, void, PolygonMode, (unsigned face, unsigned mode)) \
    X(45, 99, void, ClipControl, (unsigned origin, unsigned depth)) \
    X(99, 99, void, ClipControlEXT, (unsigned origin, unsigned depth)) \
    X(40, 30, void, PauseTransformFeedback, ()) \
    X(40, 30, void, ResumeTransformFeedback, ())
// clang-format on

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// Pointers named as in GL, without gl: `functions.BindTexture(...)`. Filled by `load`, or by hand.
///
/// It must outlive every context and object made of it; a host usually keeps one for each of its GL contexts. What a context of some
/// version does not have may be null, or may not: loaders return pointers for names they never heard of. So gl::context decides what
/// may be called, by version and extensions.
struct functions {
#define GNOMON_GL_MEMBER(gl_since, es_since, result, name, parameters) result(GNOMON_GL_CALL* name) parameters = nullptr;
    GNOMON_GL_FUNCTIONS(GNOMON_GL_MEMBER)
#undef GNOMON_GL_MEMBER
};

namespace detail {

/// A loader's pointer, which is void* or a pointer to some function, as the function it stands for.
template <typename Function, typename Found> [[nodiscard]] Function as_function(Found found) noexcept {
    static_assert(std::is_pointer_v<Found> && sizeof(Found) == sizeof(Function),
                  "gnomon: gl::load takes a loader that returns void* or a pointer to a function, as eglGetProcAddress does");
    return std::bit_cast<Function>(found);
}

} // namespace detail

/// Asks `get_proc_address(const char*)` for every function: eglGetProcAddress, glfwGetProcAddress, SDL_GL_GetProcAddress, or a lambda
/// around what the engine has. Many loaders answer only while a context is current, and for that one.
template <typename GetProcAddress> [[nodiscard]] functions load(GetProcAddress&& get_proc_address) {
    functions table;
#define GNOMON_GL_LOAD(gl_since, es_since, result, name, parameters)                                                               \
    table.name = detail::as_function<decltype(table.name)>(get_proc_address("gl" #name));
    GNOMON_GL_FUNCTIONS(GNOMON_GL_LOAD)
#undef GNOMON_GL_LOAD
    return table;
}

/// Names, with commas between, of the functions that a context of this version has and the table lacks. `version` is 10 * major + minor.
[[nodiscard]] inline std::string missing_functions(const functions& table, bool es, int version) {
    std::string names;
    const auto note = [&](bool there, int gl_since, int es_since, const char* name) {
        if (there || version < (es ? es_since : gl_since)) return;
        if (!names.empty()) names += ", ";
        names += name;
    };
#define GNOMON_GL_NOTE(gl_since, es_since, result, name, parameters) note(table.name != nullptr, gl_since, es_since, "gl" #name);
    GNOMON_GL_FUNCTIONS(GNOMON_GL_NOTE)
#undef GNOMON_GL_NOTE
    return names;
}

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD

#undef GNOMON_GL_FUNCTIONS
#undef GNOMON_GL_CALL
