// expect: gnomon: fast<narrow<Kernel>>: narrow says how already
#include <gnomon/filter/fast.hpp>

#if GNOMON_EXPECT_FAILURE
static_assert(gnomon::fast<gnomon::narrow<gnomon::binomial<2>>>::radius == 2);
#else
static_assert(gnomon::fast<gnomon::binomial<2>>::radius == 2);
#endif
