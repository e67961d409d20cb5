// expect: gnomon: a kernel with a negative weight leaves \[0, 1\]
#include <gnomon/filter/kernel.hpp>

struct sharpen { // Lanczos and its kin ring
    static constexpr int radius = 1;
#if GNOMON_EXPECT_FAILURE
    static constexpr std::array<int, 3> weights{-1, 6, -1};
    static constexpr int total = 4;
#else
    static constexpr std::array<int, 3> weights{1, 6, 1};
    static constexpr int total = 8;
#endif
};

static_assert(gnomon::kernel_is_sound<sharpen>());
