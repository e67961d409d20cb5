// expect: gnomon: gl::load takes a loader that returns void\* or a pointer to a function
#include <gnomon/gl/functions.hpp>

#include <cstdint>

#if GNOMON_EXPECT_FAILURE
using address = std::uintptr_t; // of the right size, so nothing else would tell
#else
using address = void*;
#endif

const auto table = gnomon::gl::load([](const char*) -> address { return {}; });
