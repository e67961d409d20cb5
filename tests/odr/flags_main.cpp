// Runs what the processor can run, and exits with 0 if all of it made the same picture.
#include "flags.hpp"

#include <gnomon/simd/isa.hpp>

#include <cstdio>

int main() {
    const gnomon::cpu_level level = gnomon::best_lanes();
    const std::uint32_t baseline = picture_of_baseline();
    const std::uint32_t avx2 = level >= gnomon::cpu_level::avx2 ? picture_of_avx2() : baseline;
    const std::uint32_t avx512 = level >= gnomon::cpu_level::avx512 ? picture_of_avx512() : baseline;
    std::printf("%08x %08x %08x\n", static_cast<unsigned>(baseline), static_cast<unsigned>(avx2), static_cast<unsigned>(avx512));
    return baseline == avx2 && baseline == avx512 ? 0 : 1;
}
