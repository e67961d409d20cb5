// Decisions, biases, the depth of a caster, and what is left of a lightmap.
#include "golden.hpp"

#include "../support/images.hpp"

#include <gnomon/receive/depth_error.hpp>
#include <gnomon/receive/lightmap.hpp>
#include <gnomon/receive/receive.hpp>

namespace golden {
namespace {

/// A stored texel: any bits, or depth and mask of a penumbra with whatever effects.
template <texel_format T> T any_texel(test::dice& roll) {
    using storage = typename T::storage;
    const bool wild = roll.one_in(4);
    const double mask = 0x1p-24 + static_cast<double>(roll.unit()), depth = mask * static_cast<double>(roll.unit()); // exact
    T t{};
    for (storage& stored : t.stored) {
        const std::uint32_t bits = word(roll);
        if constexpr (std::integral<storage>)
            stored = static_cast<storage>(bits);
        else
            stored = std::bit_cast<storage>(bits);
        if (!wild) stored = T::channel_type::encode(mask * static_cast<double>(roll.unit()));
    }
    if (wild) return t;
    t.stored[T::mask_index] = T::channel_type::encode(mask);
    t.stored[T::depth_index] = T::channel_type::encode(T::representation_type::clear_depth > 0.0 ? 1.0 - depth : depth);
    return t;
}

/// Intensities under one rule: at any depth, and on both sides of where the stored pair puts its caster.
template <texel_format T> hash decisions(const rule& r) {
    test::dice roll(90);
    hash h;
    for (int i = 0; i < 4'000; ++i) {
        const T t = any_texel<T>(roll);
        const float s = caster_depth(t);
        for (const float z : {roll.unit(), test::down(s), s, test::up(s)}) h.add(shadow(t, z, r));
        h.add(shadow(t, test::hostile_floats[static_cast<std::size_t>(i) % test::hostile_floats.size()], r));
    }
    return h;
}

/// The same for samples, whose numbers have more digits than storage has.
template <texel_format T> hash decisions_on_samples(const rule& r) {
    test::dice roll(91);
    const image<T> map = test::noise<T>(roll, {61, 47}, 2);
    hash h;
    for (int i = 0; i < 4'000; ++i) {
        const float x = roll.unit() * 64.0f, y = roll.unit() * 64.0f;
        const filtered<T> f = sample(map.view(), x, y);
        const float s = caster_depth(f);
        h.add(s);
        for (const float z : {roll.unit(), test::down(s), s, test::up(s)}) h.add(shadow(f, z, r));
    }
    return h;
}

constexpr bias moved(bias b) {
    b.roundings = 2;
    b.depth = 0.013f;
    return b;
}

} // namespace

void print_receive() {
    print("caster_depth", texels, []<texel_format T>(named<T>) {
        test::dice roll(92);
        hash h;
        for (int i = 0; i < 10'000; ++i) h.add(caster_depth(any_texel<T>(roll)));
        return h;
    });
    print("depth_error", texels, []<texel_format T>(named<T>) {
        test::dice roll(95);
        hash h;
        for (int i = 0; i < 4'000; ++i) {
            const T t = any_texel<T>(roll);
            h.add(depth_error(t), depth_error(t, 3));
        }
        return h;
    });
    print("shadow_towards_light", texels, []<texel_format T>(named<T>) { return decisions<T>({.caster = towards_light}); });
    print("shadow_unbiased", texels, []<texel_format T>(named<T>) { return decisions<T>({.caster = unbiased}); });
    print("shadow_towards_shadow", texels, []<texel_format T>(named<T>) { return decisions<T>({.caster = towards_shadow}); });
    print("shadow_with_everything", texels, []<texel_format T>(named<T>) {
        return decisions<T>(
            {.caster = moved(towards_shadow), .far_bound = moved(towards_light), .fade = 0.21f, .lit_beyond = true});
    });
    print("shadow_of_samples", texels, []<texel_format T>(named<T>) {
        return decisions_on_samples<T>({.caster = moved(towards_light), .far_bound = unbiased, .fade = 0.21f});
    });
    print("apply_bias", texels, []<texel_format T>(named<T>) {
        test::dice roll(93);
        hash h;
        for (int i = 0; i < 4'000; ++i) {
            const filtered<T> f = read(any_texel<T>(roll));
            const float z = roll.unit();
            for (const bias& b : {towards_light, unbiased, towards_shadow, moved(towards_light), moved(towards_shadow)}) {
                const biased<> moved_by = apply<T>(b, f.depth(), f.mask(), z);
                h.add(moved_by.e, moved_by.m, moved_by.z);
            }
        }
        return h;
    });

    hash h;
    test::dice roll(94);
    for (int i = 0; i < 40'000; ++i) {
        const float light = test::float_of(word(roll)), share = roll.unit(), ambient = roll.one_in(2) ? 0.1f : roll.unit();
        h.add(mask_light(light, share, ambient), mask_light(roll.unit(), share, ambient));
    }
    print("mask_light", "float", "-", h);
}

} // namespace golden
