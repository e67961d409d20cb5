// Rows of every format in lanes against the oracle, bit for bit: where a shadow begins, where it ends and fades, and in whatever its
// intensity is stored.
#include <gnomon/backend/reconstruct.hpp>
#include <gnomon/backend/simd_rows.hpp>

#include "../support/formats.hpp"
#include "../support/lanes.hpp"
#include "../support/shades.hpp"

#include <doctest/doctest.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {
using gnomon::rule;
using test::dice;
using test::for_each_isa;

using test::ratio_rga8;

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
};

/// How many are in half shadow.
template <typename Texel, typename Depth, typename Intensity>
int check(const std::vector<Texel>& texels, const std::vector<Depth>& z, Intensity, const rule& r) {
    std::vector<Intensity> expected(z.size());
    gnomon::receive(texels, z, expected, r);
    for_each_isa([&]<typename Isa>() {
        std::vector<Intensity> made(z.size(), Intensity(77));
        gnomon::reconstruct<Isa>(texels, z, made, r);
        CHECK(test::equal_bits(made, expected));
    });
    return test::half_shadows(expected);
}
template <typename Texel> int check_all(const receivers<Texel>& of, const rule& r) {
    dice roll(511);
    int half = 0;
    test::for_each_kind(roll, of.z, [&](const auto& z, auto intensity) { half += check(of.texels, z, intensity, r); });
    return half;
}
} // namespace

TEST_CASE_TEMPLATE("rows of every format in lanes are the oracle's, about where a shadow begins, ends and has faded, and in "
                   "between",
                   Texel, gnomon::rgb8, gnomon::rgba8, gnomon::rgba16, gnomon::rg16f, gnomon::rga16f, gnomon::rgb16f, gnomon::rg32f,
                   gnomon::rgba32f, gnomon::tm8, gnomon::tm16, ratio_rga8) {
    static_assert(gnomon::decided_in_lanes<Texel>);
    dice roll(510);
    int half = 0;
    for (const rule& r : test::rules_that_fade()) {
        receivers<Texel> of;
        for (int i = 0; i < 120; ++i) {
            const Texel t = test::any_filtered<Texel>(roll);
            for (const float z : test::depths_that_try(roll, gnomon::read(t), r)) of.add(t, z);
        }
        half += check_all(of, r);
    }
    CHECK(half > 4000);
}

TEST_CASE("every pair of bytes of a ratio in lanes: where its shadow begins, one float before and one after") {
    receivers<gnomon::tm8> of;
    for (int mask = 0; mask < 256; mask += mask < 3 || mask >= 252 ? 1 : 83)
        for (int depth = 0; depth < 256; ++depth) {
            const gnomon::tm8 t{{static_cast<std::uint8_t>(depth), static_cast<std::uint8_t>(mask)}};
            of.add_around(t, gnomon::caster_depth(t));
            of.add(t, test::smallest<float>);
        }
    for (const gnomon::bias& towards : {gnomon::unbiased, gnomon::towards_light, gnomon::towards_shadow})
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
    for (const gnomon::bias& towards : {gnomon::unbiased, gnomon::towards_light, gnomon::towards_shadow})
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
    check(texels, z, std::uint8_t{}, r);
}

TEST_CASE("a far bound that no receiver can be, of floats that its difference from the mask has no room for") {
    dice roll(515);
    const rule r{.far_bound = {.depth = 1.5f}};
    receivers<gnomon::rgba32f> of;
    for (int i = 0; i < 1000; ++i) {
        const float mask = 0.5f + roll.unit() / 2.0f;
        const gnomon::rgba32f t{{mask, mask, mask * (2.0f + roll.unit() / 2.0f), 1.0f}};
        of.add_around(t, test::first_bounded(gnomon::read(t), r));
    }
    check(of.texels, of.z, float{}, r);
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
        const Texel t = test::any_filtered<Texel>(roll);
        of.add_around(t, test::first_shadowed(t, {}));
    }
    check_all(of, {});
}
