// gnomon: soft shadow maps. The caster pass in GLSL: what a surface at a depth writes into the map, and what a far bound does.
#pragma once

#include <gnomon/gl/shader_exact.hpp>
#include <gnomon/texel/texel.hpp>

#include <concepts>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// The vertex stage of every pass over rectangles: four vertices a strip, one instance a rectangle.
///
/// Attribute 0, ivec4, of divisor 1: x0, y0, x1, y1 in texels. Uniform `gnomon_size`: the size of the target in texels.
inline constexpr std::string_view rectangles_vertex_text =
    R"(// gnomon: rectangles of texels, one an instance, a strip of four vertices each
layout(location = 0) in ivec4 gnomon_rectangle; // x0, y0, x1, y1
uniform ivec2 gnomon_size;                      // of the target

void main() {
    ivec2 corner = ivec2((gl_VertexID & 1) == 0 ? gnomon_rectangle.x : gnomon_rectangle.z,
                         (gl_VertexID & 2) == 0 ? gnomon_rectangle.y : gnomon_rectangle.w);
    gl_Position = vec4(2.0 * vec2(corner) / vec2(gnomon_size) - 1.0, 0.0, 1.0);
}
)";

/// The same with attribute 1, vec2, of divisor 1: depth and opacity of a rectangle that casts or bounds.
inline constexpr std::string_view surfaces_vertex_text =
    R"(// gnomon: rectangles of texels and their depths, one an instance, a strip of four vertices each
layout(location = 0) in ivec4 gnomon_rectangle; // x0, y0, x1, y1
layout(location = 1) in vec2 gnomon_surface;    // depth, opacity
uniform ivec2 gnomon_size;                      // of the target
flat out vec2 gnomon_depth_opacity;

void main() {
    ivec2 corner = ivec2((gl_VertexID & 1) == 0 ? gnomon_rectangle.x : gnomon_rectangle.z,
                         (gl_VertexID & 2) == 0 ? gnomon_rectangle.y : gnomon_rectangle.w);
    gl_Position = vec4(2.0 * vec2(corner) / vec2(gnomon_size) - 1.0, 0.0, 1.0);
    gnomon_depth_opacity = gnomon_surface;
}
)";

namespace detail {

/// What a shader calls a texel's format: "unorm8 depth_mask", and its channels.
template <texel_format Texel> [[nodiscard]] std::string format_name() {
    using channel_type = typename Texel::channel_type;
    std::string name = std::same_as<channel_type, unorm8>    ? "unorm8"
                       : std::same_as<channel_type, unorm16> ? "unorm16"
                       : std::same_as<channel_type, half16>  ? "half16"
                                                             : "float32";
    name += Texel::representation_type::premultiplied ? " (e, m" : " (t, m";
    if (Texel::effects.far_bound) name += ", far bound";
    if (Texel::effects.translucency) name += ", contribution";
    return name + ")";
}

/// What GLSL keeps a texel in; three channels live in four.
template <texel_format Texel> inline constexpr int components = Texel::channels == 2 ? 2 : 4;

/// "vec2" or "vec4", and of another kind "uvec2".
template <texel_format Texel> [[nodiscard]] std::string vec(const char* kind = "") {
    return kind + ("vec" + literal(components<Texel>));
}

/// Texels that GL can hold and these shaders understand.
template <texel_format Texel> consteval void check_texel() {
    static_assert(
        !std::same_as<typename Texel::representation_type, paper_depth_mask>,
        "gnomon: paper_depth_mask is a baseline for comparisons on the CPU: in GL use depth_mask, whose clear value is zero");
}

/// float gnomon_code(float v), of a share, and float gnomon_complement(float z), of a depth, as Channel::encode and
/// Representation::encode have them, to the code.
inline constexpr std::string_view encode_unorm_text = R"(
// the code nearest to @scale v, halves upwards; 0 if v is not a number
float gnomon_code(float v) {
    if (!gnomon_is_number(v) || v <= 0.0) return 0.0;
    if (v >= 1.0) return @scale;
    float code = floor(@scale * v + 0.5); // or one more: rounding keeps the order, so never less
    return gnomon_exceeds(-@scale, v, 0.5 - code) ? code - 1.0 : code;
}
)";
inline constexpr std::string_view complement_unorm_text = R"(
// the code nearest to @scale (1 - z); the only tie is half way, and goes upwards
float gnomon_complement(float z) {
    if (!gnomon_is_number(z) || z >= 1.0) return 0.0;
    return z == 0.5 ? @half : @scale - gnomon_code(z);
}
)";
inline constexpr std::string_view complement_ratio_text = R"(
// the largest code that is not nearer to the light than z
float gnomon_complement(float z) {
    if (!gnomon_is_number(z) || z >= 1.0) return 0.0;
    if (z <= 0.0) return @scale;
    float code = floor(@scale - @scale * z); // or one more: rounding keeps the order, so never less
    return gnomon_exceeds(@scale, z, @scale - code) ? code - 1.0 : code;
}
)";
inline constexpr std::string_view encode_half_text = R"(
// the half nearest to v
float gnomon_code(float v) {
    if (!gnomon_is_number(v) || v <= 0.0) return 0.0;
    return v < 1.0 ? gnomon_half(v) : 1.0;
}

// the half nearest to 1 - z, which a float cannot tell for all z before 1/2; whole numbers of 2^-25 can
float gnomon_complement(float z) {
    if (!gnomon_is_number(z) || z >= 1.0) return 0.0;
    if (z <= 0.0) return 1.0;
    if (z >= 0.5) return gnomon_half(1.0 - z);
    float units = z * 16777216.0;
    uint whole = uint(units), more = float(whole) < units ? 1u : 0u;
    return float(gnomon_nearest_even(33554432u - 2u * whole - more, 14)) * 0.00048828125;
}
)";
inline constexpr std::string_view encode_float_text = R"(
float gnomon_code(float v) {
    if (!gnomon_is_number(v) || v <= 0.0) return 0.0;
    return v < 1.0 ? v : 1.0;
}

float gnomon_complement(float z) {
    if (!gnomon_is_number(z) || z >= 1.0) return 0.0;
    return z > 0.0 ? 1.0 - z : 1.0;
}
)";

template <texel_format Texel> [[nodiscard]] std::string encode_text() {
    using channel_type = typename Texel::channel_type;
    const float scale = channel_type::scale;
    std::string text;
    if constexpr (channel_type::whole_codes)
        (((text = exceeds_text) += is_number_text) += encode_unorm_text) +=
            Texel::representation_type::premultiplied ? complement_unorm_text : complement_ratio_text;
    else if constexpr (std::same_as<channel_type, half16>)
        ((text = half_text) += is_number_text) += encode_half_text;
    else
        (text = is_number_text.substr(1)) += encode_float_text;
    return filled(text, {{"scale", literal(scale)}, {"half", literal(0.5f * (scale + 1.0f))}});
}

/// gnomon_order: what a depth buffer of 32-bit floats keeps of a surface. What is stored nearer to the light is more, of two at one
/// stored depth the more opaque; and anything is more than the empty buffer, which holds 0.
///
/// A float in [2^-126, 1] is one of 126 * 2^23 numbers, so there is room for any two codes of unorm8 or half16; of unorm16 and float32
/// for the depth and for 13 or nearly 6 bits of the contribution.
template <texel_format Texel> [[nodiscard]] std::string order_text() {
    using channel_type = typename Texel::channel_type;
    constexpr bool whole = channel_type::whole_codes;
    if constexpr (!Texel::effects.translucency) {
        return filled("\n// what is stored nearer to the light is more, and anything is more than the empty buffer\n"
                      "void gnomon_order(float complement) { gl_FragDepth = max(complement@order, 2.98023224e-8); }\n",
                      {{"order", whole ? " * " + literal(1.0f / (channel_type::scale + 1.0f)) : ""}});
    } else {
        std::string text =
            "\n// what is stored nearer to the light is more, of equals the more opaque; anything is more than the empty "
            "buffer\n";
        if (std::same_as<channel_type, half16>)
            text += "uint gnomon_rank(float v) { return v > 0.0 ? (floatBitsToUint(v) >> 13) - 105471u : 0u; } // of halves in [0, "
                    "1]\n";
        return text + "void gnomon_order(float complement, float contribution) {\n    gl_FragDepth = uintBitsToFloat(0x800000u + " +
               (std::same_as<channel_type, half16>    ? "gnomon_rank(complement) * 24578u + gnomon_rank(contribution)"
                : std::same_as<channel_type, float32> ? "uint(complement * 16777216.0) * 62u + uint(contribution * 61.0)"
                : std::same_as<channel_type, unorm16> ? "uint(complement) * 8192u + uint(contribution) / 8u"
                                                      : "uint(complement) * 256u + uint(contribution)") +
               ");\n}\n";
    }
}

} // namespace detail

/// What a fragment of a caster or of a receiver that bounds calls, for an engine's own fragment shader:
///
///     void gnomon_caster(float s)                 an opaque caster at unit depth s, as Texel::caster(s)
///     void gnomon_caster(float s, float opacity)  one that lets light through; only of a texel with translucency
///     void gnomon_bound(float z)                  a receiver at unit depth z ends the shadow, as Texel::bound(z); only with far bound
///
/// Each writes the output `gnomon_texel` at location 0, to the very code that the scalar function stores, and gl_FragDepth, whose
/// order is that of the stored codes: state must be GREATER on a 32-bit float depth buffer cleared to 0 for casters; LEQUAL, depth
/// writes off, only the far channel's colour mask, and blending MAX for bounds. Of surfaces at one stored depth the more opaque
/// stays, and the first of two whose contributions are within 1/8192 in unorm16, or 1/61 in float32. Float texels: within the precision of the driver's subtraction, and opacities below 2^-126 may be none.
template <texel_format Texel> [[nodiscard]] std::string caster_text() {
    detail::check_texel<Texel>();
    using channel_type = typename Texel::channel_type;
    constexpr bool four = detail::components<Texel> == 4, whole = channel_type::whole_codes;
    constexpr auto make = [](std::string_view depth, std::string_view mask, std::string_view bound, std::string_view share) {
        std::string text = four ? "vec4(" : "vec2(";
        (text += depth) += ", ";
        text += mask;
        if (Texel::effects.far_bound) (text += ", ") += bound;
        if (Texel::effects.translucency) (text += ", ") += share;
        if (Texel::channels == 3) text += ", 0.0";
        return text + ')';
    };
    std::string text = "// gnomon: casters of " + detail::format_name<Texel>() + "\n" + detail::encode_text<Texel>();
    text += detail::filled("\nlayout(location = 0) out @vec gnomon_texel;\n", {{"vec", four ? "vec4" : "vec2"}});
    text += detail::order_text<Texel>();
    text += detail::filled(R"(
void gnomon_caster(float s) {
    float complement = gnomon_complement(s);
    gnomon_order(complement@most);
    gnomon_texel = @opaque;
}
)",
                           {{"most", Texel::effects.translucency ? ", " + detail::literal(channel_type::scale) : ""},
                            {"opaque", make("complement@share", "1.0", "0.0", "1.0")}});
    if (Texel::effects.translucency)
        text += detail::filled(R"(
void gnomon_caster(float s, float opacity) {
    float complement = gnomon_complement(s), contribution = gnomon_code(opacity);
    gnomon_order(complement, contribution);
    gnomon_texel = @translucent;
}
)",
                               {{"translucent", make("complement@share", "1.0", "0.0", "contribution@share")}});
    if (Texel::effects.far_bound)
        text += detail::filled(
            R"(
void gnomon_bound(float z) {
    float complement = gnomon_complement(z);
    gnomon_order(complement@least);
    gnomon_texel = @bound;
}
)",
            {{"least", Texel::effects.translucency ? ", 0.0" : ""}, {"bound", make("0.0", "0.0", "complement@share", "0.0")}});
    return detail::filled(text, {{"share", whole ? " / " + detail::literal(channel_type::scale) : ""}});
}

/// The fragment stage for rectangles of casters, after surfaces_vertex_text.
template <texel_format Texel> [[nodiscard]] std::string caster_rectangles_text() {
    return caster_text<Texel>() + "\nflat in vec2 gnomon_depth_opacity;\n\nvoid main() { gnomon_caster(gnomon_depth_opacity.x" +
           (Texel::effects.translucency ? ", gnomon_depth_opacity.y" : "") + "); }\n";
}

/// The fragment stage for rectangles that bound, after surfaces_vertex_text.
template <texel_format Texel>
    requires(Texel::effects.far_bound)
[[nodiscard]] std::string bound_rectangles_text() {
    return caster_text<Texel>() + "\nflat in vec2 gnomon_depth_opacity;\n\nvoid main() { gnomon_bound(gnomon_depth_opacity.x); }\n";
}

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
