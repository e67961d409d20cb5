// expect: no matching function for call to .*caster
#include <gnomon/texel/texel.hpp>

#if GNOMON_EXPECT_FAILURE
using chosen = gnomon::rgb8;
#else
using chosen = gnomon::rga8;
#endif

auto made = chosen::caster(0.5f, 0.25f);
