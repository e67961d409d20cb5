// expect: gnomon: a kernel's total must lie in 1..65536
#include <gnomon/filter/kernel.hpp>

struct nothing { // what it sums is divided by the total
    static constexpr int radius = 0;
    static constexpr int total = GNOMON_EXPECT_FAILURE ? 0 : 1;
    static constexpr std::array<int, 1> weights{total};
};

static_assert(gnomon::kernel_is_sound<nothing>());
