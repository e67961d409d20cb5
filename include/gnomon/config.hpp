// gnomon: soft shadow maps. Every macro a user may set, and what the library demands of its compiler.
#pragma once

#include <gnomon/build.hpp>

#include <cfloat>

// GNOMON_ASSERT(condition, "sentence") checks a wrong call in debug builds. Define it before the first include to route it
// elsewhere. It has no side effects, and every function that uses it also has a written result for builds without it.
#ifndef GNOMON_ASSERT
#include <cassert>
#define GNOMON_ASSERT(condition, sentence) assert((condition) && (sentence))
#endif

// clang-format off
// NaN must compare false and a difference must not be reassociated: both decide whether a receiver is lit. g++ also tells of the
// parts of -ffast-math: a reciprocal is no correctly rounded decode, and without signed zeros float32::store rounds nothing.
#if defined(GNOMON_HAS_FAST_MATH) && !defined(GNOMON_ALLOW_FAST_MATH)
#error "gnomon: -ffast-math and -ffinite-math-only break NaN handling and exact decisions, and so do the flags that -ffast-math is \
made of. Compile the file that includes gnomon without them, or define GNOMON_ALLOW_FAST_MATH and accept that no bound is promised."
#endif

#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0 && !defined(GNOMON_ALLOW_FAST_MATH)
#error "gnomon: float and double must be evaluated in their own precision (FLT_EVAL_METHOD == 0). On 32-bit x86 pass -msse2 -mfpmath=sse."
#endif
// clang-format on
