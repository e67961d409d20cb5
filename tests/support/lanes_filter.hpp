// What lanes filter, beside what the oracle does.
#pragma once

#include "images.hpp"

#include <gnomon/backend/simd.hpp>
#include <gnomon/filter/separable.hpp>

#include <cmath>
#include <cstring>

namespace test {

/// The same bits, or numbers that are both none.
template <typename Texel> bool same_texel(const Texel& a, const Texel& b) {
    for (int c = 0; c < Texel::channels; ++c) {
        const float x = Texel::channel_type::code(a.stored[c]), y = Texel::channel_type::code(b.stored[c]);
        if (std::memcmp(&a.stored[c], &b.stored[c], sizeof a.stored[c]) != 0 && !(std::isnan(x) && std::isnan(y))) return false;
    }
    return true;
}

/// Filters a part of an image both ways, into memory and with a scratch that hold something else, and counts what differs anywhere.
template <typename Isa, gnomon::kernel Kernel, typename Texel>
int differing(gnomon::image_view<const Texel> from, gnomon::texel_rect region, int scratch_width) {
    gnomon::image<Texel> expected(from.size(), Texel::caster(0.25f)), made(from.size(), Texel::caster(0.25f));
    gnomon::filter_scratch<Texel, Kernel> scratch(from.size().width), given(scratch_width);
    gnomon::filter_region(from, expected.view(), region, scratch);
    if (!given.line().empty()) std::memset(given.line().data(), 0x5A, given.line().size_bytes());
    gnomon::simd<Isa>{}.filter_region(from, made.view(), region, given);
    int n = 0;
    for_each_texel(whole(from.size()), [&](int x, int y) { n += !same_texel(expected(x, y), made(x, y)); });
    return n;
}

template <typename Isa, gnomon::kernel Kernel, typename Texel>
int differing(gnomon::image_view<const Texel> from, gnomon::texel_rect region) {
    return differing<Isa, Kernel>(from, region, from.size().width);
}

} // namespace test
