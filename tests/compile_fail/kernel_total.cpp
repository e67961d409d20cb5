// expect: gnomon: a kernel's total must lie in 1..65536
#include <gnomon/filter/kernel.hpp>

struct heavy { // sums of 16-bit codes must fit 32 bits
    static constexpr int radius = 1;
#if GNOMON_EXPECT_FAILURE
    static constexpr int total = 65537;
    static constexpr std::array<int, 3> weights{1, 65535, 1};
#else
    static constexpr int total = 65536;
    static constexpr std::array<int, 3> weights{1, 65534, 1};
#endif
};

static_assert(gnomon::kernel_is_sound<heavy>());
