#include <gnomon/gl/format.hpp>

#include "../support/formats.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace gl = gnomon::gl;
using namespace gnomon;

namespace {

gl::context context_of(bool es, bool norm16, bool half, bool full, bool blend) {
    gl::context c;
    c.es = es;
    c.version = es ? 30 : 33;
    c.norm16 = norm16;
    c.color_buffer_half = half;
    c.color_buffer_float = full;
    c.float_blend = blend;
    return c;
}
const gl::context everything = context_of(false, true, true, true, true);
const gl::context bare_es = context_of(true, false, false, false, false);

/// What is taken in place of a texel, and why not the texel itself.
template <typename Texel> std::string taken(const gl::context& c) {
    std::string name;
    int times = 0;
    const gl::problem why = gl::with_supported<Texel>(c, [&]<texel_format T>() {
        name = gl::format_of<T>.name;
        ++times;
        static_assert(std::is_same_v<typename T::representation_type, typename Texel::representation_type>);
        static_assert(T::effects == Texel::effects);
    });
    CHECK(times == 1);
    CHECK(static_cast<bool>(why) == static_cast<bool>(gl::supports<Texel>(c)));
    return name;
}

} // namespace

TEST_CASE("every texel has a format as wide as itself or one channel wider") {
    CHECK(gl::format_of<gnomon::rg8> == gl::rg8_format);
    CHECK(gl::format_of<rgb8> == gl::rgba8_format);
    CHECK(gl::format_of<rga16> == gl::rgba16_format);
    CHECK(gl::format_of<rg16> == gl::rg16_format);
    CHECK(gl::format_of<rg16f> == gl::rg16f_format);
    CHECK(gl::format_of<rgba16f> == gl::rgba16f_format);
    CHECK(gl::format_of<rg32f> == gl::rg32f_format);
    CHECK(gl::format_of<rgb32f> == gl::rgba32f_format);
    CHECK(gl::format_of<tm8> == gl::rg8_format);
    CHECK(gl::format_of<test::ratio_rgba16> == gl::rgba16_format);
    CHECK(gl::detail::format_of_channel<unorm8, 2>() == gl::rg8_format); // at run time, too
    CHECK(gl::detail::format_of_channel<unorm16, 3>() == gl::rgba16_format);
    CHECK(gl::detail::format_of_channel<half16, 4>() == gl::rgba16f_format);
    CHECK(gl::detail::format_of_channel<float32, 2>() == gl::rg32f_format);
    static_assert(gl::format_of<rgba8>.channels == 4 && gl::format_of<rg32f>.upload_type == gl::enums::type_float);
}

TEST_CASE("a format has the channels that it is uploaded in") {
    for (const gl::format& f :
         {gl::rg8_format, gl::rg16_format, gl::rg16f_format, gl::rg32f_format, gl::rg16ui_format, gl::rg32ui_format}) {
        CAPTURE(f.name);
        CHECK((f.upload == gl::enums::rg || f.upload == gl::enums::rg_integer));
        CHECK(f.channels == 2);
    }
    for (const gl::format& f :
         {gl::rgba8_format, gl::rgba16_format, gl::rgba16f_format, gl::rgba32f_format, gl::rgba16ui_format, gl::rgba32ui_format}) {
        CAPTURE(f.name);
        CHECK((f.upload == gl::enums::rgba || f.upload == gl::enums::rgba_integer));
        CHECK(f.channels == 4);
    }
    CHECK(gl::depth_format.channels == 1);
}

TEST_CASE("scratch holds what it is said to hold, and not twice as much") {
    CHECK(gl::scratch_format(2, 65535) == gl::rg16ui_format);
    CHECK(gl::scratch_format(2, 65536) == gl::rg32ui_format);
    CHECK(gl::scratch_format(2, 0xFFFFFFFF) == gl::rg32ui_format);
    CHECK(gl::scratch_format(3, 0) == gl::rgba16ui_format);
    CHECK(gl::scratch_format(4, 65536) == gl::rgba32ui_format);
}

TEST_CASE("a desktop context supports every texel, ES 3.0 by itself eight bits alone") {
    CHECK_FALSE(gl::supports<gnomon::rg8>(everything));
    CHECK_FALSE(gl::supports<rgba16>(everything));
    CHECK_FALSE(gl::supports<rg16f>(everything));
    CHECK_FALSE(gl::supports<rgba32f>(everything));
    CHECK_FALSE(gl::supports<gnomon::rg8>(bare_es));
    CHECK_FALSE(gl::supports<rgba8>(bare_es));
    CHECK_FALSE(gl::supports<tm8>(bare_es));
    CHECK(gl::supports<rg16>(bare_es).sentence == "gnomon: RG16 cannot be drawn into: this context lacks GL_EXT_texture_norm16");
    CHECK(gl::supports<rgb16f>(bare_es).sentence ==
          "gnomon: RGBA16F cannot be drawn into: this context lacks GL_EXT_color_buffer_float or GL_EXT_color_buffer_half_float");
    CHECK(gl::supports<rg32f>(bare_es).sentence ==
          "gnomon: RG32F cannot be drawn into: this context lacks GL_EXT_color_buffer_float");
}

TEST_CASE("only a far bound blends, so only it needs blending of floats") {
    const gl::context no_blend = context_of(true, false, true, true, false);
    CHECK_FALSE(gl::supports<rg32f>(no_blend));
    CHECK_FALSE(gl::supports<rga32f>(no_blend));
    CHECK_FALSE(gl::supports<rgb16f>(no_blend));
    CHECK(gl::supports<rgb32f>(no_blend).sentence ==
          "gnomon: a far bound cannot be blended into RGBA32F: this context lacks GL_EXT_float_blend");
}

TEST_CASE("what a context cannot draw into is replaced in the order that is written down") {
    const gl::context norm_only = context_of(true, true, false, false, false),
                      half_only = context_of(true, false, true, false, false);
    CHECK(taken<rg32f>(everything) == "RG32F");
    CHECK(taken<rg32f>(norm_only) == "RG16");
    CHECK(taken<rg32f>(half_only) == "RG16F");
    CHECK(taken<rg32f>(bare_es) == "RG8");
    CHECK(taken<rg16>(everything) == "RG16");
    CHECK(taken<rg16>(half_only) == "RG16F");
    CHECK(taken<rgba16>(bare_es) == "RGBA8");
    CHECK(taken<rg16f>(norm_only) == "RG16");
    CHECK(taken<rg16f>(bare_es) == "RG8");
    CHECK(taken<gnomon::rg8>(bare_es) == "RG8");
    CHECK(taken<rgb32f>(context_of(true, false, true, true, false)) == "RGBA16F");
}

TEST_CASE("a ratio is replaced by whole codes alone") {
    CHECK(taken<tm16>(context_of(true, false, true, true, true)) == "RG8");
    CHECK(taken<tm16>(everything) == "RG16");
    CHECK(taken<tm8>(bare_es) == "RG8");
}
