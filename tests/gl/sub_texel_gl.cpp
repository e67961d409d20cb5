// The texture unit of the GL under test before the judge: linear sampling of a filtered map, as an engine does that lets hardware blend.
#include "../support/filtering.hpp"
#include "../support/formats.hpp"
#include "../support/gl_map.hpp"
#include "../support/sub_texel.hpp"

#include <gnomon/gl/pass_program.hpp>

#include <doctest/doctest.h>

#include <vector>

namespace {
namespace gl = gnomon::gl;
constexpr gnomon::extent size{32, 24};
constexpr int across = 64; // receivers, in a square
} // namespace

TEST_CASE_TEMPLATE(
    "the texture unit blends filtered maps as well as weights of eight bits can, or at least of four, and so it decides", Texel,
    gnomon::rg8, gnomon::rg16, gnomon::rg16f, gnomon::rg32f) {
    test::in_every_gl_context([](const gl::context& c) {
        if (const auto why = gl::supports<Texel>(c)) return test::skip(why.sentence);
        if (!c.float_linear && std::is_same_v<Texel, gnomon::rg32f>) return test::skip("gnomon: RG32F has no linear filter here");
        if (const auto why = gl::supports<gnomon::rg32f>(c)) return test::skip(why.sentence); // what answers are read from
        test::dice roll(761);
        const auto soft = test::dense<gnomon::binomial<3>>(test::noise<Texel>(roll, size, 4));
        test::gl_map<Texel, gnomon::box<0>> map(c, size);
        map.write_soft(soft);
        const gl::state_guard<> forced(c);
        const auto program = gl::pass_program::make(c, gl::rectangles_vertex_text,
                                                    "uniform sampler2D map;\nuniform sampler2D positions;\nlayout(location = 0) "
                                                    "out vec4 color;\nvoid main() {\n    vec2 at = "
                                                    "texelFetch(positions, ivec2(gl_FragCoord), 0).xy;\n    color = "
                                                    "textureLod(map, at / vec2(textureSize(map, 0)), 0.0);\n}\n",
                                                    {"map", "positions"});
        REQUIRE_MESSAGE(static_cast<bool>(program), program.error().sentence);

        gnomon::image<gnomon::rg32f> at({across, across}), answers({across, across});
        test::for_each_texel(whole(at.size()), [&](int x, int y) { // on the map, half a texel from its edges
            at(x, y) = {{0.5f + 31.0f * roll.unit(), 0.5f + 23.0f * roll.unit()}};
        });
        const auto positions = gl::make_texture(c, gl::rg32f_format, at.size());
        gl::write_texels<gnomon::rg32f>(c, at.view());
        const auto answer = gl::make_texture(c, gl::rg32f_format, at.size());
        const auto into = gl::make_framebuffer(c, {answer->name()});
        auto rectangles = gl::rectangle_list::make(c);
        gl::begin_pass(c, {.framebuffer = into->name(), .size = at.size()});
        program->use(c, at.size());
        gl::bind_textures(c, {map.targets().soft, positions->name()});
        for (const unsigned filter : {gl::enums::texture_min_filter, gl::enums::texture_mag_filter})
            c.gl->TexParameteri(gl::enums::texture_2d, filter, static_cast<int>(gl::enums::linear));
        rectangles->draw(c, [](auto&& f) { f(gnomon::texel_rect{0, 0, across, across}); });
        gl::texel_reader<gnomon::rg32f> reader(at.size());
        reader.read(c, into->name(), answers.view(), whole(at.size()));

        // A unit may round what it blends to a code of the texture, and a float a few times.
        const double value_error = Texel::channel_type::whole_codes       ? 1.0 / static_cast<double>(Texel::channel_type::scale)
                                   : std::is_same_v<Texel, gnomon::rg16f> ? 0x1p-11
                                                                          : 0x1p-20;
        int verdicts[3] = {}, decisions[3] = {};
        test::for_each_texel(whole(at.size()), [&](int x, int y) {
            const double px = static_cast<double>(at(x, y).stored[0]), py = static_cast<double>(at(x, y).stored[1]);
            const double e = static_cast<double>(answers(x, y).stored[0]), m = static_cast<double>(answers(x, y).stored[1]);
            for (const auto& [channel, value] : {std::pair{0, e}, {1, m}})
                ++verdicts[static_cast<int>(test::judge<Texel>(soft.view(), px, py, channel, value, value_error))];
            const float z = roll.unit();
            const bool shadowed = e > m * (1.0 - static_cast<double>(z));
            ++decisions[static_cast<int>(test::judge_decision<Texel>(soft.view(), px, py, z, shadowed, value_error))];
        });
        test::gl_report(test::format_name<Texel>(), "texture unit: not as of 8-bit weights", 2 * across * across,
                        verdicts[1] + verdicts[2]);
        test::gl_report(test::format_name<Texel>(), "its decisions: not as of 8-bit weights", across * across,
                        decisions[1] + decisions[2]);
        if (verdicts[1] + decisions[1] > 0)
            MESSAGE("warning: this texture unit has fewer than eight bits for its weights: ", verdicts[1], " of ",
                    2 * across * across);
        CHECK(verdicts[2] == 0);
        CHECK(decisions[2] == 0);
    });
}
