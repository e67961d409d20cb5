// Whatever bits a map holds and whatever the receiver, an intensity lies in [0, 1].
#include <gnomon/receive/decide.hpp>

#include "../support/bits.hpp"
#include "../support/float_dice.hpp"
#include "../support/flush.hpp"
#include "../support/formats.hpp"
#include "../support/scan.hpp"
#include "../support/sweep.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <cstdint>

using namespace gnomon;
using test::sweep;

namespace {

constexpr std::array<float, 10> receivers{0.5f,
                                          0.0f,
                                          1.0f,
                                          -1.0f,
                                          2.0f,
                                          test::infinity<float>,
                                          -test::infinity<float>,
                                          test::nan<float>,
                                          test::smallest<float>,
                                          -test::smallest<float>};

/// Both ends and the middle of every kind of half: zero, subnormal, small, near one, above one, infinity, NaN, of both signs.
constexpr std::array<std::uint16_t, 32> hostile_halves{
    0x0000, 0x0001, 0x0002, 0x01FF, 0x03FE, 0x03FF, 0x0400, 0x0401, 0x1400, 0x2E66, 0x3555, 0x37FF, 0x3800, 0x3801, 0x3BFF, 0x3C00,
    0x3C01, 0x4000, 0x5640, 0x7BFE, 0x7BFF, 0x7C00, 0x7C01, 0x7DFF, 0x7E00, 0x7FFF, 0x0003, 0x0010, 0x0100, 0x0200, 0x0800, 0x1000};

template <typename Texel>
const std::array<rule, 4> every_rule{
    rule{.caster = towards_light}, rule{.caster = unbiased}, rule{.caster = towards_shadow},
    rule{.caster = {bias_towards::shadow, 2, 0.25f}, .far_bound = unbiased, .fade = 0.125f, .lit_beyond = true}};

/// All receivers, each under one of the rules in turn: neighbouring texels get the others.
template <typename Texel> void try_texel(const Texel& texel, std::size_t turn, sweep& wrong) {
    for (const float z : receivers) {
        const float intensity = shadow(texel, z, every_rule<Texel>[turn++ % 4]);
        wrong.unless(intensity >= 0.0f && intensity <= 1.0f, "z", z, "gives", intensity, "from", texel.stored[0], texel.stored[1]);
    }
    const float s = caster_depth(texel);
    wrong.unless(s >= 0.0f && s <= 1.0f, "caster_depth", s, "from", texel.stored[0], texel.stored[1]);
}

/// All halves for a depth, under one for a mask: the first eight receivers under the rules that move it, and the depth they give.
template <typename Texel> void try_mask(unsigned mask, sweep& wrong) {
    wrong.unless_all([mask](auto&& check) {
        for (unsigned depth = 0; depth < 0x10000; ++depth) {
            const auto texel = read(Texel{{static_cast<std::uint16_t>(depth), static_cast<std::uint16_t>(mask)}});
            const auto in_range = [&](float answer, float z) {
                check(answer >= 0.0f && answer <= 1.0f, "z", z, "gives", answer, "from", depth, mask);
            };
            for (std::size_t i = 0; i < 8; ++i) {
                const float z = receivers[i];
                in_range(shadow(texel, z, rule{.caster = towards_light}), z);
                in_range(shadow(texel, z, rule{.caster = towards_shadow}), z);
            }
            in_range(caster_depth(texel), test::nan<float>);
        }
    });
}

} // namespace

TEST_CASE("subnormals are flushed where a test asks for it and nowhere else") {
    const volatile float least = 0x1p-126f;
    for (const bool flush : {false, true}) {
        const test::flush_subnormals mode(flush);
        const volatile float half = least * 0.5f;
        CHECK(test::same_bits(half, 0.0f) == (flush && test::can_flush));
    }
}

TEST_CASE_TEMPLATE("no pair of halves gives an intensity outside of 0 to 1 whether or not subnormals are flushed", Texel, rg16f,
                   test::paper16f) {
    sweep wrong;
    for (const bool flush : {false, true}) {
        const test::flush_subnormals mode(flush);
        for (unsigned e = 0; e < 0x10000; ++e)
            for (const std::uint16_t m : hostile_halves)
                for (const unsigned sign : {0u, 0x8000u})
                    try_texel(Texel{{static_cast<std::uint16_t>(e), static_cast<std::uint16_t>(m | sign)}}, e + m, wrong);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE(
    "exhaustive: none of the 2^32 pairs of halves gives an intensity outside of 0 to 1 whether or not subnormals are flushed" *
    doctest::skip()) {
    const sweep wrong = test::scan(2 * 65536, [](int row, sweep& part) {
        const test::flush_subnormals mode(row % 2 != 0);
        void (*const volatile in_this_mode)(unsigned, sweep&) = &try_mask<rg16f>; // volatile: so that no arithmetic leaves its mode
        in_this_mode(static_cast<unsigned>(row / 2), part);
    });
    CHECK(wrong.report() == "");
    CHECK(wrong.tried() == 2 * (8 * 2 + 1) * (std::size_t{1} << 32));
}

TEST_CASE_TEMPLATE("no four floats give an intensity outside of 0 to 1 whether or not subnormals are flushed", Texel, rgba32f,
                   test::paper_rgba32f) {
    test::float_dice dice(64);
    const auto number = [&dice] {
        return dice.one_in(2) ? test::hostile_floats[static_cast<std::size_t>(dice(0, 29))] : dice.any();
    };
    sweep wrong;
    for (const bool flush : {false, true}) {
        const test::flush_subnormals mode(flush);
        for (const float e : test::hostile_floats)
            for (const float m : test::hostile_floats)
                for (std::size_t turn = 0; turn < 4; ++turn) try_texel(Texel{{e, m, 0.5f, 1.0f}}, turn, wrong);
        for (std::size_t i = 0; i < 300'000; ++i) try_texel(Texel{{number(), number(), number(), number()}}, i, wrong);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("no four halves give an intensity outside of 0 to 1", Texel, rgba16f, test::paper_rgba16f) {
    test::float_dice dice(65);
    sweep wrong;
    for (std::size_t i = 0; i < 300'000; ++i) {
        const std::uint32_t low = dice.word(), high = dice.word();
        try_texel(Texel{{static_cast<std::uint16_t>(low), static_cast<std::uint16_t>(low >> 16), static_cast<std::uint16_t>(high),
                         static_cast<std::uint16_t>(high >> 16)}},
                  i, wrong);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("no 8-bit pair gives an intensity outside of 0 to 1", Texel, rg8, test::paper8) {
    sweep wrong;
    for (unsigned e = 0; e < 256; ++e)
        for (unsigned m = 0; m < 256; ++m)
            for (std::size_t turn = 0; turn < 4; ++turn)
                try_texel(Texel{{static_cast<std::uint8_t>(e), static_cast<std::uint8_t>(m)}}, turn, wrong);
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("a negative NaN or empty mask is lit at every depth whatever the other channels say", Texel, rg16f, rg32f,
                   rga32f, rgba16f, test::paper16f, test::paper_rgba32f) {
    using channel_type = typename Texel::channel_type;
    for (const double mask : {test::nan<double>, -0.25, 0.0, -0.0})
        for (const double others : {0.0, 0.5, 1.0}) {
            Texel texel{};
            for (auto& stored : texel.stored) stored = channel_type::store(others);
            texel.stored[Texel::mask_index] = channel_type::store(mask);
            for (const float z : receivers)
                for (const rule& r : every_rule<Texel>) CHECK(test::same_bits(shadow(texel, z, r), 0.0f));
        }
}
