// What the promises of a decision are about: a texel as a filter leaves it, and the depth at which it begins to shadow.
#pragma once

#include "bits.hpp"
#include "exact.hpp"

#include <gnomon/receive/decide.hpp>

#include <bit>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace test {

/// One rounding of the exact mean of `taps` texels, `covered` of which are `caster` and the others `rest`. Whole codes are summed in
/// whole numbers; a quotient of floats this short cannot come so near a tie that the rounding of the double decides it.
template <gnomon::texel_format Texel>
[[nodiscard]] Texel filtered(const Texel& caster, int covered, int taps, const Texel& rest = Texel::clear()) {
    using sum = typename Texel::linear_sum;
    sum sums[static_cast<std::size_t>(Texel::channels)];
    for (int c = 0; c < Texel::channels; ++c)
        sums[c] = static_cast<sum>(covered) * caster.template linear<sum>(c) +
                  static_cast<sum>(taps - covered) * rest.template linear<sum>(c);
    return Texel::from_linear(sums, static_cast<sum>(taps));
}

inline constexpr float beyond_every_test = 16.0f;

/// The smallest z whose receiver is shadowed, on a texel or a sample, `beyond_every_test` if there is none so near; by bisection, for a decision never
/// changes back from shadowed to lit as z grows.
template <typename Texel> [[nodiscard]] float first_shadowed(const Texel& texel, const gnomon::rule& rule) {
    std::uint32_t lit = 0, shadowed = std::bit_cast<std::uint32_t>(beyond_every_test); // positive floats are ordered as their bits
    while (shadowed - lit > 1) {
        const std::uint32_t middle = lit + (shadowed - lit) / 2;
        (gnomon::shadow(texel, float_of(middle), rule) > 0.0f ? shadowed : lit) = middle;
    }
    return float_of(shadowed);
}

/// The depth from which a decision towards light is certain again: the band s..z holds all that may be wrong with the stored
/// numbers, each rounding twice, once for what it did and once for the bias against it. Not linearised, so that it can be reached:
///     z = 1 - (e - absolute) (1 - relative - own) / ((m' + absolute) (1 + relative + own)) + h,  of the worst e and m' stored
/// For unorm that is s + q + q max((1+t)/(m+q), 1/m), but for q^2. `own` is what single precision adds: its share of the bias, and
/// one rounding; which for float and m is less, since 1 + bias is no float there and is rounded down.
template <gnomon::texel_format Texel> [[nodiscard]] double end_of_doubt(double s, double m) {
    using channel_type = typename Texel::channel_type;
    constexpr gnomon::rounding_error depth = Texel::depth_rounding, mask = Texel::mask_rounding;
    constexpr double u = 0x1p-24, scale = static_cast<double>(channel_type::scale);
    constexpr double own_depth = channel_type::whole_codes ? 0.0 : 5.0 * u;
    constexpr double own_mask = std::is_same_v<channel_type, gnomon::float32> ? 3.6 * u : own_depth;
    constexpr double error = static_cast<double>(channel_type::max_error); // of the caster's own depth
    const auto moved = [](double v, gnomon::rounding_error by, double own, double sign) {
        const double relative = static_cast<double>(by.relative), absolute = static_cast<double>(by.absolute) / scale;
        return (v * (1.0 + sign * relative) + sign * 2.0 * absolute) * (1.0 + sign * (relative + own));
    };
    const double lower = moved(m * (1.0 - s - error), depth, own_depth, -1.0);
    const double upper = lower > 0.0 ? moved(m, mask, own_mask, 1.0) : m; // behind the far plane the worst mask is the least
    return 1.0 - lower / upper + error + u;
}

/// Caster depths that try a channel: its codes' own depths, what lies half way between them, a float to each side, and both ends.
template <gnomon::channel Channel> [[nodiscard]] std::vector<float> trying_depths(int count) {
    std::vector<float> depths{0.0f, smallest<float>, 0x1p-126f, 0x1p-60f, 0x1p-25f, 0x1p-24f, down(1.0f), 1.0f};
    const double codes = Channel::whole_codes ? static_cast<double>(Channel::scale) : 4096.0;
    for (int i = 0; i < count; ++i) {
        const double half_codes =
            static_cast<double>(static_cast<std::int64_t>(i) * static_cast<std::int64_t>(2.0 * codes) / count);
        const float s = static_cast<float>(half_codes / (2.0 * codes));
        depths.insert(depths.end(), {s > 0.0f ? down(s) : s, s, up(s)});
    }
    return depths;
}

/// The depths whose caster is stored as one code: the first and the last float of them; and the last float that does not lie behind
/// the depth which the code stands for.
struct depths_of_code {
    float first;
    float own;
    float last;
};
template <gnomon::texel_format Texel> [[nodiscard]] depths_of_code depths_stored_as(typename Texel::storage stored) {
    using representation = typename Texel::representation_type;
    const auto nearer = [](typename Texel::storage a, typename Texel::storage b) { return representation::nearer(a, b); };
    const auto last_float = [&](auto&& before) { // of those in [0, 1] that hold; all do that come before it
        std::uint32_t holds = 0, fails = 0x3F800001;
        while (fails - holds > 1) {
            const std::uint32_t middle = holds + (fails - holds) / 2;
            (before(Texel::caster(float_of(middle)).stored[0]) ? holds : fails) = middle;
        }
        return float_of(holds);
    };
    const float before = last_float([&](auto code) { return nearer(code, stored); });
    const float last = last_float([&](auto code) { return !nearer(stored, code); });
    const double code = static_cast<double>(Texel::channel_type::code(stored)),
                 scale = static_cast<double>(Texel::channel_type::scale);
    constexpr bool reversed = !std::is_same_v<representation, gnomon::paper_depth_mask>;
    float own = static_cast<float>((reversed ? scale - code : code) / scale);
    const double depth = static_cast<double>(own); // is it behind?  own scale > scale - code, or > code
    if (exact_sum{}.add_product(depth, scale).add(reversed ? code : -code).add(reversed ? -scale : 0.0).sign() > 0) own = down(own);
    return {nearer(Texel::caster(before).stored[0], stored) ? up(before) : before, own, last};
}

} // namespace test
