// expect: gnomon: the weights of a kernel must sum to its total
#include <gnomon/filter/kernel.hpp>

struct darkening {
    static constexpr int radius = 1;
    static constexpr std::array<int, 3> weights{1, 2, 1};
    static constexpr int total = GNOMON_EXPECT_FAILURE ? 5 : 4;
};

static_assert(gnomon::kernel_is_sound<darkening>());
