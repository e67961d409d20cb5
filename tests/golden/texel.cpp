// Encode, decode, and what texels do with both.
#include "golden.hpp"

#include <gnomon/filter/sample.hpp>

#include <array>
#include <limits>

namespace golden {
namespace {

/// Calls f(float) for all that is hostile, for any bits, for [0, 1], and for both sides of every tie between two codes.
template <channel Channel, typename F> void for_each_float(F&& f) {
    test::dice roll(1);
    for (const float v : test::hostile_floats) f(v);
    for (int i = 0; i < 20'000; ++i) f(test::float_of(word(roll)));
    for (int i = 0; i < 20'000; ++i) f(roll.unit());
    if constexpr (Channel::whole_codes)
        for (int code = 0; code < static_cast<int>(Channel::scale); ++code) {
            const float tie = static_cast<float>((code + 0.5) / static_cast<double>(Channel::scale));
            for (const float v : {test::down(tie), tie, test::up(tie)}) f(v);
        }
}

/// Doubles that a filter may hand to `store`: codes in [0, scale] with any digits after the point, and ties.
template <channel Channel, typename F> void for_each_code(F&& f) {
    test::dice roll(2);
    for (int i = 0; i < 20'000; ++i) {
        const double v = digits(roll, Channel::whole_codes ? -4 : -160, 0);
        if constexpr (Channel::whole_codes) { // of 24 digits: then the product is exact, and fusing it with `store` changes nothing
            const double code = static_cast<double>(static_cast<float>(v) - 0x1p-24f) * static_cast<double>(Channel::scale);
            f(code);
            f(static_cast<double>(static_cast<int>(code)) + 0.5);
        } else {
            const double rounded = static_cast<double>(half_to_float(half_from(v)));
            f(v);
            f(static_cast<double>(static_cast<float>(v)));
            f(rounded);
            f(rounded * (1.0 + 0x1p-11)); // half way to the next half
        }
    }
}

/// A pair that is stored and read again in one expression, from which g++ 12 drops the rounding to float (canary.cpp).
template <channel Channel> std::array<double, 2> stored_and_read(double e, double m) {
    const filtered<texel<Channel>> f = read(texel<Channel>{{Channel::store(e), Channel::store(m)}});
    return {f.depth(), f.mask()};
}

} // namespace

void print_texel() {
    print("encode", channels, []<channel C>(named<C>) {
        hash h;
        for_each_float<C>([&h](float v) { h.add(C::encode(static_cast<double>(v))); });
        if constexpr (C::whole_codes) // doubles as near to a tie as there are: their product with the scale is not exact
            for (int code = 0; code < static_cast<int>(C::scale); ++code) {
                double below = (code + 0.5) / static_cast<double>(C::scale), above = below;
                for (int step = 0; step < 4; ++step) {
                    h.add(C::encode(below), C::encode(above));
                    below = test::down(below);
                    above = test::up(above);
                }
            }
        return h;
    });
    print("store", channels, []<channel C>(named<C>) {
        hash h;
        for_each_code<C>([&h](double code) { h.add(C::store(code)); });
        return h;
    });
    print("store_and_read_a_pair", channels, []<channel C>(named<C>) {
        hash h;
        const auto pair = opaque(&stored_and_read<C>);
        for_each_code<C>([&](double code) {
            const auto [e, m] = pair(code * 0.75, code);
            h.add(e, m);
        });
        return h;
    });
    print("decode", channels, []<channel C>(named<C>) {
        hash h;
        if constexpr (std::integral<typename C::storage>)
            for (int bits = 0; bits <= std::numeric_limits<typename C::storage>::max(); ++bits) {
                const auto stored = static_cast<typename C::storage>(bits);
                h.add(C::decode(stored), C::code(stored));
            }
        else
            for_each_float<C>([&h](float v) { h.add(C::decode(v), C::code(v)); });
        return h;
    });

    hash h;
    test::dice roll(3);
    for (const float v : test::hostile_floats) h.add(half_from(static_cast<double>(v)));
    for (int i = 0; i < 40'000; ++i) { // any exponent that a half has and some beyond; ties; the nearest to a tie
        const double v = digits(roll, -27, 17), tie = static_cast<double>(half_to_float(half_from(v))) * (1.0 + 0x1p-11);
        h.add(half_from(v), half_from(-v), half_from(tie), half_from(test::up(tie)), half_from(test::down(tie)));
    }
    print("half_from", "half16", "-", h);

    print("clear_caster_cast_bound", texels, []<texel_format T>(named<T>) {
        hash all;
        all.add(T::clear());
        test::dice dice(4);
        for_each_float<typename T::channel_type>([&](float s) {
            T here = T::caster(s), there = T::caster(dice.unit());
            all.add(here);
            if constexpr (T::effects.translucency) {
                const float depth = dice.one_in(2) ? s : dice.unit();
                there = T::caster(depth, dice.unit());
            }
            here.cast(there);
            if constexpr (T::effects.far_bound) {
                here.bound(dice.unit());
                here.bound(s);
            }
            all.add(here);
        });
        return all;
    });
}

} // namespace golden
