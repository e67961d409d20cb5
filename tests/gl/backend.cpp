// The GPU as a backend where GL fails at something: on a GL that draws nothing, so what is right was done by scalar.
#include "../support/fake_gl.hpp"
#include "../support/filtering.hpp"
#include "../support/formats.hpp"

#include <gnomon/gl/backend.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace {
namespace gl = gnomon::gl;
using gnomon::image;
using gnomon::rg8;
using kernel = gnomon::binomial<2>;

/// What a GL fails at, after so many calls that go well; and a part of what is said then.
struct failure {
    const char* name;
    int after;
    const char* says;
};

/// Calls use(backend) on a GL of its own for each failure: it is said, and nothing leaks.
template <typename Use> void for_each_failure(const std::vector<failure>& failures, Use&& use) {
    for (const failure& each : failures) {
        CAPTURE(std::string(each.name));
        CAPTURE(each.after);
        test::fake_gl fake("3.3");
        {
            const gl::context c = *gl::context::of(fake.table);
            const gl::backend run(c);
            fake.failing = {{each.name, each.after}};
            use(run);
            CHECK(run.problem().sentence.find(each.says) != std::string::npos);
        }
        CHECK(fake.alive() == 0);
        CHECK(fake.wrong == "");
    }
}

const std::vector<failure> programs_fail{{"BufferData", 0, "a buffer of"}, {"CreateProgram", 0, "no name for a program"}};
const std::vector<failure> receiving_fails{{"TexImage2D", 0, "RG8: GL_OUT_OF_MEMORY"},
                                           {"TexSubImage2D", 0, "a map's texels: GL_OUT_OF_MEMORY"},
                                           {"TexImage2D", 1, "RGBA32F: GL_OUT_OF_MEMORY"},
                                           {"TexSubImage2D", 1, "uploading receivers: GL_OUT_OF_MEMORY"},
                                           {"TexImage2D", 2, "RG32UI: GL_OUT_OF_MEMORY"},
                                           {"GenFramebuffers", 0, "no name for a framebuffer"},
                                           {"ReadPixels", 0, "receiving on the host's behalf: GL_OUT_OF_MEMORY"}};
} // namespace

TEST_CASE("whatever GL fails at, the host's image is filtered, and the backend says why not there") {
    test::dice roll(753);
    const image<rg8> from = test::noise<rg8>(roll, {40, 30}, 3), expected = test::dense<kernel>(from);
    const auto filters = [&](const gl::backend& run) {
        image<rg8> made(from.size());
        gnomon::filter_scratch<rg8, kernel> scratch(40);
        run.filter_region(from.view(), made.view(), whole(from.size()), scratch);
        CHECK(test::differences(made, expected) == 0);
    };
    for_each_failure(programs_fail, filters);
    for_each_failure({{"TexImage2D", 3, "GL_OUT_OF_MEMORY"},
                      {"GenFramebuffers", 2, "no name for a framebuffer"},
                      {"ReadPixels", 0, "filtering an image of the host's: GL_OUT_OF_MEMORY"}},
                     filters);
}

TEST_CASE("what a GPU has filtered is not filtered again") {
    test::fake_gl fake("3.3");
    const gl::context c = *gl::context::of(fake.table);
    const gl::backend run(c);
    const image<rg8> from({40, 30}, rg8::caster(0.5f)), read_back(from.size(), rg8::clear()); // by a GL that draws nothing
    image<rg8> to = from;
    gnomon::filter_scratch<rg8, kernel> scratch(40);
    run.filter_region(from.view(), to.view(), whole(from.size()), scratch);
    CHECK(run.problem().sentence == "");
    CHECK(test::differences(to, read_back) == 0);
}

TEST_CASE("an image is not filtered into itself on a GPU either") {
    test::fake_gl fake("3.3");
    const gl::context c = *gl::context::of(fake.table);
    const gl::backend run(c);
    test::dice roll(754);
    image<rg8> both = test::noise<rg8>(roll, {40, 30}, 3);
    const image<rg8> before = both;
    gnomon::filter_scratch<rg8, kernel> scratch(40);
    fake.calls.clear();
    run.filter_region(both.view(), both.view(), whole(both.size()), scratch);
    CHECK(test::differences(both, before) == 0);
    CHECK(fake.calls.empty());
}

TEST_CASE("whatever GL fails at, receivers are decided about, and the backend says why not there") {
    test::dice roll(755);
    const image<rg8> map = test::dense<kernel>(test::noise<rg8>(roll, {40, 30}, 3));
    const std::vector<float> z(40, 0.9f), x(40, 20.25f), y(40, 15.75f);
    std::vector<float> on_texels(40), at_points(40);
    gnomon::receive(map.view().row_span(7), z, on_texels);
    gnomon::receive(map.view(), x, y, z, at_points);
    CHECK(at_points[0] > 0.0f);
    const auto receives_on_texels = [&](const gl::backend& run) {
        std::vector<float> made(40);
        gnomon::receive(run, map.view().row_span(7), z, made);
        CHECK(made == on_texels);
    };
    const auto receives_at_points = [&](const gl::backend& run) {
        std::vector<float> made(40);
        gnomon::receive(run, map.view(), x, y, z, made);
        CHECK(made == at_points);
    };
    for (const auto& failures : {programs_fail, receiving_fails}) {
        for_each_failure(failures, receives_on_texels);
        for_each_failure(failures, receives_at_points);
    }
}

TEST_CASE("numbers of any count are lines of a texture with less than a line to spare") {
    for (const int count : {1, 2, 5, 1023, 1024, 1025, 4096, 5000, 1 << 20}) {
        const gnomon::extent lines = gl::detail::lines_of(count);
        CAPTURE(count);
        CHECK(lines.width <= 1024); // which every context has
        CHECK(lines.width * lines.height >= count);
        CHECK(lines.width * (lines.height - 1) < count);
        CHECK((lines.width == 1024 || lines.width == count));
    }
    CHECK(gl::detail::lines_of(0) == gnomon::extent{1, 1});
}

TEST_CASE("as many receivers are decided about as have all that they need, and no more, be it one or none") {
    test::fake_gl fake("3.3");
    fake.table.ReadPixels = [](int, int, int width, int height, unsigned, unsigned, void* to) {
        std::fill_n(static_cast<std::uint32_t*>(to), 4 * width * height, std::bit_cast<std::uint32_t>(0.5f));
    };
    const gl::context c = *gl::context::of(fake.table);
    const gl::backend run(c);
    const image<rg8> map({8, 8}, rg8::clear()), none;
    using sizes = std::array<std::size_t, 5>; // of texels, x, y, z and intensities
    for (const sizes& n : {sizes{9, 9, 9, 9, 9},
                           {3, 9, 9, 9, 9},
                           {9, 3, 9, 9, 9},
                           {9, 9, 3, 9, 9},
                           {9, 9, 9, 3, 9},
                           {9, 9, 9, 9, 3},
                           {1, 1, 9, 9, 9},
                           {0, 9, 9, 0, 9}}) {
        const auto first = [](std::size_t count, float decided) {
            std::vector<float> expected(9, 7.0f);
            std::fill_n(expected.begin(), count, decided);
            return expected;
        };
        const std::vector<rg8> texels(n[0], rg8::clear());
        const std::vector<float> x(n[1]), y(n[2]), z(n[3]);
        const auto into = [&n](std::vector<float>& all) { return gnomon::strided_span<float>(all.data(), static_cast<int>(n[4])); };
        std::vector<float> made(9, 7.0f);
        gnomon::receive(run, texels, z, into(made));
        CHECK(made == first(std::min({n[0], n[3], n[4]}), 0.5f));
        made = first(0, 0.0f);
        gnomon::receive(run, map.view(), x, y, z, into(made));
        CHECK(made == first(std::min({n[1], n[2], n[3], n[4]}), 0.5f));
        made = first(0, 0.0f);
        fake.calls.clear();
        gnomon::receive(run, none.view(), x, y, z, into(made)); // lit, and nobody is asked
        CHECK(made == first(std::min({n[1], n[2], n[3], n[4]}), 0.0f));
        CHECK(fake.calls.empty());
        CHECK(run.problem().sentence == "");
    }
    CHECK(fake.wrong == "");
}

TEST_CASE("more receivers than a square of the longest lines are all decided about, and none behind the last is read") {
    test::fake_gl fake("3.3");
    fake.table.ReadPixels = [](int, int, int width, int height, unsigned, unsigned, void* to) {
        CHECK((width == 1024 && height == 1025));
        std::fill_n(static_cast<std::uint32_t*>(to), 4 * width * height, std::bit_cast<std::uint32_t>(0.5f));
    };
    const gl::context c = *gl::context::of(fake.table);
    const gl::backend run(c);
    constexpr std::size_t count = 1024 * 1024 + 1;
    const std::vector<rg8> texels(count, rg8::clear());
    std::vector<float> made(count);
    gnomon::receive(run, texels, std::vector<float>(count), made);
    CHECK(std::count(made.begin(), made.end(), 0.5f) == static_cast<std::ptrdiff_t>(count));
}

TEST_CASE("an empty part of an image is filtered without a call, and a texel that GL has not without GL") {
    test::fake_gl fake("OpenGL ES 3.0");
    const gl::context c = *gl::context::of(fake.table);
    const gl::backend run(c);
    test::dice roll(756);
    const image<rg8> from = test::noise<rg8>(roll, {40, 30}, 3);
    image<rg8> made({40, 30}, rg8::caster(0.25f));
    const image<rg8> before = made;
    gnomon::filter_scratch<rg8, kernel> scratch(40);
    fake.calls.clear();
    for (const gnomon::texel_rect region : {gnomon::texel_rect{5, 5, 5, 9}, {5, 5, 9, 5}, {40, 0, 50, 9}, {0, -9, 9, 0}})
        run.filter_region(from.view(), made.view(), region, scratch);
    CHECK(test::differences(made, before) == 0);
    CHECK(fake.calls.empty());

    using wide = gnomon::rg16;
    const image<wide> map = test::noise<wide>(roll, {40, 30}, 3);
    const std::vector<float> z(40, 0.9f);
    std::vector<float> intensity(40), expected(40);
    gnomon::receive(map.view().row_span(7), z, expected);
    gnomon::receive(run, map.view().row_span(7), z, intensity);
    CHECK(intensity == expected);
    CHECK(run.problem().sentence.find("GL_EXT_texture_norm16") != std::string::npos);
    CHECK(fake.calls["CreateProgram"] == 0);
}

TEST_CASE("a pass for receivers of each kind compiles the main that is theirs, and finds their texture") {
    test::fake_gl fake("3.3");
    const gl::context c = *gl::context::of(fake.table);
    const auto makes = [&](gl::receivers of, std::string_view main, const char* texture) {
        fake.uniforms.clear();
        const auto made = gl::receive_pass<rg8>::make(c, of);
        CHECK(made.error().sentence == "");
        const std::string_view source = fake.sources.back();
        CHECK(source.substr(source.size() - main.size()) == main);
        CHECK(fake.uniforms.count(texture) == 1);
    };
    makes(gl::receivers::texels, gl::receive_texels_main_text, "gnomon_depths");
    makes(gl::receivers::points, gl::receive_points_main_text, "gnomon_points");
    makes(gl::receivers::screen, gl::receive_screen_main_text, "gnomon_depths");
}

TEST_CASE("sizes, texture units, a rule and a matrix reach the uniforms that have their names") {
    using numbers = std::vector<float>;
    static std::vector<std::string> names;
    static std::map<std::string, numbers> told;
    test::fake_gl fake("3.3");
    fake.table.GetUniformLocation = [](unsigned, const char* name) {
        names.emplace_back(name);
        return static_cast<int>(names.size()) - 1;
    };
    static const auto name_at = [](int location) { return names.at(static_cast<std::size_t>(location)); };
    fake.table.Uniform1i = [](int at, int a) { told[name_at(at)] = {static_cast<float>(a)}; };
    fake.table.Uniform2i = [](int at, int a, int b) { told[name_at(at)] = {static_cast<float>(a), static_cast<float>(b)}; };
    fake.table.Uniform1f = [](int at, float a) { told[name_at(at)] = {a}; };
    fake.table.Uniform4f = [](int at, float a, float b, float c, float d) { told[name_at(at)] = {a, b, c, d}; };
    fake.table.UniformMatrix4fv = [](int at, int count, unsigned char transposed, const float* values) {
        CHECK(count == 1);
        CHECK(transposed == 0);
        told[name_at(at)] = numbers(values, values + 16);
    };
    using Texel = gnomon::rgb8;
    const gl::context c = *gl::context::of(fake.table);
    auto pass = *gl::receive_pass<Texel>::make(c, gl::receivers::screen);
    constexpr float to_map[16] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
    for (const bool lit_beyond : {false, true}) {
        gnomon::rule by;
        by.caster = {.roundings = 2, .depth = 0.125f};
        by.far_bound = {.roundings = 5, .depth = 0.25f};
        by.fade = 0.5f;
        by.lit_beyond = lit_beyond;
        told.erase("gnomon_lit_beyond");
        pass.draw(c, {0, {17, 19}}, 0, 0, by, to_map);
        const auto bias = [](const gnomon::bias& b) {
            const auto steps = gnomon::bias_steps<Texel, float>::of(b);
            return numbers{steps.depth_less, steps.depth_share, steps.mask_more, steps.mask_share};
        };
        CHECK(bias(by.caster) != bias(by.far_bound));
        CHECK(told["gnomon_size"] == numbers{17, 19});
        CHECK(told["gnomon_map"] == numbers{0});
        CHECK(told["gnomon_depths"] == numbers{1});
        CHECK(told["gnomon_lit_beyond"] == numbers{lit_beyond ? 1.0f : 0.0f});
        CHECK(told["gnomon_caster_bias"] == bias(by.caster));
        CHECK(told["gnomon_bound_bias"] == bias(by.far_bound));
        CHECK(told["gnomon_fade"] == numbers{0.5f});
        CHECK(told["gnomon_to_map"] == numbers(to_map, to_map + 16));
        CHECK(told["gnomon_caster_nearer"] == numbers{gnomon::bias_steps<Texel, float>::of(by.caster).nearer});
        CHECK(told["gnomon_bound_nearer"] == numbers{gnomon::bias_steps<Texel, float>::of(by.far_bound).nearer});
        CHECK(told.size() == 10);
    }
}
