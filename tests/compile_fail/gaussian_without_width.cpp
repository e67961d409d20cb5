// expect: gnomon: gaussian<R, SigmaPercent>: the standard deviation, in percent of R, must be positive
#include <gnomon/filter/kernel.hpp>

#if GNOMON_EXPECT_FAILURE
static_assert(gnomon::gaussian<3, 0>::radius == 3);
#else
static_assert(gnomon::gaussian<3, 1>::radius == 3);
#endif
