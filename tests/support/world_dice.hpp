// Seeded dice for positions in the world.
#pragma once

#include <gnomon/geometry/bounds.hpp>

#include <random>

namespace test {

struct world_dice {
    std::mt19937_64 bits;
    double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(bits); }
    glm::dvec3 vector(double reach) { return {(*this)(-reach, reach), (*this)(-reach, reach), (*this)(-reach, reach)}; }
    glm::dvec3 inside(const gnomon::bounding_box& b) {
        return {(*this)(b.lower.x, b.upper.x), (*this)(b.lower.y, b.upper.y), (*this)(b.lower.z, b.upper.z)};
    }
};

} // namespace test
