// expect: gnomon: narrow<fast<Kernel>>: narrow is as fast already
#include <gnomon/filter/fast.hpp>

#if GNOMON_EXPECT_FAILURE
static_assert(gnomon::narrow<gnomon::fast<gnomon::binomial<2>>>::radius == 2);
#else
static_assert(gnomon::narrow<gnomon::binomial<2>>::radius == 2);
#endif
