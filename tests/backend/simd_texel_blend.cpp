// Receivers anywhere on maps of every format, blended and decided in doubles, against the oracle, bit for bit.
#include <gnomon/backend/reconstruct.hpp>
#include <gnomon/backend/simd_shade.hpp>
#include <gnomon/backend/simd_texel_blend.hpp>

#include "../support/formats.hpp"
#include "../support/lanes.hpp"
#include "../support/shades.hpp"

#include <doctest/doctest.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace {
using gnomon::extent;
using gnomon::rule;
using gnomon::strided_span;
using test::dice;
using test::for_each_isa;

using test::ratio_rga8;

/// A map whose memory ends where its last texel does: the address sanitizer watches.
template <typename Texel> struct tight_map {
    extent size;
    std::unique_ptr<Texel[]> memory;

    tight_map(dice& roll, extent s)
        : size(s), memory(std::make_unique<Texel[]>(static_cast<std::size_t>(s.width) * static_cast<std::size_t>(s.height))) {
        test::for_each_texel(whole(size), [&](int x, int y) {
            view_of_all()(x, y) = roll.one_in(4) ? Texel::clear() : test::any_filtered<Texel>(roll);
        });
    }
    [[nodiscard]] gnomon::image_view<Texel> view_of_all() const { return {memory.get(), size}; }
    [[nodiscard]] gnomon::image_view<const Texel> view() const { return view_of_all(); }
};

struct points {
    std::vector<float> x, y, z;
};
template <typename Texel> points some_points(dice& roll, const tight_map<Texel>& map, const rule& r, int count) {
    points p;
    const auto position = [&roll](int size) {
        if (roll.one_in(100)) return test::hostile_floats[static_cast<std::size_t>(roll(0, 29))];
        return static_cast<float>(roll(-2 * 256, (size + 2) * 256)) / 256.0f;
    };
    for (int i = 0; i < count; ++i) {
        const float x = position(map.size.width), y = position(map.size.height);
        for (const float z : test::depths_that_try(roll, gnomon::sample(map.view(), x, y), r)) {
            p.x.push_back(x);
            p.y.push_back(y);
            p.z.push_back(z);
        }
    }
    return p;
}
} // namespace

TEST_CASE_TEMPLATE(
    "receivers anywhere on maps of every format are decided in lanes as by the oracle, on the map and beside it, about "
    "where a shadow begins, ends and has faded",
    Texel, gnomon::rgb8, gnomon::rgba8, gnomon::rga16, gnomon::rgba16, gnomon::rg16f, gnomon::rgb16f, gnomon::rga32f,
    gnomon::rgba32f, gnomon::tm8, gnomon::tm16, ratio_rga8) {
    dice roll(520);
    int half = 0;
    for (const rule& r : test::rules_that_fade())
        for (const extent size : {extent{9, 7}, {2, 2}, {40, 3}}) {
            const tight_map<Texel> map(roll, size);
            const points p = some_points(roll, map, r, 60);
            test::for_each_kind(roll, p.z, [&](const auto& z, auto intensity) {
                std::vector<decltype(intensity)> expected(z.size());
                gnomon::receive(map.view(), p.x, p.y, z, expected, r);
                half += test::half_shadows(expected);
                for_each_isa([&]<typename Isa>() {
                    std::vector<decltype(intensity)> made(z.size(), decltype(intensity)(77));
                    gnomon::reconstruct<Isa>(map.view(), strided_span<const float>(p.x), strided_span<const float>(p.y), z, made,
                                             r);
                    CHECK(test::equal_bits(made, expected));
                });
            });
        }
    CHECK(half > 4000);
}

namespace {
using lanes = gnomon::emulated<16>;
template <typename Texel, typename Intensity>
using chosen = typename gnomon::on_any::blended_decision<lanes, Texel, float, Intensity>::blending;
static_assert(std::same_as<chosen<gnomon::rg8, std::uint16_t>, gnomon::on_any::byte_blend<lanes, gnomon::rg8>>);
static_assert(std::same_as<chosen<gnomon::rg16, std::uint8_t>, gnomon::on_any::word_blend<lanes, gnomon::rg16>>);
static_assert(std::same_as<chosen<gnomon::rg32f, float>, gnomon::on_any::number_blend<lanes, gnomon::rg32f, float>>);
static_assert(
    std::same_as<chosen<gnomon::rg32f, std::uint8_t>, gnomon::on_any::texel_blend<lanes, gnomon::rg32f, float, std::uint8_t>>);
static_assert(std::same_as<chosen<gnomon::rga8, float>, gnomon::on_any::texel_blend<lanes, gnomon::rga8, float, float>>);
static_assert(std::same_as<chosen<gnomon::tm8, float>, gnomon::on_any::texel_blend<lanes, gnomon::tm8, float, float>>);

template <typename Texel, typename Depth> using blending = gnomon::on_any::texel_blend<lanes, Texel, Depth, std::uint8_t>;

/// Is a register answered that has this among its numbers?
template <typename Texel> bool answered(int channel, double code, std::size_t receiver = 3) {
    using by = blending<Texel, float>;
    typename by::blended of{};
    of.code[channel][receiver] = code;
    const std::array z{0.75f, 0.75f, 0.75f, 0.75f};
    std::array<std::uint8_t, 4> made{};
    return by::answered(by::moving::template of<Texel, float>({}), of, z.data(), made.data());
}
} // namespace

TEST_CASE("a blend of floats that is no number is the scalar loop's, of whichever number, and no other is") {
    for (int channel = 0; channel < 4; ++channel) {
        CHECK(answered<gnomon::rgba32f>(channel, 0.5));
        CHECK(answered<gnomon::rgba32f>(channel, test::infinity<double>));
        for (std::size_t receiver = 0; receiver < 4; ++receiver)
            CHECK_FALSE(answered<gnomon::rgba32f>(channel, test::nan<double>, receiver));
        CHECK_FALSE(answered<gnomon::rgba32f>(channel, -test::infinity<double>));
        CHECK(answered<gnomon::rgba16>(channel, 65535.0));
    }
}

TEST_CASE("a pair that its bias leaves below nothing, in floats of no caster, is lit at depths in codes") {
    constexpr gnomon::rga16f less_than_nothing{{0x8003, 0x0001, 0x3C00}};
    const gnomon::image<gnomon::rga16f> map({2, 2}, less_than_nothing);
    const std::vector<float> at(16, 1.0f);
    const std::vector<std::uint16_t> z(16, 100);
    const rule r{.caster = {.towards = gnomon::bias_towards::shadow, .roundings = 5}};
    for_each_isa([&]<typename Isa>() {
        std::vector<float> made(16, 77.0f);
        gnomon::reconstruct<Isa>(map.view(), strided_span<const float>(at), strided_span<const float>(at), z, made, r);
        CHECK(made == std::vector<float>(16, 0.0f));
    });
}

TEST_CASE("words of 32 bits fade within 2^-22 of their bound as by the oracle, whose products no compiler fuses") {
    const std::array<gnomon::rgb16, 4> texels{
        {{{0xE456, 0xE456, 0x6C08}}, {{0x7A4E, 0x7A4E, 0x235F}}, {{0x7C7A, 0x7C7A, 0x11CC}}, {{0x60FB, 0x60FB, 0x2B97}}}};
    const gnomon::image_view<const gnomon::rgb16> map(texels.data(), {2, 2});
    dice roll(521);
    for (const float fade : {0x1.8e3658p-24f, 0x1p-27f, 0x1.4p-22f}) {
        const rule r{.caster = gnomon::unbiased, .far_bound = gnomon::unbiased, .fade = fade};
        points p{{0x1.39p+0f}, {0x1.8ep-1f}, {0x1.46830cp-1f}};
        for (int i = 0; i < 4000; ++i) {
            p.x.push_back(0.5f + static_cast<float>(roll(0, 256)) / 256.0f);
            p.y.push_back(0.5f + static_cast<float>(roll(0, 256)) / 256.0f);
            p.z.push_back(test::first_bounded(gnomon::sample(map, p.x.back(), p.y.back()), r));
        }
        std::vector<float> expected(p.z.size());
        gnomon::receive(map, p.x, p.y, p.z, expected, r);
        if (fade > 0x1p-24f && fade < 0x1p-23f) CHECK(test::equal(expected[0], 0x1.18b590p-2f));
        for_each_isa([&]<typename Isa>() {
            std::vector<float> made(p.z.size(), 77.0f);
            gnomon::reconstruct<Isa>(map, strided_span<const float>(p.x), strided_span<const float>(p.y), p.z, made, r);
            CHECK(test::equal_bits(made, expected));
        });
    }
}
