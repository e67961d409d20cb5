// The lanes against the oracle, bit for bit: every target this processor has, every width up to two registers and a bit, every
// alignment, regions in the middle of something, and floats that are none.
#include <gnomon/backend/simd.hpp>

#include "../support/bits.hpp"
#include "../support/filtering.hpp"
#include "../support/formats.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

namespace {
using gnomon::binomial;
using gnomon::box;
using gnomon::cpu_level;
using gnomon::emulated;
using gnomon::extent;
using gnomon::filter_scratch;
using gnomon::gaussian;
using gnomon::image;
using gnomon::image_view;
using gnomon::rg8;
using gnomon::simd;
using gnomon::tent;
using gnomon::texel_rect;
using test::dice;
using test::for_each_texel;

/// Calls f.template operator()<Isa>() for all that this processor can run.
template <typename F> void for_each_isa(F&& f) {
    f.template operator()<gnomon::best_isa>();
    f.template operator()<emulated<48>>();
#if GNOMON_X86
    f.template operator()<gnomon::sse2>();
    if (gnomon::best_lanes() >= cpu_level::avx2) f.template operator()<gnomon::avx2>();
    if (gnomon::best_lanes() >= cpu_level::avx512) f.template operator()<gnomon::avx512>();
#endif
}

/// The same bits, or numbers that are both none.
template <typename Texel> bool same_texel(const Texel& a, const Texel& b) {
    for (int c = 0; c < Texel::channels; ++c) {
        const float x = Texel::channel_type::code(a.stored[c]), y = Texel::channel_type::code(b.stored[c]);
        if (std::memcmp(&a.stored[c], &b.stored[c], sizeof a.stored[c]) != 0 && !(std::isnan(x) && std::isnan(y))) return false;
    }
    return true;
}

/// Filters a part of an image both ways, into memory that holds something else, and counts what differs anywhere.
template <typename Isa, gnomon::kernel Kernel, typename Texel> int differing(image_view<const Texel> from, texel_rect region) {
    image<Texel> expected(from.size(), Texel::caster(0.25f)), made(from.size(), Texel::caster(0.25f));
    filter_scratch<Texel, Kernel> scratch(from.size().width);
    gnomon::filter_region(from, expected.view(), region, scratch);
    simd<Isa>{}.filter_region(from, made.view(), region, scratch);
    int n = 0;
    for_each_texel(whole(from.size()), [&](int x, int y) { n += !same_texel(expected(x, y), made(x, y)); });
    return n;
}

struct own_channel : gnomon::unorm16 {}; // lanes cannot know what a user's channel does

/// Any bits at all, so for half and float infinities, NaN and numbers beyond [0, 1] too.
template <typename Texel> void fill_with_bits(dice& roll, image_view<Texel> to) {
    for_each_texel(whole(to.size()), [&](int x, int y) {
        for (auto& stored : to(x, y).stored) {
            std::uint32_t bits = static_cast<std::uint32_t>(roll(0, 65535));
            bits = bits << 16 | static_cast<std::uint32_t>(roll(0, 65535));
            std::memcpy(&stored, &bits, sizeof stored);
        }
    });
}
} // namespace

TEST_CASE_TEMPLATE("lanes filter as the oracle does, for every width to 67 and at every alignment", Texel, rg8, gnomon::rg16,
                   gnomon::rgb16f, gnomon::rg32f) {
    dice roll(401);
    constexpr int alignments = 16, widest = 67, height = 6;
    image<Texel> memory({widest + alignments, height});
    fill_with_bits(roll, memory.view());
    for_each_isa([&]<typename Isa>() {
        int wrong = 0;
        for (int width = 0; width <= widest; ++width)
            for (int offset = 0; offset < alignments; offset += width % 5 == 0 ? 1 : 5) {
                const image_view<const Texel> part(&memory(offset, 0), {width, height}, memory.view().stride());
                wrong += differing<Isa, binomial<2>>(part, whole(part.size()));
            }
        CHECK(wrong == 0);
    });
}

TEST_CASE_TEMPLATE("lanes filter as the oracle does, for every shape of kernel and any part of a map", Texel, rg8, gnomon::rgb8,
                   gnomon::rg16, gnomon::rg16f, test::paper8) {
    dice roll(402);
    image<Texel> map({1100, 23}, Texel::clear()); // wider than a strip
    for_each_texel({40, 0, 1100, 23}, [&](int x, int y) {
        if (!roll.one_in(3)) map(x, y) = test::any_caster<Texel>(roll);
    });
    for_each_isa([&]<typename Isa>() {
        test::for_each_kernel(test::kernels<box<0>, binomial<4>, tent<1>, gaussian<3>, gaussian<17>>{}, [&]<typename Kernel>() {
            CAPTURE(Kernel::radius);
            for (const texel_rect part : {whole(map.size()), texel_rect{7, 3, 8, 4}, texel_rect{1090, 9, 1100, 23},
                                          texel_rect{0, 0, 33, 1}, texel_rect{500, 2, 590, 21}, texel_rect{5, 5, 5, 9}})
                CHECK(differing<Isa, Kernel>(image_view<const Texel>(map.view()), part) == 0);
        });
    });
}

TEST_CASE("a region partly or wholly off the map is to lanes what it is to the oracle") {
    const image<rg8> map({40, 5}, rg8::caster(0.5f));
    CHECK(differing<gnomon::best_isa, binomial<2>>(map.view(), {-9, -9, 90, 90}) == 0);
    CHECK(differing<gnomon::best_isa, binomial<2>>(map.view(), {90, 90, 95, 95}) == 0);
}

TEST_CASE_TEMPLATE("what lanes do not know is left to the oracle: a ratio of two sums, a channel of a user's, radii beyond 256",
                   Texel, gnomon::tm8, gnomon::texel<own_channel>, rg8) {
    dice roll(403);
    const image<Texel> map = test::noise<Texel>(roll, {70, 9}, 2);
    CHECK(differing<gnomon::best_isa, gaussian<3>>(map.view(), whole(map.size())) == 0);
    CHECK(differing<gnomon::best_isa, box<300>>(map.view(), whole(map.size())) == 0);
    const std::vector<float> z(70, 0.75f);
    std::vector<float> expected(70), made(70);
    gnomon::receive(map.view().row_span(4), z, expected);
    gnomon::receive(simd<>{}, map.view().row_span(4), z, made);
    CHECK(expected == made);
}

TEST_CASE("bytes with weights of eight bits go by whole numbers, all else by doubles") {
    using gnomon::on_any::byte_filter;
    using gnomon::on_any::filter_of;
    using lanes = emulated<16>;
    CHECK(std::same_as<filter_of<lanes, binomial<4>, rg8>, byte_filter<lanes, binomial<4>, rg8>>);
    CHECK(std::same_as<filter_of<lanes, tent<1>, rg8>, byte_filter<lanes, tent<1>, rg8>>);
    CHECK_FALSE(std::same_as<filter_of<lanes, box<1>, rg8>, byte_filter<lanes, box<1>, rg8>>);           // 1/9
    CHECK_FALSE(std::same_as<filter_of<lanes, gaussian<2>, rg8>, byte_filter<lanes, gaussian<2>, rg8>>); // sixteen bits
    CHECK_FALSE(std::same_as<filter_of<lanes, box<0>, rg8>, byte_filter<lanes, box<0>, rg8>>);           // 256 is no byte
    CHECK_FALSE(std::same_as<filter_of<lanes, binomial<1>, gnomon::rgb8>, byte_filter<lanes, binomial<1>, gnomon::rgb8>>);
    CHECK_FALSE(std::same_as<filter_of<lanes, binomial<1>, gnomon::rg16>, byte_filter<lanes, binomial<1>, gnomon::rg16>>);
}

TEST_CASE_TEMPLATE("lanes decide as the oracle does: every width to 67, any stride, any rule, and depths that are none", Texel, rg8,
                   gnomon::rg16, gnomon::rga8, gnomon::rga16, gnomon::rg32f, test::paper8, gnomon::rgb8) {
    dice roll(404);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const float odd_depths[] = {0.0f,      -0.0f,     1.0f,     0.5f,      std::nextafter(0.5f, 0.0f),
                                -1.0f,     2.0f,      infinity, -infinity, std::numeric_limits<float>::quiet_NaN(),
                                0x1p-126f, 0x1p-149f, 3e38f};
    std::vector<gnomon::rule> rules{{}, {.caster = gnomon::unbiased}, {.caster = gnomon::towards_shadow}, {.lit_beyond = true}};
    rules.push_back({.caster = {.roundings = 1000, .depth = 0.125f}});
    rules.push_back({.caster = {.caster_is_code = true}});
    for_each_isa([&]<typename Isa>() {
        int wrong = 0, dark = 0;
        for (int count = 0; count <= 67; ++count)
            for (const int spread : {1, 3}) {
                const auto size = static_cast<std::size_t>(count * spread + 1);
                std::vector<Texel> texels(size);
                std::vector<float> z(size), expected(size, -1.0f), made(size, -1.0f);
                fill_with_bits(roll, image_view<Texel>(texels.data(), {static_cast<int>(size), 1}));
                for (std::size_t i = 0; i < size; ++i) {
                    if (!roll.one_in(3)) texels[i] = test::any_caster<Texel>(roll);
                    z[i] = roll.one_in(4) ? odd_depths[roll(0, 12)] : roll.unit();
                    if (roll.one_in(2)) z[i] = gnomon::caster_depth(texels[i]) + static_cast<float>(roll(-2, 2)) * 0x1p-24f;
                }
                const auto spread_over = [&](auto& memory) {
                    using T = std::remove_reference_t<decltype(memory[0])>;
                    return gnomon::strided_span<T>(memory.data(), count, static_cast<std::ptrdiff_t>(sizeof(T)) * spread);
                };
                const auto& constant_texels = texels;
                const auto& constant_z = z;
                for (const gnomon::rule& r : rules) {
                    gnomon::receive(spread_over(constant_texels), spread_over(constant_z), spread_over(expected), r);
                    simd<Isa>{}.receive(spread_over(constant_texels), spread_over(constant_z), spread_over(made), r);
                    wrong += std::memcmp(expected.data(), made.data(), size * sizeof(float)) != 0;
                    for (const float intensity : made) dark += intensity > 0.0f;
                }
            }
        CHECK(wrong == 0);
        CHECK(dark > 1000);
    });
}

TEST_CASE_TEMPLATE(
    "lanes decide exactly: every pair of bytes at the threshold, one float before and one after, and at the least depth there is",
    Texel, rg8) {
    std::vector<Texel> texels;
    std::vector<float> z;
    for (int mask = 0; mask < 256; ++mask)
        for (int depth = 0; depth < 256; ++depth) {
            const Texel t{{static_cast<std::uint8_t>(depth), static_cast<std::uint8_t>(mask)}};
            const float s = gnomon::caster_depth(t);
            for (const float at : {std::nextafter(s, -1.0f), s, std::nextafter(s, 2.0f), 0x1p-149f}) {
                texels.push_back(t);
                z.push_back(at);
            }
        }
    std::vector<float> expected(z.size()), made(z.size());
    const gnomon::bias least{.towards = gnomon::bias_towards::shadow,
                             .caster_is_code = true}; // (0, 1) becomes (1/2, 1/2), and s nothing
    for (const gnomon::bias& towards : {gnomon::unbiased, gnomon::towards_light, gnomon::towards_shadow, least}) {
        gnomon::receive(texels, z, expected, {.caster = towards});
        for_each_isa([&]<typename Isa>() {
            simd<Isa>{}.receive(gnomon::strided_span<const Texel>(texels), gnomon::strided_span<const float>(z),
                                gnomon::strided_span<float>(made), {.caster = towards});
            CHECK(expected == made);
        });
    }
}
