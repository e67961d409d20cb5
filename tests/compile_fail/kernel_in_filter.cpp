// expect: gnomon: the weights of a kernel must sum to its total
#include <gnomon/filter/separable.hpp>

// No check of one's own is needed: the filter itself refuses.
struct darkening {
    static constexpr int radius = 1;
#if GNOMON_EXPECT_FAILURE
    static constexpr int total = 5;
#else
    static constexpr int total = 4;
#endif
    static constexpr std::array<int, 3> weights{1, 2, 1};
};

void blur(gnomon::image_view<const gnomon::rg8> from, gnomon::image_view<gnomon::rg8> to,
          gnomon::filter_scratch<gnomon::rg8, darkening>& scratch) {
    gnomon::filter_region(from, to, whole(to.size()), scratch);
}
