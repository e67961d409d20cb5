// gnomon: soft shadow maps. The GL constants that gl/ uses, by GL's names in small letters; no macro of a GL header can touch them.
//
// Where a C++ keyword, a type of gnomon's or a macro of somebody's stands in the way: type_float, blend_min, back_face.
#pragma once

#include <gnomon/config.hpp>

namespace gnomon::inline GNOMON_BUILD {
namespace gl::enums {

// clang-format off
/// @name Answers
/// @{
inline constexpr unsigned no_error = 0, invalid_enum = 0x0500, invalid_value = 0x0501, invalid_operation = 0x0502, out_of_memory = 0x0505,
    invalid_framebuffer_operation = 0x0506, context_lost = 0x0507, context_lost_webgl = 0x9242;
inline constexpr unsigned vendor = 0x1F00, renderer = 0x1F01, version = 0x1F02, extensions = 0x1F03, num_extensions = 0x821D;
inline constexpr unsigned max_texture_size = 0x0D33, max_draw_buffers = 0x8824, max_viewports = 0x825B, max_clip_distances = 0x0D32,
    max_combined_texture_image_units = 0x8B4D;
inline constexpr unsigned framebuffer_complete = 0x8CD5, compile_status = 0x8B81, link_status = 0x8B82, info_log_length = 0x8B84;
/// @}

/// @name Internal formats, and the formats and types of what is uploaded and read back
/// @{
inline constexpr unsigned rg8 = 0x822B, rgba8 = 0x8058, rg16 = 0x822C, rgba16 = 0x805B, rg16f = 0x822F, rgba16f = 0x881A, rg32f = 0x8230,
    rgba32f = 0x8814, rg16ui = 0x823A, rgba16ui = 0x8D76, rg32ui = 0x823C, rgba32ui = 0x8D70, r8 = 0x8229, r32f = 0x822E, r32ui = 0x8236,
    depth_component16 = 0x81A5, depth_component24 = 0x81A6, depth_component32f = 0x8CAC, depth24_stencil8 = 0x88F0;
inline constexpr unsigned red = 0x1903, rg = 0x8227, rgb = 0x1907, rgba = 0x1908, red_integer = 0x8D94, rg_integer = 0x8228,
    rgba_integer = 0x8D99, depth_component = 0x1902, implementation_color_read_type = 0x8B9A, implementation_color_read_format = 0x8B9B;
inline constexpr unsigned type_unsigned_byte = 0x1401, type_unsigned_short = 0x1403, type_int = 0x1404, type_unsigned_int = 0x1405,
    type_float = 0x1406, type_half = 0x140B;
/// @}

/// @name Textures, framebuffers, buffers
/// @{
inline constexpr unsigned texture0 = 0x84C0, texture_2d = 0x0DE1, active_texture = 0x84E0, texture_binding_2d = 0x8069, sampler_binding = 0x8919;
inline constexpr unsigned texture_mag_filter = 0x2800, texture_min_filter = 0x2801, texture_wrap_s = 0x2802, texture_wrap_t = 0x2803,
    texture_max_level = 0x813D, texture_compare_mode = 0x884C, nearest = 0x2600, linear = 0x2601, clamp_to_edge = 0x812F, repeat = 0x2901;
inline constexpr unsigned framebuffer = 0x8D40, draw_framebuffer = 0x8CA9, read_framebuffer = 0x8CA8, draw_framebuffer_binding = 0x8CA6,
    read_framebuffer_binding = 0x8CAA, color_attachment0 = 0x8CE0, depth_attachment = 0x8D00, color = 0x1800, depth = 0x1801, stencil = 0x1802;
inline constexpr unsigned color_buffer_bit = 0x4000, depth_buffer_bit = 0x0100, none = 0;
inline constexpr unsigned array_buffer = 0x8892, element_array_buffer = 0x8893, pixel_pack_buffer = 0x88EB, pixel_unpack_buffer = 0x88EC,
    array_buffer_binding = 0x8894, pixel_pack_buffer_binding = 0x88ED, pixel_unpack_buffer_binding = 0x88EF, vertex_array_binding = 0x85B5;
inline constexpr unsigned static_draw = 0x88E4, dynamic_draw = 0x88E8, stream_draw = 0x88E0;
inline constexpr unsigned points = 0x0000, triangles = 0x0004, triangle_strip = 0x0005, triangle_fan = 0x0006;
inline constexpr unsigned vertex_shader = 0x8B31, fragment_shader = 0x8B30, current_program = 0x8B8D;
/// @}

/// @name State
/// @{
inline constexpr unsigned blend = 0x0BE2, color_logic_op = 0x0BF2, cull_face = 0x0B44, depth_clamp = 0x864F, depth_test = 0x0B71,
    dither = 0x0BD0, framebuffer_srgb = 0x8DB9, polygon_offset_fill = 0x8037, polygon_smooth = 0x0B41, primitive_restart = 0x8F9D,
    rasterizer_discard = 0x8C89, sample_alpha_to_coverage = 0x809E, sample_alpha_to_one = 0x809F, sample_coverage = 0x80A0,
    sample_mask = 0x8E51, scissor_test = 0x0C11, stencil_test = 0x0B90, clip_distance0 = 0x3000;
inline constexpr unsigned viewport = 0x0BA2, scissor_box = 0x0C10, depth_range = 0x0B70, depth_func = 0x0B74, depth_writemask = 0x0B72,
    color_writemask = 0x0C23, cull_face_mode = 0x0B45, front_face = 0x0B46, polygon_mode = 0x0B40, clip_origin = 0x935C,
    clip_depth_mode = 0x935D, transform_feedback_active = 0x8E24, transform_feedback_paused = 0x8E23;
inline constexpr unsigned blend_src_rgb = 0x80C9, blend_dst_rgb = 0x80C8, blend_src_alpha = 0x80CB, blend_dst_alpha = 0x80CA,
    blend_equation_rgb = 0x8009, blend_equation_alpha = 0x883D;
inline constexpr unsigned zero = 0, one = 1, func_add = 0x8006, blend_min = 0x8007, blend_max = 0x8008;
inline constexpr unsigned never = 0x0200, less = 0x0201, equal = 0x0202, lequal = 0x0203, greater = 0x0204, gequal = 0x0206, always = 0x0207;
inline constexpr unsigned front = 0x0404, back_face = 0x0405, front_and_back = 0x0408, clockwise = 0x0900, counter_clockwise = 0x0901,
    fill = 0x1B02, line = 0x1B01, lower_left = 0x8CA1, upper_left = 0x8CA2, negative_one_to_one = 0x935E, zero_to_one = 0x935F;
/// @}

/// @name How texels lie in the host's memory: PixelStorei's names
/// @{
inline constexpr unsigned unpack_alignment = 0x0CF5, unpack_row_length = 0x0CF2, unpack_skip_rows = 0x0CF3, unpack_skip_pixels = 0x0CF4,
    unpack_swap_bytes = 0x0CF0, unpack_lsb_first = 0x0CF1;
inline constexpr unsigned pack_alignment = 0x0D05, pack_row_length = 0x0D02, pack_skip_rows = 0x0D03, pack_skip_pixels = 0x0D04,
    pack_swap_bytes = 0x0D00, pack_lsb_first = 0x0D01;
/// @}
// clang-format on

} // namespace gl::enums
} // namespace gnomon::inline GNOMON_BUILD
