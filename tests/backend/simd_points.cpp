// Receivers anywhere, blended and decided in lanes, against the oracle, bit for bit: every position there is around a texel, on the map,
// across each of its borders and far away; every width, any stride and rule; and nothing beside the map is read.
#include <gnomon/backend/simd.hpp>
#include <gnomon/backend/simd_blend.hpp>
#include <gnomon/backend/simd_number_blend.hpp>
#include <gnomon/backend/simd_points.hpp>

#include "../support/bits.hpp"
#include "../support/formats.hpp"
#include "../support/lanes.hpp"
#include "../support/threshold.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace {
using gnomon::extent;
using gnomon::image;
using gnomon::image_view;
using gnomon::rg16;
using gnomon::rg16f;
using gnomon::rg32f;
using gnomon::rg8;
using gnomon::rule;
using gnomon::simd;
using gnomon::strided_span;
using test::dice;
using test::for_each_isa;

const rule rules[] = {
    {},
    {.caster = gnomon::unbiased},
    {.caster = gnomon::towards_shadow},
    {.caster = {.roundings = 2}},
    {.caster = {.towards = gnomon::bias_towards::shadow, .roundings = 128}},
    {.caster = {.roundings = 129}},
    {.caster = {.roundings = 0, .depth = -0.125f}},
    {.caster = {.towards = gnomon::bias_towards::shadow, .roundings = 0, .depth = 0.25f}},
    {.caster = {.depth = 0.5f, .caster_is_code = true}, .lit_beyond = true},
};

struct points {
    std::vector<float> x, y, z;
    std::vector<std::uint16_t> codes;
};

/// Around the map: on every 1/512 texel and a float beside it, nowhere, and at depths around that of the blend.
template <typename Texel> points some_points(dice& roll, const image<Texel>& map, int count) {
    constexpr float odd[] = {
        test::infinity<float>, -test::infinity<float>, test::nan<float>, 3e38f, -3e38f, 4194304.0f, 1.5f, -0.0f, 1e-30f, -1e-30f};
    points p;
    const auto position = [&](int size) {
        if (roll.one_in(40)) return odd[roll(0, 9)];
        const float at = static_cast<float>(roll(-2 * 512, (size + 2) * 512)) / 512.0f;
        return roll.one_in(2) ? at : (roll.one_in(2) ? test::up(at) : test::down(at));
    };
    for (int i = 0; i < count; ++i) {
        p.x.push_back(position(map.size().width));
        p.y.push_back(position(map.size().height));
        const auto f = gnomon::sample(map.view(), p.x.back(), p.y.back());
        constexpr float half = 0.5f / Texel::channel_type::scale;
        const float s = gnomon::caster_depth(f), moved = roll.one_in(2) ? half + half / static_cast<float>(f.mask() + 0.5) : 0.0f;
        const float z = roll.one_in(8) ? odd[roll(0, 9)]
                                       : (roll.one_in(3) ? roll.unit() : s + moved + static_cast<float>(roll(-2, 2)) * 0x1p-24f);
        p.z.push_back(z);
        p.codes.push_back(roll.one_in(16)
                              ? static_cast<std::uint16_t>(65535 * roll(0, 1))
                              : static_cast<std::uint16_t>(gnomon::unorm16::encode(static_cast<double>(z)) + roll(-1, 1)));
    }
    return p;
}

template <typename Depth> const std::vector<Depth>& depths_of(const points& p) {
    if constexpr (std::is_same_v<Depth, float>)
        return p.z;
    else
        return p.codes;
}
} // namespace

TEST_CASE_TEMPLATE("receivers anywhere are decided in lanes as by the oracle: any position, map, rule and depth", Texel, rg8, rg16,
                   rg16f, rg32f) {
    dice roll(431);
    for (const extent size : {extent{23, 17}, {2, 2}, {1, 9}, {9, 1}, {300, 3}, {0, 0}}) {
        image<Texel> map = test::noise<Texel>(roll, size, 2);
        if (!size.empty()) test::fill_with_bits(roll, map.view().part({0, 0, size.width / 3, size.height / 2})); // e > m too
        const points p = some_points(roll, map, 3000);
        const auto as_by_the_oracle = [&]<typename Depth, typename Intensity>(Depth, Intensity) {
            const auto& z = depths_of<Depth>(p);
            for (const rule& r : rules) {
                std::vector<Intensity> expected(p.x.size()), made(p.x.size());
                gnomon::receive(map.view(), p.x, p.y, z, expected, r);
                int dark = 0;
                for (const Intensity intensity : expected) dark += intensity > Intensity{};
                CHECK((size.width < 20 || dark > 50));
                for_each_isa([&]<typename Isa>() {
                    gnomon::receive(simd<Isa>{}, map.view(), p.x, p.y, z, made, r);
                    CHECK(std::memcmp(expected.data(), made.data(), made.size() * sizeof(Intensity)) == 0);
                });
            }
        };
        as_by_the_oracle(float{}, float{});
        as_by_the_oracle(float{}, std::uint8_t{});
        as_by_the_oracle(float{}, std::uint16_t{});
        as_by_the_oracle(std::uint16_t{}, float{});
        as_by_the_oracle(std::uint16_t{}, std::uint8_t{});
        as_by_the_oracle(std::uint16_t{}, std::uint16_t{});
    }
}

TEST_CASE_TEMPLATE("receivers anywhere are decided exactly where a shadow begins, however many roundings their bias makes up for",
                   Texel, rg8, rg16, rg16f, rg32f) {
    dice roll(436);
    image<Texel> map = test::noise<Texel>(roll, {40, 30}, 2);
    test::for_each_texel({0, 0, 20, 30}, [&](int x, int y) { // masks near the full one are what a bias moves beyond 2^24
        const double mask = 1.0 - static_cast<double>(roll.unit()) / 5.0, depth = static_cast<double>(roll.unit()) * mask;
        map(x, y) = {{Texel::channel_type::encode(depth), Texel::channel_type::encode(mask)}};
    });
    for (const int roundings : {0, 1, 2, 3, 127, 128})
        for (const auto towards : {gnomon::bias_towards::light, gnomon::bias_towards::none, gnomon::bias_towards::shadow}) {
            // Moved towards the light all the same, there is something to decide at pairs that are moved to beyond 2^24 by shadow's side.
            const float depth = towards == gnomon::bias_towards::shadow && roundings == 127 ? -1.5f : 0.0f;
            const rule r{.caster = {.towards = towards, .roundings = roundings, .depth = depth}};
            points p;
            for (int i = 0; i < 16 * 500; ++i) {
                p.x.push_back(41.0f * roll.unit());
                p.y.push_back(31.0f * roll.unit());
                p.z.push_back(0.0f);
                p.codes.push_back(0);
                const bool alone = i % 16 == 0; // in a register: where another is in doubt the oracle itself decides
                if (!alone && !Texel::channel_type::whole_codes) continue;
                const float begins = test::first_shadowed(gnomon::sample(map.view(), p.x.back(), p.y.back()), r);
                const int code = gnomon::unorm16::encode(static_cast<double>(begins));
                p.codes.back() = static_cast<std::uint16_t>(std::clamp(code + roll(-1, 1), 0, 65535));
                if (alone || std::is_same_v<Texel, rg16>) p.z.back() = roll.one_in(2) ? test::down(begins) : begins;
            }
            const auto as_by_the_oracle = [&](const auto& z) {
                std::vector<float> expected(p.x.size()), made(p.x.size());
                gnomon::receive(map.view(), p.x, p.y, z, expected, r);
                for_each_isa([&]<typename Isa>() {
                    gnomon::receive(simd<Isa>{}, map.view(), p.x, p.y, z, made, r);
                    CHECK(expected == made);
                });
            };
            as_by_the_oracle(p.z);
            as_by_the_oracle(p.codes);
        }
}

TEST_CASE_TEMPLATE("every position within a texel and its neighbours, to 1/512, gives the oracle's blend, at the border too", Texel,
                   rg8, rg16, rg16f, rg32f) {
    dice roll(432);
    const image<Texel> map = test::noise<Texel>(roll, {3, 2}, 2);
    points p;
    for (int y = -1024; y <= 4 * 512; y += 37)
        for (int x = -1024; x <= 5 * 512; ++x) {
            p.x.push_back(static_cast<float>(x) / 512.0f);
            p.y.push_back(static_cast<float>(y) / 512.0f);
            p.z.push_back(1.0f);
        }
    std::vector<float> expected(p.x.size()), made(p.x.size());
    gnomon::receive(map.view(), p.x, p.y, p.z, expected, {.caster = gnomon::unbiased});
    for_each_isa([&]<typename Isa>() {
        gnomon::receive(simd<Isa>{}, map.view(), p.x, p.y, p.z, made, {.caster = gnomon::unbiased});
        CHECK(expected == made);
    });
}

TEST_CASE_TEMPLATE("the least mask that a blend can have is an intensity, for depths in codes too", Texel, rg8, rg16) {
    image<Texel> map({3, 3}, Texel::clear());
    map(1, 1) = {{1, 1}};
    const std::vector<float> at(8, 0.5f + 1.0f / 256);
    const std::vector<std::uint16_t> deepest(at.size(), 65535);
    std::vector<float> made(at.size());
    for_each_isa([&]<typename Isa>() {
        gnomon::receive(simd<Isa>{}, map.view(), at, at, deepest, made, {.caster = gnomon::unbiased});
        CHECK(made == std::vector<float>(at.size(), 1.0f / (Texel::channel_type::scale * 65536)));
    });
}

TEST_CASE_TEMPLATE(
    "a receiver that its bias moves behind every caster is shadowed by those on the far plane, for depths in codes too", Texel, rg8,
    rg16) {
    const image<Texel> map({3, 3}, Texel::caster(1.0f));
    const std::vector<float> at(64, 1.5f);
    const std::vector<std::uint16_t> deepest(at.size(), 65535);
    std::vector<float> made(at.size());
    for_each_isa([&]<typename Isa>() {
        gnomon::receive(simd<Isa>{}, map.view(), at, at, deepest, made,
                        {.caster = {.roundings = 1, .depth = -0.001f, .caster_is_code = true}});
        CHECK(made == std::vector<float>(at.size(), 1.0f));
    });
}

TEST_CASE_TEMPLATE(
    "receivers anywhere: every width to 67 and some beyond, any stride, in place, and on a map whose rows go upwards", Texel, rg8,
    rg16, rg16f, rg32f) {
    dice roll(433);
    const image<Texel> map = test::noise<Texel>(roll, {40, 30}, 2);
    const image_view<const Texel> upwards(map.view().row(29), {40, 30}, -map.view().stride());
    const points p = some_points(roll, map, 1800);
    const auto spread_over = [](auto* memory, int count, int spread) {
        using T = std::remove_pointer_t<decltype(memory)>;
        return strided_span<T>(memory, count, static_cast<std::ptrdiff_t>(sizeof(T)) * spread);
    };
    for_each_isa([&]<typename Isa>() {
        int wrong = 0;
        for (int count = 0; count < 600; count += count < 67 ? 1 : 63) // copied by 256
            for (const auto& [of_x, of_y, of_z, of_intensity] :
                 {std::array{1, 1, 1, 1}, {2, 1, 1, 1}, {1, 3, 1, 1}, {1, 1, 2, 1}, {1, 1, 1, 2}, {3, 3, 3, 3}}) {
                const auto x = spread_over(p.x.data() + 1, count, of_x), y = spread_over(p.y.data(), count, of_y),
                           z = spread_over(p.z.data(), count, of_z);
                std::vector<float> expected(1800, -7.0f), made = expected;
                gnomon::receive(upwards, x, y, z, spread_over(expected.data(), count, of_intensity));
                gnomon::receive(simd<Isa>{}, upwards, x, y, z, spread_over(made.data(), count, of_intensity));
                wrong += expected != made;
                for (int which = 0; which < 3; ++which) {
                    if (of_intensity > 1 || (which == 0 ? of_x : which == 1 ? of_y : of_z) > 1) continue;
                    const float* const from = &(which == 0 ? x : which == 1 ? y : z)[0];
                    std::vector<float> in_place(from, from + count);
                    const auto own = spread_over(std::as_const(in_place).data(), count, 1);
                    gnomon::receive(simd<Isa>{}, upwards, which == 0 ? own : x, which == 1 ? own : y, which == 2 ? own : z,
                                    spread_over(in_place.data(), count, 1));
                    wrong += !std::equal(in_place.begin(), in_place.end(), expected.begin());
                }
            }
        CHECK(wrong == 0);
    });
}

TEST_CASE("receivers anywhere on maps of more texels a side than lanes count are decided as by the oracle") {
    dice roll(435);
    constexpr int most = 1 << 21, many = 1 << 22 | 9;
    std::vector<rg8> memory(2 * many);
    for (const int last : {most, many})
        for (int i = 2 * last - 18; i < 2 * last; ++i) memory[static_cast<std::size_t>(i)] = test::any_caster<rg8>(roll);
    const auto near_end = [](int size) { // from nine texels before it to two beyond, by halves, which floats still tell
        std::vector<float> at;
        for (int i = -18; i <= 4; ++i) at.push_back(static_cast<float>(size) + static_cast<float>(i) * 0.5f);
        return at;
    };
    const auto decided_as_by_the_oracle = [](image_view<const rg8> map, const std::vector<float>& x, const std::vector<float>& y) {
        const std::vector<float> z(x.size(), 0.9f);
        std::vector<float> expected(x.size()), made(x.size());
        gnomon::receive(map, x, y, z, expected);
        int wrong = 0;
        for_each_isa([&]<typename Isa>() {
            gnomon::receive(simd<Isa>{}, map, x, y, z, made);
            wrong += expected != made;
        });
        return wrong == 0 && std::any_of(expected.begin(), expected.end(), [](float dark) { return dark > 0.0f; });
    };
    for (const int size : {most, many}) {
        const std::vector<float> along = near_end(size), across(along.size(), 0.75f);
        CHECK(decided_as_by_the_oracle({memory.data(), {size, 2}}, along, across));
        CHECK(decided_as_by_the_oracle({memory.data(), {2, size}}, across, along));
    }
}

TEST_CASE("lanes blend on maps of 2 to 2^21 texels a side whose offsets fit 32 bits, for rules of 128 roundings") {
    const std::tuple<rg8, rg16> memory; // that of offsets beyond 32 bits is not to be had, and none is read
    const auto serves_on = [&memory]<typename Texel>(Texel, extent size, std::ptrdiff_t stride, int roundings) {
        return gnomon::detail::blended_on<Texel>({&std::get<Texel>(memory), size, stride}, {.caster = {.roundings = roundings}});
    };
    const auto serves = [&](extent size, std::ptrdiff_t stride, int roundings = 1) {
        return serves_on(rg8{}, size, stride, roundings);
    };
    constexpr int most = 1 << 21;
    for (const int sign : {1, -1}) {
        CHECK((serves_on(rg16{}, {2, 4}, sign * 0x1FFFFFFC, 1) && !serves_on(rg16{}, {2, 4}, sign * 0x20000000, 1)));
        CHECK((serves_on(rg16{}, {most, 2048}, sign * 0xFEFFC, 1) && !serves_on(rg16{}, {most, 2048}, sign * 0xFF000, 1)));
        CHECK((serves_on(rg16{}, {2, 2}, sign * 8, 128) && !serves_on(rg16{}, {2, 2}, sign * 8, 129)));
        CHECK((serves({2, 4}, sign * 0x1FFFFFFE) && !serves({2, 4}, sign * 0x1FFFFFFF)));
        CHECK((serves({2, 3}, sign * 0x2AAAAAA9) && !serves({2, 3}, sign * 0x2AAAAAAA)));       // the first is all there is
        CHECK((serves({most, 2048}, sign * 0xFF7FF) && !serves({most, 2048}, sign * 0xFF800))); // rows that overlap
        CHECK((serves({2, 2}, sign * 4) && !serves({1, 2}, sign * 4) && !serves({2, 1}, sign * 4)));
        CHECK((serves({most, 2}, sign * 4) && !serves({most + 1, 2}, sign * 4)));
        CHECK((serves({2, most}, sign * 4) && !serves({2, most + 1}, sign * 4)));
        CHECK((serves({2, 2}, sign * 4, 0) && serves({2, 2}, sign * 4, 128) && !serves({2, 2}, sign * 4, 129)));
    }
}

namespace {
using lanes = gnomon::emulated<16>;

/// Do floats tell of m (z - s) = beyond, in codes, for a receiver at half of the depth?
template <typename Texel, typename Depth> bool told(double mask, double beyond, gnomon::bias bias) {
    using blending = typename gnomon::on_any::blended_decision<lanes, Texel, Depth, float>::blending;
    using number = decltype(typename blending::pair{}.m);
    bias.caster_is_code = true; // and the receiver stays where it is
    const double moved = bias.towards == gnomon::bias_towards::light ? 0.75 * bias.roundings : 0.0;
    const auto by = gnomon::on_any::blend_rule<lanes>::of<Texel, Depth>({.caster = bias});
    const auto code = [](double codes) {
        if constexpr (std::is_same_v<number, lanes::floats>)
            return lanes::repeat(static_cast<float>(codes * 65536.0));
        else
            return lanes::repeat32(static_cast<std::uint32_t>(codes * 65536.0));
    };
    const typename blending::pair blended{code(mask / 2 + moved - beyond), code(mask)};
    const Depth middle = std::is_same_v<Depth, float> ? Depth(0.5f) : Depth(32768); // a code's is half a code beyond
    const std::array half{middle, middle, middle, middle};
    lanes::masks shadowed{};
    return blending::decided(by, blended, half.data(), shadowed);
}
template <typename Texel> void told_from(double doubt, double mask, gnomon::bias bias) {
    for (const double sign : {-1.0, 1.0}) {
        CHECK_FALSE(told<Texel, float>(mask, sign * doubt / 2, bias));
        CHECK(told<Texel, float>(mask, sign * doubt * 2, bias));
    }
}
/// Of a 65536th of a code under nothing, for a receiver so near to the far plane.
bool told_of_least_mask(float beyond) {
    using blending = gnomon::on_any::blended_decision<lanes, rg16, float, float>::blending;
    const float z = 1.0f - beyond;
    const std::array depths{z, z, z, z};
    lanes::masks shadowed{};
    return blending::decided(gnomon::on_any::blend_rule<lanes>::of<rg16, float>({.caster = gnomon::unbiased}),
                             {lanes::repeat32(0), lanes::repeat32(1)}, depths.data(), shadowed);
}
} // namespace

TEST_CASE("a blend is decided but nearest nothing: words within 2^-32 of a code, bytes that more than one rounding moves within an "
          "8192nd, and always against depths in codes") {
    for (const double mask : {65535.0, 4097.0, 2.0}) {
        CHECK_FALSE(told<rg16, float>(mask, 0.0, gnomon::unbiased));
        for (const double sign : {-1.0, 1.0}) CHECK(told<rg16, float>(mask, sign * 0x1p-16, gnomon::unbiased));
        CHECK(told<rg16, std::uint16_t>(mask, mask / 131070.0, gnomon::unbiased));
    }
    CHECK((told_of_least_mask(0x1.2p-16f) && !told_of_least_mask(0x1.ep-17f)));
    for (const double mask : {255.0, 16.0, 2.0}) {
        told_from<rg8>(0x1p-13, mask, {.roundings = 2});
        CHECK(told<rg8, float>(mask, 0.0, {.roundings = 1}));
        CHECK(told<rg8, float>(mask, 0.0, {.towards = gnomon::bias_towards::none, .roundings = 2}));
        CHECK(told<rg8, std::uint16_t>(mask, mask / 131070.0, gnomon::unbiased));
    }
}

TEST_CASE_TEMPLATE("blends of whole codes are decided as by the oracle at the codes of depth where their shadow begins", Texel, rg8,
                   rg16) {
    using code = typename Texel::storage;
    dice roll(442);
    const std::vector<float> middle(64, 1.0f);
    std::vector<float> expected(64), made(64);
    for (const int roundings : {0, 1, 2, 127, 128})
        for (const auto towards : {gnomon::bias_towards::light, gnomon::bias_towards::none, gnomon::bias_towards::shadow})
            for (int i = 0; i < 100; ++i) {
                const rule r{.caster = {.towards = towards, .roundings = roundings}};
                const int mask = roll(1, std::numeric_limits<code>::max() >> roll(0, 7)), depth = roll(0, mask);
                const image<Texel> map({2, 2}, {{static_cast<code>(depth), static_cast<code>(mask)}});
                const float begins = test::first_shadowed(map(0, 0), r);
                const int first = gnomon::unorm16::encode(static_cast<double>(gnomon::lesser(begins, 1.0f)));
                std::vector<std::uint16_t> z(64);
                for (std::uint16_t& each : z) each = static_cast<std::uint16_t>(std::clamp(first + roll(-2, 2), 0, 65535));
                gnomon::receive(map.view(), middle, middle, z, expected, r);
                for_each_isa([&]<typename Isa>() {
                    gnomon::receive(simd<Isa>{}, map.view(), middle, middle, z, made, r);
                    CHECK(expected == made);
                });
            }
}

TEST_CASE_TEMPLATE("a blend of half and float is decided in lanes, for float intensities, unless it is none", Texel, rg16f, rg32f) {
    using blending = gnomon::on_any::number_blend<lanes, Texel, float>;
    const rule plain; // which a decision only points to
    const auto by = blending::moving::template of<Texel, float>(plain);
    const std::array z{0.25f, 0.75f, 0.25f, 0.75f};
    lanes::masks shadowed{};
    CHECK(blending::decided(by, {lanes::repeat(0.25f), lanes::repeat(0.5f)}, z.data(), shadowed));
    std::array<float, 4> made{};
    lanes::store(made.data(), lanes::keep(shadowed, lanes::repeat(1.0f)));
    CHECK(made == std::array{0.0f, 1.0f, 0.0f, 1.0f});
    CHECK_FALSE(blending::decided(by, {lanes::repeat(test::nan<float>), lanes::repeat(0.5f)}, z.data(), shadowed));
    CHECK_FALSE(blending::decided(by, {lanes::repeat(0.25f), lanes::repeat(test::nan<float>)}, z.data(), shadowed));
}

TEST_CASE("a blend of floats is summed in the oracle's order, which shows where a sum lies between two floats") {
    constexpr rg32f half_a_place{{0.0f, 0x1p-24f}}, too_little{{0.0f, 0x1.8p-54f}}; // to count, but two of it together
    const std::array texels{rg32f{{0.0f, 1.0f}}, half_a_place, too_little, too_little};
    const image_view<const rg32f> map(texels.data(), {2, 2}, 2 * sizeof(rg32f));
    const std::vector<float> middle(16, 1.0f), deep(16, 2.0f);
    std::vector<float> made(16);
    for_each_isa([&]<typename Isa>() {
        gnomon::receive(simd<Isa>{}, map, middle, middle, deep, made);
        CHECK(made == std::vector<float>(16, 0.25f));
    });
    gnomon::receive(map, middle, middle, deep, made);
    CHECK(made == std::vector<float>(16, 0.25f));
}

TEST_CASE("results of receivers anywhere are called for ahead of time, each register's once") {
    const image<rg8> map({4, 4}, rg8::caster(0.5f));
    const std::vector<float> where(40, 1.5f);
    std::vector<float> made(40);
    test::counted_lanes::forget();
    gnomon::receive(simd<test::counted_lanes>{}, map.view(), where, where, where, made);
    CHECK(test::counted_lanes::prefetches == 40 / test::counted_lanes::float_lanes);
}

TEST_CASE("receivers anywhere: the shortest span counts in lanes too") {
    dice roll(435);
    const image<rg8> map = test::noise<rg8>(roll, {40, 30}, 2);
    const points p = some_points(roll, map, 200);
    for (int shortest = 0; shortest < 4; ++shortest) {
        const auto first = [shortest](auto& all, int index) { return strided_span(all.data(), index == shortest ? 99 : 200); };
        const auto x = first(p.x, 0), y = first(p.y, 1), z = first(p.z, 2);
        std::vector<float> expected(p.z.size(), -7.0f);
        const std::vector<float> before = expected;
        gnomon::receive(map.view(), x, y, z, first(expected, 3));
        CHECK(expected[99] == -7.0f);
        for_each_isa([&]<typename Isa>() {
            std::vector<float> made = before;
            gnomon::receive(simd<Isa>{}, map.view(), x, y, z, first(made, 3));
            CHECK(made == expected);
        });
    }
}

TEST_CASE_TEMPLATE("lanes read nothing beside the map: its memory ends where its last texel does", Texel, rg8, rg16, rg16f, rg32f) {
    dice roll(434);
    for (const extent size : {extent{2, 2}, {5, 3}, {64, 2}, {2, 9}}) { // the address sanitizer watches; so do the bits, without it
        const auto memory = std::make_unique<Texel[]>(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
        const image_view<Texel> map(memory.get(), size);
        test::for_each_texel(whole(size), [&](int x, int y) { map(x, y) = test::any_caster<Texel>(roll); });
        points p; // whole registers of neighbours, among them some within a texel of each border
        for (float y = -1.0f; y < static_cast<float>(size.height + 1); y += 0.11f)
            for (float x = -1.0f; x < static_cast<float>(size.width + 1); x += 1.0f / 64) {
                p.x.push_back(x);
                p.y.push_back(y);
                p.z.push_back(1.0f);
            }
        std::vector<float> expected(p.x.size()), made(p.x.size());
        gnomon::receive(map, p.x, p.y, p.z, expected);
        for_each_isa([&]<typename Isa>() {
            gnomon::receive(simd<Isa>{}, map, p.x, p.y, p.z, made);
            CHECK(expected == made);
        });
    }
}
