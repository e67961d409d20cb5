// gnomon: soft shadow maps. IEEE binary16, through integers alone: the same bits on every compiler, with or without F16C.
#pragma once

#include <gnomon/config.hpp>

#include <bit>
#include <cstdint>

namespace gnomon::inline GNOMON_BUILD {

/// The half nearest to `v`, ties to even, as its bit pattern. Overflow gives infinity, NaN a quiet NaN.
///
///     sign 1 | exponent 5, bias 15 | mantissa 10        smallest normal 2^-14, smallest subnormal 2^-24
///
/// From double, so that an exact sum is rounded once. No pair of casts:
/// g++ 12 takes two conversions to a narrower type and back, side by side, for none at all.
[[nodiscard]] constexpr std::uint16_t half_from(double v) noexcept {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(v);
    const auto sign = static_cast<std::uint16_t>(bits >> 48 & 0x8000u);
    const int exponent = static_cast<int>(bits >> 52 & 0x7FFu) - 1023;
    const std::uint64_t fraction = bits & 0xFFFFFFFFFFFFFu;
    if (exponent == 1024) return static_cast<std::uint16_t>(sign | (fraction != 0 ? 0x7E00u : 0x7C00u));
    if (exponent > 15) return static_cast<std::uint16_t>(sign | 0x7C00u);
    if (exponent < -25) return sign; // below half the smallest subnormal, or zero

    // The significand in units of the last place that survives; a carry out of the mantissa moves into the exponent by itself.
    const bool normal = exponent >= -14;
    const int dropped = normal ? 42 : 28 - exponent;
    const std::uint64_t significand =
        normal ? (static_cast<std::uint64_t>(exponent + 15) << 52 | fraction) : (1ull << 52 | fraction);
    const std::uint64_t kept = significand >> dropped;
    const std::uint64_t rest = significand & ((1ull << dropped) - 1);
    const std::uint64_t tie = 1ull << (dropped - 1);
    const bool up = rest > tie || (rest == tie && (kept & 1) != 0);
    return static_cast<std::uint16_t>(sign | (kept + (up ? 1 : 0)));
}

/// The value of a half, exactly. Any of the 65,536 patterns; NaN stays NaN.
[[nodiscard]] constexpr float half_to_float(std::uint16_t h) noexcept {
    const std::uint32_t sign = (h & 0x8000u) << 16;
    const std::uint32_t exponent = h >> 10 & 0x1Fu;
    std::uint32_t mantissa = h & 0x3FFu;
    if (exponent == 31) return std::bit_cast<float>(sign | 0x7F800000u | mantissa << 13);
    if (exponent != 0) return std::bit_cast<float>(sign | (exponent + 112) << 23 | mantissa << 13);
    if (mantissa == 0) return std::bit_cast<float>(sign);
    const int shift = std::countl_zero(mantissa) - 21; // brings the leading one to bit 10
    mantissa = mantissa << shift & 0x3FFu;
    return std::bit_cast<float>(sign | (113u - static_cast<unsigned>(shift)) << 23 | mantissa << 13);
}

} // namespace gnomon::inline GNOMON_BUILD
