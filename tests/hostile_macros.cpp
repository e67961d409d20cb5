// The words <windows.h>, X11, engines and old C headers take as macros: gnomon must not use one of them as a name.
// Standard headers come first; these macros are at war with them, too.
#include <array>
#include <bit>
#include <cassert>
#include <cfloat>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#ifdef __clang__
#pragma clang diagnostic ignored "-Wunused-macros" // unused is what they should be
#endif

// windows.h
#define near
#define far
#define small char
#define interface struct
#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))
#define TRANSPARENT 1
#define OPAQUE 2
#define ERROR 0
#define IN
#define OUT
#define RELATIVE 2
#define DIFFERENCE 11
// X11
#define None 0L
#define Bool int
#define Status int
#define Success 0
#define Always 2
#define Complex 0
// Unreal, and AssertMacros.h of macOS
#define check(x) (void)(x)
#define verify(x) (void)(x)
#define require(x, label) goto label
// complex.h, and what fmt tests with
#define I 42

#include <gnomon/gl/soft_shadow_map.hpp>
#include <gnomon/gl/state.hpp>
#include <gnomon/gnomon.hpp>

int main() {
    gnomon::soft_shadow_map<gnomon::rg8, gnomon::binomial<3>> map({.width = 512, .height = 512, .tile = 16});
    map.cast({.x0 = 200, .y0 = 200, .x1 = 300, .y1 = 300}, 0.4f);
    map.filter();
    std::printf("lit %.3f umbra %.3f penumbra %.3f in front %.3f\n", static_cast<double>(map.shadow(10, 10, 0.9f)),
                static_cast<double>(map.shadow(250, 250, 0.9f)), static_cast<double>(map.shadow(199, 250, 0.9f)),
                static_cast<double>(map.shadow(250, 250, 0.2f)));
}
