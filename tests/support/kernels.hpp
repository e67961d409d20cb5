// The kernels under test, as types: four shapes, any radius; and the same as plain numbers for oracles that know no template.
#pragma once

#include <gnomon/filter/kernel.hpp>

#include <array>
#include <utility>
#include <vector>

namespace test {

/// A kernel as numbers; `weights[radius + i]` counts for the texel i steps away.
struct taps {
    int radius;
    int total;
    std::vector<int> weights;

    int at(int i) const { return weights[static_cast<std::size_t>(radius + i)]; }
};
/// Of weights that no user may bring: their sum may be larger.
template <gnomon::kernel K> taps taps_of_any() { return {K::radius, K::total, {K::weights.begin(), K::weights.end()}}; }
template <gnomon::kernel K> taps taps_of() {
    static_assert(gnomon::kernel_is_sound<K>());
    return taps_of_any<K>();
}

template <gnomon::kernel... Kernels> struct kernels {};

/// A kernel of a user's: rim and sum of a box, and none.
struct spread {
    static constexpr int radius = 2;
    static constexpr int total = 5;
    static constexpr std::array weights{1, 0, 3, 0, 1};
};

/// Calls f.template operator()<Kernel>() for each.
template <typename F, gnomon::kernel... Kernels> void for_each_kernel(kernels<Kernels...>, F&& f) {
    (f.template operator()<Kernels>(), ...);
}

/// All four shapes at these radii.
template <typename F, int... Radii> void for_each_shape(std::integer_sequence<int, Radii...>, F&& f) {
    for_each_kernel(
        kernels<gnomon::box<Radii>..., gnomon::tent<Radii>..., gnomon::binomial<Radii>..., gnomon::gaussian<Radii>...>{}, f);
}

} // namespace test
