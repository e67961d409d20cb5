// What a backend does to the host's images, whichever it is: written once, and run by backend.cpp and gl/.
#pragma once

#include "../support/backends.hpp"
#include "../support/bits.hpp"
#include "../support/filtering.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace test {

/// Filters a whole map, and receives a row and points.
template <gnomon::texel_format Texel, typename Backend> void is_the_free_functions(const Backend& run) {
    using gnomon::binomial, gnomon::image, gnomon::image_view, gnomon::rule, gnomon::strided_span;
    dice roll(121);
    const auto casters = noise<Texel>(roll, {40, 30}, 4);
    const image<Texel> soft = dense<filters_as_kernel<Backend, Texel, binomial<2>>>(casters);
    image<Texel> by_backend(soft.size(), Texel::caster(0.25f));
    gnomon::filter_scratch<Texel, binomial<2>> scratch(40);
    run.filter_region(image_view<const Texel>(casters.view()), by_backend.view(), whole(soft.size()), scratch);
    CHECK(differences(by_backend, soft) == 0);

    std::vector<float> x, y, z, found(40), expected(40);
    for (int i = 0; i < 40; ++i) {
        x.push_back(40 * roll.unit());
        y.push_back(30 * roll.unit());
        z.push_back(roll.unit());
    }
    const rule distant{.caster = {.depth = 0.25f}}; // so far from the default that losing it shows
    int wrong = 0;
    run.receive(soft.view().row_span(7), strided_span<const float>(z), strided_span<float>(found), distant);
    for (int i = 0; i < 40; ++i)
        wrong +=
            !same_bits(found[static_cast<std::size_t>(i)], gnomon::shadow(soft(i, 7), z[static_cast<std::size_t>(i)], distant));
    run.receive(soft.view(), strided_span<const float>(x), strided_span<const float>(y), strided_span<const float>(z),
                strided_span<float>(found), distant);
    gnomon::receive(soft.view(), x, y, z, expected, distant);
    for (std::size_t i = 0; i < 40; ++i) wrong += !same_bits(found[i], expected[i]);
    CHECK(wrong == 0);
}

} // namespace test
