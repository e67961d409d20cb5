// Ways to filter a whole image: by the library, and by the definition.
#pragma once

#include "images.hpp"
#include "kernels.hpp"

#include <gnomon/filter/separable.hpp>

namespace test {

/// The whole of an image filtered by the library. The result's memory and the scratch begin as rubbish.
template <gnomon::kernel Kernel, gnomon::texel_format Texel> gnomon::image<Texel> dense(const gnomon::image<Texel>& from) {
    gnomon::image<Texel> to(from.size(), Texel::caster(0.25f));
    gnomon::filter_scratch<Texel, Kernel> scratch(from.size().width);
    for (auto& element : scratch.line()) std::memset(&element, 0xFF, sizeof element); // for floats, NaN
    gnomon::filter_region(from.view(), to.view(), whole(from.size()), scratch);
    return to;
}

/// sum of w(i) w(j) code(x+i, y+j) for one channel, in two dimensions at once; clear lies off the map. Exact in std::uint64_t for
/// unorm texels, whose sums stay below 2^49.
template <typename Number, gnomon::texel_format Texel>
Number convolved(const gnomon::image<Texel>& from, const taps& k, int x, int y, int channel) {
    const Texel clear = Texel::clear();
    Number sum = 0;
    for (int j = -k.radius; j <= k.radius; ++j)
        for (int i = -k.radius; i <= k.radius; ++i) {
            const Texel& t = whole(from.size()).contains(x + i, y + j) ? from(x + i, y + j) : clear;
            const auto weight = static_cast<Number>(k.at(i)) * static_cast<Number>(k.at(j));
            sum += weight * static_cast<Number>(Texel::channel_type::code(t.stored[channel]));
        }
    return sum;
}

/// Which pass comes first.
enum class first { rows, columns };

/// A kernel in the hands of one who stores between the passes: every row is rounded to texels, then every column of those; or the
/// other way round.
/// Sums of whole codes are exact; those of floats are doubles, whose own rounding is far below a texel's.
template <gnomon::texel_format Texel>
gnomon::image<Texel> twice_rounded(const gnomon::image<Texel>& from, const taps& k, first order = first::rows) {
    using wide = typename Texel::linear_sum;
    const Texel clear = Texel::clear();
    const auto pass = [&](const gnomon::image<Texel>& in, int right, int down) {
        gnomon::image<Texel> out(in.size());
        for_each_texel(whole(in.size()), [&](int x, int y) {
            wide sums[static_cast<std::size_t>(Texel::channels)]{};
            for (int i = -k.radius; i <= k.radius; ++i) {
                const int column = x + i * right, row = y + i * down;
                const Texel& t = whole(in.size()).contains(column, row) ? in(column, row) : clear;
                for (int c = 0; c < Texel::channels; ++c) sums[c] += static_cast<wide>(k.at(i)) * t.template linear<wide>(c);
            }
            out(x, y) = Texel::from_linear(sums, static_cast<wide>(k.total));
        });
        return out;
    };
    return order == first::rows ? pass(pass(from, 1, 0), 0, 1) : pass(pass(from, 0, 1), 1, 0);
}

} // namespace test
