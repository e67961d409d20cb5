// Dice for floats: their bits are thrown, so that every exponent is as likely as any other.
#pragma once

#include "bits.hpp"
#include "dice.hpp"

#include <cstdint>

namespace test {

class float_dice : public dice {
  public:
    using dice::dice;

    std::uint32_t word() {
        return static_cast<std::uint32_t>((*this)(0, 0xFFFF)) << 16 | static_cast<std::uint32_t>((*this)(0, 0xFFFF));
    }
    /// Any of the 2^32 patterns.
    float any() { return float_of(word()); }
    /// A float in [0, 1], subnormals among them.
    float any_unit() { return float_of(word() % (0x3F800000u + 1)); }
    /// A double in [low, 2 low), all of its digits random.
    double binade(double low) {
        return low * (1.0 + static_cast<double>(word()) * 0x1p-32 + static_cast<double>(word() >> 12) * 0x1p-52);
    }
};

} // namespace test
