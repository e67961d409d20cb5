// expect: gnomon: simd<Isa> takes sse2, avx2, avx512, neon, wasm128, emulated<Bytes> or lanes of your own
#include <gnomon/backend/simd.hpp>

struct widest {}; // has none of the operations

#if GNOMON_EXPECT_FAILURE
[[maybe_unused]] constexpr gnomon::simd<widest> run{};
#else
[[maybe_unused]] constexpr gnomon::simd<gnomon::emulated<32>> run{};
#endif
