// expect: gnomon: -ffast-math
// flags: -ffast-math
#if !GNOMON_EXPECT_FAILURE
#define GNOMON_ALLOW_FAST_MATH
#endif
#include <gnomon/gnomon.hpp>
