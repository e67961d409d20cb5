// gnomon: soft shadow maps. GLSL as text: the line a shader begins with, numbers as GLSL writes them, and how a text is filled in.
#pragma once

#include <gnomon/config.hpp>

#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// The shading languages that gnomon writes. Texts are the same in all of them, but for the lines they begin with.
enum class glsl_version {
    desktop_330, ///< OpenGL 3.3 core; `precise` where there is ARB_gpu_shader5, with which `sample` is a keyword too
    desktop_400, ///< OpenGL 4.0 core and later: `precise` keeps a product and a sum from being fused
    es_300,      ///< OpenGL ES 3.0, WebGL2
    es_320,      ///< OpenGL ES 3.2: `precise`, too
};

/// What goes before any shader text of gnomon: the version, full precision, and nothing in place of `precise` where it is unknown.
[[nodiscard]] constexpr std::string_view glsl_header(glsl_version version) noexcept {
    if (version == glsl_version::desktop_330)
        return "#version 330 core\n#ifdef GL_ARB_gpu_shader5\n#extension GL_ARB_gpu_shader5 : enable\n"
               "#else\n#define precise\n#endif\n";
    if (version == glsl_version::desktop_400) return "#version 400 core\n";
    if (version == glsl_version::es_320)
        return "#version 320 es\nprecision highp float;\nprecision highp int;\n"
               "precision highp sampler2D;\nprecision highp usampler2D;\n";
    return "#version 300 es\n#define precise\nprecision highp float;\nprecision highp int;\n"
           "precision highp sampler2D;\nprecision highp usampler2D;\n";
}

namespace detail {

/// A float in GLSL: the fewest digits that are read back as the same; what is not finite as its bits.
[[nodiscard]] inline std::string literal(float v) {
    char digits[64];
    if (!(v - v <= 0.0f)) return "uintBitsToFloat(" + std::to_string(std::bit_cast<std::uint32_t>(v)) + "u)";
    const auto end = std::to_chars(digits, digits + sizeof digits, v).ptr;
    std::string text(digits, end);
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}
/// A whole number in GLSL: 3 as int, 3u as uint.
[[nodiscard]] inline std::string literal(int v) { return std::to_string(v); }
[[nodiscard]] inline std::string literal(std::uint32_t v) { return std::to_string(v) + 'u'; }

/// A word of a template and what stands for it.
struct filling {
    std::string_view word;
    std::string text;
};

/// A text in which every word after an at sign is replaced.
[[nodiscard]] inline std::string filled(std::string_view text, std::initializer_list<filling> fillings) {
    std::string result(text);
    for (const filling& each : fillings) {
        const std::string word = '@' + std::string(each.word);
        for (std::size_t at = result.find(word); at != std::string::npos; at = result.find(word, at + each.text.size()))
            result.replace(at, word.size(), each.text);
    }
    return result;
}

} // namespace detail
} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
