// Sparse equals dense (h15), frame after frame, on the CPU. The reference engine fails this by a ghost of the last frame.
#include "moving.hpp"

#include <doctest/doctest.h>

namespace {
template <gnomon::kernel Kernel, typename Backend> struct in_each_format {
    template <typename... Texels> static void check() {
        std::uint64_t seed = 131;
        (check_one<Texels>(++seed), ...);
    }
    template <typename Texel> static void check_one(std::uint64_t seed) {
        CAPTURE(seed);
        CHECK(test::moving::wrong_frames<Texel, Kernel>(Backend{}, 100, seed) == 0);
    }
};
template <gnomon::kernel Kernel, typename Backend> void check_all_aliases() {
    using namespace gnomon;
    in_each_format<Kernel, Backend>::template check<rg8, rg16, rg16f, rg32f, rgb8, rgb16, rgb16f, rgb32f, rga8, rga16, rga16f,
                                                    rga32f, rgba8, rgba16, rgba16f, rgba32f>();
}
} // namespace

TEST_CASE("100 frames of moving casters equal dense filtering from scratch, in all 16 formats: no blur") {
    check_all_aliases<gnomon::box<0>, gnomon::scalar>();
}
TEST_CASE("100 frames of moving casters equal dense filtering from scratch, in all 16 formats: binomial<3>") {
    check_all_aliases<gnomon::binomial<3>, gnomon::scalar>();
}
TEST_CASE("100 frames of moving casters equal dense filtering from scratch: in lanes") {
    using namespace gnomon;
    in_each_format<binomial<3>, simd<>>::check<rg8, rgb16, rga16f, rgba32f>();
}
TEST_CASE("100 frames of moving casters equal dense filtering from scratch, in all 16 formats: gaussian<8>") {
    check_all_aliases<gnomon::gaussian<8>, gnomon::scalar>();
}

TEST_CASE("the paper's own pair keeps up with its frames as well, although its clear is not zero") {
    in_each_format<gnomon::tent<4>, gnomon::scalar>::check<test::paper8, test::paper16, test::paper16f, test::paper32f,
                                                           test::paper_rgba8, test::paper_rgba32f>();
}
