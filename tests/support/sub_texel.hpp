// Is what a GPU's texture unit answers as good as it promises? Units blend with weights of a few bits, so there is no one right answer:
// there is an interval, of what all positions give that the unit may have taken for the one asked for.
#pragma once

#include <gnomon/receive/decide.hpp>
#include <gnomon/texel/image.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace test {

/// How good an answer is. Of many the worst counts.
enum class verdict {
    pass, ///< within what weights of eight bits allow, which is what units have
    warn, ///< within four bits, the least that an API lets a unit have: the map works, with steps in its penumbra
    fail, ///< within neither: another texel, another filter, a wrong number
};
[[nodiscard]] constexpr verdict worse(verdict a, verdict b) { return a < b ? b : a; }

/// What a unit may do to a position, and to a result.
struct sampling_model {
    int weight_bits;    ///< a position is taken as any that is less than 2^-weight_bits texels off, on either axis
    double value_error; ///< what a result may be off beside that, in [0, 1]: half a code where it is stored as one
};

struct interval {
    double least, most;
    [[nodiscard]] bool holds(double v) const { return v >= least && v <= most; }
};

namespace detail {

/// Where a bilinear surface over [x - d, x + d] can be extreme: at its ends, and at the centres of texels between them.
[[nodiscard]] inline std::array<double, 3> extremes(double x, double d) {
    const double centre = std::floor(x + d - 0.5) + 0.5;
    return {x - d, x + d, centre > x - d ? centre : x - d};
}

/// One channel of a map, blended at a position, in codes; clear lies off the map.
template <gnomon::texel_format Texel, typename Value>
[[nodiscard]] double blended(gnomon::image_view<const Texel> map, double x, double y, Value&& value) {
    const double u = x - 0.5, v = y - 0.5, column = std::floor(u), row = std::floor(v), a = u - column, b = v - row;
    const auto at = [&](int i, int j) {
        const int c = static_cast<int>(column) + i, r = static_cast<int>(row) + j;
        return value(read(whole(map.size()).contains(c, r) ? map(c, r) : Texel::clear()));
    };
    return (1 - b) * ((1 - a) * at(0, 0) + a * at(1, 0)) + b * ((1 - a) * at(0, 1) + a * at(1, 1));
}

} // namespace detail

/// What `value(filtered)` may be at (x, y), in texels, by linear sampling. Within a cell of four texels a blend is bilinear, and
/// extreme at a corner of what was asked; so the corners of each cell are all that need be looked at.
template <gnomon::texel_format Texel, typename Value>
[[nodiscard]] interval sampled(gnomon::image_view<const Texel> map, double x, double y, const sampling_model& unit, Value&& value) {
    const double d = std::ldexp(1.0, -unit.weight_bits);
    interval found{HUGE_VAL, -HUGE_VAL};
    for (const double px : detail::extremes(x, d))
        for (const double py : detail::extremes(y, d)) {
            const double v = detail::blended(map, px, py, value);
            found = {std::min(found.least, v), std::max(found.most, v)};
        }
    return found;
}

/// Judges one channel, a share of 1, that a unit answered at (x, y). `value_error` beside its weights, as in sampling_model.
template <gnomon::texel_format Texel>
[[nodiscard]] verdict judge(gnomon::image_view<const Texel> map, double x, double y, int channel, double answer,
                            double value_error) {
    constexpr double scale = gnomon::filtered<Texel>::scale;
    const auto value = [channel](const gnomon::filtered<Texel>& t) { return t.code[channel] / scale; };
    for (const int bits : {8, 4}) {
        const interval may = sampled(map, x, y, {bits, value_error}, value);
        if (interval{may.least - value_error, may.most + value_error}.holds(answer))
            return bits == 8 ? verdict::pass : verdict::warn;
    }
    return verdict::fail;
}

/// Judges a decision without bias, shadowed or not, about a receiver at depth `z`: e > m (1-z) for one pair that the unit may have
/// made, both of whose numbers have the same weights, for they are of one texel; each off by value_error.
template <gnomon::texel_format Texel>
[[nodiscard]] verdict judge_decision(gnomon::image_view<const Texel> map, double x, double y, float z, bool shadowed,
                                     double value_error) {
    constexpr double scale = gnomon::filtered<Texel>::scale;
    const double rest = 1.0 - static_cast<double>(z);
    const auto value = [rest](const gnomon::filtered<Texel>& t) { return (t.depth() - t.mask() * rest) / scale; };
    const double either = value_error * (1.0 + std::fabs(rest));
    for (const int bits : {8, 4}) {
        const interval may = sampled(map, x, y, {bits, value_error}, value);
        if (shadowed ? may.most + either > 0.0 : may.least - either <= 0.0) return bits == 8 ? verdict::pass : verdict::warn;
    }
    return verdict::fail;
}

} // namespace test
