// gnomon: soft shadow maps. The filter in GLSL: a pass over columns into sums, a pass over those in rows, one rounding.
#pragma once

#include <gnomon/filter/separable.hpp>
#include <gnomon/gl/shader_caster.hpp>
#include <gnomon/gl/shader_exact.hpp>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// The kernel that GL filters with. Whole codes: as it is. GL has no double, so half and float are always filtered as by fast<Kernel>;
/// an engine's rule has filter_roundings<Texel, kernel_in_gl<Texel, Kernel>>.
template <texel_format Texel, kernel Kernel>
using kernel_in_gl =
    std::conditional_t<Texel::channel_type::whole_codes || gnomon::detail::is_fast<Kernel> || gnomon::detail::is_narrow<Kernel>,
                       Kernel, fast<Kernel>>;

namespace detail {

/// The numbers of a filter in GL, from the plan of filter/separable.hpp.
template <texel_format Texel, kernel Kernel> struct filter_in_gl {
    using by = gnomon::detail::sums<Texel, kernel_in_gl<Texel, Kernel>>;
    using weights_of = typename by::weights_of;
    static constexpr bool whole_codes = Texel::channel_type::whole_codes, ratio = !Texel::representation_type::premultiplied;
    static constexpr auto scale = static_cast<std::uint64_t>(Texel::channel_type::scale);
    static constexpr auto total = static_cast<std::uint64_t>(weights_of::total);
    /// The largest number that a tap of the first pass and one of the second can be, and what the last sum is divided by.
    static constexpr std::uint64_t most = ratio ? scale * scale : scale, most_between = by::stored_between ? most : most * total;
    static constexpr std::uint64_t whole = by::stored_between ? total : total * total;
    static constexpr bool two_words = whole_codes && most * whole + whole / 2 > 0xFFFFFFFFu; ///< a sum of the second pass
    static constexpr bool narrow = gnomon::detail::is_narrow<Kernel>;
    /// Small kernels are written out, tap by tap; larger ones are loops over a table of weights, but boxes.
    static constexpr bool written_out = Kernel::radius <= 16;
    /// How far from the centre taps have one weight, if all beyond have one too: so have those of a box. Else -1.
    static constexpr int alike = [] {
        constexpr int first = lesser(Kernel::radius, whole_codes ? 0 : 1); // the centre of floats is not in the loop
        const auto at = [](int away) { return weights_of::weights[static_cast<std::size_t>(Kernel::radius + away)]; };
        int last = first;
        while (last < Kernel::radius && at(last + 1) == at(first)) ++last;
        for (int away = last + 1; away <= Kernel::radius; ++away)
            if (at(away) != at(Kernel::radius)) return -1;
        return last;
    }();
    static_assert(
        !whole_codes || most * total <= 0xFFFFFFFFu,
        "gnomon: sums of this texel and kernel do not fit the scratch of GL; tm16 is for the CPU, in GL take tm8 or rg16");
};

} // namespace detail

/// The largest number that the first pass leaves to the second, for each channel an unsigned integer; half and float leave a float's
/// bits. So the scratch is RG16UI, RG32UI, RGBA16UI or RGBA32UI; 0 by a narrow kernel, whose scratch is a texture like the map's.
template <texel_format Texel, kernel Kernel>
inline constexpr std::uint32_t filter_scratch_largest =
    detail::filter_in_gl<Texel, Kernel>::narrow ? 0u
    : Texel::channel_type::whole_codes          ? static_cast<std::uint32_t>(detail::filter_in_gl<Texel, Kernel>::most_between)
                                                : 0xFFFFFFFFu;

namespace detail {

/// "vec2(f(v.x), f(v.y))" from "f(v." and ")"
template <texel_format Texel> [[nodiscard]] std::string each_component(const std::string& before, const std::string& after) {
    std::string text = vec<Texel>() + "(";
    for (int c = 0; c < components<Texel>; ++c) (text += c == 0 ? "" : ", ") += before + "xyzw"[c] + after;
    return text + ")";
}

/// `gnomon_add(weight, away)` for every tap of whole codes; of floats from the centre outwards, two taps at a time, as the scalar filter
/// sums them.
template <texel_format Texel, kernel Kernel> [[nodiscard]] std::string taps_text() {
    using of = filter_in_gl<Texel, Kernel>;
    const auto weight = [](int tap) {
        if constexpr (of::whole_codes)
            return literal(static_cast<std::uint32_t>(of::weights_of::weights[static_cast<std::size_t>(tap)]));
        else
            return literal(of::by::template weight<float>(tap));
    };
    const int nearest = of::whole_codes ? -Kernel::radius : 1;
    const std::string first = literal(nearest), last = literal(Kernel::radius);
    std::string text = of::whole_codes ? "" : "    gnomon_sum = " + weight(Kernel::radius) + " * gnomon_at(0);\n";
    if (of::written_out) {
        for (int away = nearest; away <= Kernel::radius; ++away)
            text += "    gnomon_add(" + weight(Kernel::radius + away) + ", " + literal(away) + ");\n";
        return text;
    }
    const std::string inner = weight(Kernel::radius + lesser(Kernel::radius, 1)), outer = weight(0);
    const std::string each = of::alike < 0                 ? "gnomon_weights[abs(away)]"
                             : of::alike == Kernel::radius ? outer
                                                           : "abs(away) <= " + literal(of::alike) + " ? " + inner + " : " + outer;
    return text + "    for (int away = " + first + "; away <= " + last + "; ++away) gnomon_add(" + each + ", away);\n";
}

/// The weights from the centre outwards, if taps_text needs a table.
template <texel_format Texel, kernel Kernel> [[nodiscard]] std::string weights_text() {
    using of = filter_in_gl<Texel, Kernel>;
    if (of::written_out || of::alike >= 0) return "";
    const std::string array = (of::whole_codes ? "uint[" : "float[") + literal(Kernel::radius + 1) + "]";
    std::string text = "\nconst " + array + " gnomon_weights = " + array + "(";
    for (int i = 0; i <= Kernel::radius; ++i) {
        text += i == 0 ? "" : i % 16 == 0 ? ",\n    " : ", ";
        if constexpr (of::whole_codes)
            text += literal(static_cast<std::uint32_t>(of::weights_of::weights[static_cast<std::size_t>(Kernel::radius + i)]));
        else
            text += literal(of::by::template weight<float>(Kernel::radius + i));
    }
    return text + "); // from the centre outwards\n";
}

/// "(e, m) of unorm8 by 7 taps"
template <texel_format Texel, kernel Kernel> [[nodiscard]] std::string filter_name() {
    using of = filter_in_gl<Texel, Kernel>;
    return format_name<Texel>() + " by " + literal(2 * Kernel::radius + 1) + " taps of together " +
           literal(static_cast<int>(of::total));
}

/// Two taps more of one weight, rounded as a pair, as a product and in the sum.
inline constexpr std::string_view add_floats_text = R"(    precise @vec both = gnomon_at(-away) + gnomon_at(away);
    precise @vec product = weight * both;
    gnomon_sum = gnomon_sum + product;
)";

/// A pass, filled: first what is its own, then what both passes have alike, whose sums are parts of `whole`.
template <texel_format Texel, kernel Kernel>
[[nodiscard]] std::string filled_pass(const std::string& text, std::uint64_t whole, std::initializer_list<filling> own) {
    using of = filter_in_gl<Texel, Kernel>;
    return filled(filled(text, own), {{"weights", weights_text<Texel, Kernel>()},
                                      {"taps", taps_text<Texel, Kernel>()},
                                      {"scale", literal(Texel::channel_type::scale)},
                                      {"half", std::to_string(whole / 2)},
                                      {"whole", std::to_string(whole)},
                                      {"zero", (of::whole_codes ? vec<Texel>("u") : vec<Texel>()) + "(0)"},
                                      {"sum", of::whole_codes ? vec<Texel>("u") : "precise " + vec<Texel>()},
                                      {"number", of::whole_codes ? "uint" : "float"},
                                      {"uvec", vec<Texel>("u")},
                                      {"vec", vec<Texel>()}});
}

/// How whole codes are read in the first pass: as a linear filter has to see them.
template <texel_format Texel> [[nodiscard]] std::string linear_text() {
    const std::string codes = vec<Texel>("u") + "(gnomon_at(away) * " + literal(Texel::channel_type::scale) + " + 0.5)";
    if (Texel::representation_type::premultiplied) return codes;
    std::string text = vec<Texel>("u") + "(";
    for (int c = 0; c < components<Texel>; ++c) {
        const std::string code = std::string("codes.") + "xyzw"[c];
        text += (c == 0 ? "" : ", ") + code + (c == Texel::depth_index || c == Texel::far_index ? " * codes.y" : "");
    }
    return text + ")";
}

} // namespace detail

/// The first pass: the weighted sums of the 2R+1 texels above and below, or floats' bits of them, into the unsigned integers of the
/// scratch. Uniform sampler2D `gnomon_texels`: the map of casters, whose size is the map's; what lies above and below is clear.
///
/// To be drawn over the columns that the second pass reads: each rectangle grown by R to the left and right, clipped to the map.
template <texel_format Texel, kernel Kernel> [[nodiscard]] std::string filter_columns_text() {
    detail::check_texel<Texel>();
    static_assert(kernel_is_sound<Kernel>());
    using of = detail::filter_in_gl<Texel, Kernel>;
    using detail::vec;
    constexpr bool is_half = std::is_same_v<typename Texel::channel_type, half16>;
    std::string text = "// gnomon: columns of " + detail::filter_name<Texel, Kernel>() + "\n";
    if (of::narrow && is_half) text += std::string(half_text) + "\n";
    text += R"(uniform sampler2D gnomon_texels;
layout(location = 0) out @stored gnomon_sums;
@weights
@sum gnomon_sum = @zero;
int gnomon_height = 0; // the map's; asked once a fragment, since asking costs a GPU more than fetching a texel

@vec gnomon_at(int away) {
    ivec2 at = ivec2(gl_FragCoord) + ivec2(0, away);
    if (at.y < 0 || at.y >= gnomon_height) return @vec(0);
    return @vec(texelFetch(gnomon_texels, at, 0));
}

void gnomon_add(@number weight, int away) {
)";
    if constexpr (!of::whole_codes)
        text += detail::add_floats_text;
    else if constexpr (of::ratio)
        text += "    @uvec codes = @uvec(gnomon_at(away) * @scale + 0.5);\n    gnomon_sum += weight * @linear;\n";
    else
        text += "    gnomon_sum += weight * @linear;\n";
    text += "}\n\nvoid main() {\n    gnomon_height = textureSize(gnomon_texels, 0).y;\n@taps    gnomon_sums = @result;\n}\n";
    const std::string result = of::narrow && is_half            ? detail::each_component<Texel>("gnomon_half(gnomon_sum.", ")")
                               : of::narrow && !of::whole_codes ? "gnomon_sum"
                               : of::narrow                     ? "@vec((gnomon_sum + @halfu) / @wholeu) / @scale"
                               : !of::whole_codes               ? "floatBitsToUint(gnomon_sum)"
                               : of::by::stored_between         ? "(gnomon_sum + @halfu) / @wholeu"
                                                                : "gnomon_sum";
    return detail::filled_pass<Texel, Kernel>(text, of::total,
                                              {{"linear", of::whole_codes ? detail::linear_text<Texel>() : ""},
                                               {"result", result},
                                               {"stored", vec<Texel>(of::narrow ? "" : "u")}});
}

namespace detail {

/// What the sums of whole codes become: divided once, to nearest, halves upwards, a ratio down.
template <texel_format Texel, kernel Kernel> [[nodiscard]] std::string division_text() {
    using of = filter_in_gl<Texel, Kernel>;
    constexpr bool shifts = of::whole == std::uint64_t{1} << 32;
    std::string text;
    if (of::two_words) {
        text += "\n// the sums of a channel as two words, the high one first\n"
                "uvec2 gnomon_words(uint low, uint high) {\n"
                "    uint word = low + (high << 16);\n"
                "    return uvec2((high >> 16) + (word < low ? 1u : 0u), word);\n}\n";
        if (!shifts || of::ratio) text += "\n" + std::string(quotient_text);
        text += "\n// a share of the whole, to nearest, halves upwards\nuint gnomon_nearest(uvec2 sum) {\n"
                "    uint word = sum.y + @halfu;\n";
        text += shifts ? "    return sum.x + (word < sum.y ? 1u : 0u);\n}\n"
                       : "    return gnomon_quotient(uvec2(sum.x + (word < sum.y ? 1u : 0u), word), uvec2(0u, @wholeu));\n}\n";
    } else if (of::ratio) {
        text += "\n// a share of the whole, to nearest, halves upwards\nuint gnomon_nearest(uint sum) { return (sum + @halfu) / "
                "@wholeu; }\n";
    }
    return text;
}

/// The codes of the second pass, as an expression.
template <texel_format Texel, kernel Kernel> [[nodiscard]] std::string codes_text() {
    using of = filter_in_gl<Texel, Kernel>;
    if constexpr (!of::two_words && !of::ratio) return "(gnomon_sum + @halfu) / @wholeu";
    const auto sum = [](int c) {
        const std::string name(1, "xyzw"[c]);
        return of::two_words ? "gnomon_words(gnomon_low." + name + ", gnomon_high." + name + ")" : "gnomon_sum." + name;
    };
    std::string text = vec<Texel>("u") + "(";
    for (int c = 0; c < components<Texel>; ++c) {
        const bool depth = of::ratio && (c == Texel::depth_index || c == Texel::far_index);
        text += c == 0 ? "" : ", ";
        text += !depth          ? "gnomon_nearest(" + sum(c) + ")"
                : of::two_words ? "gnomon_quotient(" + sum(c) + ", " + sum(1) + ")"
                                : sum(c) + " / " + sum(1);
    }
    return text + ")";
}

} // namespace detail

/// The second pass and the last rounding: the map's texels from the sums of the first. Uniform usampler2D `gnomon_sums`: the scratch,
/// as large as the map (a sampler2D by a narrow kernel). What lies to the left and right of it is clear; of it no more is read than R
/// columns beside a rectangle.
template <texel_format Texel, kernel Kernel> [[nodiscard]] std::string filter_rows_text() {
    detail::check_texel<Texel>();
    static_assert(kernel_is_sound<Kernel>());
    using of = detail::filter_in_gl<Texel, Kernel>;
    using detail::vec;
    constexpr bool is_half = std::is_same_v<typename Texel::channel_type, half16>;
    std::string text = "// gnomon: rows of " + detail::filter_name<Texel, Kernel>() + "\n";
    if (is_half) text += std::string(half_text) + "\n";
    text += R"(uniform @sampler gnomon_sums;
layout(location = 0) out @vec gnomon_texel;
@weights@division
)";
    text += of::two_words ? "@uvec gnomon_low = @zero, gnomon_high = @zero; // sums of the low and the high 16 bits\n"
                          : "@sum gnomon_sum = @zero;\n";
    text += R"(int gnomon_width = 0; // the map's

@sums gnomon_at(int away) {
    ivec2 at = ivec2(gl_FragCoord) + ivec2(away, 0);
    if (at.x < 0 || at.x >= gnomon_width) return @sums(0);
    return @fetch;
}

void gnomon_add(@number weight, int away) {
)";
    text += !of::whole_codes ? detail::add_floats_text
            : of::two_words  ? "    @uvec sums = gnomon_at(away);\n    gnomon_low += weight * (sums & 0xFFFFu);\n"
                               "    gnomon_high += weight * (sums >> 16);\n"
                             : "    gnomon_sum += weight * gnomon_at(away);\n";
    text += "}\n\nvoid main() {\n    gnomon_width = textureSize(gnomon_sums, 0).x;\n@taps";
    if constexpr (!of::whole_codes) {
        text += "    gnomon_texel = ";
        const std::string halves = detail::each_component<Texel>("gnomon_half(gnomon_sum.", ")");
        text += is_half ? halves : "gnomon_sum";
    } else {
        if (of::ratio)
            text += std::string("    if (gnomon_nearest(") +
                    (of::two_words ? "gnomon_words(gnomon_low.y, gnomon_high.y)" : "gnomon_sum.y") +
                    ") == 0u) {\n        gnomon_texel = @vec(0);\n        return;\n    }\n";
        text += "    @uvec codes = @codes;\n    gnomon_texel = @vec(codes) / @scale";
    }
    text += ";\n}\n";
    const char* const fetch = of::narrow && of::whole_codes ? "@uvec(@vec(texelFetch(gnomon_sums, at, 0)) * @scale + 0.5)"
                              : of::narrow                  ? "@vec(texelFetch(gnomon_sums, at, 0))"
                              : of::whole_codes             ? "@uvec(texelFetch(gnomon_sums, at, 0))"
                                                            : "uintBitsToFloat(@uvec(texelFetch(gnomon_sums, at, 0)))";
    return detail::filled_pass<Texel, Kernel>(text, of::whole,
                                              {{"sampler", of::narrow ? "sampler2D" : "usampler2D"},
                                               {"fetch", fetch},
                                               {"sums", of::whole_codes ? vec<Texel>("u") : vec<Texel>()},
                                               {"division", detail::division_text<Texel, Kernel>()},
                                               {"codes", detail::codes_text<Texel, Kernel>()}});
}

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
