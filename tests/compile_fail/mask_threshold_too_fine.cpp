// expect: gnomon: no mask is enough to tell so many depths apart in this texel
#include <gnomon/receive/depth_error.hpp>

#if GNOMON_EXPECT_FAILURE
constexpr int steps = 256;
#else
constexpr int steps = 255;
#endif

static_assert(gnomon::mask_threshold<gnomon::rg8, steps> > 0.0f);
