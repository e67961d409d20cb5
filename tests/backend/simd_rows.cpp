// Rows of every format in lanes against the oracle, bit for bit: where a shadow begins, where it ends and fades, and in whatever its
// intensity is stored.
#include <gnomon/backend/reconstruct.hpp>
#include <gnomon/backend/simd_rows.hpp>

#include "../support/formats.hpp"
#include "../support/lanes.hpp"
#include "../support/threshold.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace {
using gnomon::bias;
using gnomon::depth_ratio;
using gnomon::rule;
using test::dice;
using test::for_each_isa;

using ratio_rga8 = gnomon::texel<gnomon::unorm8, depth_ratio, test::translucent>;

/// A caster at some depth over a receiver, or over none, of which a filter left some share or all. One in eight is any bits, with a mask or
/// without.
template <typename Texel> Texel any_filtered(dice& roll) {
    Texel t = Texel::clear();
    if (roll.one_in(8)) {
        test::fill_with_bits(roll, gnomon::image_view<Texel>(&t, {1, 1}));
        if (roll.one_in(4)) t.stored[Texel::mask_index] = {};
        return t;
    }
    t = test::any_caster<Texel>(roll);
    const int taps = roll.one_in(4) ? 65535 : 81, least = roll.one_in(4) ? 3 : taps;
    return test::filtered(t, roll.one_in(4) ? taps : roll(0, least), taps);
}

/// The first depth past the far bound.
template <typename Texel> float first_bounded(Texel t, const rule& r) {
    t.stored[Texel::depth_index] = t.stored[Texel::far_index];
    t.stored[Texel::far_index] = {};
    if constexpr (Texel::effects.translucency) t.stored[Texel::contribution_index] = Texel::channel_type::encode(1.0);
    return test::first_shadowed(t, {.caster = r.far_bound});
}

std::vector<rule> all_rules() {
    using enum gnomon::bias_towards;
    constexpr float infinity = test::infinity<float>;
    std::vector<rule> rules{{}, {.caster = gnomon::unbiased, .far_bound = gnomon::unbiased, .lit_beyond = true}};
    for (const float fade : {0x1p-6f, 0x1p-20f, 3.0f, infinity, -1.0f, test::nan<float>}) rules.push_back({.fade = fade});
    rules.push_back({.caster = {.towards = shadow}, .far_bound = {.towards = shadow}, .fade = 0.125f});
    rules.push_back({.caster = {.towards = none}, .far_bound = {.towards = shadow, .roundings = 300}, .fade = 0.3f});
    rules.push_back({.caster = {.roundings = 1000, .depth = 0.01f}, .far_bound = {.depth = 0.25f}, .fade = 0.01f});
    rules.push_back({.caster = {.caster_is_code = true}, .far_bound = {.roundings = 1000, .caster_is_code = true}});
    return rules;
}

/// Texels and the depths that try them.
template <typename Texel> struct receivers {
    std::vector<Texel> texels;
    std::vector<float> z;

    void add(const Texel& t, float at) {
        texels.push_back(t);
        z.push_back(at);
    }
    void add_around(const Texel& t, float at) {
        for (const float here : {test::down(at), at, test::up(at)}) add(t, here);
    }
    template <typename Depth> [[nodiscard]] std::vector<Depth> depths(dice& roll) const {
        std::vector<Depth> made(z.size());
        for (std::size_t i = 0; i < z.size(); ++i)
            if constexpr (std::same_as<Depth, float>)
                made[i] = z[i];
            else
                made[i] =
                    static_cast<Depth>(std::clamp(int{gnomon::unorm16::encode(static_cast<double>(z[i]))} + roll(-1, 1), 0, 65535));
        return made;
    }
};

template <typename Texel, typename Depth, typename Intensity>
void check(const receivers<Texel>& of, const std::vector<Depth>& z, const rule& r) {
    std::vector<Intensity> expected(z.size()), made(z.size());
    gnomon::receive(of.texels, z, expected, r);
    for_each_isa([&]<typename Isa>() {
        gnomon::reconstruct<Isa>(of.texels, z, made, r);
        CHECK(std::equal(made.begin(), made.end(), expected.begin(), [](auto a, auto b) {
            if constexpr (std::same_as<Intensity, float>)
                return test::same_bits(a, b);
            else
                return a == b;
        }));
    });
}
template <typename Texel> void check_all(const receivers<Texel>& of, const rule& r) {
    dice roll(511);
    const std::vector<float> z = of.template depths<float>(roll);
    check<Texel, float, float>(of, z, r);
    check<Texel, float, std::uint16_t>(of, z, r);
    check<Texel, std::uint16_t, std::uint8_t>(of, of.template depths<std::uint16_t>(roll), r);
}
} // namespace

TEST_CASE_TEMPLATE("rows of every format in lanes are the oracle's, about where a shadow begins, ends and has faded, and in "
                   "between",
                   Texel, gnomon::rgb8, gnomon::rgba8, gnomon::rgba16, gnomon::rg16f, gnomon::rga16f, gnomon::rgb16f, gnomon::rg32f,
                   gnomon::rgba32f, gnomon::tm8, gnomon::tm16, ratio_rga8) {
    static_assert(gnomon::decided_in_lanes<Texel>);
    dice roll(510);
    for (const rule& r : all_rules()) {
        receivers<Texel> of;
        for (int i = 0; i < 120; ++i) {
            const Texel t = any_filtered<Texel>(roll);
            of.add_around(t, test::first_shadowed(t, r));
            if constexpr (Texel::effects.far_bound) {
                const float bound = first_bounded(t, r);
                of.add_around(t, bound);
                if (r.fade > 0.0f) {
                    of.add_around(t, bound + r.fade);
                    of.add(t, bound + r.fade * roll.unit());
                }
            }
            of.add(t, roll.unit());
            of.add(t, test::hostile_floats[static_cast<std::size_t>(roll(0, 29))]);
        }
        check_all(of, r);
    }
}

TEST_CASE("every pair of bytes of a ratio in lanes: where its shadow begins, one float before and one after") {
    receivers<gnomon::tm8> of;
    for (int mask = 0; mask < 256; mask += mask < 3 || mask >= 252 ? 1 : 83)
        for (int depth = 0; depth < 256; ++depth) {
            const gnomon::tm8 t{{static_cast<std::uint8_t>(depth), static_cast<std::uint8_t>(mask)}};
            of.add_around(t, gnomon::caster_depth(t));
            of.add(t, test::smallest<float>);
        }
    for (const bias& towards : {gnomon::unbiased, gnomon::towards_light, gnomon::towards_shadow})
        check_all(of, {.caster = towards});
}

TEST_CASE("words of a ratio in lanes at the depths that are their codes', where products have no bit to spare") {
    dice roll(512);
    receivers<gnomon::tm16> of;
    for (int i = 0; i < 4000; ++i) {
        const int depth = roll.one_in(2) ? roll(0, 65535) : roll(0, 255) * 257;
        const gnomon::tm16 t{
            {static_cast<std::uint16_t>(depth), static_cast<std::uint16_t>(roll.one_in(4) ? 65535 : roll(0, 65535))}};
        of.add_around(t, gnomon::caster_depth(t));
        of.add_around(t, static_cast<float>(65535 - depth) / 65536.0f); // a float of few bits near it
    }
    for (const bias& towards : {gnomon::unbiased, gnomon::towards_light, gnomon::towards_shadow})
        check_all(of, {.caster = towards});
}

TEST_CASE("every code of a depth that lies on its far bound") {
    std::vector<gnomon::rgb16> texels;
    std::vector<std::uint16_t> z;
    for (int code = 0; code < 65536; ++code) {
        texels.push_back({{65535, 65535, static_cast<std::uint16_t>(65535 - code)}});
        z.push_back(static_cast<std::uint16_t>(code));
    }
    const rule r{.caster = gnomon::unbiased, .far_bound = gnomon::unbiased};
    check<gnomon::rgb16, std::uint16_t, std::uint8_t>({texels, {}}, z, r);
}

TEST_CASE("a far bound that no receiver can be, of floats that its difference from the mask has no room for") {
    dice roll(515);
    const rule r{.far_bound = {.depth = 1.5f}};
    receivers<gnomon::rgba32f> of;
    for (int i = 0; i < 1000; ++i) {
        const float mask = 0.5f + roll.unit() / 2.0f;
        const gnomon::rgba32f t{{mask, mask, mask * (2.0f + roll.unit() / 2.0f), 1.0f}};
        of.add_around(t, first_bounded(t, r));
    }
    check<gnomon::rgba32f, float, float>(of, of.z, r);
}

namespace {
/// Do lanes tell of a register whose texels have all a format can have, of receivers before the caster, behind it, and past the bound?
template <typename Texel, typename Depth, typename Intensity> bool told(const rule& r) {
    using by = gnomon::on_any::decision<gnomon::emulated<32>, Texel, Depth, Intensity>;
    dice roll(513);
    std::array<Texel, by::step> texels;
    std::array<Depth, by::step> z;
    std::array<Intensity, by::step> made;
    constexpr std::array<float, 4> at{0.125f, 0.45f, 0.75f, 0.95f};
    for (std::size_t i = 0; i < texels.size(); ++i) {
        Texel t = Texel::caster(0.25f);
        if constexpr (Texel::effects.far_bound) t.bound(0.7f);
        texels[i] = i == 3 ? Texel::clear() : test::filtered(t, 40, 81);
        z[i] = std::same_as<Depth, float> ? static_cast<Depth>(at[i % 4]) : static_cast<Depth>(at[i % 4] * 65535.0f);
    }
    return by::one(by::of(r), texels[0].stored, z.data(), made.data());
}
} // namespace

TEST_CASE_TEMPLATE("no ordinary register of any format is left to the scalar loop", Texel, gnomon::rgb8, gnomon::rgba16,
                   gnomon::rg16f, gnomon::rga16f, gnomon::rgb16f, gnomon::rgba32f, gnomon::tm8, gnomon::tm16) {
    for (const float fade : {0.0f, 0.25f})
        for (const auto towards : {gnomon::bias_towards::light, gnomon::bias_towards::shadow}) {
            const rule r{.caster = {.towards = towards}, .far_bound = {.towards = towards}, .fade = fade};
            CHECK(told<Texel, float, float>(r));
            CHECK(told<Texel, float, std::uint16_t>(r));
            CHECK(told<Texel, std::uint16_t, std::uint8_t>(r));
        }
}

TEST_CASE_TEMPLATE("what lanes do not know of is the oracle's too", Texel, test::paper8, test::paper_rgba16f, test::ratio_rgba8) {
    static_assert(!gnomon::decided_in_lanes<Texel>);
    dice roll(514);
    receivers<Texel> of;
    for (int i = 0; i < 200; ++i) {
        const Texel t = any_filtered<Texel>(roll);
        of.add_around(t, test::first_shadowed(t, {}));
    }
    check_all(of, {});
}
