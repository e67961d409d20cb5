// expect: gnomon: tent<R>: R is the number of taps on each side of the centre, 0..255
#include <gnomon/filter/kernel.hpp>

#if GNOMON_EXPECT_FAILURE
static_assert(gnomon::tent<256>::radius == 256);
#else
static_assert(gnomon::tent<255>::radius == 255);
#endif
