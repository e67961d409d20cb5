// The GPU as a backend for the host's images: the suite of backends, parts of maps, and what it does where GL cannot.
#include "../backend/suite.hpp"
#include "../support/formats.hpp"
#include "../support/gl_backends.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <string>
#include <vector>

namespace gl = gnomon::gl;
using gnomon::image;
using gnomon::image_view;
using gnomon::texel_rect;

TEST_CASE_TEMPLATE("the GPU as a backend is the free functions", Texel, gnomon::rg8, gnomon::rg16, gnomon::rga8) {
    test::on_gl_with<Texel>([](const gl::backend& run) {
        test::is_the_free_functions<Texel>(run);
        CHECK(run.problem().sentence == "");
    });
}

TEST_CASE_TEMPLATE("the GPU filters any part of the host's image, and writes nothing beside it", Texel, gnomon::rg8,
                   gnomon::rgb16f) {
    test::on_gl_with<Texel>([](const gl::backend& run) {
        using kernel = gnomon::tent<3>;
        test::dice roll(751);
        const image<Texel> from = test::noise<Texel>(roll, {40, 30}, 3);
        gnomon::filter_scratch<Texel, kernel> scratch(40);
        gnomon::filter_scratch<Texel, gl::kernel_in_gl<Texel, kernel>> scalars(40);
        for (const texel_rect part :
             {texel_rect{0, 0, 40, 30}, {7, 5, 8, 6}, {-9, -9, 12, 4}, {33, 21, 99, 99}, {20, 0, 20, 9}, {50, 0, 60, 9}}) {
            image<Texel> made(from.size(), Texel::caster(0.25f)), expected = made;
            run.filter_region(from.view(), made.view(), part, scratch);
            CHECK(run.problem().sentence == "");
            gnomon::filter_region(from.view(), expected.view(), part, scalars);
            CHECK(test::differences(made, expected) == 0);
        }
    });
}

TEST_CASE("where GL cannot, scalar filters and receives, and the backend says why") {
    test::in_every_gl_context([](const gl::context& c) {
        using gnomon::rg8;
        gl::context small = c; // as if it were
        small.max_texture_size = 16;
        const gl::backend run(small);
        test::dice roll(752);
        const image<rg8> from = test::noise<rg8>(roll, {40, 30}, 3), expected = test::dense<gnomon::binomial<2>>(from);
        image<rg8> made(from.size());
        gnomon::filter_scratch<rg8, gnomon::binomial<2>> scratch(40);
        run.filter_region(from.view(), made.view(), whole(from.size()), scratch);
        CHECK(run.problem().sentence.find("16") != std::string::npos);
        CHECK(test::differences(made, expected) == 0);
        const std::vector<float> z(40, 0.9f);
        std::vector<float> found(40), right(40);
        gnomon::receive(run, expected.view().row_span(7), z, found);
        CHECK(run.problem().sentence != "");
        gnomon::receive(expected.view().row_span(7), z, right);
        CHECK(found == right);
        small.norm16 = false;
        const gl::backend without(small);
        std::vector<gnomon::rg16> words(40, gnomon::rg16::caster(0.5f));
        gnomon::receive(without, words, z, found);
        CHECK(without.problem().sentence.find("GL_EXT_texture_norm16") != std::string::npos);
        CHECK(found == std::vector<float>(40, 1.0f));
        run.filter_region(from.view(), made.view(), {0, 0, 8, 8}, scratch); // and where it can again, the GPU
        CHECK(run.problem().sentence == "");
    });
}

TEST_CASE("the GPU receives nothing, and on a map of nothing, and all is lit") {
    test::in_every_gl_context([](const gl::context& c) {
        using gnomon::rg8;
        const gl::backend run(c);
        const std::vector<float> at(3, 0.5f), z(3, 0.9f);
        std::vector<float> intensity(3, 7.0f);
        gnomon::receive(run, image_view<const rg8>{}, at, at, z, intensity);
        CHECK(intensity == std::vector<float>(3, 0.0f));
        gnomon::receive(run, std::vector<rg8>{}, z, intensity);
        CHECK(intensity == std::vector<float>(3, 0.0f));
        CHECK(run.problem().sentence == "");
    });
}
