// Some hosts let the processor flush subnormals to zero. While a `flush_subnormals` lives, this thread does, on x86.
#pragma once

#if defined(__SSE2__) || defined(_M_X64)
#include <xmmintrin.h>

namespace test {

inline constexpr bool can_flush = true;

class flush_subnormals {
  public:
    explicit flush_subnormals(bool on) noexcept : before_(_mm_getcsr()) {
        if (on) _mm_setcsr(before_ | 0x8040u); // FTZ for results, DAZ for operands
    }
    flush_subnormals(const flush_subnormals&) = delete;
    flush_subnormals& operator=(const flush_subnormals&) = delete;
    ~flush_subnormals() { _mm_setcsr(before_); }

  private:
    unsigned before_;
};

} // namespace test
#else
namespace test {

inline constexpr bool can_flush = false;

class flush_subnormals {
  public:
    explicit flush_subnormals(bool) noexcept {}
    flush_subnormals(const flush_subnormals&) = delete;
    flush_subnormals& operator=(const flush_subnormals&) = delete;
    ~flush_subnormals() {}
};

} // namespace test
#endif
