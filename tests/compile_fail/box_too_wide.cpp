// expect: gnomon: box<R>: R is the number of taps on each side of the centre, 0..4096
#include <gnomon/filter/kernel.hpp>

#if GNOMON_EXPECT_FAILURE
static_assert(gnomon::box<4097>::radius == 4097);
#else
static_assert(gnomon::box<4096>::radius == 4096);
#endif
