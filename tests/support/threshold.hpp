// What the promises of a decision are about: a texel as a filter leaves it, and the depth at which it begins to shadow.
#pragma once

#include "bits.hpp"

#include <gnomon/receive/decide.hpp>

#include <bit>
#include <cstdint>
#include <vector>

namespace test {

/// One rounding of the exact mean of `taps` texels, `covered` of which are `caster` and the others clear. A quotient this short
/// cannot come so near a tie that the rounding of the double decides it.
template <gnomon::texel_format Texel>
[[nodiscard]] Texel filtered(const Texel& caster, int covered, int taps, const Texel& rest = Texel::clear()) {
    using channel_type = typename Texel::channel_type;
    Texel t{};
    for (int c = 0; c < Texel::channels; ++c) {
        const double code = static_cast<double>(channel_type::code(caster.stored[c])),
                     other = static_cast<double>(channel_type::code(rest.stored[c]));
        t.stored[c] = channel_type::store((covered * code + (taps - covered) * other) / taps);
    }
    return t;
}

inline constexpr float beyond_every_test = 16.0f;

/// The smallest z whose receiver is shadowed, `beyond_every_test` if there is none so near; by bisection, for a decision never
/// changes back from shadowed to lit as z grows.
template <gnomon::texel_format Texel> [[nodiscard]] float first_shadowed(const Texel& texel, const gnomon::rule& rule) {
    std::uint32_t lit = 0, shadowed = std::bit_cast<std::uint32_t>(beyond_every_test); // positive floats are ordered as their bits
    while (shadowed - lit > 1) {
        const std::uint32_t middle = lit + (shadowed - lit) / 2;
        (gnomon::shadow(texel, float_of(middle), rule) > 0.0f ? shadowed : lit) = middle;
    }
    return float_of(shadowed);
}

/// The depth from which a decision towards light is certain again: the band s..z holds all that may be wrong with the stored numbers,
/// each rounding twice (once for what it did, once for the bias against it). In codes the filter's roundings are `depth` and `mask`:
///     z = s + q + 2^-24 + 2 (relative t + absolute/m) of the depth + 2 (relative + absolute/m) r of the mask,  r = max(1-z, 0) + q
/// with q = 2 max_error; for unorm that is s + q (1+r)/m + q, and for floats it does not depend on m but for subnormals.
template <gnomon::texel_format Texel> [[nodiscard]] double end_of_doubt(double s, double m) {
    using channel_type = typename Texel::channel_type;
    constexpr gnomon::rounding_error depth = Texel::representation_type::template depth_rounding<channel_type>(),
                                     mask = channel_type::rounding;
    constexpr double own = channel_type::whole_codes ? 0.0 : 0x1p-22, scale = static_cast<double>(channel_type::scale);
    constexpr double q = 2.0 * static_cast<double>(channel_type::max_error);
    const auto twice = [m](gnomon::rounding_error e, double of) {
        return (2.0 * static_cast<double>(e.relative) + own) * of +
               2.0 * static_cast<double>(e.absolute) / scale * (of > 0.0 ? 1.0 / m : 0.0);
    };
    const double sure = s + q + 0x1p-24 + twice(depth, 1.0 - s + q), per_r = twice(mask, 1.0);
    const double before_far_plane = (sure + per_r * (1.0 + q)) / (1.0 + per_r); // z = sure + per_r (1 - z + q)
    return before_far_plane < 1.0 ? before_far_plane : sure + per_r * q;
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

} // namespace test
