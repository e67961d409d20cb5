// expect: gnomon: depth_ratio, and whatever else is not premultiplied, is for unorm8 and unorm16
#include <gnomon/texel/texel.hpp>

#if GNOMON_EXPECT_FAILURE
using channel = gnomon::half16;
#else
using channel = gnomon::unorm16;
#endif

auto made = gnomon::texel<channel, gnomon::depth_ratio>::clear();
