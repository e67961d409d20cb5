// expect: (no matching function for call to|invalid reference to function).*bound
#include <gnomon/texel/texel.hpp>

#if GNOMON_EXPECT_FAILURE
using chosen = gnomon::rga8;
#else
using chosen = gnomon::rgb8;
#endif

void end_shadow(chosen& texel) { texel.bound(0.5f); }
