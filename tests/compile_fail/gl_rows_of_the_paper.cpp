// expect: gnomon: paper_depth_mask is a baseline for comparisons on the CPU: in GL use depth_mask
#include <gnomon/gl/shader_filter.hpp>

#if GNOMON_EXPECT_FAILURE
using representation = gnomon::paper_depth_mask;
#else
using representation = gnomon::depth_mask;
#endif

const auto text = gnomon::gl::filter_rows_text<gnomon::texel<gnomon::unorm8, representation>, gnomon::box<1>>();
