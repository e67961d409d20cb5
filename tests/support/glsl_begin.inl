// From here to glsl_end.inl the words of GLSL are those of support/glsl.hpp, and no compiler complains of a shader that it is not C++.
#ifdef __clang__
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Weverything"
#else
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wuseless-cast"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#endif
#define float real
#define bool truth
#define precise
#define layout(location)
#define uniform static
#define in static
#define out static
#define flat
