// Decisions in lanes on depths and intensities in codes against the oracle, bit for bit: every width up to two registers and a bit, any
// stride, alignment and rule, results in place; and for bytes every pair there is, at the codes where its shadow begins.
#include <gnomon/backend/simd.hpp>
#include <gnomon/backend/simd_codes.hpp>
#include <gnomon/backend/simd_decision.hpp>
#include <gnomon/backend/simd_receive.hpp>

#include "../support/formats.hpp"
#include "../support/lanes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace {
using gnomon::image_view;
using gnomon::rg16;
using gnomon::rg8;
using gnomon::rule;
using gnomon::simd;
using gnomon::strided_span;
using test::dice;
using test::fill_with_bits;
using test::for_each_isa;

/// What rows hold.
template <typename T, typename D, typename I> struct row_of {
    using texel = T;
    using depth = D;
    using intensity = I;
};
using byte_row = row_of<rg8, std::uint16_t, std::uint8_t>;
using byte_row_of_floats = row_of<rg8, float, std::uint8_t>;
using word_row = row_of<rg16, std::uint16_t, std::uint16_t>;
using float_row = row_of<gnomon::rg32f, float, float>;
using float_row_of_codes = row_of<gnomon::rg32f, std::uint16_t, float>;
using word_row_to_bytes = row_of<rg16, std::uint16_t, std::uint8_t>;
using words_to_bytes = row_of<rg16, float, std::uint8_t>;
using bytes_to_words = row_of<rg8, std::uint16_t, std::uint16_t>;
using bytes_to_floats = row_of<rg8, std::uint16_t, float>;
using words_to_floats = row_of<rg16, std::uint16_t, float>;
using translucent_words = row_of<gnomon::rga16, std::uint16_t, float>;
using half_row_to_floats = row_of<gnomon::rg16f, std::uint16_t, float>;
using half_row = row_of<gnomon::rg16f, std::uint16_t, std::uint8_t>;
using bounded_row = row_of<gnomon::rgb8, std::uint16_t, std::uint8_t>;
using translucent_row = row_of<gnomon::rga8, std::uint16_t, std::uint8_t>;
using ratio_row = row_of<gnomon::tm8, std::uint16_t, std::uint8_t>;
using ratio_row_of_words = row_of<gnomon::tm16, std::uint16_t, std::uint16_t>;

const std::vector<rule>& rules() {
    static const std::vector<rule> all{
        {},
        {.caster = gnomon::unbiased},
        {.caster = gnomon::towards_shadow},
        {.caster = {.roundings = 1000, .depth = 0.125f}},
        {.caster = {.roundings = 0, .depth = -0.125f}},
        {.caster = {.depth = -0.125f}},
        {.caster = {.towards = gnomon::bias_towards::shadow, .roundings = 7, .depth = 0.25f}},
        {.caster = {.towards = gnomon::bias_towards::shadow, .roundings = 0, .depth = -2.0f}},
        {.caster = {.depth = 2.0f}},
        {.caster = {.caster_is_code = true}},
        {.caster = {.roundings = 0, .depth = 1.0f / 65535.0f, .caster_is_code = true}}, // one code
        {.caster = {.roundings = 2}},
        {.caster = {.towards = gnomon::bias_towards::shadow, .roundings = 1 << 25}},
        {.caster = {.roundings = 1 << 25, .caster_is_code = true}},
        {.lit_beyond = true},
    };
    return all;
}

template <typename Row> float any_depth(dice& roll, const typename Row::texel& texel) {
    const float s = gnomon::caster_depth(texel);
    return roll.one_in(3) ? roll.unit()
                          : s + static_cast<float>(roll(-3, 3)) / 65535.0f + (roll.one_in(2) ? 129.0f / 65535.0f : 0.0f);
}
void set(float& z, float value) { z = value; }
void set(std::uint16_t& z, float value) { z = gnomon::unorm16::encode(static_cast<double>(value)); }

/// `count` elements that lie `spread` apart in `memory`.
template <typename T> strided_span<T> spread_over(T* memory, int count, int spread) {
    return {memory, count, static_cast<std::ptrdiff_t>(sizeof(T)) * spread};
}

/// The code after which the oracle's shadow on a texel begins.
template <typename Intensity, typename Texel> int last_lit_code(const Texel& t, const rule& r) {
    int lit = 0, dark = 65536;
    while (dark - lit > 1) {
        const int middle = (lit + dark) / 2;
        const bool is_dark =
            gnomon::shadow_as<Intensity>(read(t), gnomon::depth16{static_cast<std::uint16_t>(middle)}, r) > Intensity{};
        (is_dark ? dark : lit) = middle;
    }
    return lit;
}
std::uint16_t nearest_code(int code) { return static_cast<std::uint16_t>(std::clamp(code, 0, 65535)); }

/// Lanes of every set store the oracle's bits.
template <typename Intensity, typename Texel>
void check_lanes(const std::vector<Texel>& texels, const std::vector<std::uint16_t>& z, const rule& r) {
    std::vector<Intensity> expected(z.size()), made(z.size());
    gnomon::receive(texels, z, expected, r);
    for_each_isa([&]<typename Isa>() {
        std::fill(made.begin(), made.end(), Intensity{77});
        gnomon::receive(simd<Isa>{}, texels, z, made, r);
        CHECK(std::memcmp(expected.data(), made.data(), made.size() * sizeof(Intensity)) == 0);
    });
}
} // namespace

TYPE_TO_STRING_AS("bytes, depths of 16 bits", byte_row);
TYPE_TO_STRING_AS("bytes, float depths", byte_row_of_floats);
TYPE_TO_STRING_AS("16 bits, depths of 16 bits", word_row);
TYPE_TO_STRING_AS("floats", float_row);
TYPE_TO_STRING_AS("floats, depths of 16 bits", float_row_of_codes);
TYPE_TO_STRING_AS("16 bits, depths of 16 bits, to bytes", word_row_to_bytes);
TYPE_TO_STRING_AS("16 bits to bytes", words_to_bytes);
TYPE_TO_STRING_AS("bytes to 16 bits", bytes_to_words);
TYPE_TO_STRING_AS("bytes to floats", bytes_to_floats);
TYPE_TO_STRING_AS("16 bits to floats", words_to_floats);
TYPE_TO_STRING_AS("translucent 16 bits to floats", translucent_words);
TYPE_TO_STRING_AS("halves to floats", half_row_to_floats);
TYPE_TO_STRING_AS("halves", half_row);
TYPE_TO_STRING_AS("far bounds", bounded_row);
TYPE_TO_STRING_AS("translucent", translucent_row);
TYPE_TO_STRING_AS("ratios", ratio_row);
TYPE_TO_STRING_AS("ratios of 16 bits", ratio_row_of_words);

TEST_CASE_TEMPLATE("lanes decide on codes as the oracle does: every width to 140, any stride, alignment and rule", Row, byte_row,
                   byte_row_of_floats, word_row, word_row_to_bytes, float_row, float_row_of_codes, half_row, words_to_bytes,
                   bytes_to_words, bytes_to_floats, words_to_floats, translucent_words, half_row_to_floats, bounded_row,
                   translucent_row, ratio_row, ratio_row_of_words) {
    using Texel = typename Row::texel;
    using Depth = typename Row::depth;
    using Intensity = typename Row::intensity;
    dice roll(421);
    std::vector<Texel> texels(430);
    std::vector<Depth> z(430);
    fill_with_bits(roll, image_view<Texel>(texels.data(), {430, 1}));
    for (std::size_t i = 0; i < texels.size(); ++i) {
        if (!roll.one_in(4)) texels[i] = test::any_caster<Texel>(roll);
        set(z[i], roll.one_in(16) ? static_cast<float>(roll(0, 1)) : any_depth<Row>(roll, texels[i]));
    }
    for_each_isa([&]<typename Isa>() {
        int wrong = 0, dark = 0;
        for (int count = 0; count <= 140; count += count < 70 ? 1 : 7)
            for (const auto& [of_texels, of_z, of_intensity] : {std::array{1, 1, 1}, {3, 1, 1}, {1, 2, 1}, {1, 1, 2}, {2, 3, 2}}) {
                const int first = roll(0, 3);
                const auto some_texels = spread_over<const Texel>(texels.data() + first, count, of_texels);
                const auto some_z = spread_over<const Depth>(z.data() + first, count, of_z);
                const rule& r = rules()[static_cast<std::size_t>(count) % rules().size()];
                std::vector<Intensity> expected(300, Intensity{77}), made = expected;
                gnomon::receive(some_texels, some_z, spread_over(expected.data() + first, count, of_intensity), r);
                gnomon::receive(simd<Isa>{}, some_texels, some_z, spread_over(made.data() + first, count, of_intensity), r);
                wrong += std::memcmp(expected.data(), made.data(), expected.size() * sizeof(Intensity)) != 0;
                for (const Intensity intensity : made) dark += intensity > Intensity{} && !gnomon::same(intensity, Intensity{77});
            }
        CHECK(wrong == 0);
        CHECK(dark > (Texel::effects.far_bound ? 10 : 1000));
    });
}

TEST_CASE("lanes decide every pair of bytes as the oracle does, at the codes where its shadow begins, one before and one after, "
          "under every rule") {
    for (const rule& r : rules()) {
        std::vector<rg8> texels;
        std::vector<std::uint16_t> z;
        for (int mask = 0; mask < 256; ++mask)
            for (int depth = 0; depth < 256; ++depth) {
                const rg8 t{{static_cast<std::uint8_t>(depth), static_cast<std::uint8_t>(mask)}};
                const int lit = mask > 0 ? last_lit_code<std::uint8_t>(t, r) : 0;
                for (const int code : {0, lit - 1, lit, lit + 1, lit + 2, 65535}) {
                    texels.push_back(t);
                    z.push_back(nearest_code(code));
                }
            }
        check_lanes<std::uint8_t>(texels, z, r);
        check_lanes<std::uint16_t>(texels, z, r);
        check_lanes<float>(texels, z, r);
    }
}

TEST_CASE_TEMPLATE("a pair is decided as the oracle does where its shadow begins, alone among texels of nothing, in any lane", Row,
                   byte_row, bytes_to_words, bytes_to_floats, word_row, word_row_to_bytes, words_to_floats) {
    using Texel = typename Row::texel;
    using storage = typename Texel::storage;
    constexpr int last = std::numeric_limits<storage>::max();
    constexpr int apart = 64; // no two in the registers that are decided together
    dice roll(437);
    for (const rule& r : rules()) {
        std::vector<Texel> texels(5000 * apart, Texel::clear());
        std::vector<std::uint16_t> z(texels.size(), 30000);
        for (std::size_t first = 0; first < texels.size(); first += apart) {
            const Texel t{{static_cast<storage>(roll(0, last)), static_cast<storage>(roll(1, last))}};
            const std::size_t at = first + static_cast<std::size_t>(roll(0, apart - 1));
            texels[at] = t;
            z[at] = nearest_code(last_lit_code<float>(t, r) + roll(-1, 2));
        }
        check_lanes<typename Row::intensity>(texels, z, r);
    }
}

TEST_CASE("of the default rule the quick way tells, but where a shadow begins") {
    using by = gnomon::on_any::byte_decision<gnomon::emulated<16>, rg8, std::uint8_t>;
    CHECK(by::of({}).one_rounding_towards_light);
    std::array<rg8, by::step> texels;
    std::array<std::uint16_t, by::step> depths;
    std::array<std::uint8_t, by::step> made;
    texels.fill(rg8::caster(0.5f));
    for (std::size_t i = 0; i < depths.size(); ++i) depths[i] = i % 2 == 0 ? 0x4000 : 0xC000;
    const auto tells = [&] { return by::quick(by::of({}).nearer, texels[0].stored, depths.data(), made.data()); };
    CHECK(tells());
    CHECK((made[0] == 0 && made[1] == 255));
    const int unsure = 256 * (255 - texels[5].stored[rg8::depth_index]) + 255; // is the high half of (256 M + 128) Z
    depths[5] = static_cast<std::uint16_t>((65536 * std::int64_t{unsure} + 65407) / 65408 + gnomon::codes_towards_light<rg8>({}));
    CHECK_FALSE(tells());
}

TEST_CASE_TEMPLATE("lanes decide pairs of words as the oracle does, of the least and greatest codes and between them", Row,
                   word_row, word_row_to_bytes, words_to_floats) {
    constexpr int codes[] = {0,     1,     2,     3,     4,     127,   128,   129,   255,   256,  257,
                             32766, 32767, 32768, 32769, 65279, 65406, 65408, 65533, 65534, 65535};
    for (const rule& r : rules()) {
        std::vector<rg16> texels;
        std::vector<std::uint16_t> z;
        for (const int mask : codes)
            for (const int depth : codes) {
                const rg16 t{{static_cast<std::uint16_t>(depth), static_cast<std::uint16_t>(mask)}};
                const int lit = last_lit_code<float>(t, r);
                for (const int code : {0, 1, lit - 2, lit - 1, lit, lit + 1, lit + 2, lit + 3, 32768, 65534, 65535}) {
                    texels.insert(texels.end(), 64, t); // a register of the widest lanes: no neighbour is unsure in its place
                    z.insert(z.end(), 64, nearest_code(code));
                }
            }
        check_lanes<typename Row::intensity>(texels, z, r);
    }
}

namespace {
/// Does the quick way tell of registers of these pairs at these depths?
template <typename Intensity> bool told_of_words(const rg16& t, int depth, const rule& r, int expected) {
    using by = gnomon::on_any::word_decision<gnomon::emulated<16>, rg16, Intensity>;
    std::array<rg16, by::step> texels;
    std::array<std::uint16_t, by::step> depths;
    std::array<Intensity, by::step> made;
    texels.fill(t);
    depths.fill(static_cast<std::uint16_t>(depth));
    made.fill(77);
    const bool told = by::quick(by::of(r), texels[0].stored, depths.data(), made.data());
    for (const Intensity each : made) CHECK(each == (told ? expected : 77));
    return told;
}
} // namespace

TEST_CASE_TEMPLATE("of words the quick way tells what is surely lit or shadowed, for one rounding towards light and for two",
                   Intensity, std::uint8_t, std::uint16_t) {
    constexpr int all = std::numeric_limits<Intensity>::max();
    for (const int k : {1, 2}) {
        const rule r{.caster = {.roundings = k, .caster_is_code = true}}; // moves no depth
        CAPTURE(k);
        // M = 65535: the high half of M Z is Z - 1, so it is surely in shadow from Z - 1 = F on.
        for (const int depth : {1, 1000, 40000, 65535}) {
            const rg16 t{{static_cast<std::uint16_t>(depth), 65535}};
            const int f = 65535 - depth + k;
            if (f + 1 <= 65535) CHECK(told_of_words<Intensity>(t, f + 1, r, all));
            if (f <= 65535) CHECK_FALSE(told_of_words<Intensity>(t, f, r, 0));
            if (f - 1 <= 65535) CHECK_FALSE(told_of_words<Intensity>(t, f - 1, r, 0));
            if (f >= 3) CHECK(told_of_words<Intensity>(t, f - 2, r, 0));
        }
        for (const int z : {0, 1, 30000, 65535}) CHECK(told_of_words<Intensity>(rg16::clear(), z, r, 0));
        for (const int z : {0, 1, 30000, 65535}) CHECK(told_of_words<Intensity>(rg16{{0, 1}}, z, r, 0));
        CHECK_FALSE(told_of_words<Intensity>(rg16{{1, 1}}, 65535, r, 0));
        CHECK_FALSE(told_of_words<Intensity>(rg16{{500, 100}}, 100, r, 0)); // no caster has such a pair
    }
    const auto tries = [](const gnomon::bias& b) {
        return gnomon::on_any::word_decision<gnomon::emulated<16>, rg16, Intensity>::of({.caster = b}).asked_for_by_filters;
    };
    CHECK((tries({}) && tries({.roundings = 2}) && tries({.depth = 0.125f}) && tries({.caster_is_code = true})));
    CHECK_FALSE((tries({.roundings = 0}) || tries({.roundings = 3}) || tries({.depth = -0.125f}) || tries(gnomon::unbiased) ||
                 tries(gnomon::towards_shadow)));
}

TEST_CASE_TEMPLATE(
    "lanes decide pairs of 16 bits, floats and halves as the oracle does, at the codes where a shadow begins and beside them", Row,
    word_row, word_row_to_bytes, bytes_to_words, float_row_of_codes, half_row_to_floats, translucent_words) {
    using Texel = typename Row::texel;
    dice roll(422);
    for (const rule& r : rules()) {
        std::vector<Texel> texels;
        std::vector<std::uint16_t> z;
        for (int i = 0; i < 2000; ++i) {
            const Texel t = test::any_caster<Texel>(roll);
            const int lit = last_lit_code<float>(t, r);
            for (const int code : {lit - 1, lit, lit + 1, lit + 2}) {
                texels.push_back(t);
                z.push_back(nearest_code(code));
            }
        }
        check_lanes<typename Row::intensity>(texels, z, r);
    }
}

TEST_CASE_TEMPLATE("a mask that a bias takes away is nothing to lanes too, whatever depth a texel holds", Row, float_row_of_codes,
                   half_row_to_floats) {
    using Texel = typename Row::texel;
    std::vector<Texel> texels;
    std::vector<std::uint16_t> z;
    for (int exponent = -25; exponent < 0; ++exponent)
        for (const double e : {-1.0, -0x1p-10, 0.0})
            for (const int code : {1, 30000, 65534, 65535}) {
                texels.push_back({{Texel::channel_type::encode(e), Texel::channel_type::encode(std::ldexp(1.0, exponent))}});
                z.push_back(static_cast<std::uint16_t>(code));
            }
    for (const rule& r : rules()) check_lanes<float>(texels, z, r);
}

TEST_CASE("pairs of floats beyond every map are decided as the oracle does, where products with a depth in codes overflow") {
    const auto check_alone = [](float e, float m, int code) { // lest another receiver's doubt speaks for this one
        const std::vector<gnomon::rg32f> texels(64, {{e, m}});
        const std::vector<std::uint16_t> z(64, nearest_code(code));
        for (const rule& r : rules()) check_lanes<float>(texels, z, r);
    };
    check_alone(0.5f, 1e36f, 47284);
    check_alone(4.8436753e33f, 1.00360511e34f, 33906);
    dice roll(441);
    for (int exponent = 60; exponent < 128; ++exponent)
        for (int i = 0; i < 20; ++i) {
            const float m = std::ldexp(0.5f + 0.5f * roll.unit(), exponent), e = m * (roll.one_in(9) ? -1.0f : 1.0f) * roll.unit();
            const double begins = 65535.0 * (1.0 - static_cast<double>(e) / static_cast<double>(m));
            check_alone(e, m, static_cast<int>(std::min(begins, 65535.0)) + roll(-1, 2));
        }
}

TEST_CASE("every mask is stored as the oracle stores it, as 8 bits, as 16 and as a float") {
    std::vector<rg16> words(65536);
    std::vector<rg8> bytes(65536);
    for (int m = 0; m < 65536; ++m) {
        words[static_cast<std::size_t>(m)] = {{static_cast<std::uint16_t>(m), static_cast<std::uint16_t>(m)}};
        bytes[static_cast<std::size_t>(m)] = {{static_cast<std::uint8_t>(m), static_cast<std::uint8_t>(m)}};
    }
    const std::vector<std::uint16_t> last(65536, 65535);
    check_lanes<std::uint8_t>(words, last, {});
    check_lanes<std::uint16_t>(words, last, {});
    check_lanes<float>(words, last, {});
    check_lanes<std::uint16_t>(bytes, last, {});
    check_lanes<float>(bytes, last, {});
}

TEST_CASE_TEMPLATE(
    "ratios are decided without a product, as by the oracle, about the codes where their shadows begin, by every rule", Texel,
    gnomon::tm8, gnomon::tm16) {
    constexpr int last = std::numeric_limits<typename Texel::storage>::max();
    dice roll(443);
    for (const rule& r : rules()) {
        std::vector<Texel> texels;
        std::vector<std::uint16_t> z;
        for (int i = 0; i < 512; ++i)
            for (const int mask : {0, 1, roll(0, last), last}) {
                const int depth = last == 255 ? i % 256 : (i < 8 ? i * last / 7 : roll(0, last));
                const int begins = 65535 - 65535 / last * depth + gnomon::codes_towards_light<Texel>(r.caster);
                for (const int code : {0, 65535, begins - 1, begins, begins + 1, begins + 2}) {
                    texels.push_back({{static_cast<typename Texel::storage>(depth), static_cast<typename Texel::storage>(mask)}});
                    z.push_back(nearest_code(code));
                }
            }
        check_lanes<std::uint8_t>(texels, z, r);
        check_lanes<std::uint16_t>(texels, z, r);
        check_lanes<float>(texels, z, r);
    }
}

TEST_CASE("of rows the shortest span counts in lanes too") {
    dice roll(424);
    std::vector<rg8> texels(300);
    fill_with_bits(roll, image_view<rg8>(texels.data(), {300, 1}));
    const std::vector<std::uint16_t> z(300, 65535);
    for (int shortest = 0; shortest < 3; ++shortest) {
        const auto first = [shortest](auto& all, int index) { return strided_span(all.data(), index == shortest ? 199 : 300); };
        for_each_isa([&]<typename Isa>() {
            std::vector<std::uint8_t> expected(300, 77), made = expected;
            gnomon::receive(first(texels, 0), first(z, 1), first(expected, 2));
            gnomon::receive(simd<Isa>{}, first(texels, 0), first(z, 1), first(made, 2));
            CHECK(expected[199] == 77);
            CHECK(made == expected);
        });
    }
}

TEST_CASE("results packed where texels were are no texels of a register that goes once more over some") {
    for_each_isa([&]<typename Isa>() {
        for (const int count : {17, 33, 65}) {
            std::vector<rg8> texels(65, {{30, 76}}); // and two results in turn, 0 and 76, are a caster at the far plane
            std::vector<std::uint16_t> z(65, 6000);
            for (std::size_t i = 1; i < z.size(); i += 2) z[i] = 60000;
            const strided_span<std::uint8_t> packed(reinterpret_cast<std::uint8_t*>(texels.data()), count);
            gnomon::receive(simd<Isa>{}, texels, z, packed);
            int wrong = 0;
            for (int i = 0; i < count; ++i) wrong += packed[i] != (i % 2 == 0 ? 0 : 76);
            CHECK(wrong == 0);
        }
    });
}

TEST_CASE_TEMPLATE("results may take the place of what they come from, in lanes as in the oracle", Row, byte_row, word_row,
                   word_row_to_bytes, bytes_to_words, words_to_floats, float_row, ratio_row, ratio_row_of_words) {
    using Texel = typename Row::texel;
    using Depth = typename Row::depth;
    using Intensity = typename Row::intensity;
    dice roll(423);
    std::vector<Texel> texels(321);
    std::vector<Depth> z(321);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        texels[i] = test::any_caster<Texel>(roll);
        set(z[i], i < 160 ? roll.unit() : any_depth<Row>(roll, texels[i])); // where lanes are sure, and then where they are not
        if (i < 240)
            continue; // a last register holds one of these that is new, and would light the others, at depths of their results
        using channel = typename Texel::channel_type;
        texels[i] = {{channel::encode(Texel::representation_type::premultiplied ? 0.12 : 0.4), channel::encode(0.3)}};
        set(z[i], 0.9f);
    }
    std::vector<Intensity> apart(321);
    gnomon::receive(texels, z, apart);
    for_each_isa([&]<typename Isa>() {
        auto in_texels = texels, packed = texels;
        auto in_depths = z;
        const auto first_of = [](auto& memory) { return reinterpret_cast<Intensity*>(memory.data()); };
        gnomon::receive(simd<Isa>{}, in_texels, z, strided_span<Intensity>(first_of(in_texels), 321, sizeof(Texel)));
        gnomon::receive(simd<Isa>{}, packed, z, strided_span<Intensity>(first_of(packed), 321)); // element i lies before texel i
        if constexpr (sizeof(Intensity) <= sizeof(Depth))
            gnomon::receive(simd<Isa>{}, texels, in_depths, strided_span<Intensity>(first_of(in_depths), 321, sizeof(Depth)));
        int wrong = 0;
        for (int i = 0; i < 321; ++i) {
            const Intensity expected = apart[static_cast<std::size_t>(i)];
            wrong += std::memcmp(&in_texels[static_cast<std::size_t>(i)], &expected, sizeof expected) != 0;
            wrong += std::memcmp(first_of(packed) + i, &expected, sizeof expected) != 0;
            if constexpr (sizeof(Intensity) <= sizeof(Depth))
                wrong += std::memcmp(&in_depths[static_cast<std::size_t>(i)], &expected, sizeof expected) != 0;
        }
        CHECK(wrong == 0);
    });
}
