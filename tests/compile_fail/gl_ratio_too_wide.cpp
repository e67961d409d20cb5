// expect: gnomon: sums of this texel and kernel do not fit the scratch of GL
#include <gnomon/gl/shader_filter.hpp>

#if GNOMON_EXPECT_FAILURE
using texel = gnomon::tm16;
#else
using texel = gnomon::tm8;
#endif

const auto text = gnomon::gl::filter_columns_text<texel, gnomon::box<1>>();
