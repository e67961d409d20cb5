// expect: gnomon: a kernel must be symmetric, or the shadow moves
#include <gnomon/filter/kernel.hpp>

struct leaning {
    static constexpr int radius = 1;
    static constexpr int total = 3;
#if GNOMON_EXPECT_FAILURE
    static constexpr std::array<int, 3> weights{2, 1, 0};
#else
    static constexpr std::array<int, 3> weights{1, 1, 1};
#endif
};

static_assert(gnomon::eight_bit<leaning>::total == 256);
