// The suites of the facade on a GPU, in every context there is: what a map promises, and sparse equals dense.
#include "../facade/moving.hpp"
#include "../facade/suite.hpp"
#include "../support/gl_backends.hpp"
#include "../support/gl_report.hpp"

#include <doctest/doctest.h>

namespace suite = test::facade;

TEST_CASE("the ten lines print on a GPU what they say") {
    test::on_gl([](const auto& run) { suite::ten_lines(run); });
}
TEST_CASE_TEMPLATE("maps of nothing, of one texel, of one row, and smaller than their kernel take every call on a GPU", Texel,
                   gnomon::rg8, gnomon::rgba32f, gnomon::tm8) {
    test::on_gl_with<Texel>([](const auto& run) { suite::maps_of_nothing<Texel>(run); });
}
TEST_CASE("casting nothing on a GPU leaves a lit map: empty, inverted and far away rectangles") {
    test::on_gl([](const auto& run) { suite::casting_nothing(run); });
}
TEST_CASE("a caster of no depth lies on a GPU at the far plane, too, and one beyond the planes on them") {
    test::on_gl_with<gnomon::rg16>([](const auto& run) { suite::odd_depths(run); });
}
TEST_CASE_TEMPLATE("opacity is the intensity of an opaque caster's shadow on a GPU", Texel, gnomon::rga8, gnomon::rga16,
                   gnomon::rgba32f) {
    test::on_gl_with<Texel>([](const auto& run) { suite::opacity_is_intensity<Texel>(run); });
}
TEST_CASE_TEMPLATE("a far bound ends the shadow on a GPU at the first receiver, and only where one was drawn", Texel, gnomon::rgb8,
                   gnomon::rgba16f, gnomon::rgba32f, test::ratio_rgba8) {
    test::on_gl_with<Texel>([](const auto& run) { suite::far_bound_ends_the_shadow<Texel>(run); });
}
TEST_CASE("a map on a GPU is asked for points, rows and reach as any other is, and its decision acts on all of them") {
    test::on_gl_with<gnomon::rg16>([](const auto& run) {
        suite::points_of_three_numbers(run);
        suite::reaches_asks_tiles(run);
        suite::reached_under_a_bias(run);
        suite::decision_acts_on_all(run);
        suite::many_are_as_one<gnomon::rgba16>(run);
        suite::jobs_are_as_one<gnomon::rg16>(run);
    });
}
TEST_CASE_TEMPLATE("clear forgets every caster on a GPU, but the filtered map stays readable until the next filter", Texel,
                   gnomon::rg8, gnomon::rgba16f) {
    test::on_gl_with<Texel>([](const auto& run) { suite::clear_forgets<Texel>(run); });
}
TEST_CASE_TEMPLATE("filter has no memory on a GPU: twice is once, and casting between two adds", Texel, gnomon::rg8, gnomon::rgba16,
                   gnomon::tm8) {
    test::on_gl_with<Texel>([](const auto& run) { suite::filter_has_no_memory<Texel>(run, 3); });
}
TEST_CASE_TEMPLATE("20 frames of moving casters on a GPU equal dense filtering by scalar", Texel, gnomon::rg8, gnomon::rg16,
                   gnomon::rg16f, gnomon::rgb32f, gnomon::rga8, gnomon::rga16f, gnomon::rgba8, gnomon::rgba16) {
    test::on_gl_with<Texel>([](const auto& run) {
        const int wrong = test::moving::wrong_frames<Texel, gnomon::binomial<3>>(run, 20, 731);
        test::gl_report(gnomon::gl::format_of<Texel>.name, "frames, sparse = dense", 20 * 4, wrong); // maps of four tile sizes
        CHECK(wrong == 0);
    });
}
