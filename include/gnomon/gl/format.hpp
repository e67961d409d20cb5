// gnomon: soft shadow maps. How a texel lies in a GL texture, whether a context can draw into it, and what to use if not.
#pragma once

#include <gnomon/gl/context.hpp>
#include <gnomon/texel/texel.hpp>

#include <cstdint>
#include <string>
#include <type_traits>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// A sized internal format, and what TexImage2D and ReadPixels are told beside it.
///
/// Uploads keep the texture's own channels and type in every context. Reads are RGBA of a type that every context can read from such
/// a target (OpenGL ES knows no other): bytes, shorts, floats, or unsigned ints for scratch.
struct format {
    const char* name;     ///< as in GL without GL_: "RG16F"
    unsigned internal;    ///< GL_RG16F
    int channels;         ///< of the texture: 2 or 4
    unsigned upload;      ///< GL_RG
    unsigned upload_type; ///< GL_HALF_FLOAT
    unsigned read;        ///< GL_RGBA, GL_RGBA_INTEGER
    unsigned read_type;   ///< GL_FLOAT

    [[nodiscard]] friend constexpr bool operator==(const format& a, const format& b) noexcept { return a.internal == b.internal; }
};

// clang-format off
inline constexpr format rg8_format     {"RG8",      enums::rg8,      2, enums::rg,           enums::type_unsigned_byte,  enums::rgba,         enums::type_unsigned_byte};
inline constexpr format rgba8_format   {"RGBA8",    enums::rgba8,    4, enums::rgba,         enums::type_unsigned_byte,  enums::rgba,         enums::type_unsigned_byte};
inline constexpr format rg16_format    {"RG16",     enums::rg16,     2, enums::rg,           enums::type_unsigned_short, enums::rgba,         enums::type_unsigned_short};
inline constexpr format rgba16_format  {"RGBA16",   enums::rgba16,   4, enums::rgba,         enums::type_unsigned_short, enums::rgba,         enums::type_unsigned_short};
inline constexpr format rg16f_format   {"RG16F",    enums::rg16f,    2, enums::rg,           enums::type_half,           enums::rgba,         enums::type_float};
inline constexpr format rgba16f_format {"RGBA16F",  enums::rgba16f,  4, enums::rgba,         enums::type_half,           enums::rgba,         enums::type_float};
inline constexpr format rg32f_format   {"RG32F",    enums::rg32f,    2, enums::rg,           enums::type_float,          enums::rgba,         enums::type_float};
inline constexpr format rgba32f_format {"RGBA32F",  enums::rgba32f,  4, enums::rgba,         enums::type_float,          enums::rgba,         enums::type_float};
inline constexpr format rg16ui_format  {"RG16UI",   enums::rg16ui,   2, enums::rg_integer,   enums::type_unsigned_short, enums::rgba_integer, enums::type_unsigned_int};
inline constexpr format rgba16ui_format{"RGBA16UI", enums::rgba16ui, 4, enums::rgba_integer, enums::type_unsigned_short, enums::rgba_integer, enums::type_unsigned_int};
inline constexpr format rg32ui_format  {"RG32UI",   enums::rg32ui,   2, enums::rg_integer,   enums::type_unsigned_int,   enums::rgba_integer, enums::type_unsigned_int};
inline constexpr format rgba32ui_format{"RGBA32UI", enums::rgba32ui, 4, enums::rgba_integer, enums::type_unsigned_int,   enums::rgba_integer, enums::type_unsigned_int};
inline constexpr format depth_format   {"DEPTH_COMPONENT32F", enums::depth_component32f, 1, enums::depth_component, enums::type_float, enums::depth_component, enums::type_float};
// clang-format on

namespace detail {

/// Of two formats the one with as many channels as the texel, or one more: there is no three-channel format that must be renderable.
[[nodiscard]] constexpr const format& wide_enough(int channels, const format& two, const format& four) noexcept {
    return channels <= 2 ? two : four;
}

template <typename Channel, int Channels> [[nodiscard]] constexpr format format_of_channel() noexcept {
    constexpr bool is_8 = std::is_same_v<Channel, unorm8>, is_16 = std::is_same_v<Channel, unorm16>,
                   is_half = std::is_same_v<Channel, half16>;
    static_assert(is_8 || is_16 || is_half || std::is_same_v<Channel, float32>,
                  "gnomon: GL stores texels of unorm8, unorm16, half16 and float32; no internal format is known for this channel");
    return is_8      ? wide_enough(Channels, rg8_format, rgba8_format)
           : is_16   ? wide_enough(Channels, rg16_format, rgba16_format)
           : is_half ? wide_enough(Channels, rg16f_format, rgba16f_format)
                     : wide_enough(Channels, rg32f_format, rgba32f_format);
}

} // namespace detail

/// Where a texel lives: channel i of the texel is channel i of the texture. Three channels go into RGBA, whose alpha is then unused.
template <texel_format Texel>
inline constexpr format format_of = detail::format_of_channel<typename Texel::channel_type, Texel::channels>();

/// What sums between two passes are kept in, exactly: `channels` unsigned numbers up to `largest`. Drawable in every context.
/// A float goes through as its bits.
[[nodiscard]] constexpr const format& scratch_format(int channels, std::uint32_t largest) noexcept {
    return largest <= 0xFFFF ? detail::wide_enough(channels, rg16ui_format, rgba16ui_format)
                             : detail::wide_enough(channels, rg32ui_format, rgba32ui_format);
}

/// Empty if maps of this texel can be drawn, filtered and bounded in the context; else what is missing. GL 3.3 lacks nothing, nor does
/// any context for unorm8.
template <texel_format Texel> [[nodiscard]] problem supports(const context& c) {
    using channel = typename Texel::channel_type;
    const auto lacks = [](const char* extension) {
        return problem{"gnomon: " + std::string(format_of<Texel>.name) + " cannot be drawn into: this context lacks " + extension};
    };
    if (std::is_same_v<channel, unorm16> && !c.norm16) return lacks("GL_EXT_texture_norm16");
    if (std::is_same_v<channel, half16> && !c.color_buffer_half)
        return lacks("GL_EXT_color_buffer_float or GL_EXT_color_buffer_half_float");
    if (std::is_same_v<channel, float32> && !c.color_buffer_float) return lacks("GL_EXT_color_buffer_float");
    if (std::is_same_v<channel, float32> && Texel::effects.far_bound && !c.float_blend)
        return problem{"gnomon: a far bound cannot be blended into " + std::string(format_of<Texel>.name) +
                       ": this context lacks GL_EXT_float_blend"};
    return {};
}

namespace detail {

template <typename... Texels> struct texel_list {};
template <typename... Channels> struct channel_list {
    template <typename R, effects E> using texels = texel_list<texel<Channels, R, E>...>;
};

/// What comes nearest to a channel, itself first. A depth that is not stored times the mask has whole codes.
template <typename Channel, bool Premultiplied> struct nearest_channels : channel_list<unorm8> {};
template <bool Premultiplied> struct nearest_channels<unorm16, Premultiplied> : channel_list<unorm16, unorm8> {};
template <> struct nearest_channels<unorm16, true> : channel_list<unorm16, half16, unorm8> {};
template <> struct nearest_channels<half16, true> : channel_list<half16, unorm16, unorm8> {};
template <> struct nearest_channels<float32, true> : channel_list<float32, unorm16, half16, unorm8> {};

} // namespace detail

/// A texel, then what comes nearest to it where a context cannot draw into its format, of the same meaning and effects:
/// float32, unorm16, half16, unorm8;  unorm16, half16, unorm8;  half16, unorm16, unorm8;  unorm8, which is drawable everywhere.
template <texel_format Texel>
using fallbacks_of =
    typename detail::nearest_channels<typename Texel::channel_type, Texel::representation_type::premultiplied>::template texels<
        typename Texel::representation_type, Texel::effects>;

/// Calls `use.template operator()<T>()` for the first T of fallbacks_of<Texel> that the context supports. Returns why Texel itself was
/// not taken; empty if it was.
///
///     auto why = gl::with_supported<rg16>(context, [&]<texel_format T>() { map = make_map<T>(context); });
template <texel_format Texel, typename Use> problem with_supported(const context& c, Use&& use) {
    const auto first = [&]<typename... Ts>(detail::texel_list<Ts...>) {
        const auto taken = [&]<typename T>() {
            if (supports<T>(c)) return false;
            use.template operator()<T>();
            return true;
        };
        (void)(taken.template operator()<Ts>() || ...);
    };
    first(fallbacks_of<Texel>{});
    return supports<Texel>(c);
}

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
