// expect: gnomon: narrow<Kernel>: a ratio of depth and mask is made from sums of both passes
#include <gnomon/filter/separable.hpp>

#if GNOMON_EXPECT_FAILURE
using texel = gnomon::tm8;
#else
using texel = gnomon::rg8;
#endif

constexpr int roundings = gnomon::filter_roundings<texel, gnomon::narrow<gnomon::box<1>>>;
