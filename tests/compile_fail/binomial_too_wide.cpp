// expect: gnomon: binomial<R>: .*use gaussian for more
#include <gnomon/filter/kernel.hpp>

#if GNOMON_EXPECT_FAILURE
static_assert(gnomon::binomial<31>::radius == 31);
#else
static_assert(gnomon::binomial<30>::radius == 30);
#endif
