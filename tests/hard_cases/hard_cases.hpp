// What the hard cases share. A case is named as in the table of names in check.py, and has one section in one file of this folder:
// first what the library must do, then, where a simpler way fails, that way failing, so that the case is known to be hard.
//     decision.cpp      h01 h02 h05 h07 h08 h09 h10   a stored pair and a receiver
//     ../filter/pyramid.cpp   h16                     mip levels
//     filter.cpp        h03 h04 h06 h14 h15           sums of weights, borders, tiles
//     effects.cpp       h11 h12 h13                   far bound and translucency
//     world.cpp         h17 h18 h19                   large worlds, deep ranges, degenerate lights
//     self_shadow.cpp   h26 h27                       surfaces that receive their own shadow
//     compiler.cpp      h28                           what compilers do to floats
// waiting.txt lists the cases of parts that are not built yet; check.py, a ctest, holds both lists against each other.
#pragma once

#include "../support/bits.hpp"
#include "../support/formats.hpp"

#include <gnomon/receive/decide.hpp>

#include <array>

#define EVERY_PLAIN_TEXEL                                                                                                          \
    gnomon::rg8, gnomon::rg16, gnomon::rg16f, gnomon::rg32f, gnomon::tm8, gnomon::tm16, test::paper8, test::paper16,               \
        test::paper16f, test::paper32f
#define EVERY_BOUNDED_TEXEL                                                                                                        \
    gnomon::rgb8, gnomon::rgb16, gnomon::rgb16f, gnomon::rgb32f, test::ratio_rgba8, test::ratio_rgba16, test::paper_rgba8,         \
        test::paper_rgba16, test::paper_rgba16f, test::paper_rgba32f
#define EVERY_TRANSLUCENT_TEXEL                                                                                                    \
    gnomon::rga8, gnomon::rga32f, gnomon::rgba8, gnomon::rgba16, gnomon::rgba16f, gnomon::rgba32f, test::ratio_rgba8
/// A filter treats all channels alike, so those texels that have most of them stand for the others.
#define EVERY_FILTERED_TEXEL                                                                                                       \
    gnomon::rg8, gnomon::tm8, gnomon::rgba8, gnomon::rgba16, gnomon::rgba16f, gnomon::rgba32f, test::ratio_rgba16,                 \
        test::paper_rgba8, test::paper_rgba16, test::paper_rgba16f, test::paper_rgba32f
#define EVERY_TEXEL EVERY_PLAIN_TEXEL, EVERY_BOUNDED_TEXEL, EVERY_TRANSLUCENT_TEXEL

namespace test {

inline constexpr std::array<gnomon::rule, 3> every_rule{gnomon::rule{.caster = gnomon::towards_light},
                                                        gnomon::rule{.caster = gnomon::unbiased},
                                                        gnomon::rule{.caster = gnomon::towards_shadow}};

template <typename Texel> bool lit(const Texel& texel, float z, const gnomon::rule& r = {}) {
    return same_bits(gnomon::shadow(texel, z, r), 0.0f);
}
template <typename Texel> bool in_full_shadow(const Texel& texel, float z, const gnomon::rule& r = {}) {
    return same_bits(gnomon::shadow(texel, z, r), 1.0f);
}

} // namespace test
