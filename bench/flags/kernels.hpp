// Filters and decisions as one build makes them. kernels.cpp is compiled twice: -O2 as a user might, and -O3 -march=native.
#pragma once

#include <span>

namespace flags {

/// Runs once, on memory of its own, of 1024 x 1024 texels. Nothing of gnomon's crosses from one build to another.
struct kernel {
    const char* name;
    void (*run)();
};

/// In the best lanes of the processor, or in those of AVX2.
enum class lanes { best, avx2 };
std::span<const kernel> o2_plain(lanes which);
std::span<const kernel> o3_native(lanes which);

} // namespace flags
