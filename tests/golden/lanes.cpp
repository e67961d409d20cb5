// What simd<> makes of a map, and each set of lanes that the processor has. The numbers are those of `scalar`.
#include "golden.hpp"

#include "../support/images.hpp"
#include "../support/lanes.hpp"

#include <gnomon/backend/simd.hpp>

#include <cstdint>
#include <tuple>
#include <vector>

namespace golden {
namespace {

/// Texels that lanes filter themselves: by whole numbers, and by doubles.
constexpr std::tuple filtered_in_lanes{named<rg8>{"rg8"},         named<rgb8>{"rgb8"},   named<rg16>{"rg16"},
                                       named<rgba16f>{"rgba16f"}, named<rg32f>{"rg32f"}, named<paper<unorm8>>{"paper_rg8"}};
constexpr std::tuple kernels_in_lanes =
    std::tuple_cat(kernels, std::tuple{named<fast<gaussian<4>>>{"fast<gaussian<4>>"}, named<fast<box<3>>>{"fast<box<3>>"}});
constexpr std::tuple received_in_lanes{named<rg8>{"rg8"},     named<rga8>{"rga8"},   named<rg16>{"rg16"},
                                       named<rga16>{"rga16"}, named<rg16f>{"rg16f"}, named<rg32f>{"rg32f"}};

/// hash_of(simd<Isa>) of all of them, or 0 if they do not agree.
template <typename F> std::uint64_t one_of_all(F&& hash_of) {
    const std::uint64_t one = hash_of(simd<>{});
    bool same = true;
    test::for_each_isa([&]<typename Isa>() { same &= hash_of(simd<Isa>{}) == one; });
    return same ? one : 0;
}
} // namespace

void print_lanes() {
    print("filter_in_lanes", filtered_in_lanes, kernels_in_lanes, []<texel_format T, kernel K>(named<T>, named<K>) {
        test::dice roll(96);
        const image<T> map = test::noise<T>(roll, {139, 47}, 3);
        return one_of_all([&](const auto& backend) {
            image<T> soft(map.size(), T::clear());
            filter_scratch<T, K> scratch(map.size().width);
            backend.filter_region(map.view(), soft.view(), whole(map.size()), scratch);
            return test::hash(soft);
        });
    });
    print("receive_in_lanes", received_in_lanes, []<texel_format T>(named<T>) {
        test::dice roll(97);
        const image<T> map = test::noise<T>(roll, {139, 47}, 2);
        return one_of_all([&](const auto& backend) {
            test::dice again = roll;
            hash h;
            std::vector<float> z(139), intensity(139);
            for (int y = 0; y < map.size().height; ++y)
                for (const rule& r : {rule{}, rule{.caster = unbiased, .lit_beyond = true}, rule{.caster = towards_shadow}}) {
                    for (int x = 0; x < map.size().width; ++x)
                        z[static_cast<std::size_t>(x)] = again.one_in(2) ? caster_depth(map(x, y)) : again.unit();
                    receive(backend, map.view().row_span(y), z, intensity, r);
                    for (const float shadow : intensity) h.add(shadow);
                }
            return h.value();
        });
    });
}

} // namespace golden
