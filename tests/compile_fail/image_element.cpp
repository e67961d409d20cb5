// expect: gnomon: image<T> holds plain texels: T must be trivially copyable
#include <gnomon/texel/image.hpp>

#if GNOMON_EXPECT_FAILURE
struct element {
    element() = default;
    element(const element&) {}
    element& operator=(const element&) = default;
};
#else
struct element {};
#endif

gnomon::image<element> made({1, 1});
