// gnomon: soft shadow maps. The decision in GLSL: the formulas of receive/, evaluated with numbers that write themselves down.
#pragma once

#include <gnomon/gl/glsl.hpp>
#include <gnomon/gl/shader_caster.hpp>
#include <gnomon/gl/shader_exact.hpp>
#include <gnomon/receive/decide.hpp>

#include <cstddef>
#include <string>
#include <utility>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// A rule as the numbers of a shader: printed, or uniforms that may change without compiling anew.
template <texel_format Texel> struct shader_rule {
    using steps = bias_steps<Texel, glsl::number, glsl::number>;
    steps caster, far_bound;
    glsl::number fade;
    glsl::truth lit_beyond;
    std::string declarations = {};

    [[nodiscard]] static shader_rule printed(const rule& r) {
        return {steps::of(r.caster), steps::of(r.far_bound), glsl::number(r.fade), glsl::truth(r.lit_beyond)};
    }
    /// vec4 gnomon_caster_bias and float gnomon_caster_nearer hold bias_steps<Texel, float>::of(rule.caster), vec4 gnomon_bound_bias and
    /// float gnomon_bound_nearer those of rule.far_bound, in the order of its members; float gnomon_fade and bool gnomon_lit_beyond. The
    /// shares of whole codes are 1 and not read, and of a texel without a far bound there are only the caster's and the last.
    [[nodiscard]] static shader_rule uniforms() {
        const auto of = [](const std::string& name) {
            const auto part = [&](const char* component) { return glsl::number("gnomon_" + name + component); };
            const auto share = [&](const char* component) { // of whole codes it is 1
                return Texel::channel_type::whole_codes ? glsl::number(1) : part(component);
            };
            return steps{part("_bias.x"), share("_bias.y"), part("_bias.z"), share("_bias.w"), part("_nearer")};
        };
        std::string declarations =
            "\nuniform vec4 gnomon_caster_bias; // less of the depth, its share, more of the mask, its share\n"
            "uniform float gnomon_caster_nearer;\nuniform bool gnomon_lit_beyond;\n";
        if (Texel::effects.far_bound)
            declarations += "uniform vec4 gnomon_bound_bias;\nuniform float gnomon_bound_nearer;\nuniform float gnomon_fade;\n";
        return {of("caster"), of("bound"), glsl::number("gnomon_fade"), glsl::truth("gnomon_lit_beyond"), declarations};
    }
};

namespace detail {

/// Blends of these have more bits than a float, and are decided in parts. (Those of halves and floats are rounded to floats by `apply`,
/// and those of bytes are floats.)
template <texel_format Texel> inline constexpr bool wide_blends = Texel::channel_type::whole_codes && Texel::linear_scale > 255.0;

/// A channel of a texel in codes, or of a blend in whole codes and their fractions.
[[nodiscard]] inline glsl::number channel_of(glsl::block& body, bool wide, char component) {
    const std::string of(1, component);
    if (!wide) return glsl::number("texel." + of, &body);
    return body.let(("code_" + of).c_str(), glsl::number::wide("vec2(whole." + of + ", fraction." + of + ")", &body));
}

/// float gnomon_shadow(vec2 texel, float z): shadow(filtered, z, rule), of a texel in codes; or gnomon_shadow_of_blend.
template <texel_format Texel> [[nodiscard]] std::string decide_text(const shader_rule<Texel>& by, bool wide = false) {
    using glsl::number;
    glsl::block body;
    filtered<Texel, number> texel{};
    for (int c = 0; c < Texel::channels; ++c) texel.code[c] = channel_of(body, wide, "xyzw"[c]);
    const number z("z", &body);

    std::string no_number = "!gnomon_is_number(z)";
    if (!Texel::channel_type::whole_codes) no_number += " || !gnomon_is_number(texel.x) || !gnomon_is_number(texel.y)";
    body.say("if (" + no_number + ") return 0.0;");
    body.say("if (" + (!both(texel.mask() > number(0), gnomon::detail::may_be_shadowed(z, by.lit_beyond))).text() +
             ") return 0.0;");
    body.say("if (" + (!gnomon::detail::behind_caster(texel, z, by.caster)).text() + ") return 0.0;");
    number left(1);
    if constexpr (Texel::effects.far_bound) left = gnomon::detail::before_far_bound(texel, z, by.far_bound, by.fade);
    body.say("return " + gnomon::detail::intensity_of<Texel>(texel.contribution(), let("kept", left)).text() + ";");
    const std::string_view single = R"(
// intensity of the shadow on a receiver at depth z, by the numbers of a filtered texel in codes
float gnomon_shadow(@vec texel, float z) {
@body}
)",
                           blend = R"(
// the same by a blend, whose numbers are whole codes and their fractions
float gnomon_shadow_of_blend(@vec whole, @vec fraction, float z) {
@body}
)";
    return filled(wide ? blend : single, {{"body", body.text()}, {"vec", vec<Texel>()}});
}

/// uvec2 gnomon_read(sampler2D map, ivec2 size, ivec2 at), or vec2 of floats: a texel in codes, as `linear` has them; clear off the map.
template <texel_format Texel> [[nodiscard]] std::string read_text() {
    constexpr bool whole = Texel::channel_type::whole_codes;
    std::string codes = whole ? "return @uvec(texel * @scale + 0.5)" : "return texel";
    if (!Texel::representation_type::premultiplied) {
        codes = "@uvec codes = @uvec(texel * @scale + 0.5);\n    return codes * @uvec(";
        for (int c = 0; c < components<Texel>; ++c)
            codes += std::string(c == 0 ? "" : ", ") + (c == Texel::depth_index || c == Texel::far_index ? "codes.y" : "@wholeu");
        codes += ")";
    }
    return filled("\n// a texel in codes; clear lies off the map\n"
                  "@read gnomon_read(sampler2D map, ivec2 size, ivec2 at) {\n"
                  "    if (at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y) return @read(0);\n"
                  "    @vec texel = @vec(texelFetch(map, at, 0));\n"
                  "    " +
                      codes + ";\n}\n",
                  {{"read", vec<Texel>(whole ? "u" : "")},
                   {"scale", literal(Texel::channel_type::scale)},
                   {"whole", std::to_string(static_cast<int>(Texel::channel_type::scale))},
                   {"uvec", vec<Texel>("u")},
                   {"vec", vec<Texel>()}});
}

/// Four texels blended, as filter/sample.hpp does.
inline constexpr std::string_view sample_text = R"(
// intensity at texel `at` of a map
float gnomon_shadow(sampler2D map, ivec2 at, float z) { return gnomon_shadow(@vec(gnomon_read(map, textureSize(map, 0), at)), z); }

// intensity at a position in texels, blended from four, in steps of 1/256; off the map is lit
float gnomon_shadow_at(sampler2D map, vec2 position, float z) {
    ivec2 size = textureSize(map, 0);
    vec2 end = vec2(size) + 1.0;
    if (!gnomon_is_number(position.x) || !gnomon_is_number(position.y)) return 0.0;
    if (position.x <= -1.0 || position.y <= -1.0 || position.x >= end.x || position.y >= end.y) return 0.0;
    ivec2 fine = (ivec2(floor(512.0 * position)) - 255) >> 1; // from the centre of texel 0
    ivec2 at = fine >> 8;
    uvec2 right = uvec2(fine & 255), left = 256u - right;
    @precise@read sum = @weight(left.x * left.y) * gnomon_read(map, size, at);
    sum = sum + @weight(right.x * left.y) * gnomon_read(map, size, at + ivec2(1, 0));
    sum = sum + @weight(left.x * right.y) * gnomon_read(map, size, at + ivec2(0, 1));
    sum = sum + @weight(right.x * right.y) * gnomon_read(map, size, at + ivec2(1, 1));
    return @decision;
}
)";

} // namespace detail

/// What a receiver's fragment shader calls:
///
///     float gnomon_shadow(sampler2D map, ivec2 at, float z)            a receiver at unit depth z on texel `at`, as shadow(map(x, y), z)
///     float gnomon_shadow_at(sampler2D map, vec2 position, float z)    at a position in texels, as shadow(sample(map, x, y), z)
///
/// The map's texture needs no filter and no border; it is read with texelFetch. Whether there is shadow is decided as by the scalar
/// functions, in every bit: for texels read one by one, and for whole codes blended, exactly. (The scalar decision of blended 16-bit codes
/// and ratios is one of doubles, and rounds 57 bits to 53; of bytes up to two roundings are exact.) Blends of halves and floats are sums in
/// single precision, and decide as if z were off by 2^-20 (1 - z) + 2^-23. The intensity is the nearest float, of blends of 16-bit codes
/// and of ratios within 2^-24; past a far bound, a fade in single precision. Subnormal floats count as the driver has them, mostly as zero.
template <texel_format Texel> [[nodiscard]] std::string receive_text(const shader_rule<Texel>& by) {
    detail::check_texel<Texel>();
    constexpr bool whole = Texel::channel_type::whole_codes;
    constexpr bool wide = detail::wide_blends<Texel>;
    const char* const decision = wide ? "gnomon_shadow_of_blend(@vec(sum >> 16), @vec(sum & 0xFFFFu) * 0.0000152587890625, z)"
                                      : "gnomon_shadow(@vec(sum) * 0.0000152587890625, z)";
    std::string text = "// gnomon: receivers behind casters of " + detail::format_name<Texel>() + "\n" + std::string(exceeds_text);
    text += is_number_text;
    if (whole) text += divide_text;
    if (wide) text += "\n" + std::string(exceeds_blend_text);
    text += by.declarations + detail::decide_text<Texel>(by);
    if (wide) text += detail::decide_text<Texel>(by, true);
    return text + detail::read_text<Texel>() +
           detail::filled(detail::sample_text, {{"decision", decision},
                                                {"read", detail::vec<Texel>(whole ? "u" : "")},
                                                {"precise", whole ? "" : "precise "},
                                                {"weight", whole ? "" : "float"},
                                                {"vec", detail::vec<Texel>()}});
}
template <texel_format Texel> [[nodiscard]] std::string receive_text(const rule& r = {}) {
    return receive_text<Texel>(shader_rule<Texel>::printed(r));
}

/// @name Fragment stages that write intensities, after receive_text and rectangles_vertex_text or any vertices that cover the target.
/// Uniform sampler2D `gnomon_map`: the filtered map. Output at location 0: the intensity, in the first channel.
/// @{
/// Receivers one to one on the texels of the map; their depths in the first channel of sampler2D `gnomon_depths`.
inline constexpr std::string_view receive_texels_main_text = R"(
uniform sampler2D gnomon_map;
uniform sampler2D gnomon_depths; // of receivers, one to one on texels
layout(location = 0) out float gnomon_intensity;

void main() {
    ivec2 at = ivec2(gl_FragCoord);
    gnomon_intensity = gnomon_shadow(gnomon_map, at, texelFetch(gnomon_depths, at, 0).x);
}
)";
/// Receivers anywhere on the map: sampler2D `gnomon_points` holds x and y in texels and the depth.
inline constexpr std::string_view receive_points_main_text = R"(
uniform sampler2D gnomon_map;
uniform sampler2D gnomon_points; // of receivers: x and y in texels, depth
layout(location = 0) out float gnomon_intensity;

void main() {
    vec3 point = vec3(texelFetch(gnomon_points, ivec2(gl_FragCoord), 0));
    gnomon_intensity = gnomon_shadow_at(gnomon_map, vec2(point), point.z);
}
)";
/// What a camera sees: sampler2D `gnomon_depths` is its depth buffer, as large as the target, and mat4 `gnomon_to_map` takes
/// (x, y in pixels of it, what it holds, 1) to x and y in texels of the map and unit depth, times w.
inline constexpr std::string_view receive_screen_main_text = R"(
uniform sampler2D gnomon_map;
uniform sampler2D gnomon_depths; // of the screen
uniform mat4 gnomon_to_map;      // from pixels and their depth
layout(location = 0) out float gnomon_intensity;

void main() {
    float depth = texelFetch(gnomon_depths, ivec2(gl_FragCoord), 0).x;
    vec4 point = gnomon_to_map * vec4(gl_FragCoord.x, gl_FragCoord.y, depth, 1.0);
    gnomon_intensity = gnomon_shadow_at(gnomon_map, vec2(point) / point.w, point.z / point.w);
}
)";
/// @}

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
