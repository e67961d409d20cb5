// Weights are judged by their definitions, in long double and with the standard library's own exponential.
#include <gnomon/filter/kernel.hpp>

#include "../support/kernels.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

namespace {
using gnomon::binomial;
using gnomon::box;
using gnomon::eight_bit;
using gnomon::gaussian;
using gnomon::kernel;
using gnomon::tent;

using test::taps;
using test::taps_of;

template <template <int> typename Kernel, int... Radii> std::vector<taps> all(std::integer_sequence<int, Radii...>) {
    return {taps_of<Kernel<Radii>>()...};
}
template <template <int> typename Kernel, int... Below> std::vector<taps> eighths(std::integer_sequence<int, Below...>) {
    return {taps_of<eight_bit<Kernel<Below + 1>>>()...};
}
template <int Percent> struct bell {
    template <int Radius> using kernel = gaussian<Radius, Percent>;
};
using to_32 = std::make_integer_sequence<int, 33>;
using from_1_to_32 = std::make_integer_sequence<int, 32>;
using to_30 = std::make_integer_sequence<int, 31>;
const std::vector<taps> boxes = all<box>(to_32{}), tents = all<tent>(to_32{}), binomials = all<binomial>(to_30{});
const std::vector<taps> narrow_bells = all<bell<33>::kernel>(to_32{}), bells = all<bell<50>::kernel>(to_32{}),
                        wide_bells = all<bell<100>::kernel>(to_32{});

long double variance(const taps& k) {
    long double sum = 0;
    for (int i = -k.radius; i <= k.radius; ++i) sum += static_cast<long double>(k.at(i)) * i * i;
    return sum / k.total;
}

/// Defects of the contract: every kernel is non-negative, symmetric, highest in the middle, and sums to a total that stays exact.
/// `uneven` is what an outer weight may be above its inner neighbour.
int defects(const taps& k, int uneven = 0) {
    int n = static_cast<int>(k.weights.size()) != 2 * k.radius + 1;
    long sum = 0;
    for (int i = -k.radius; i <= k.radius; ++i) {
        n += k.at(i) < 0 || k.at(i) != k.at(-i);
        n += i > 0 && k.at(i) > k.at(i - 1) + uneven;
        sum += k.at(i);
    }
    return n + (sum != k.total) + (k.total < 1 || k.total > 65536);
}

/// The largest difference of any weight from its exact share, in units of a weight.
template <typename Exact> long double worst_weight(const taps& k, Exact&& exact) {
    long double sum = 0, worst = 0;
    for (int i = -k.radius; i <= k.radius; ++i) sum += exact(i);
    for (int i = -k.radius; i <= k.radius; ++i)
        worst = std::max(worst, std::fabs(static_cast<long double>(k.at(i)) - exact(i) * k.total / sum));
    return worst;
}

long double choose(int n, int k) {
    long double product = 1;
    for (int i = 1; i <= k; ++i) product = product * (n - k + i) / i;
    return std::round(product);
}
} // namespace

TEST_CASE("every kernel is non-negative, symmetric, highest in the middle, and sums to its total, for radius 0 to 32") {
    for (const auto* kernels : {&boxes, &tents, &binomials, &narrow_bells, &bells, &wide_bells})
        for (const taps& k : *kernels) {
            CAPTURE(k.radius);
            CHECK(defects(k) == 0);
        }
}

TEST_CASE("box, tent and the binomials up to 8 keep their proportions exactly") {
    for (const taps& k : boxes) CHECK(worst_weight(k, [](int) { return 1.0L; }) <= 0.0L);
    for (const taps& k : tents)
        CHECK(worst_weight(k, [&k](int i) { return static_cast<long double>(k.radius + 1 - std::abs(i)); }) <= 0.0L);
    for (const taps& k : binomials)
        if (k.radius <= 8) CHECK(worst_weight(k, [&k](int i) { return choose(2 * k.radius, k.radius + i); }) <= 0.0L);
}

TEST_CASE("the wider binomials and the gaussians are within one unit in 65,536 of their proportions") {
    long double worst = 0;
    for (const taps& k : binomials)
        if (k.radius > 8) {
            CHECK(k.total == 65536);
            worst = std::max(worst, worst_weight(k, [&k](int i) { return choose(2 * k.radius, k.radius + i); }));
        }
    for (const auto& [percent, kernels] : {std::pair{33, &narrow_bells}, {50, &bells}, {100, &wide_bells}})
        for (const taps& k : *kernels) {
            CHECK(k.total == 65536);
            const long double sigma = std::max(k.radius, 1) * percent / 100.0L;
            worst = std::max(worst, worst_weight(k, [sigma](int i) { return std::exp(-i * i / (2 * sigma * sigma)); }));
        }
    CHECK(worst <= 1.0L); // reached: binomial<9>'s centre is whole, and what is left for the pairs is odd
    CHECK(worst > 0.5L);  // tight: apportioning to a fixed sum cannot do with half a unit
}

TEST_CASE("in weights of eight bits a kernel keeps its contract, and its proportions to within one unit in 256") {
    const std::vector<taps> rounded[] = {eighths<box>(from_1_to_32{}), eighths<tent>(from_1_to_32{}),
                                         eighths<bell<50>::kernel>(from_1_to_32{}), eighths<bell<33>::kernel>(from_1_to_32{})};
    const std::vector<taps>* const originals[] = {&boxes, &tents, &bells, &narrow_bells};
    long double worst = 0;
    for (std::size_t shape = 0; shape < 4; ++shape)
        for (const taps& k : rounded[shape]) {
            CAPTURE(shape);
            CAPTURE(k.radius);
            const taps& original = (*originals[shape])[static_cast<std::size_t>(k.radius)];
            CHECK(k.total == 256);
            CHECK(defects(k, 1) == 0);
            worst = std::max(worst, worst_weight(k, [&original](int i) { return static_cast<long double>(original.at(i)); }));
        }
    CHECK(worst <= 1.0L);
    CHECK(worst > 0.9L);
}

TEST_CASE("standard deviations are the stated ones") {
    for (const taps& k : boxes)
        CHECK(std::fabs(variance(k) - k.radius * (k.radius + 1) / 3.0L) < 1e-15L * (1 + k.radius * k.radius));
    for (const taps& k : tents)
        CHECK(std::fabs(variance(k) - k.radius * (k.radius + 2) / 6.0L) < 1e-15L * (1 + k.radius * k.radius));
    for (const taps& k : binomials)
        CHECK(std::fabs(variance(k) - k.radius / 2.0L) < (k.radius <= 8 ? 1e-15L * (1 + k.radius) : 0.01L));
    CHECK(std::sqrt(variance(bells[32])) == doctest::Approx(0.88 * 16).epsilon(0.01)); // cutting off at two deviations takes 12 %
}

TEST_CASE("a gaussian of 50 percent keeps 14 percent of its peak at the rim, one of 33 keeps 1") {
    CHECK(bells[32].at(32) * 100 / bells[32].at(0) == 13);
    CHECK(narrow_bells[32].at(32) * 100 / narrow_bells[32].at(0) == 1);
}

TEST_CASE("weights are apportioned at run time as by the compiler") {
    const auto each = [](auto kernel, auto proportions) {
        using K = decltype(kernel);
        CHECK(gnomon::detail::apportion<K::radius>(proportions) == K::weights);
    };
    std::array<std::uint64_t, 10> row{}; // C(18, 9), C(18, 10), ...
    row[9] = 1;
    for (std::size_t i = 9; i > 0; --i) row[i - 1] = row[i] * (9 + i) / (10 - i);
    each(binomial<9>{}, row);
    std::array<double, 5> bell{}; // sigma is 2, so i * i / 8
    for (int i = 0; i < 5; ++i) bell[static_cast<std::size_t>(i)] = gnomon::detail::exp_minus(i * i / 8.0);
    each(gaussian<4>{}, bell);
}

TEST_CASE("what is left over after pairs goes to the centre, and the rest to the largest remainders, of equals to the inner ones") {
    const std::array third{1.0, 1.0}; // 21845.33 each, so one unit is left
    CHECK(gnomon::detail::apportion<1>(third) == std::array{21845, 21846, 21845});
    const std::array fifth{1.0, 0.9, 1.1}; // 13107.2, 11796.48, 14417.92: three units are left
    CHECK(gnomon::detail::apportion<2>(fifth) == std::array{14418, 11796, 13108, 11796, 14418});
    const std::array falling{26, 25, 24, 23, 22}; // of 256: 31.10, 29.91, 28.71, 27.51, 26.32; five are left, for two pairs of four
    CHECK(gnomon::detail::apportion<4, 256>(falling) == std::array{26, 27, 29, 30, 32, 30, 29, 27, 26});
    const std::array eleventh{1.0, 1.0, 1.0, 1.0, 1.0, 1.0}; // 5957.8 each: nine are left, for the centre and four pairs of five
    CHECK(gnomon::detail::apportion<5>(eleventh) == std::array{5957, 5958, 5958, 5958, 5958, 5958, 5958, 5958, 5958, 5958, 5957});
}

TEST_CASE("exp_minus is the exponential to 2e-15") {
    long double worst = 0;
    for (int i = 0; i <= 60000; ++i) {
        const double x = i / 1000.0;
        worst = std::max(
            worst, std::fabs(static_cast<long double>(gnomon::detail::exp_minus(x)) - std::exp(-static_cast<long double>(x))));
    }
    CHECK(worst < 2e-15L);
    CHECK(worst > 1e-15L);
    CHECK(gnomon::detail::exp_minus(0.0) >= 1.0);
    CHECK(gnomon::detail::exp_minus(1e9) <= 0.0);
}

namespace {
struct own { // what a user writes
    static constexpr int radius = 1;
    static constexpr int total = 10;
    static constexpr std::array<int, 3> weights{3, 4, 3};
};
struct no_total {
    static constexpr int radius = 1;
    static constexpr std::array<int, 3> weights{3, 4, 3};
};
struct one_weight_short {
    static constexpr int radius = 1;
    static constexpr int total = 10;
    static constexpr std::array<int, 2> weights{5, 5};
};
struct float_weights {
    static constexpr int radius = 1;
    static constexpr int total = 1;
    static constexpr std::array<float, 3> weights{0.25f, 0.5f, 0.25f};
};
struct wide_total {
    static constexpr int radius = 1;
    static constexpr long total = 10;
    static constexpr std::array<int, 3> weights{3, 4, 3};
};
static_assert(kernel<own> && gnomon::kernel_is_sound<own>());
static_assert(no_total::weights.size() == 3 && wide_total::weights.size() == 3 && float_weights::weights.size() == 3 &&
              one_weight_short::weights.size() == 2);
static_assert(!kernel<no_total> && !kernel<one_weight_short> && !kernel<float_weights> && !kernel<wide_total> && !kernel<int>);

// Known by heart.
static_assert(box<2>::weights == std::array{1, 1, 1, 1, 1} && box<2>::total == 5);
static_assert(tent<2>::weights == std::array{1, 2, 3, 2, 1} && tent<2>::total == 9);
static_assert(binomial<2>::weights == std::array{1, 4, 6, 4, 1} && binomial<2>::total == 16);
static_assert(gaussian<0>::weights == std::array{65536} && binomial<0>::weights == std::array{1});
static_assert(tent<255>::total == gnomon::kernel_total_limit && gnomon::kernel_is_sound<tent<255>>());
static_assert(gnomon::kernel_is_sound<gaussian<100, 25>>());
} // namespace
