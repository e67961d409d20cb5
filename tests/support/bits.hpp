// Floats as the bits they are: exact equality, neighbours, and the numbers nobody likes.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>

namespace test {

[[nodiscard]] constexpr bool same_bits(float a, float b) noexcept {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}
[[nodiscard]] constexpr bool same_bits(double a, double b) noexcept {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Equal as numbers: 0 is -0, NaN is nothing.
template <typename Real> [[nodiscard]] constexpr bool equal(Real a, Real b) noexcept { return a <= b && a >= b; }
template <typename Real> [[nodiscard]] constexpr bool is_nan(Real v) noexcept { return !(v <= v); }

namespace detail {
template <typename Bits, typename Real> [[nodiscard]] constexpr Real step(Real v, bool up) noexcept {
    const auto bits = std::bit_cast<Bits>(v);
    constexpr Bits sign = Bits{1} << (8 * sizeof(Bits) - 1);
    if ((bits & ~sign) == 0) return std::bit_cast<Real>(static_cast<Bits>(up ? 1 : (sign | 1)));
    return std::bit_cast<Real>(static_cast<Bits>(((bits & sign) == 0) == up ? bits + 1 : bits - 1));
}
} // namespace detail

/// The next number of the type above or below; \pre finite.
[[nodiscard]] constexpr float up(float v) noexcept { return detail::step<std::uint32_t>(v, true); }
[[nodiscard]] constexpr float down(float v) noexcept { return detail::step<std::uint32_t>(v, false); }
[[nodiscard]] constexpr double up(double v) noexcept { return detail::step<std::uint64_t>(v, true); }
[[nodiscard]] constexpr double down(double v) noexcept { return detail::step<std::uint64_t>(v, false); }

[[nodiscard]] constexpr float float_of(std::uint32_t bits) noexcept { return std::bit_cast<float>(bits); }

template <typename Real> inline constexpr Real infinity = std::numeric_limits<Real>::infinity();
template <typename Real> inline constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();
template <typename Real> inline constexpr Real smallest = std::numeric_limits<Real>::denorm_min();

/// Both signs of what breaks code: zero, subnormal, the edge of normal, around 1/2 and 1, beyond, the largest, infinity, NaN.
inline constexpr std::array<float, 30> hostile_floats{0.0f,
                                                      -0.0f,
                                                      smallest<float>,
                                                      -smallest<float>,
                                                      0x1p-127f,
                                                      -0x1p-127f,
                                                      0x1p-126f,
                                                      -0x1p-126f,
                                                      0x1p-100f,
                                                      0x1p-25f,
                                                      0.25f,
                                                      0x1.fffffep-2f,
                                                      0.5f,
                                                      0x1.000002p-1f,
                                                      0.75f,
                                                      0x1.fffffep-1f,
                                                      1.0f,
                                                      -1.0f,
                                                      0x1.000002p0f,
                                                      2.0f,
                                                      -2.0f,
                                                      65504.0f,
                                                      65536.0f,
                                                      0x1p31f,
                                                      -0x1p31f,
                                                      0x1.fffffep127f,
                                                      -0x1.fffffep127f,
                                                      infinity<float>,
                                                      -infinity<float>,
                                                      nan<float>};

} // namespace test
