// Receivers whose depth is a code of 16 bits, and intensities in codes: decided as whole numbers are, and rounded once.
#include <gnomon/receive/decide.hpp>
#include <gnomon/receive/receive.hpp>

#include "../support/dice.hpp"
#include "../support/formats.hpp"
#include "../support/images.hpp"
#include "../support/sweep.hpp"
#include "../support/threshold.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

using namespace gnomon;
using test::sweep;

namespace {

/// The decision from its definition, in half codes: (2E - k) 65535 > (2M + k) (65535 - z), z moved by whole codes.
bool shadowed(std::int64_t e, std::int64_t m, int code, bias_towards towards, int k, int codes) {
    const std::int64_t sign = towards == bias_towards::light ? 1 : (towards == bias_towards::shadow ? -1 : 0);
    const std::int64_t z = code - sign * codes;
    if (m <= 0 || code == 0 || z <= 0) return false;
    return z > 65535 ||
           std::max<std::int64_t>(2 * e - sign * k, 0) * 65535 > std::max<std::int64_t>(2 * m + sign * k, 0) * (65535 - z);
}

template <typename Texel> bool is_dark(const Texel& t, int code, const rule& r) {
    return shadow_as<std::uint8_t>(read(t), depth16{static_cast<std::uint16_t>(code)}, r) > 0;
}

constexpr bias_towards sides[] = {bias_towards::light, bias_towards::none, bias_towards::shadow};

} // namespace

TEST_CASE(
    "a depth of 16 bits is decided in whole numbers: every pair of bytes, at the code where its shadow begins and beside it") {
    sweep wrong;
    for (const auto towards : sides)
        for (const int k : {1, 2})
            for (const bool exact : {false, true}) {
                const rule r{.caster = {.towards = towards, .roundings = k, .caster_is_code = exact}};
                const int codes = towards == bias_towards::none || exact ? 0 : 129;
                for (int m = 0; m < 256; ++m)
                    for (int e = 0; e < 256; ++e) {
                        const rg8 t{{static_cast<std::uint8_t>(e), static_cast<std::uint8_t>(m)}};
                        int lit = 0, dark = 65536; // no code from which it is shadowed is lit again
                        while (dark - lit > 1) {
                            const int middle = (lit + dark) / 2;
                            (shadowed(e, m, middle, towards, k, codes) ? dark : lit) = middle;
                        }
                        for (const int code : {0, 1, lit - 1, lit, dark, dark + 1, 65535})
                            if (code >= 0 && code < 65536 && m > 0)
                                wrong.unless(is_dark(t, code, r) == shadowed(e, m, code, towards, k, codes), "e", e, "m", m, "z",
                                             code, "towards", static_cast<int>(towards));
                    }
            }
    CHECK(wrong.report() == "");
}

TEST_CASE("a depth of 16 bits is decided in whole numbers: pairs of 16 bits and blends of four") {
    test::dice roll(95);
    sweep wrong;
    for (int i = 0; i < 200'000; ++i) {
        const auto towards = sides[i % 3];
        const int k = roll(0, 3), extra = roll(0, 900);
        const rule r{.caster = {.towards = towards, .roundings = k, .depth = static_cast<float>(extra) / 65535.0f}};
        const std::int64_t m = roll(1, 65535), e = roll(0, static_cast<int>(m)), part = i % 2 ? 65536 : 1;
        const std::int64_t m_part = roll.one_in(2) ? 0 : roll(0, static_cast<int>(part) - 1),
                           e_part = std::min<std::int64_t>(m_part, 7);
        filtered<rg16> f{};
        f.code[0] = static_cast<double>(e) + static_cast<double>(e_part) / static_cast<double>(part);
        f.code[1] = static_cast<double>(m) + static_cast<double>(m_part) / static_cast<double>(part);
        // The same in units of a part, where a rounding is k parts.
        const std::int64_t e_all = e * part + e_part, m_all = m * part + m_part;
        const std::int64_t sign = towards == bias_towards::light ? 1 : (towards == bias_towards::shadow ? -1 : 0);
        const int near_code = std::clamp(static_cast<int>(65535 - 65535 * e / m + sign * (extra + 1)) + roll(-2, 2), 1, 65535);
        for (const int code : {near_code, roll(0, 65535)}) {
            const bool expected = shadowed(e_all, m_all, code, towards, k * static_cast<int>(part), extra + 1);
            wrong.unless((shadow_as<float>(f, depth16{static_cast<std::uint16_t>(code)}, r) > 0.0f) == expected, "e", e_all, "m",
                         m_all, "z", code, "towards", static_cast<int>(towards), "k", k, "moved", extra);
        }
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("a bias moves a depth of 16 bits by whole codes, rounded up, and never farther than the range") {
    CHECK(codes_towards_light<rg8>({}) == 129); // 257/2 for the caster's byte, 1/2 for the receiver's own code
    CHECK(codes_towards_light<rg16>({}) == 1);
    CHECK(codes_towards_light<rg8>(towards_shadow) == -129);
    CHECK(codes_towards_light<rg8>({.caster_is_code = true}) == 0);
    CHECK(codes_towards_light<rg8>(unbiased) == 0);
    CHECK(codes_towards_light<tm8>({}) == 1); // rounds its casters towards the light itself
    CHECK(codes_towards_light<tm8>(towards_shadow) == -258);
    const auto of_depth = [](float depth, bias_towards towards) {
        return codes_towards_light<rg8>({.towards = towards, .depth = depth, .caster_is_code = true});
    };
    CHECK(of_depth(10.0f / 65535.0f, bias_towards::light) == 10);
    CHECK(of_depth(10.5f / 65535.0f, bias_towards::light) == 11);
    CHECK(of_depth(10.5f / 65535.0f, bias_towards::shadow) == -11);
    CHECK(of_depth(-10.5f / 65535.0f, bias_towards::light) == -10);
    CHECK(of_depth(0x1p-9f / 65535.0f, bias_towards::light) == 0); // up but for 1/256 of one
    CHECK(of_depth(0x1.8p-8f / 65535.0f, bias_towards::light) == 1);
    CHECK(codes_towards_light<rg16>({.depth = 0.25f / 65535.0f}) == 2); // the caster's half, the receiver's half, a quarter
    CHECK(of_depth(1.0f, bias_towards::light) == 65535);
    constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    for (const float far_off : {3.0f, 1e30f, inf}) {
        CHECK(of_depth(far_off, bias_towards::light) == 65535);
        CHECK(of_depth(far_off, bias_towards::shadow) == -65535);
        CHECK(of_depth(-far_off, bias_towards::light) == -65535);
    }
    CHECK(of_depth(nan, bias_towards::light) == 65535); // lit
    CHECK(of_depth(nan, bias_towards::shadow) == 65535);
    CHECK(of_depth(nan, bias_towards::none) == 0);
}

TEST_CASE_TEMPLATE("towards light no code of a receiver at or before its caster is shadowed, towards shadow none behind it is lit",
                   Texel, rg8, rg16, rg16f, rg32f, tm8, tm16, test::paper8, test::paper16) {
    sweep wrong;
    for (const float s : test::trying_depths<typename Texel::channel_type>(257))
        for (const int covered : {1, 3, 8, 16}) {
            const Texel t = test::filtered(Texel::caster(s), covered, 16);
            const int code = unorm16::encode(static_cast<double>(s));
            if (static_cast<double>(Texel::channel_type::code(t.stored[1])) <= 0.0) continue;
            wrong.unless(!is_dark(t, code, {}), "false shadow, s", s, "of 16", covered);
            wrong.unless(code == 0 || s >= 1.0f || is_dark(t, code, {.caster = towards_shadow}), "false light, s", s, "of 16",
                         covered);
            // And shadow is kept two codes beyond where it is kept for a float: one for rounding up, one for the receiver's code.
            const double kept = test::end_of_doubt<Texel>(static_cast<double>(s), covered / 16.0) * 65535.0 + 2.0;
            if constexpr (std::same_as<typename Texel::representation_type, depth_mask>)
                wrong.unless(kept >= 65535.0 || is_dark(t, static_cast<int>(kept) + 1, {}), "lost shadow, s", s, "of 16", covered);
        }
    CHECK(wrong.report() == "");
}

TEST_CASE_TEMPLATE("totality: whatever the bits, a depth of no code is lit, a clear texel is lit, and an intensity is one", Texel,
                   rg8, rgb8, rg16f, rgba32f, tm16, test::paper16f) {
    test::dice roll(96);
    sweep wrong;
    const filtered<Texel> clear = read(Texel::clear());
    for (int i = 0; i < 20'000; ++i) {
        filtered<Texel> f{};
        for (auto& code : f.code)
            code = roll.one_in(4) ? (roll.one_in(2) ? std::numeric_limits<double>::quiet_NaN() : 1e30)
                                  : static_cast<double>(roll.unit()) * 70000.0 - 9.0;
        const rule r{.caster = {.towards = sides[i % 3], .depth = roll.unit() - 0.5f}, .fade = 0.1f};
        const depth16 z{static_cast<std::uint16_t>(roll(0, 65535))};
        const float intensity = shadow_as<float>(f, z, r);
        wrong.unless(intensity >= 0.0f && intensity <= 1.0f, "intensity", intensity);
        wrong.unless(shadow_as<std::uint16_t>(f, depth16{0}, r) == 0 && shadow_as<std::uint8_t>(clear, z, r) == 0, "lit", i);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("an intensity in codes is the mask's own, or the nearest to it, halves upwards") {
    sweep wrong;
    const auto behind = [](auto number, const auto& f) {
        return shadow_as<decltype(number)>(f, depth16{65535}, {.caster = unbiased});
    };
    for (int m = 0; m < 256; ++m) {
        const auto f = read(rg8{{static_cast<std::uint8_t>(m), static_cast<std::uint8_t>(m)}});
        wrong.unless(behind(std::uint8_t{}, f) == m && behind(std::uint16_t{}, f) == 257 * m, "byte", m);
        wrong.unless(same(behind(0.0f, f), static_cast<float>(m) / 255.0f), "byte as float", m);
    }
    for (int m = 0; m < 65536; ++m) {
        const auto f = read(rg16{{static_cast<std::uint16_t>(m), static_cast<std::uint16_t>(m)}});
        wrong.unless(behind(std::uint16_t{}, f) == m && behind(std::uint8_t{}, f) == (m + 128) / 257, "16 bits", m);
        const auto half = read(rg16f{{static_cast<std::uint16_t>(m), static_cast<std::uint16_t>(m)}});
        const double value = half.mask() <= 65504.0 ? half.mask() : 0.0; // NaN, what is negative and the infinite are lit
        const int nearest = value > 0.0 ? static_cast<int>(std::min(value, 1.0) * 65535.0 + 0.5) : 0;
        wrong.unless(behind(std::uint16_t{}, half) == nearest, "half", m);
    }
    for (int m = 0; m <= 255 * 256; ++m) { // blends, in parts of a byte's code, among them every tie of bytes
        filtered<rg16> f{};
        f.code[0] = f.code[1] = 257.0 * (m / 256) + (m % 256) * 257.0 / 256.0;
        wrong.unless(behind(std::uint8_t{}, f) == (m + 128) / 256, "blend", m);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("depths and intensities of each kind may be mixed, in rows, images and anywhere") {
    test::dice roll(97);
    const image<rg8> map = test::noise<rg8>(roll, {40, 6}, 3);
    image<std::uint16_t> z(map.size());
    test::for_each_texel(whole(z.size()), [&](int x, int y) { z(x, y) = static_cast<std::uint16_t>(roll(0, 65535)); });
    image<std::uint8_t> bytes(map.size());
    image<std::uint16_t> words(map.size());
    image<float> floats(map.size());
    receive(map.view(), z.view(), bytes.view());
    receive(map.view(), z.view(), words.view());
    receive(map.view(), z.view(), floats.view());
    sweep wrong;
    test::for_each_texel(whole(z.size()), [&](int x, int y) {
        wrong.unless(words(x, y) == 257 * bytes(x, y) && same(floats(x, y), static_cast<float>(bytes(x, y)) / 255.0f) &&
                         bytes(x, y) == shadow_as<std::uint8_t>(read(map(x, y)), depth16{z(x, y)}),
                     "x", x, "y", y);
    });
    std::vector<float> x, y, depth;
    std::vector<std::uint16_t> code;
    for (int i = 0; i < 500; ++i) {
        x.push_back(44 * roll.unit() - 2);
        y.push_back(10 * roll.unit() - 2);
        code.push_back(static_cast<std::uint16_t>(roll(0, 65535)));
        depth.push_back(roll.unit());
    }
    std::array<std::uint8_t, 500> from_codes{}, from_floats{};
    receive(map.view(), x, y, code, from_codes);
    receive(map.view(), x, y, depth, from_floats);
    for (std::size_t i = 0; i < 500; ++i) {
        const auto f = sample(map.view(), x[i], y[i]);
        wrong.unless(from_codes[i] == shadow_as<std::uint8_t>(f, depth16{code[i]}) &&
                         from_floats[i] == shadow_as<std::uint8_t>(f, depth[i]),
                     "point", i);
    }
    CHECK(wrong.report() == "");
}

TEST_CASE("a result may lie in the texel or the depth it comes from") {
    test::dice roll(98);
    std::vector<rg8> texels;
    std::vector<std::uint16_t> z;
    for (int i = 0; i < 300; ++i) {
        texels.push_back(test::any_caster<rg8>(roll));
        z.push_back(static_cast<std::uint16_t>(roll(0, 65535)));
    }
    std::vector<std::uint8_t> apart(300);
    receive(texels, z, apart);
    auto in_texels = texels;
    receive(in_texels, z, strided_span<std::uint8_t>(&in_texels[0].stored[0], 300, 2));
    auto in_depths = z;
    receive(texels, in_depths, strided_span<std::uint8_t>(reinterpret_cast<std::uint8_t*>(in_depths.data()), 300, 2));
    auto packed = texels; // byte i lies before texel i
    receive(packed, z, strided_span<std::uint8_t>(&packed[0].stored[0], 300));
    int wrong = 0;
    for (std::size_t i = 0; i < 300; ++i)
        wrong += in_texels[i].stored[0] != apart[i] || reinterpret_cast<std::uint8_t*>(&in_depths[i])[0] != apart[i] ||
                 reinterpret_cast<std::uint8_t*>(packed.data())[i] != apart[i];
    CHECK(wrong == 0);
}
