// expect: gnomon: eight_bit<Kernel>: the radius must be 1..32
#include <gnomon/filter/kernel.hpp>

#if GNOMON_EXPECT_FAILURE
static_assert(gnomon::eight_bit<gnomon::gaussian<33>>::radius == 33);
#else
static_assert(gnomon::eight_bit<gnomon::gaussian<32>>::radius == 32);
#endif
