// One function, compiled three times with different flags, and linked into one program: see flags.cpp and flags_main.cpp.
// Only plain numbers cross from one of these files to another.
#pragma once

#include <cstdint>

std::uint32_t picture_of_baseline();
std::uint32_t picture_of_avx2();
std::uint32_t picture_of_avx512();
