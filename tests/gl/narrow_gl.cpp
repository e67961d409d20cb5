// A filter whose scratch is a texture like the map's, on every GL there is.
#include "../support/filtering.hpp"
#include "../support/formats.hpp"
#include "../support/gl_map.hpp"
#include "../support/gl_report.hpp"

namespace {
using namespace gnomon;

template <texel_format Texel, kernel Kernel> void filters_as_scalar(const gl::context& c) {
    if (const auto why = gl::supports<Texel>(c)) return test::skip(why.sentence);
    test::dice roll(713);
    const extent size{61, 47};
    test::gl_map<Texel, Kernel> map(c, size);
    const auto from = test::noise<Texel>(roll, size, 2);
    map.write_casters(from);
    map.filter(whole(size));
    const int differing = test::differences(map.soft(), test::dense<Kernel>(from));
    test::gl_report(test::format_name<Texel>(), "narrow columns and rows", 1ll * size.width * size.height, differing);
    CHECK(differing == 0);
}
} // namespace

TEST_CASE("GL filters as scalar does where the scratch is no wider than the map") {
    test::in_every_gl_context([](const gl::context& c) {
        filters_as_scalar<rg8, narrow<binomial<3>>>(c);
        filters_as_scalar<rgba16, narrow<gaussian<4>>>(c);
        filters_as_scalar<rg16f, narrow<tent<2>>>(c);
        filters_as_scalar<rgba32f, narrow<box<20>>>(c);
    });
}
