// gnomon: soft shadow maps. Code for a processor that the rest of the file is not compiled for.
//
// Between GNOMON_TARGET_BEGIN("avx2") and GNOMON_TARGET_END functions may use those instructions, whatever the command line allows;
// who calls them has asked the processor first. MSVC allows intrinsics anywhere and needs no word of it.
#pragma once

// clang-format off
#define GNOMON_PRAGMA(...) _Pragma(#__VA_ARGS__)
#if defined(__clang__)
#define GNOMON_TARGET_BEGIN(features) GNOMON_PRAGMA(clang attribute push(__attribute__((target(features))), apply_to = function))
#define GNOMON_TARGET_END GNOMON_PRAGMA(clang attribute pop)
#elif defined(__GNUC__)
#define GNOMON_TARGET_BEGIN(features) GNOMON_PRAGMA(GCC push_options) GNOMON_PRAGMA(GCC target(features))
#define GNOMON_TARGET_END GNOMON_PRAGMA(GCC pop_options)
#else
#define GNOMON_TARGET_BEGIN(features)
#define GNOMON_TARGET_END
#endif

// One lane operation: a static member function that is never called, always expanded.
#if defined(__GNUC__)
#define GNOMON_LANES [[nodiscard, gnu::always_inline]] static inline
#define GNOMON_LANES_VOID [[gnu::always_inline]] static inline
#define GNOMON_INLINE [[gnu::always_inline]] inline
#if defined(__clang__)
#define GNOMON_UNROLL(times) GNOMON_PRAGMA(unroll times)
#else
#define GNOMON_UNROLL(times) GNOMON_PRAGMA(GCC unroll times)
#endif
#else
#define GNOMON_LANES [[nodiscard]] static __forceinline
#define GNOMON_LANES_VOID static __forceinline
#define GNOMON_INLINE __forceinline
#define GNOMON_UNROLL(times)
#endif

// Keeps a number in a register of its own: loops of such loads and stores are not made into gathers, or into vectors put together
// number by number.
#if defined(__GNUC__)
#define GNOMON_ALONE(a) asm("" : "+r"(a))
#else
#define GNOMON_ALONE(a) static_cast<void>(a)
#endif

// Keeps a sum where it stands, see emulated::settle; and a product from being fused with what it is added to.
#if defined(__GNUC__) && defined(__x86_64__)
#define GNOMON_SETTLE(a) asm("" : "+v"(a))
#elif defined(__GNUC__) && defined(__aarch64__)
#define GNOMON_SETTLE(a) asm("" : "+w"(a))
#elif defined(__GNUC__) && !defined(__wasm__)
#define GNOMON_SETTLE(a) asm("" : "+m"(a))
#else
#define GNOMON_SETTLE(a) static_cast<void>(a)
#endif

#if defined(__x86_64__) || defined(_M_X64)
#define GNOMON_X86 1
#else
#define GNOMON_X86 0
#endif
#if defined(__GNUC__) && defined(__ARM_NEON) && defined(__AARCH64EL__)
#define GNOMON_NEON 1
#else
#define GNOMON_NEON 0
#endif
#if defined(__wasm_simd128__)
#define GNOMON_WASM 1
#else
#define GNOMON_WASM 0
#endif
// clang-format on
