// gnomon: soft shadow maps. The name of this build, in which everything of gnomon lives: namespace gnomon::inline GNOMON_BUILD.
//
// Of an inline function that two files share the linker keeps one copy, whichever. Were one file compiled with -mavx2 and the other
// for any processor, the program could die on one without AVX2, or round differently from what a file was compiled for. So code of
// different flags has different names, gnomon::x86_sse2 and gnomon::x86_v3, and one program may hold both. A gnomon type that
// crosses from one to the other is an undefined reference when the program is linked; pass plain numbers and pointers there.
//
// Named is what x86 and ARM compilers use by themselves once they are allowed to. Flags that no macro tells of are not.
#pragma once

// clang-format off
// A level of the x86-64 ABI, or the widest registers.
#if defined(__AVX2__) && defined(__FMA__) && defined(__F16C__) && defined(__POPCNT__) && defined(__LZCNT__) && defined(__BMI__) && \
    defined(__BMI2__) && defined(__MOVBE__)
#define GNOMON_BUILD_V3 1
#endif
#if defined(GNOMON_BUILD_V3) && defined(__AVX512F__) && defined(__AVX512CD__) && defined(__AVX512DQ__) && defined(__AVX512BW__) && \
    defined(__AVX512VL__)
#define GNOMON_BUILD_V4 1
#endif
#if defined(GNOMON_BUILD_V4)
#define GNOMON_BUILD_LANES x86_v4
#elif defined(__AVX512F__)
#define GNOMON_BUILD_LANES x86_avx512
#elif defined(GNOMON_BUILD_V3)
#define GNOMON_BUILD_LANES x86_v3
#elif defined(__AVX2__)
#define GNOMON_BUILD_LANES x86_avx2
#elif defined(__AVX__)
#define GNOMON_BUILD_LANES x86_avx
#elif defined(__SSE4_2__)
#define GNOMON_BUILD_LANES x86_sse4_2
#elif defined(__SSE4_1__)
#define GNOMON_BUILD_LANES x86_sse4_1
#elif defined(__SSSE3__)
#define GNOMON_BUILD_LANES x86_ssse3
#elif defined(__SSE3__)
#define GNOMON_BUILD_LANES x86_sse3
#elif defined(__SSE2__) || defined(_M_X64)
#define GNOMON_BUILD_LANES x86_sse2
#elif defined(__aarch64__) || defined(_M_ARM64)
#define GNOMON_BUILD_LANES arm64
#elif defined(__wasm_simd128__)
#define GNOMON_BUILD_LANES wasm_simd128
#else
#define GNOMON_BUILD_LANES portable
#endif

// What else is allowed. It is written down here, once: within a #pragma GCC target the compiler's macros change.
// First what a level has in its name:
#if !defined(GNOMON_BUILD_V3) || (defined(__AVX512F__) && !defined(GNOMON_BUILD_V4))
#ifdef __FMA__
#define GNOMON_HAS_FMA 1
#endif
#ifdef __F16C__
#define GNOMON_HAS_F16C 1
#endif
#ifdef __POPCNT__
#define GNOMON_HAS_POPCNT 1
#endif
#ifdef __LZCNT__
#define GNOMON_HAS_LZCNT 1
#endif
#ifdef __BMI__
#define GNOMON_HAS_BMI 1
#endif
#ifdef __BMI2__
#define GNOMON_HAS_BMI2 1
#endif
#ifdef __MOVBE__
#define GNOMON_HAS_MOVBE 1
#endif
#ifdef __AVX512CD__
#define GNOMON_HAS_AVX512CD 1
#endif
#ifdef __AVX512DQ__
#define GNOMON_HAS_AVX512DQ 1
#endif
#ifdef __AVX512BW__
#define GNOMON_HAS_AVX512BW 1
#endif
#ifdef __AVX512VL__
#define GNOMON_HAS_AVX512VL 1
#endif
#endif // and what none of them has
#ifdef __AVX512VNNI__
#define GNOMON_HAS_AVX512VNNI 1
#endif
#ifdef __AVX512VBMI__
#define GNOMON_HAS_AVX512VBMI 1
#endif
#ifdef __AVX512VBMI2__
#define GNOMON_HAS_AVX512VBMI2 1
#endif
#ifdef __AVX512BITALG__
#define GNOMON_HAS_AVX512BITALG 1
#endif
#ifdef __AVX512VPOPCNTDQ__
#define GNOMON_HAS_AVX512VPOPCNTDQ 1
#endif
#ifdef __AVX512FP16__
#define GNOMON_HAS_AVX512FP16 1
#endif
#ifdef __AVXVNNI__
#define GNOMON_HAS_AVXVNNI 1
#endif
#ifdef __GFNI__
#define GNOMON_HAS_GFNI 1
#endif
#ifdef __SSE4A__
#define GNOMON_HAS_SSE4A 1
#endif
#ifdef __XOP__
#define GNOMON_HAS_XOP 1
#endif
#ifdef __FMA4__
#define GNOMON_HAS_FMA4 1
#endif
#ifdef __TBM__
#define GNOMON_HAS_TBM 1
#endif
#ifdef __ARM_FEATURE_DOTPROD
#define GNOMON_HAS_DOTPROD 1
#endif
#ifdef __ARM_FEATURE_MATMUL_INT8
#define GNOMON_HAS_MATMUL_INT8 1
#endif
#ifdef __ARM_FEATURE_FP16_VECTOR_ARITHMETIC
#define GNOMON_HAS_FP16_VECTOR_ARITHMETIC 1
#endif
#ifdef __ARM_FEATURE_SVE
#define GNOMON_HAS_SVE 1
#endif
#ifdef __ARM_FEATURE_SVE2
#define GNOMON_HAS_SVE2 1
#endif

// -ffast-math or a part of it, as far as compilers tell: <gnomon/config.hpp> refuses it or lets it pass.
#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__)
#define GNOMON_HAS_FAST_MATH 1
#endif

// GNOMON_WORD(FMA, _fma) is _fma where GNOMON_HAS_FMA is 1, and else nothing: the comma that 1 makes moves it to second place.
#define GNOMON_COMMA_1 ,
#define GNOMON_SECOND(first, second, ...) second
#define GNOMON_SECOND_OF(...) GNOMON_SECOND(__VA_ARGS__)
#define GNOMON_WORD_OF(has, word) GNOMON_SECOND_OF(GNOMON_COMMA_##has word, , )
#define GNOMON_WORD_IF(has, word) GNOMON_WORD_OF(has, word)
#define GNOMON_WORD(feature, word) GNOMON_WORD_IF(GNOMON_HAS_##feature, word)
#define GNOMON_PASTE_OF(a, b, c, d, e, f, g, h) a##b##c##d##e##f##g##h
#define GNOMON_PASTE(a, b, c, d, e, f, g, h) GNOMON_PASTE_OF(a, b, c, d, e, f, g, h)

#define GNOMON_BUILD_MORE GNOMON_PASTE(GNOMON_WORD(FMA, _fma), GNOMON_WORD(F16C, _f16c), GNOMON_WORD(POPCNT, _popcnt), \
    GNOMON_WORD(LZCNT, _lzcnt), GNOMON_WORD(BMI, _bmi), GNOMON_WORD(BMI2, _bmi2), GNOMON_WORD(MOVBE, _movbe), GNOMON_WORD(GFNI, _gfni))
#define GNOMON_BUILD_AVX512 GNOMON_PASTE(GNOMON_WORD(AVX512CD, _cd), GNOMON_WORD(AVX512DQ, _dq), GNOMON_WORD(AVX512BW, _bw), \
    GNOMON_WORD(AVX512VL, _vl), GNOMON_WORD(AVX512VNNI, _vnni), GNOMON_WORD(AVX512VBMI, _vbmi), GNOMON_WORD(AVX512VBMI2, _vbmi2), \
    GNOMON_WORD(AVX512BITALG, _bitalg))
#define GNOMON_BUILD_RARE GNOMON_PASTE(GNOMON_WORD(AVX512VPOPCNTDQ, _vpopcntdq), GNOMON_WORD(AVX512FP16, _fp16), \
    GNOMON_WORD(AVXVNNI, _avxvnni), GNOMON_WORD(SSE4A, _sse4a), GNOMON_WORD(XOP, _xop), GNOMON_WORD(FMA4, _fma4), GNOMON_WORD(TBM, _tbm), )
#define GNOMON_BUILD_ARM GNOMON_PASTE(GNOMON_WORD(DOTPROD, _dotprod), GNOMON_WORD(MATMUL_INT8, _i8mm), \
    GNOMON_WORD(FP16_VECTOR_ARITHMETIC, _fp16), GNOMON_WORD(SVE, _sve), GNOMON_WORD(SVE2, _sve2), , , )
#define GNOMON_BUILD GNOMON_PASTE(GNOMON_BUILD_LANES, GNOMON_BUILD_MORE, GNOMON_BUILD_AVX512, GNOMON_BUILD_RARE, GNOMON_BUILD_ARM, \
    GNOMON_WORD(FAST_MATH, _fast_math), , )
// clang-format on
