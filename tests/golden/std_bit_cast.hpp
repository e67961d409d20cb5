// The emscripten of Debian 12 is clang 14 with the libc++ of clang 13, which lacks one thing that gnomon asks of a C++20 library.
#pragma once

#include <bit>

#if !defined(__cpp_lib_bit_cast) || __cpp_lib_bit_cast < 201806L
namespace std {
template <typename To, typename From> constexpr To bit_cast(const From& from) noexcept { return __builtin_bit_cast(To, from); }
} // namespace std
#endif
