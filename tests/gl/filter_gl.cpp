// The filter on GL against `scalar`, bit for bit: column sums, both passes, every plan of arithmetic, any part of a map, and scratch and
// soft maps that hold rubbish before.
#include "../support/filtering.hpp"
#include "../support/formats.hpp"
#include "../support/gl_map.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <string>
#include <vector>

namespace {
namespace gl = gnomon::gl;
using gnomon::binomial;
using gnomon::box;
using gnomon::extent;
using gnomon::fast;
using gnomon::gaussian;
using gnomon::image;
using gnomon::narrow;
using gnomon::tent;
using gnomon::texel_rect;
using test::dice;

void report(const char* format, const std::string& pass, long long compared, long long differing) {
    test::gl_report(format, pass, compared, differing);
    CAPTURE(pass);
    CHECK(differing == 0);
}

/// Sums of the first pass that differ from scalar's line.
template <gnomon::kernel Kernel, typename Texel>
int differing_sums(const std::vector<std::uint32_t>& sums, const image<Texel>& from) {
    const int width = from.size().width;
    [[maybe_unused]] constexpr auto scale = static_cast<std::uint32_t>(Texel::channel_type::scale);
    std::vector<gnomon::line_element<Texel>> line(static_cast<std::size_t>(width * Texel::channels));
    int wrong = 0;
    for (int y = 0; y < from.size().height; ++y) {
        gnomon::detail::sum_columns<gl::kernel_in_gl<Texel, Kernel>, Texel>(from.view(), y, 0, width, line);
        for (int x = 0; x < width; ++x)
            for (int i = 0; i < Texel::channels; ++i) {
                const auto sum = line[static_cast<std::size_t>(x * Texel::channels + i)];
                const std::uint32_t made = sums[static_cast<std::size_t>(4 * (y * width + x) + i)];
                if constexpr (!Texel::representation_type::premultiplied) // GL scales no mask, and divides so much less
                    wrong += i == Texel::depth_index || i == Texel::far_index ? made != sum : made * scale != sum;
                else if constexpr (Texel::channel_type::whole_codes)
                    wrong += made != sum;
                else
                    wrong += made != std::bit_cast<std::uint32_t>(static_cast<float>(sum));
            }
    }
    return wrong;
}

/// Casters, or any codes at all where a code is a number whatever its bits.
template <typename Texel> image<Texel> content(dice& roll, extent size, bool casters) {
    image<Texel> map = test::noise<Texel>(roll, size, 2);
    if constexpr (Texel::channel_type::whole_codes)
        if (!casters)
            test::for_each_texel(whole(size), [&](int x, int y) {
                for (auto& code : map(x, y).stored) code = static_cast<typename Texel::storage>(roll(0, 65535));
            });
    return map;
}

/// Parts of a map: corners, single texels, rows, columns, off its edges.
std::vector<texel_rect> parts(extent size) {
    std::vector<texel_rect> all{whole(size)};
    for (const texel_rect r : {texel_rect{0, 0, 1, 1},
                               {3, 2, 30, 9},
                               {size.width - 5, size.height - 4, size.width, size.height},
                               {0, 7, size.width, 8},
                               {11, 0, 12, size.height}})
        if (const texel_rect part = clip(r, size); !part.empty()) all.push_back(part);
    return all;
}

template <typename Texel, gnomon::kernel Kernel> void filters_as_scalar(const gl::context& c, extent size, dice& roll) {
    CAPTURE(Kernel::radius);
    CAPTURE(size.width);
    const std::string kernel = " R=" + std::to_string(Kernel::radius);
    const char* const format = test::format_name<Texel>();
    const long long texels = 1ll * size.width * size.height;
    test::gl_map<Texel, Kernel> map(c, size);
    for (const bool casters : {true, false}) {
        const image<Texel> from = content<Texel>(roll, size, casters);
        map.write_casters(from);
        map.spoil_scratch();
        map.filter(whole(size));
        if constexpr (gl::filter_scratch_largest<Texel, Kernel> != 0) // else it holds texels, of which the rows are proof
            report(format, "columns" + kernel, texels, differing_sums<Kernel>(map.scratch(), from));
        const image<Texel> expected = test::dense<gl::kernel_in_gl<Texel, Kernel>>(from);
        report(format, "columns and rows" + kernel, texels, test::differences(map.soft(), expected));

        for (const gl::rectangles_by way : {gl::rectangles_by::instances, gl::rectangles_by::scissor}) {
            image<Texel> part_by_part = content<Texel>(roll, size, true);
            map.write_soft(part_by_part);
            const std::vector<texel_rect> all = parts(size);
            const texel_rect part = all[static_cast<std::size_t>(roll(0, static_cast<int>(all.size()) - 1))];
            map.spoil_scratch();
            map.filter(part, way);
            test::for_each_texel(part, [&](int x, int y) { part_by_part(x, y) = expected(x, y); });
            report(format, "a part" + kernel, texels, test::differences(map.soft(), part_by_part));
        }
    }
}

template <typename Texel, gnomon::kernel... Kernels> void in_every_context() {
    test::in_every_gl_context([](const gl::context& c) {
        if (const auto why = gl::supports<Texel>(c)) return test::skip(why.sentence);
        dice roll(711);
        (filters_as_scalar<Texel, Kernels>(c, {61, 47}, roll), ...);
    });
}
} // namespace

TEST_CASE("GL filters as scalar does: rg8, kernels of every shape, in one word and in two, written out and in loops") {
    in_every_context<gnomon::rg8, box<0>, box<1>, tent<2>, binomial<3>, gaussian<8>, fast<gaussian<8>>, box<32>, gaussian<40>,
                     test::spread>();
}
TEST_CASE("GL filters as scalar does: rg16, sums of two words, and rounded between the passes by fast kernels") {
    in_every_context<gnomon::rg16, box<2>, binomial<3>, gaussian<8>, fast<gaussian<4>>, fast<tent<1>>, gaussian<33>>();
}
TEST_CASE("GL filters as scalar does: three and four channels") {
    in_every_context<gnomon::rgb8, binomial<3>>();
    in_every_context<gnomon::rgba8, gaussian<4>>();
    in_every_context<gnomon::rgba16, gaussian<4>, fast<binomial<9>>>();
    in_every_context<gnomon::rgb16, tent<3>>();
}
TEST_CASE("GL filters as scalar does by the fast kernel: halves") {
    in_every_context<gnomon::rg16f, box<0>, box<2>, binomial<3>, gaussian<8>, fast<gaussian<20>>>();
    in_every_context<gnomon::rgba16f, tent<3>>();
}
TEST_CASE("GL filters as scalar does by the fast kernel: floats") {
    in_every_context<gnomon::rg32f, box<0>, box<2>, binomial<3>, gaussian<8>, fast<gaussian<20>>>();
    in_every_context<gnomon::rgb32f, tent<3>>();
}
TEST_CASE("GL filters as scalar does: ratios of two sums") {
    in_every_context<gnomon::tm8, binomial<3>, gaussian<4>, box<17>>();
    in_every_context<test::ratio_rgba8, tent<2>>();
}
TEST_CASE("GL filters as scalar does: a narrow scratch, which holds texels") {
    in_every_context<gnomon::rg8, narrow<binomial<3>>>();
    in_every_context<gnomon::rgba16, narrow<gaussian<4>>>();
    in_every_context<gnomon::rg16f, narrow<tent<3>>>();
    in_every_context<gnomon::rg32f, narrow<binomial<3>>>();
}

TEST_CASE("GL filters maps of one texel, of one row, of one column, and smaller than their kernel") {
    test::in_every_gl_context([](const gl::context& c) {
        dice roll(712);
        for (const extent size : {extent{1, 1}, {65, 1}, {1, 65}, {5, 4}})
            filters_as_scalar<gnomon::rgba8, gaussian<16>>(c, size, roll);
    });
}
