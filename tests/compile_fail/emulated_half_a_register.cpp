// expect: gnomon: emulated<Bytes>: a register has 16 bytes or a multiple of it
#include <gnomon/simd/emulated.hpp>

#if GNOMON_EXPECT_FAILURE
static_assert(gnomon::emulated<24>::bytes == 24);
#else
static_assert(gnomon::emulated<48>::bytes == 48);
#endif
