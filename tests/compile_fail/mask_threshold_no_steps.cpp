// expect: gnomon: mask_threshold<Texel, Steps>: Steps is into how many depths the light's range is told, 1 or more
#include <gnomon/receive/depth_error.hpp>

#if GNOMON_EXPECT_FAILURE
constexpr int steps = 0;
#else
constexpr int steps = 1;
#endif

static_assert(gnomon::mask_threshold<gnomon::rg8, steps> > 0.0f);
