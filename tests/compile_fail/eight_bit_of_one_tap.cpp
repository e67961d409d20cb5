// expect: gnomon: eight_bit<Kernel>: the radius must be 1..32
#include <gnomon/filter/kernel.hpp>

#if GNOMON_EXPECT_FAILURE
static_assert(gnomon::eight_bit<gnomon::box<0>>::radius == 0);
#else
static_assert(gnomon::eight_bit<gnomon::box<1>>::radius == 1);
#endif
