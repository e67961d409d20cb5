// gnomon: soft shadow maps. Kernels: separable, non-negative, and summing to exactly one because the weights are whole numbers.
#pragma once

#include <gnomon/unit.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace gnomon::inline GNOMON_BUILD {

/// A separable filter: 2 * radius + 1 whole weights, whose sum is `total`; a tap counts weight / total.
///
/// Whole weights make the sum one in any arithmetic, and a unorm map is filtered without any error before its one rounding.
/// `kernel_is_sound` says the rest of the contract, and a filter refuses a kernel that breaks it, with a sentence.
template <typename K>
concept kernel = requires {
    requires std::same_as<std::remove_cv_t<decltype(K::radius)>, int>;
    requires std::same_as<std::remove_cv_t<decltype(K::total)>, int>;
    requires std::same_as<std::remove_cv_t<decltype(K::weights)>, std::array<int, static_cast<std::size_t>(2 * K::radius + 1)>>;
};

/// The largest total: two passes over 16-bit codes then stay within 48 bits, and a float times a weight is exact in double.
inline constexpr int kernel_total_limit = 65536;

/// Refuses, at compile time, a kernel that would darken, brighten, shift, ring or overflow.
template <kernel K> consteval bool kernel_is_sound() {
    constexpr auto negative = [] {
        for (const int w : K::weights)
            if (w < 0) return true;
        return false;
    }();
    constexpr auto lopsided = [] {
        for (std::size_t i = 0; i < K::weights.size(); ++i)
            if (K::weights[i] != K::weights[K::weights.size() - 1 - i]) return true;
        return false;
    }();
    constexpr auto sum = [] {
        std::int64_t s = 0;
        for (const int w : K::weights) s += w;
        return s;
    }();
    static_assert(
        !negative,
        "gnomon: a kernel with a negative weight leaves [0, 1] and breaks the depth test; use box, tent, binomial or gaussian");
    static_assert(negative || sum == K::total,
                  "gnomon: the weights of a kernel must sum to its total, or shadows lose or gain strength");
    static_assert(!lopsided, "gnomon: a kernel must be symmetric, or the shadow moves");
    static_assert(K::total > 0 && K::total <= kernel_total_limit,
                  "gnomon: a kernel's total must lie in 1..65536, so that both passes stay exact");
    return true;
}

namespace detail {

template <int Radius> using weights_of = std::array<int, static_cast<std::size_t>(2 * Radius + 1)>;

/// Whole weights that sum to exactly `Total` and keep the proportions of `exact` to within one unit each: by largest
/// remainder, in symmetric pairs; what is odd goes to the centre.
template <int Radius, int Total = kernel_total_limit, typename Number>
constexpr weights_of<Radius> apportion(const std::array<Number, static_cast<std::size_t>(Radius + 1)>& exact) {
    Number sum = exact[0];
    for (std::size_t i = 1; i <= Radius; ++i) sum += 2 * exact[i];
    std::array<int, static_cast<std::size_t>(Radius + 1)> share{};
    std::array<double, static_cast<std::size_t>(Radius + 1)> rest{};
    int left = Total;
    for (std::size_t i = 0; i <= Radius; ++i) {
        const double ideal = static_cast<double>(exact[i]) * Total / static_cast<double>(sum);
        share[i] = static_cast<int>(ideal);
        rest[i] = ideal - share[i];
        left -= i == 0 ? share[i] : 2 * share[i];
    }
    if (left % 2 != 0) {
        ++share[0];
        --left;
    }
    // The largest remainders get one more, of equal ones the inner ones: all above `high`, and of those above `low` as many as are left.
    // Remainders of whole numbers lie 2^-16 apart.
    constexpr int halvings = std::integral<Number> ? 18 : 40;
    double low = 0.0, high = 1.0;
    for (int k = 0; k < halvings && left > 0; ++k) {
        const double middle = (low + high) / 2.0;
        int above = 0;
        for (std::size_t i = 1; i <= Radius; ++i) above += rest[i] > middle ? 2 : 0;
        (above <= left ? high : low) = middle;
        if (above == left) break;
    }
    for (const double bound : {high, low})
        for (std::size_t i = 1; i <= Radius && left > 0; ++i)
            if (rest[i] > bound) {
                ++share[i];
                left -= 2;
                rest[i] = 0.0;
            }
    weights_of<Radius> w{};
    for (std::size_t i = 0; i <= Radius; ++i) w[Radius + i] = w[Radius - i] = share[i];
    return w;
}

/// exp(-x) for x >= 0, within 2e-15: the series at x / 2^k, squared k times. (No constexpr <cmath> in C++20.)
constexpr double exp_minus(double x) {
    int halvings = 0;
    for (; x > 0.125; ++halvings) x /= 2;
    double term = 1.0, sum = 1.0;
    for (int n = 1; n < 14; ++n) sum += term *= -x / n;
    for (; halvings > 0; --halvings) sum *= sum;
    return sum;
}

} // namespace detail

/// Every tap the same: 1 / (2R+1), exactly. Standard deviation sqrt(R(R+1)/3).
template <int Radius> struct box {
    static_assert(Radius >= 0 && Radius <= 4096, "gnomon: box<R>: R is the number of taps on each side of the centre, 0..4096");
    static constexpr int radius = Radius;
    static constexpr int total = 2 * Radius + 1;
    static constexpr auto weights = [] {
        detail::weights_of<Radius> w{};
        for (int& each : w) each = 1;
        return w;
    }();
};

/// Falling linearly to nothing just outside: (R+1-|i|) / (R+1)^2, exactly. Standard deviation sqrt(R(R+2)/6).
template <int Radius> struct tent {
    static_assert(Radius >= 0 && Radius < 256, "gnomon: tent<R>: R is the number of taps on each side of the centre, 0..255");
    static constexpr int radius = Radius;
    static constexpr int total = (Radius + 1) * (Radius + 1);
    static constexpr auto weights = [] {
        detail::weights_of<Radius> w{};
        for (int i = 0; i <= Radius; ++i) w[static_cast<std::size_t>(i)] = w[static_cast<std::size_t>(2 * Radius - i)] = i + 1;
        return w;
    }();
};

/// The row 2R of Pascal's triangle over 4^R: exact up to R = 8, to within 2^-16 a tap beyond. Standard deviation sqrt(R/2).
template <int Radius> struct binomial {
    static_assert(Radius >= 0 && Radius <= 30,
                  "gnomon: binomial<R>: R is the number of taps on each side of the centre, 0..30; use gaussian for more");
    static constexpr int radius = Radius;
    static constexpr int total = Radius <= 8 ? 1 << (2 * Radius) : kernel_total_limit;
    static constexpr auto weights = [] {
        std::array<std::uint64_t, static_cast<std::size_t>(Radius + 1)> row{}; // from the centre outwards
        std::uint64_t choose = 1;                                              // C(2R, k), k from the rim to the centre
        for (int k = 0; k <= Radius; ++k) {
            row[static_cast<std::size_t>(Radius - k)] = choose;
            choose = choose * static_cast<std::uint64_t>(2 * Radius - k) / static_cast<std::uint64_t>(k + 1);
        }
        if constexpr (Radius > 8) return detail::apportion<Radius>(row);
        detail::weights_of<Radius> w{};
        for (std::size_t i = 0; i <= Radius; ++i) w[Radius + i] = w[Radius - i] = static_cast<int>(row[i]);
        return w;
    }();
};

/// The sampled normal distribution cut off at R, within 2^-16 a tap of its exact proportions.
/// `SigmaPercent` is the standard deviation in percent of R: 50 leaves 14 % of the peak at the rim, 33 leaves 1 %.
template <int Radius, int SigmaPercent = 50> struct gaussian {
    static_assert(Radius >= 0 && Radius <= 256, "gnomon: gaussian<R>: R is the number of taps on each side of the centre, 0..256");
    static_assert(SigmaPercent > 0, "gnomon: gaussian<R, SigmaPercent>: the standard deviation, in percent of R, must be positive");
    static constexpr int radius = Radius;
    static constexpr int total = kernel_total_limit;
    static constexpr auto weights = [] {
        std::array<double, static_cast<std::size_t>(Radius + 1)> bell{};
        const double sigma = greater(Radius, 1) * (SigmaPercent / 100.0);
        for (int i = 0; i <= Radius; ++i) bell[static_cast<std::size_t>(i)] = detail::exp_minus(i * i / (2 * sigma * sigma));
        return detail::apportion<Radius>(bell);
    }();
};

namespace detail {

/// A kernel's proportions in whole weights of another total, within one unit of each.
template <kernel Kernel, int Total> struct in_units {
    static constexpr int radius = Kernel::radius;
    static constexpr int total = Total;
    static constexpr auto weights = [] {
        std::array<int, static_cast<std::size_t>(radius + 1)> proportions{};
        for (std::size_t i = 0; i <= radius; ++i) proportions[i] = Kernel::weights[radius + i];
        return apportion<radius, total>(proportions);
    }();
};

} // namespace detail

/// Another kernel in weights of eight bits, within one unit in 256 of its proportions, so a weight may be one unit above its inner
/// neighbour. For 8-bit maps, which the lanes of backend/simd.hpp then filter in whole numbers, several times as fast. `binomial` up
/// to R = 4 is one already, and `tent` of R = 1, 3, 7 and 15.
template <kernel Kernel> struct eight_bit : detail::in_units<Kernel, 256> {
    static_assert(kernel_is_sound<Kernel>());
    static_assert(Kernel::radius > 0 && Kernel::radius <= 32,
                  "gnomon: eight_bit<Kernel>: the radius must be 1..32; beyond, 256 units are too few for the weights of a kernel");
};

} // namespace gnomon::inline GNOMON_BUILD
