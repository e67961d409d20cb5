// expect: gnomon: a kernel must be symmetric, or the shadow moves
#include <gnomon/filter/kernel.hpp>

struct leaning {
    static constexpr int radius = 1;
    static constexpr int total = 4;
#if GNOMON_EXPECT_FAILURE
    static constexpr std::array<int, 3> weights{2, 1, 1};
#else
    static constexpr std::array<int, 3> weights{1, 2, 1};
#endif
};

static_assert(gnomon::kernel_is_sound<leaning>());
