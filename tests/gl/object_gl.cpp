#include <gnomon/gl/format.hpp>
#include <gnomon/gl/object.hpp>
#include <gnomon/gl/program.hpp>
#include <gnomon/gl/state.hpp>

#include "../support/egl.hpp"
#include "../support/formats.hpp"

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace gl = gnomon::gl;
namespace enums = gnomon::gl::enums;
using namespace gnomon;

namespace {

/// Bytes of a texel's storage for channel c of texel i: every code of 8 bits, and of 16 bits or floats many, all in [0, 1].
template <typename Storage> Storage stored(std::size_t i) {
    if constexpr (std::is_same_v<Storage, float>)
        return static_cast<float>(i % 4096) / 4095.0f;
    else
        return static_cast<Storage>(i * 37);
}
template <typename Channel> std::vector<typename Channel::storage> texels_of(std::size_t count) {
    std::vector<typename Channel::storage> texels(count);
    for (std::size_t i = 0; i < count; ++i) texels[i] = stored<typename Channel::storage>(i);
    if constexpr (std::is_same_v<Channel, half16>)
        for (auto& t : texels) t = static_cast<std::uint16_t>(t % 0x3C01); // halves from 0 to 1
    return texels;
}
/// What a read gives for a stored number: the code of a unorm, the value of a half or a float.
template <typename Channel> float read_back(const void* texels, std::size_t i) {
    if constexpr (std::is_same_v<Channel, unorm8>)
        return static_cast<const std::uint8_t*>(texels)[i];
    else if constexpr (std::is_same_v<Channel, unorm16>)
        return static_cast<const std::uint16_t*>(texels)[i];
    else
        return static_cast<const float*>(texels)[i];
}

} // namespace

TEST_CASE_TEMPLATE("a texture that a context supports gives back every number put into it", Texel, gnomon::rg8, rg16, rg16f, rg32f,
                   rgba8, rgba16, rgba16f, rgba32f) {
    test::in_every_gl_context([](const gl::context& c) {
        using channel = typename Texel::channel_type;
        constexpr gl::format f = gl::format_of<Texel>;
        if (const gl::problem why = gl::supports<Texel>(c)) return test::skip(why.sentence);
        constexpr int width = 61, height = 67;
        const gl::state_guard guard(c);
        const auto made = gl::make_texture(c, f, {width, height});
        REQUIRE(made);
        const auto texels = texels_of<channel>(std::size_t{width} * height * f.channels);
        c.gl->TexSubImage2D(enums::texture_2d, 0, 0, 0, width, height, f.upload, f.upload_type, texels.data());
        const auto frame = gl::make_framebuffer(c, {made->name()});
        REQUIRE_MESSAGE(static_cast<bool>(frame), frame.error().sentence);
        std::vector<float> read(4 * width * height);
        c.gl->ReadPixels(0, 0, width, height, f.read, f.read_type, read.data());
        int wrong = 0;
        for (std::size_t i = 0; i < texels.size(); ++i) {
            const std::size_t at = i / f.channels * 4 + i % f.channels;
            wrong += std::bit_cast<std::uint32_t>(read_back<channel>(read.data(), at)) !=
                     std::bit_cast<std::uint32_t>(channel::code(texels[i]));
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE("scratch of whole numbers can be drawn into and read in every context") {
    test::in_every_gl_context([](const gl::context& c) {
        const gl::state_guard guard(c);
        for (const gl::format& f : {gl::rg16ui_format, gl::rg32ui_format, gl::rgba16ui_format, gl::rgba32ui_format}) {
            CAPTURE(f.name);
            const auto made = gl::make_texture(c, f, {3, 2});
            REQUIRE(made);
            const auto frame = gl::make_framebuffer(c, {made->name()});
            REQUIRE_MESSAGE(static_cast<bool>(frame), frame.error().sentence);
            const unsigned most = f.upload_type == enums::type_unsigned_short ? 0xFFFFu : 0xFFFFFFFFu;
            const unsigned value[4] = {most, most - 1, 1, 0};
            c.gl->ClearBufferuiv(enums::color, 0, value);
            unsigned read[4 * 6] = {};
            c.gl->ReadPixels(0, 0, 3, 2, f.read, f.read_type, read);
            CHECK(read[20] == most);
            CHECK(read[21] == most - 1);
            if (f.channels == 4) CHECK(read[22] == 1);
        }
    });
}

TEST_CASE("a depth buffer of floats makes every target complete") {
    test::in_every_gl_context([](const gl::context& c) {
        const gl::state_guard guard(c);
        const auto color = gl::make_texture(c, gl::rgba8_format, {5, 9}), depth = gl::make_texture(c, gl::depth_format, {5, 9});
        REQUIRE((color && depth));
        CHECK(gl::make_framebuffer(c, {color->name()}, depth->name()));
    });
}

TEST_CASE("a real driver's complaint about a shader reaches the message") {
    test::in_every_gl_context([](const gl::context& c) {
        const std::string version = c.es ? "#version 300 es\n" : "#version 330 core\n";
        const std::string vertex = version + "void main() { gl_Position = vec4(0); }\n";
        const auto made = gl::make_program(c, vertex, version + "out highp vec4 color;\nvoid main() { color = sundial; }\n");
        REQUIRE_FALSE(made);
        CHECK(made.error().sentence.find("gnomon: the driver rejects the fragment shader: ") == 0);
        CHECK(made.error().sentence.find("sundial") != std::string::npos);
        const auto unlinked = gl::make_program(
            c, vertex,
            version + "out highp vec4 color;\nhighp vec4 defined_nowhere();\nvoid main() { color = defined_nowhere(); }\n");
        REQUIRE_FALSE(unlinked);
        CHECK(unlinked.error().sentence.find("gnomon: the driver does not link the program: ") == 0);
    });
}
