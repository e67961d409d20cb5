// expect: gnomon: -ffast-math and -ffinite-math-only
// flags: -ffinite-math-only
#if !GNOMON_EXPECT_FAILURE
#define GNOMON_ALLOW_FAST_MATH
#endif
#include <gnomon/gnomon.hpp>
