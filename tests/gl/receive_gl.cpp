// Decisions on GL against `scalar`: one to one on texels, at points, on the screen; every rule, at the depth where shadow begins.
#include "../support/bits.hpp"
#include "../support/filtering.hpp"
#include "../support/formats.hpp"
#include "../support/gl_map.hpp"

#include <gnomon/gl/backend.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

namespace {
namespace gl = gnomon::gl;
using gnomon::extent;
using gnomon::image;
using gnomon::rule;
using test::dice;

std::vector<rule> rules() {
    return {{},
            {.caster = gnomon::unbiased, .far_bound = gnomon::unbiased},
            {.caster = gnomon::towards_shadow, .far_bound = gnomon::towards_shadow},
            {.lit_beyond = true},
            {.caster = {.roundings = 2, .depth = 0.125f}, .far_bound = {.depth = 0.03125f}},
            {.caster = {.caster_is_code = true}}};
}

/// Filtered texels, and where codes are whole any at all.
template <typename Texel> std::vector<Texel> texels(dice& roll, int count) {
    const extent size{count, 8};
    const image<Texel> soft = test::dense<gnomon::binomial<3>>(test::noise<Texel>(roll, size, 3));
    std::vector<Texel> found;
    for (int i = 0; i < count; ++i) {
        found.push_back(soft(i, 4));
        if constexpr (Texel::channel_type::whole_codes)
            if (roll.one_in(3))
                for (auto& code : found.back().stored) code = static_cast<typename Texel::storage>(roll(0, 65535));
    }
    return found;
}

/// Depths beside the caster's and beside what is rounded away of it, and depths that are none.
template <typename Texel> float depth_for(dice& roll, const Texel& t) {
    constexpr float odd[] = {
        0.0f, -0.0f, 1.0f, 0.5f, -1.0f, 2.0f, 0x1p-126f, 3e38f, test::infinity<float>, -test::infinity<float>, test::nan<float>};
    if (roll.one_in(6)) return odd[roll(0, 10)];
    float z = gnomon::caster_depth(t);
    if (roll.one_in(2)) z += gnomon::caster_depth_error<Texel>.nearer;
    for (int steps = roll(-2, 2); steps != 0; steps += steps < 0 ? 1 : -1) z = std::nextafter(z, steps < 0 ? -1.0f : 2.0f);
    if (roll.one_in(4)) z = roll.unit();
    return std::fabs(z) < 0x1p-126f ? 0.0f : z; // a driver may take a subnormal number for nothing, and llvmpipe does
}

struct differing {
    int decisions = 0, intensities = 0;
    float most = 0.0f;
    void note(float made, float expected) {
        decisions += (made > 0.0f) != (expected > 0.0f);
        intensities += !test::same_bits(made, expected);
        most = std::fmax(most, std::fabs(made - expected));
    }
};
} // namespace

TEST_CASE_TEMPLATE("GL decides as scalar does, in every bit, receivers one to one on texels", Texel, gnomon::rg8, gnomon::rg16,
                   gnomon::rg16f, gnomon::rg32f, gnomon::rgb8, gnomon::rga16, gnomon::rgba16f, gnomon::rgba32f, gnomon::tm8,
                   test::ratio_rgba8) {
    test::in_every_gl_context([](const gl::context& c) {
        if (const auto why = gl::supports<Texel>(c)) return test::skip(why.sentence);
        const gl::backend run(c);
        dice roll(721);
        constexpr int count = 3000; // more than one line
        const std::vector<Texel> on = texels<Texel>(roll, count);
        std::vector<float> z, made(count), expected(count);
        for (const Texel& t : on) z.push_back(depth_for(roll, t));
        differing found;
        int dark = 0;
        for (const rule& r : rules()) {
            gnomon::receive(on, z, expected, r);
            gnomon::receive(run, on, z, made, r);
            CHECK(run.problem().sentence == "");
            for (std::size_t i = 0; i < count; ++i) {
                found.note(made[i], expected[i]);
                dark += expected[i] > 0.0f;
            }
        }
        test::gl_report(test::format_name<Texel>(), "decisions", 6 * count, found.decisions);
        test::gl_report(test::format_name<Texel>(), "intensities", 6 * count, found.intensities);
        CHECK(found.decisions == 0);
        CHECK(found.intensities == 0);
        CHECK(dark > count);
    });
}

TEST_CASE("GL fades a shadow past its far bound as scalar does, to 2^-18") {
    test::in_every_gl_context([](const gl::context& c) {
        const gl::backend run(c);
        dice roll(722);
        constexpr int count = 2000;
        const auto on = texels<gnomon::rgba8>(roll, count);
        std::vector<float> z, made(count), expected(count);
        for (int i = 0; i < count; ++i) z.push_back(roll.unit());
        const rule r{.fade = 0.25f};
        gnomon::receive(on, z, expected, r);
        gnomon::receive(run, on, z, made, r);
        float most = 0.0f;
        for (std::size_t i = 0; i < count; ++i) most = std::fmax(most, std::fabs(made[i] - expected[i]));
        CHECK(most <= 0x1p-18f);
    });
}

TEST_CASE_TEMPLATE("GL decides at points as scalar does: whole codes in every bit", Texel, gnomon::rg8, gnomon::rga8, gnomon::rg16,
                   gnomon::tm8) {
    test::in_every_gl_context([](const gl::context& c) {
        if (const auto why = gl::supports<Texel>(c)) return test::skip(why.sentence);
        const gl::backend run(c);
        dice roll(723);
        const image<Texel> map = test::dense<gnomon::binomial<3>>(test::noise<Texel>(roll, {31, 23}, 3));
        constexpr int count = 4000;
        constexpr float odd[] = {
            test::nan<float>, test::infinity<float>, -test::infinity<float>, 1e30f, -1e30f, -0.75f, 31.5f, 0.5f};
        std::vector<float> x, y, z, made(count), expected(count);
        for (int i = 0; i < count; ++i) {
            x.push_back(roll.one_in(20) ? odd[roll(0, 7)] : 35.0f * roll.unit() - 2.0f);
            y.push_back(roll.one_in(20) ? odd[roll(0, 7)] : 27.0f * roll.unit() - 2.0f);
            z.push_back(roll.unit());
        }
        differing found;
        for (const rule& r : rules()) {
            gnomon::receive(map.view(), x, y, z, expected, r);
            gnomon::receive(run, map.view(), x, y, z, made, r);
            CHECK(run.problem().sentence == "");
            for (std::size_t i = 0; i < count; ++i) found.note(made[i], expected[i]);
        }
        test::gl_report(test::format_name<Texel>(), "decisions at points", 6 * count, found.decisions);
        CHECK(found.decisions == 0);
        CHECK(found.most <= (Texel::linear_scale > 255.0 ? 0x1p-24f : 0.0f)); // a float holds a blend of bytes
    });
}

TEST_CASE("a mask of the screen is what its pixels' points receive, in its first channel alone") {
    test::in_every_gl_context([](const gl::context& c) {
        using gnomon::rg8;
        constexpr extent size{40, 30}, screen{33, 21};
        dice roll(724);
        test::gl_map<rg8, gnomon::box<0>> map(c, size);
        const image<rg8> soft = test::dense<gnomon::binomial<3>>(test::noise<rg8>(roll, size, 3));
        map.write_soft(soft);
        auto pass = gl::receive_pass<rg8>::make(c, gl::receivers::screen);
        CHECK(pass.error().sentence == "");
        if (!pass) return;

        const gl::state_guard<> forced(c);
        const auto depths = gl::make_texture(c, gl::depth_format, screen);
        image<float> z(screen);
        test::for_each_texel(whole(screen), [&](int x, int y) { z(x, y) = roll.unit(); });
        for (int y = 0; y < screen.height; ++y)
            c.gl->TexSubImage2D(gl::enums::texture_2d, 0, 0, y, screen.width, 1, gl::enums::depth_component, gl::enums::type_float,
                                &z(0, y));
        const auto mask = gl::make_texture(c, gl::rgba8_format, screen);
        const auto into = gl::make_framebuffer(c, {mask->name()});
        constexpr float before[4] = {0.0f, 1.0f, 0.0f, 1.0f};
        c.gl->ClearBufferfv(gl::enums::color, 0, before);

        // Half a texel a pixel and a corner 3.25, 2.5 texels off; depth as it is; all times w = 2.
        constexpr float to_map[16] = {1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f,
                                      0.0f, 0.0f, 2.0f, 0.0f, 6.5f, 5.0f, 0.0f, 2.0f};
        pass->draw(c, {into->name(), screen}, map.targets().soft, depths->name(), rule{}, to_map);
        std::vector<unsigned char> made(4u * 33 * 21);
        c.gl->ReadPixels(0, 0, screen.width, screen.height, gl::enums::rgba, gl::enums::type_unsigned_byte, made.data());
        int wrong = 0, others = 0, dark = 0;
        test::for_each_texel(whole(screen), [&](int x, int y) {
            const unsigned char* pixel = &made[static_cast<std::size_t>(4 * (y * screen.width + x))];
            const float px = (static_cast<float>(x) + 0.5f) / 2.0f + 3.25f, py = (static_cast<float>(y) + 0.5f) / 2.0f + 2.5f;
            const float expected = gnomon::shadow(gnomon::sample(soft.view(), px, py), z(x, y));
            wrong += std::abs(pixel[0] - static_cast<int>(expected * 255.0f + 0.5f)) > 1; // a blend may lie near a half
            wrong += (pixel[0] > 0) != (expected * 255.0f > 0.501f) && std::fabs(expected * 255.0f - 0.5f) > 0.001f;
            others += pixel[1] != 255 || pixel[2] != 0 || pixel[3] != 255;
            dark += pixel[0] > 0;
        });
        test::gl_report("RG8", "mask of the screen", 33 * 21, wrong);
        CHECK(wrong == 0);
        CHECK(others == 0);
        CHECK(dark > 50);
    });
}
