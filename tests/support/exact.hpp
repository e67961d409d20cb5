// Oracles without rounding. They use integers alone, so that no property of the machine's floats is taken on trust.
#pragma once

#include "bits.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace test {

/// A sum of floating point numbers and of their products, kept exactly: two's complement fixed point from 2^-384 to 2^191.
class exact_sum {
  public:
    exact_sum& add(double v) { return add_product(v, 1.0); }
    exact_sum& add_product(double a, double b) {
        const parts p = split(a), q = split(b);
        const bool negative = p.negative != q.negative;
        const int exponent = p.exponent + q.exponent;
        add(p.low * q.low, exponent, negative);
        add(p.low * q.high, exponent + 32, negative);
        add(p.high * q.low, exponent + 32, negative);
        add(p.high * q.high, exponent + 64, negative);
        return *this;
    }
    [[nodiscard]] int sign() const noexcept {
        if (limbs_.back() >> 63 != 0) return -1;
        for (const std::uint64_t limb : limbs_)
            if (limb != 0) return 1;
        return 0;
    }

  private:
    static constexpr int lowest_exponent = -384;

    struct parts {
        std::uint64_t low;
        std::uint64_t high;
        int exponent;
        bool negative;
    };
    [[nodiscard]] static parts split(double v) noexcept {
        const auto bits = std::bit_cast<std::uint64_t>(v);
        const int biased = static_cast<int>(bits >> 52 & 0x7FF);
        std::uint64_t significand = (bits & 0xFFFFFFFFFFFFF) | (biased != 0 ? std::uint64_t{1} << 52 : 0);
        const int zeros = significand != 0 ? std::countr_zero(significand) : 0;
        significand >>= zeros;
        return {significand & 0xFFFFFFFF, significand >> 32, (biased != 0 ? biased : 1) - 1075 + zeros, bits >> 63 != 0};
    }
    void add(std::uint64_t magnitude, int exponent, bool negative) {
        const auto place = static_cast<std::size_t>(exponent - lowest_exponent); // out of range: put() throws
        const auto shift = static_cast<int>(place % 64);
        put(place / 64, magnitude << shift, negative);
        if (shift != 0) put(place / 64 + 1, magnitude >> (64 - shift), negative);
    }
    void put(std::size_t limb, std::uint64_t magnitude, bool negative) {
        if (magnitude == 0) return;
        if (limb >= limbs_.size()) throw std::out_of_range("exact_sum");
        while (magnitude != 0 && limb < limbs_.size()) {
            std::uint64_t& here = limbs_[limb++];
            const std::uint64_t before = here;
            here = negative ? before - magnitude : before + magnitude;
            magnitude = (negative ? here > before : here < before) ? 1 : 0; // carry or borrow
        }
    }

    std::array<std::uint64_t, 9> limbs_{};
};

/// Is e > m (1-z), exactly?
[[nodiscard]] inline bool exactly_behind(double e, double m, double z) {
    return exact_sum{}.add(e).add(-m).add_product(m, z).sign() > 0;
}

/// Is `f` the float nearest to (m - e) / m, ties to even? By the midpoints to both neighbours: no division.
/// \pre m > 0 and 0 <= e <= m
[[nodiscard]] inline bool is_nearest_depth(float f, float e, float m) {
    const double own = static_cast<double>(f), depth = static_cast<double>(e), mask = static_cast<double>(m);
    const auto side = [&](float neighbour) {                                // of (own + neighbour)/2 against the quotient
        const double middle = (own + static_cast<double>(neighbour)) / 2.0; // 25 bits: exact
        return exact_sum{}.add_product(middle, mask).add(-mask).add(depth).sign();
    };
    const int below = side(down(f)), above = side(up(f));
    const bool even = (std::bit_cast<std::uint32_t>(f) & 1) == 0;
    return below <= 0 && above >= 0 && (even || (below < 0 && above > 0));
}

/// A positive normal float as significand / 2^shift.
struct whole_parts {
    std::int64_t significand;
    int shift;
};
[[nodiscard]] constexpr whole_parts split(float v) noexcept {
    const auto bits = std::bit_cast<std::uint32_t>(v);
    return {static_cast<std::int64_t>((bits & 0x7FFFFF) | 0x800000), 150 - static_cast<int>(bits >> 23)};
}

/// Is `f` the float nearest to a / m, ties to even? In 64-bit integers, for scans.
/// \pre 0 <= a <= m, 0 < m < 65536
[[nodiscard]] constexpr bool is_nearest_share(float f, std::int64_t a, std::int64_t m) noexcept {
    if (a == 0 || !(f >= 0x1p-17f && f <= 1.0f)) return a == 0 && same_bits(f, 0.0f);
    const auto [significand, shift] = split(f);
    const std::int64_t above = 4 * (significand * m - (a << shift));                     // of the quotient, in units of ulp / (4 m)
    const std::int64_t to_below = significand == 0x800000 ? m : 2 * m, to_above = 2 * m; // half way to the neighbours
    return (significand & 1) == 0 ? above <= to_below && -above <= to_above : above < to_below && -above < to_above;
}

} // namespace test
