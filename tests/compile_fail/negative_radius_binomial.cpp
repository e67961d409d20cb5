// expect: gnomon: binomial<R>: R is the number of taps on each side of the centre
#include <gnomon/filter/kernel.hpp>

#if GNOMON_EXPECT_FAILURE
static_assert(gnomon::binomial<-1>::radius == -1);
#else
static_assert(gnomon::binomial<0>::radius == 0);
#endif
