// The shader texts that are kept in golden/, for readers and for tests that run them as C++, by their file names.
#pragma once

#include <gnomon/gl/shader_caster.hpp>
#include <gnomon/gl/shader_filter.hpp>
#include <gnomon/gl/shader_receive.hpp>

#include <string>
#include <utility>
#include <vector>

namespace test {

/// A far bound that fades, and a receiver that errs the other way.
inline constexpr gnomon::rule fading{.far_bound = gnomon::towards_shadow, .fade = 0.25f, .lit_beyond = true};

inline std::vector<std::pair<std::string, std::string>> golden_texts() {
    using namespace gnomon;
    using namespace gnomon::gl;
    std::vector<std::pair<std::string, std::string>> texts{
        {"rectangles_vertex", std::string(rectangles_vertex_text)},
        {"surfaces_vertex", std::string(surfaces_vertex_text)},
        {"caster_rgba8", caster_rectangles_text<rgba8>()},
        {"caster_rgba16", caster_rectangles_text<rgba16>()},
        {"caster_rgba16f", caster_rectangles_text<rgba16f>()},
        {"caster_rgba32f", caster_rectangles_text<rgba32f>()},
        {"caster_rg32f", caster_rectangles_text<rg32f>()},
        {"caster_tm8", caster_rectangles_text<tm8>()},
        {"caster_tm16", caster_rectangles_text<tm16>()},
        {"bound_rgb8", bound_rectangles_text<rgb8>()},
        {"receive_rg8", receive_text<rg8>() + std::string(receive_texels_main_text)},
        {"receive_rg16", receive_text<rg16>() + std::string(receive_points_main_text)},
        {"receive_rg16f", receive_text<rg16f>() + std::string(receive_screen_main_text)},
        {"receive_rg32f", receive_text<rg32f>()},
        {"receive_tm8", receive_text<tm8>()},
        {"receive_rgb8", receive_text<rgb8>()},
        {"receive_rgba8_fading", receive_text<rgba8>(fading)},
        {"receive_rgb16f_fading", receive_text<rgb16f>(fading)},
        {"receive_rgb8_uniforms", receive_text<rgb8>(shader_rule<rgb8>::uniforms())},
    };
    const auto filter = [&]<texel_format Texel, kernel Kernel>(const char* name) {
        texts.emplace_back(std::string("columns_") + name, filter_columns_text<Texel, Kernel>());
        texts.emplace_back(std::string("rows_") + name, filter_rows_text<Texel, Kernel>());
    };
    filter.operator()<rg8, binomial<2>>("rg8_binomial_2");
    filter.operator()<rg16, gaussian<2>>("rg16_gaussian_2");
    filter.operator()<rg16, box<130>>("rg16_box_130");
    filter.operator()<rg16, fast<gaussian<2>>>("rg16_fast_gaussian_2");
    filter.operator()<rg8, gaussian<20>>("rg8_gaussian_20");
    filter.operator()<rg16f, tent<2>>("rg16f_tent_2");
    filter.operator()<rg32f, fast<gaussian<20>>>("rg32f_fast_gaussian_20");
    filter.operator()<rgba32f, gaussian<2>>("rgba32f_gaussian_2");
    filter.operator()<tm8, tent<1>>("tm8_tent_1");
    filter.operator()<texel<unorm8, depth_ratio, effects{.far_bound = true, .translucency = true}>, gaussian<2>>(
        "tmba8_gaussian_2");
    filter.operator()<rgba8, narrow<box<1>>>("rgba8_narrow_box_1");
    filter.operator()<rg16f, narrow<tent<2>>>("rg16f_narrow_tent_2");
    filter.operator()<rg32f, narrow<tent<2>>>("rg32f_narrow_tent_2");
    filter.operator()<rg32f, fast<box<1>>>("rg32f_fast_box_1");
    filter.operator()<rg32f, box<20>>("rg32f_box_20");
    return texts;
}

} // namespace test
