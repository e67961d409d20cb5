// expect: gnomon: gaussian<R>: R is the number of taps on each side of the centre, 0..256
#include <gnomon/filter/kernel.hpp>

#if GNOMON_EXPECT_FAILURE
static_assert(gnomon::gaussian<257>::radius == 257);
#else
static_assert(gnomon::gaussian<256>::radius == 256);
#endif
