// expect: gnomon: float and double must be evaluated in their own precision
#include <cfloat>
#undef FLT_EVAL_METHOD
#define FLT_EVAL_METHOD 2 // as with the x87
#if !GNOMON_EXPECT_FAILURE
#define GNOMON_ALLOW_FAST_MATH
#endif
#include <gnomon/unit.hpp>
