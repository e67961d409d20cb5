// What gnomon is measured beside, in GLSL: written here, plainly, as the authors named at each describe it.
//
// Receivers' texts end in `float bench_light(vec2 texel, float z)`: how much light reaches depth z at a position in texels of
// `map`. Depths grow away from the light, and the map's clear depth is 1.
#pragma once

#include <gnomon/filter/kernel.hpp>

#include <string>
#include <string_view>

namespace bench_gl {

/// Casters and all else that is drawn into a map; their own depth is the position's.
inline constexpr std::string_view mesh_vertex_text = R"(
layout(location = 0) in vec3 bench_position; // in the map and away from the light, each in [0, 1]
out float bench_depth;

void main() {
    bench_depth = bench_position.z;
    gl_Position = vec4(2.0 * bench_position - 1.0, 1.0);
}
)";
inline constexpr std::string_view screen_vertex_text =
    "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }\n";

/// After a receiver's text: x, y and z from `points`, to the intensity of the shadow.
inline constexpr std::string_view receive_main_text = R"(
uniform sampler2D points;
layout(location = 0) out float bench_intensity;

void main() {
    vec3 point = vec3(texelFetch(points, ivec2(gl_FragCoord), 0));
    bench_intensity = 1.0 - bench_light(vec2(point), point.z);
}
)";

/// @name Percentage closer filtering: a depth map alone, compared by the sampler, which blends 2 x 2 comparisons.
/// @{
inline constexpr std::string_view pcf_casters_text = "void main() {}\n";

/// What a comparing sampler gives by itself: W. Reeves, D. Salesin, R. Cook, Rendering Antialiased Shadows with Depth Maps, 1987.
inline constexpr std::string_view pcf_2x2_text = R"(
uniform sampler2DShadow map;
const float bias = 0.001;

float bench_light(vec2 texel, float z) { return texture(map, vec3(texel / vec2(textureSize(map, 0)), z - bias)); }
)";
/// I. Castano, Shadow Mapping Summary, Part 1, 2013: four comparing samples for taps of 1, 2, 1. The derivation is his for 5x5.
inline constexpr std::string_view pcf_3x3_text = R"(
uniform sampler2DShadow map;
const float bias = 0.001;

float bench_light(vec2 texel, float z) {
    vec2 size = vec2(textureSize(map, 0)), base = floor(texel + 0.5), st = texel + 0.5 - base;
    base -= 0.5;
    vec2 w0 = 3.0 - 2.0 * st, w1 = 1.0 + 2.0 * st;
    vec2 p0 = (base + (2.0 - st) / w0 - 1.0) / size, p1 = (base + st / w1 + 1.0) / size;
    z -= bias;
    float sum = w0.x * w0.y * texture(map, vec3(p0.x, p0.y, z)) + w1.x * w0.y * texture(map, vec3(p1.x, p0.y, z));
    sum += w0.x * w1.y * texture(map, vec3(p0.x, p1.y, z)) + w1.x * w1.y * texture(map, vec3(p1.x, p1.y, z));
    return sum / 16.0;
}
)";
/// The same, his own text: nine comparing samples for taps of 1, 3, 4, 3, 1.
inline constexpr std::string_view pcf_5x5_text = R"(
uniform sampler2DShadow map;
const float bias = 0.001;

float bench_light(vec2 texel, float z) {
    vec2 size = vec2(textureSize(map, 0)), base = floor(texel + 0.5), st = texel + 0.5 - base;
    base -= 0.5;
    vec2 w0 = 4.0 - 3.0 * st, w2 = 1.0 + 3.0 * st;
    const float w1 = 7.0;
    vec2 p0 = (base + (3.0 - 2.0 * st) / w0 - 2.0) / size, p1 = (base + (3.0 + st) / w1) / size, p2 = (base + st / w2 + 2.0) / size;
    z -= bias;
    float sum = w0.x * w0.y * texture(map, vec3(p0.x, p0.y, z)) + w1 * w0.y * texture(map, vec3(p1.x, p0.y, z));
    sum += w2.x * w0.y * texture(map, vec3(p2.x, p0.y, z)) + w0.x * w1 * texture(map, vec3(p0.x, p1.y, z));
    sum += w1 * w1 * texture(map, vec3(p1.x, p1.y, z)) + w2.x * w1 * texture(map, vec3(p2.x, p1.y, z));
    sum += w0.x * w2.y * texture(map, vec3(p0.x, p2.y, z)) + w1 * w2.y * texture(map, vec3(p1.x, p2.y, z));
    sum += w2.x * w2.y * texture(map, vec3(p2.x, p2.y, z));
    return sum / 144.0;
}
)";
/// @}

/// @name Variance shadow maps: W. Donnelly, A. Lauritzen, Variance Shadow Maps, 2006, and A. Lauritzen, GPU Gems 3, chapter 8: two
/// moments in 32-bit floats, blurred, Chebyshev's bound. No mip levels, and no reduction of bleeding, which trades leaks for hard
/// edges.
/// @{
inline constexpr std::string_view vsm_casters_text = R"(
in float bench_depth;
layout(location = 0) out vec2 moments;

void main() {
    vec2 slope = vec2(dFdx(bench_depth), dFdy(bench_depth));
    moments = vec2(bench_depth, bench_depth * bench_depth + 0.25 * dot(slope, slope));
}
)";
inline constexpr std::string_view vsm_text = R"(
uniform sampler2D map;
const float least_variance = 0.00002;

float bench_light(vec2 texel, float z) {
    vec2 moments = vec2(texture(map, texel / vec2(textureSize(map, 0))));
    float variance = max(moments.y - moments.x * moments.x, least_variance), behind = z - moments.x;
    return behind <= 0.0 ? 1.0 : variance / (variance + behind * behind);
}
)";
/// @}

/// @name Exponential variance shadow maps: A. Lauritzen, M. McCool, Layered Variance Shadow Maps, 2008, with both warps, in 32-bit
/// floats; exponents 40 and 5 and the bias as in M. Pettineo, A Sampling of Shadow Techniques, 2013.
/// @{
inline constexpr std::string_view evsm_warp_text = R"(
const vec2 exponents = vec2(40.0, 5.0);

vec2 bench_warp(float z) {
    vec2 warped = exp(exponents * vec2(2.0 * z - 1.0, 1.0 - 2.0 * z));
    return vec2(warped.x, -warped.y);
}
)";
inline constexpr std::string_view evsm_casters_text = R"(
in float bench_depth;
layout(location = 0) out vec4 moments;

void main() {
    vec2 warped = bench_warp(bench_depth);
    moments = vec4(warped, warped * warped);
}
)";
inline constexpr std::string_view evsm_text = R"(
uniform sampler2D map;

float bench_light(vec2 texel, float z) {
    vec4 moments = texture(map, texel / vec2(textureSize(map, 0)));
    vec2 warped = bench_warp(z), slope = 0.0001 * exponents * warped;
    vec2 variance = max(vec2(moments.z, moments.w) - vec2(moments) * vec2(moments), slope * slope), behind = warped - vec2(moments);
    vec2 light = variance / (variance + behind * behind);
    return min(behind.x <= 0.0 ? 1.0 : light.x, behind.y <= 0.0 ? 1.0 : light.y);
}
)";
/// @}

/// gnomon's own pair as an engine may write it that wants no exactness: floats, the sampler's blend, a constant for three roundings
/// of eight bits and one for the caster's own. It shows what the library's exact receiver and filter cost.
inline constexpr std::string_view plain_text = R"(
uniform sampler2D map;
const float step = 1.0 / 255.0;

float bench_light(vec2 texel, float z) {
    vec2 pair = vec2(texture(map, texel / vec2(textureSize(map, 0))));
    return pair.x - 1.5 * step > (pair.y + 1.5 * step) * (1.0 + 0.5 * step - z) ? 1.0 - pair.y : 1.0;
}
)";

/// One pass of a separable blur along `step`, "1, 0" or "0, 1": sums of floats, clamped to the edge.
template <gnomon::kernel Kernel> [[nodiscard]] std::string blur_text(const std::string& step) {
    std::string text = R"(
uniform sampler2D map;
layout(location = 0) out vec4 blurred;

vec4 tap(int away) {
    ivec2 at = ivec2(gl_FragCoord) + away * ivec2()" +
                       step + R"();
    return texelFetch(map, clamp(at, ivec2(0), textureSize(map, 0) - 1), 0);
}

void main() {
    blurred = vec4(0.0);
)";
    for (int tap = -Kernel::radius; tap <= Kernel::radius; ++tap)
        text += "    blurred += " + std::to_string(Kernel::weights[static_cast<std::size_t>(tap + Kernel::radius)]) + ".0 / " +
                std::to_string(Kernel::total) + ".0 * tap(" + std::to_string(tap) + ");\n";
    return text + "}\n";
}

} // namespace bench_gl
