// Seeded dice for the tests: the same throws with every standard library, which std::uniform_int_distribution does not promise.
#pragma once

#include <gnomon/rect.hpp>

#include <cstdint>
#include <random>

namespace test {

class dice {
  public:
    explicit dice(std::uint64_t seed) : bits_(seed) {}

    /// A whole number in [low, high].
    int operator()(int low, int high) {
        const auto sides = static_cast<std::uint64_t>(std::int64_t{high} - low) + 1;
        return static_cast<int>(low + static_cast<std::int64_t>(bits_() % sides));
    }
    bool one_in(int n) { return (*this)(1, n) == 1; }
    /// A multiple of 2^-24 in [0, 1).
    float unit() { return static_cast<float>(bits_() >> 40) * 0x1p-24f; }
    /// A rectangle whose corners lie up to `beyond` texels off the map; one in eight is inverted or empty.
    gnomon::texel_rect rect(gnomon::extent map, int beyond) {
        gnomon::texel_rect r{(*this)(-beyond, map.width + beyond), (*this)(-beyond, map.height + beyond), 0, 0};
        const int least = one_in(8) ? -3 : 1;
        r.x1 = r.x0 + (*this)(least, 1 + map.width / 2);
        r.y1 = r.y0 + (*this)(least, 1 + map.height / 2);
        return r;
    }

  private:
    std::mt19937_64 bits_;
};

} // namespace test
