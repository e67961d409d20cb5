// The four channels against one statement of what a channel is: a list of numbers from 0 to 1, and the nearest of them.
#include <gnomon/texel/channel.hpp>

#include "../support/bits.hpp"
#include "../support/exact.hpp"
#include "../support/float_dice.hpp"
#include "../support/formats.hpp"
#include "../support/sweep.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

using gnomon::channel;
using gnomon::float32;
using gnomon::half16;
using gnomon::unorm16;
using gnomon::unorm8;
using test::sweep;

#define ALL_CHANNELS gnomon::unorm8, gnomon::unorm16, gnomon::half16, gnomon::float32

// One model of the concept, and four near misses. (Not in the unnamed namespace: nobody calls their members.)
namespace channel_models {
struct derived : unorm8 {};
struct without_max_error {
    using storage = std::uint8_t;
    static constexpr bool whole_codes = true;
    static constexpr float scale = 255.0f;
    static constexpr gnomon::rounding_error rounding = unorm8::rounding;
    static constexpr storage encode(double v) noexcept { return unorm8::encode(v); }
    static constexpr storage store(double v) noexcept { return unorm8::store(v); }
    static constexpr float code(storage s) noexcept { return unorm8::code(s); }
    static constexpr float decode(storage s) noexcept { return unorm8::decode(s); }
};
struct may_throw : unorm8 {
    static constexpr storage encode(double v) { return unorm8::encode(v); }
};
struct double_scale : unorm8 {
    static constexpr double scale = 255.0;
};
struct stores_int : unorm8 {
    static constexpr int store(double v) noexcept { return static_cast<int>(v); }
};
} // namespace channel_models

namespace {

/// Every stored value in [0, 1], rising; of float32 one in 4093, and all near both ends and near 1/2.
template <channel Channel> std::vector<typename Channel::storage> all_stored() {
    std::vector<typename Channel::storage> stored;
    if constexpr (std::is_same_v<Channel, float32>) {
        const auto put = [&stored](std::uint32_t from, std::uint32_t to, std::uint32_t step) {
            for (std::uint32_t bits = from; bits <= to; bits += step) stored.push_back(test::float_of(bits));
        };
        constexpr std::uint32_t half = 0x3F000000, one = 0x3F800000, near = 1000;
        put(0, near, 1);
        put(near + 1, half - near, 4093);
        put(half - near + 1, half + near, 1);
        put(half + near + 1, one - near, 4093);
        put(one - near + 1, one, 1);
    } else {
        const unsigned last = Channel::whole_codes ? static_cast<unsigned>(Channel::scale) : 0x3C00;
        for (unsigned code = 0; code <= last; ++code) stored.push_back(static_cast<typename Channel::storage>(code));
    }
    return stored;
}

template <typename Storage> bool same(Storage a, Storage b) {
    if constexpr (std::is_same_v<Storage, float>)
        return test::same_bits(a, b);
    else
        return a == b;
}

template <channel Channel> double error_at(double v) {
    return std::abs(static_cast<double>(Channel::decode(Channel::encode(v))) - v);
}

/// Where the error of a channel is largest: half way between two stored values, and one double before.
template <channel Channel> std::vector<double> worst_values() {
    std::vector<double> values;
    const auto stored = all_stored<Channel>();
    for (std::size_t i = 0; i + 1 < stored.size(); ++i) {
        const double here = static_cast<double>(Channel::code(stored[i]));
        double next = static_cast<double>(Channel::code(stored[i + 1]));
        if constexpr (std::is_same_v<Channel, float32>) next = static_cast<double>(test::up(stored[i]));
        const double middle = (here + next) / 2.0 / static_cast<double>(Channel::scale);
        values.insert(values.end(), {test::down(middle), middle, test::up(middle)});
    }
    return values;
}

// The same at compile time, where undefined behaviour does not compile.
static_assert(unorm8::encode(0.5) == 128 && unorm16::encode(0.5) == 32768 && half16::encode(0.5) == 0x3800);
static_assert(unorm8::encode(test::nan<double>) == 0 && unorm16::encode(-test::infinity<double>) == 0);
static_assert(unorm8::encode(test::infinity<double>) == 255 && half16::encode(1e300) == 0x3C00);
static_assert(test::same_bits(float32::encode(0x1.000001p-1), 0.5f)); // a tie, to even

static_assert(channel<channel_models::derived>);
static_assert(!channel<channel_models::without_max_error> && !channel<channel_models::may_throw>);
static_assert(!channel<channel_models::double_scale> && !channel<channel_models::stores_int>);
static_assert(!channel<std::uint8_t> && !channel<float> && !channel<void>);

} // namespace

TEST_CASE_TEMPLATE("a channel gives back every value it stores", Channel, ALL_CHANNELS) {
    sweep wrong;
    for (const auto stored : all_stored<Channel>()) {
        wrong.unless(same(Channel::encode(static_cast<double>(Channel::decode(stored))), stored), "encode, stored", stored);
        wrong.unless(same(Channel::store(static_cast<double>(Channel::code(stored))), stored), "store, stored", stored);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("decode gives the float nearest to code / scale for every code", Channel, ALL_CHANNELS) {
    sweep wrong;
    for (const auto stored : all_stored<Channel>()) { // code / scale = (m - e) / m with m = scale, e = scale - code
        const float code = Channel::code(stored), value = Channel::decode(stored);
        const bool nearest = Channel::whole_codes ? test::is_nearest_depth(value, Channel::scale - code, Channel::scale)
                                                  : test::same_bits(value, code);
        wrong.unless(nearest, "stored", stored, "decoded", value);
    }
    CHECK(wrong.report() == "");
    CHECK(test::same_bits(Channel::decode(Channel::encode(0.0)), 0.0f));
    CHECK(test::same_bits(Channel::decode(Channel::encode(1.0)), 1.0f));
}

TEST_CASE_TEMPLATE("unorm encode gives the nearest code for every float beside a tie and ties go up", Channel, gnomon::unorm8,
                   gnomon::unorm16) {
    const auto nearest = [](float v) { // by counting: the codes c with 2c - 1 <= 2 N v
        const double scale = static_cast<double>(Channel::scale), value = static_cast<double>(v);
        int code = static_cast<int>(scale * value) - 2; // a start below the answer
        while (code < static_cast<int>(scale) &&
               test::exact_sum{}.add_product(2.0 * scale, value).add(-2.0 * code - 1.0).sign() >= 0)
            ++code;
        return gnomon::greater(code, 0);
    };
    sweep wrong;
    for (int code = 0; code < static_cast<int>(Channel::scale); ++code) {
        const float tie = static_cast<float>((code + 0.5) / static_cast<double>(Channel::scale));
        for (const float v : {test::down(test::down(tie)), test::down(tie), tie, test::up(tie), test::up(test::up(tie))})
            wrong.unless(Channel::encode(static_cast<double>(v)) == nearest(v), "v", v, "nearest", nearest(v));
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("a float channel stores no negative zero") { CHECK(std::bit_cast<std::uint32_t>(float32::store(-0.0)) == 0); }

TEST_CASE("float32 encode rounds every midpoint to even and a double beside it to the nearer float") {
    sweep wrong;
    for (const float v : all_stored<float32>()) {
        if (v >= 1.0f) continue;
        const float next = test::up(v);
        const double middle = (static_cast<double>(v) + static_cast<double>(next)) / 2.0;
        const float even = (std::bit_cast<std::uint32_t>(v) & 1) == 0 ? v : next;
        wrong.unless(same(float32::encode(test::down(middle)), v), "below the midpoint after", v);
        wrong.unless(same(float32::encode(middle), even), "at the midpoint after", v);
        wrong.unless(same(float32::encode(test::up(middle)), next), "above the midpoint after", v);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("encode never falls when its argument rises", Channel, ALL_CHANNELS) {
    test::float_dice dice(3);
    std::vector<double> values = worst_values<Channel>();
    for (int i = 0; i < 200'000; ++i)
        values.push_back(static_cast<double>(dice.any_unit()) + static_cast<double>(dice.unit()) * 0x1p-20);
    std::sort(values.begin(), values.end());
    sweep wrong;
    for (std::size_t i = 1; i < values.size(); ++i)
        wrong.unless(Channel::encode(values[i - 1]) <= Channel::encode(values[i]), "v", values[i - 1], "and", values[i]);
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("encode takes NaN to 0 and what lies outside of 0 to 1 to the nearer end", Channel, ALL_CHANNELS) {
    const auto zero = typename Channel::storage{}, one = Channel::encode(1.0);
    for (const double low :
         {test::nan<double>, -test::nan<double>, -test::infinity<double>, -1e300, -1.0, -test::smallest<double>, -0.0})
        CHECK(same(Channel::encode(low), zero));
    for (const double high : {test::up(1.0), 2.0, 1e300, test::infinity<double>}) CHECK(same(Channel::encode(high), one));
    CHECK(same(Channel::encode(test::down(1.0)), one));
    CHECK(same(Channel::encode(test::smallest<double>), zero));
}

TEST_CASE_TEMPLATE("a channel keeps its max_error and nearly reaches it", Channel, ALL_CHANNELS) {
    double worst = 0.0; // as a share of what is stated
    for (const double v : worst_values<Channel>())
        worst = std::max(worst, error_at<Channel>(v) / static_cast<double>(Channel::max_error));
    CHECK(worst <= 1.0);
    CHECK(worst >= 0.999);
}

TEST_CASE_TEMPLATE("a channel keeps its rounding and nearly reaches it both below the first step and above a half", Channel,
                   ALL_CHANNELS) {
    const double first = static_cast<double>(Channel::decode(all_stored<Channel>()[1]));
    double worst = 0.0, worst_low = 0.0, worst_high = 0.0; // as shares of what is stated
    for (const double v : worst_values<Channel>()) {
        const double exact = v * static_cast<double>(Channel::scale);
        const double rounded = static_cast<double>(Channel::code(Channel::store(exact)));
        const double stated =
            static_cast<double>(Channel::rounding.relative) * exact + static_cast<double>(Channel::rounding.absolute);
        const double share = std::abs(rounded - exact) / stated;
        worst = std::max(worst, share);
        if (v < first) worst_low = std::max(worst_low, share);
        if (v > 0.5) worst_high = std::max(worst_high, share);
    }
    CHECK(worst <= 1.0);
    CHECK(worst_high >= 0.99);
    CHECK(worst_low >= (std::is_same_v<Channel, float32> ? 0.49 : 0.99)); // half the smallest float is none
}

TEST_CASE("a hostile half is read as it is") {
    CHECK(test::is_nan(half16::decode(0x7E00)));
    CHECK(test::is_nan(half16::code(0xFC01)));
    CHECK(test::same_bits(half16::decode(0x7C00), test::infinity<float>));
    CHECK(test::same_bits(half16::code(0xFC00), -test::infinity<float>));
    CHECK(test::same_bits(half16::decode(0xBC00), -1.0f));
    CHECK(test::same_bits(half16::decode(0x8000), -0.0f));
}

TEST_CASE_TEMPLATE("a pair's depth is rounded as its channel is, but the paper's by half an ulp of one", Channel, ALL_CHANNELS) {
    gnomon::rounding_error (*ask)() noexcept = gnomon::depth_mask::depth_rounding<Channel>; // at run time
    const gnomon::rounding_error own = ask();
    CHECK(test::same_bits(own.relative, Channel::rounding.relative));
    CHECK(test::same_bits(own.absolute, Channel::rounding.absolute));
    ask = gnomon::paper_depth_mask::depth_rounding<Channel>;
    const gnomon::rounding_error paper = ask();
    CHECK(test::same_bits(paper.relative, 0.0f));
    CHECK(test::same_bits(paper.absolute, Channel::whole_codes ? 0.5f : Channel::max_error));
}
