// The formats under test, by short names: a test case that is made per type carries the type in its name.
#pragma once

#include <gnomon/texel/texel.hpp>

#include <doctest/doctest.h>

namespace test {

template <gnomon::channel Channel, gnomon::effects Effects = gnomon::effects{}>
using paper = gnomon::texel<Channel, gnomon::paper_depth_mask, Effects>;

inline constexpr gnomon::effects bounded{.far_bound = true};
inline constexpr gnomon::effects translucent{.translucency = true};
inline constexpr gnomon::effects both{.far_bound = true, .translucency = true};

using paper8 = paper<gnomon::unorm8>;
using paper16 = paper<gnomon::unorm16>;
using paper16f = paper<gnomon::half16>;
using paper32f = paper<gnomon::float32>;
using paper_rgba8 = paper<gnomon::unorm8, both>;
using paper_rgba16 = paper<gnomon::unorm16, both>;
using paper_rgba16f = paper<gnomon::half16, both>;
using paper_rgba32f = paper<gnomon::float32, both>;

using ratio_rga8 = gnomon::texel<gnomon::unorm8, gnomon::depth_ratio, translucent>;
using ratio_rgba8 = gnomon::texel<gnomon::unorm8, gnomon::depth_ratio, both>;
using ratio_rgba16 = gnomon::texel<gnomon::unorm16, gnomon::depth_ratio, both>;

} // namespace test

TYPE_TO_STRING_AS("unorm8", gnomon::unorm8);
TYPE_TO_STRING_AS("unorm16", gnomon::unorm16);
TYPE_TO_STRING_AS("half16", gnomon::half16);
TYPE_TO_STRING_AS("float32", gnomon::float32);
TYPE_TO_STRING_AS("rg8", gnomon::rg8);
TYPE_TO_STRING_AS("rg16", gnomon::rg16);
TYPE_TO_STRING_AS("rg16f", gnomon::rg16f);
TYPE_TO_STRING_AS("rg32f", gnomon::rg32f);
TYPE_TO_STRING_AS("rgb8", gnomon::rgb8);
TYPE_TO_STRING_AS("rgb16", gnomon::rgb16);
TYPE_TO_STRING_AS("rgb16f", gnomon::rgb16f);
TYPE_TO_STRING_AS("rgb32f", gnomon::rgb32f);
TYPE_TO_STRING_AS("rga8", gnomon::rga8);
TYPE_TO_STRING_AS("rga32f", gnomon::rga32f);
TYPE_TO_STRING_AS("rgba8", gnomon::rgba8);
TYPE_TO_STRING_AS("rgba16", gnomon::rgba16);
TYPE_TO_STRING_AS("rgba16f", gnomon::rgba16f);
TYPE_TO_STRING_AS("rgba32f", gnomon::rgba32f);
TYPE_TO_STRING_AS("tm8", gnomon::tm8);
TYPE_TO_STRING_AS("tm16", gnomon::tm16);
TYPE_TO_STRING_AS("ratio_rga8", test::ratio_rga8);
TYPE_TO_STRING_AS("ratio_rgba8", test::ratio_rgba8);
TYPE_TO_STRING_AS("ratio_rgba16", test::ratio_rgba16);
TYPE_TO_STRING_AS("paper8", test::paper8);
TYPE_TO_STRING_AS("paper16", test::paper16);
TYPE_TO_STRING_AS("paper16f", test::paper16f);
TYPE_TO_STRING_AS("paper32f", test::paper32f);
TYPE_TO_STRING_AS("paper_rgba8", test::paper_rgba8);
TYPE_TO_STRING_AS("paper_rgba16", test::paper_rgba16);
TYPE_TO_STRING_AS("paper_rgba16f", test::paper_rgba16f);
TYPE_TO_STRING_AS("paper_rgba32f", test::paper_rgba32f);
