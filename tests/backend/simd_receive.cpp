// Decisions in lanes against the oracle, bit for bit: every width up to two registers and a bit, any stride, any rule, depths that are
// none; and for bytes every pair there is, at its threshold.
#include <gnomon/backend/simd.hpp>
#include <gnomon/backend/simd_decision.hpp>
#include <gnomon/backend/simd_receive.hpp>
#include <gnomon/soft_shadow_map.hpp>

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
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace {
using gnomon::image_view;
using gnomon::rg8;
using gnomon::simd;
using test::dice;
using test::fill_with_bits;
using test::for_each_isa;
} // namespace

TEST_CASE_TEMPLATE(
    "lanes decide as the oracle does: every width to 67 and some beyond, any stride, any rule, and depths that are none", Texel,
    rg8, gnomon::rg16, gnomon::rga8, gnomon::rga16, gnomon::rg32f, gnomon::rga16f, gnomon::rga32f, gnomon::rgb8) {
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
        for (int count = 0; count < 600; count += count < 67 ? 1 : 63) // copied by 64
            for (const auto& [of_texels, of_z, of_intensity] : {std::array{1, 1, 1}, {3, 1, 1}, {1, 3, 1}, {1, 1, 2}, {2, 3, 2}}) {
                const auto size = static_cast<std::size_t>(3 * count + 1);
                std::vector<Texel> texels(size);
                std::vector<float> z(size), expected(size, -1.0f), made(size, -1.0f);
                fill_with_bits(roll, image_view<Texel>(texels.data(), {static_cast<int>(size), 1}));
                for (std::size_t i = 0; i < size; ++i) {
                    if (!roll.one_in(3)) texels[i] = test::any_caster<Texel>(roll);
                    z[i] = roll.one_in(4) ? odd_depths[roll(0, 12)] : roll.unit();
                    if (roll.one_in(2)) z[i] = gnomon::caster_depth(texels[i]) + static_cast<float>(roll(-2, 2)) * 0x1p-24f;
                }
                const auto spread_over = [&](auto& memory, int spread) {
                    using T = std::remove_reference_t<decltype(memory[0])>;
                    return gnomon::strided_span<T>(memory.data(), count, static_cast<std::ptrdiff_t>(sizeof(T)) * spread);
                };
                const auto& constant_texels = texels;
                const auto& constant_z = z;
                for (const gnomon::rule& r : rules) {
                    gnomon::receive(spread_over(constant_texels, of_texels), spread_over(constant_z, of_z),
                                    spread_over(expected, of_intensity), r);
                    simd<Isa>{}.receive(spread_over(constant_texels, of_texels), spread_over(constant_z, of_z),
                                        spread_over(made, of_intensity), r);
                    wrong += std::memcmp(expected.data(), made.data(), size * sizeof(float)) != 0;
                    for (const float intensity : made) dark += intensity > 0.0f;
                }
            }
        CHECK(wrong == 0);
        CHECK(dark > 1000);
    });
}

TEST_CASE_TEMPLATE("lanes decide as the oracle does at every alignment, in floats and in codes", Texel, rg8, gnomon::rg16,
                   gnomon::rga8, gnomon::rg16f, gnomon::rg32f) {
    dice roll(406);
    const auto wrong_in = [&roll]<typename Isa, typename Depth, typename Intensity>(int count, int bytes) {
        test::past_a_line<Texel> of_texels(bytes, count);
        test::past_a_line<Depth> of_z((3 * bytes + count) % 64, count);
        test::past_a_line<Intensity> of_made((5 * bytes + 2 * count) % 64, count);
        const auto texels = of_texels.elements();
        const auto z = of_z.elements();
        const auto made = of_made.elements();
        std::vector<Intensity> expected(made.size());
        for (std::size_t i = 0; i < z.size(); ++i) {
            texels[i] = test::any_caster<Texel>(roll);
            if constexpr (std::same_as<Depth, float>)
                z[i] = roll.unit();
            else
                z[i] = static_cast<Depth>(roll(0, 65535));
        }
        gnomon::receive(texels, z, expected);
        gnomon::receive(simd<Isa>{}, texels, z, made);
        const bool same = std::equal(expected.begin(), expected.end(), made.begin());
        return int{!same} + int{!of_made.is_alone()};
    };
    for_each_isa([&]<typename Isa>() {
        int wrong = 0;
        test::for_each_alignment([&](int count, int bytes) {
            wrong += wrong_in.template operator()<Isa, float, float>(count, bytes) +
                     wrong_in.template operator()<Isa, std::uint16_t, std::uint8_t>(count, bytes) +
                     wrong_in.template operator()<Isa, std::uint16_t, std::uint16_t>(count, bytes) +
                     wrong_in.template operator()<Isa, float, std::uint8_t>(count, bytes);
        });
        CHECK(wrong == 0);
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

TEST_CASE_TEMPLATE("lanes decide floats and halves exactly: at the float where a shadow begins, one before and one after, and the "
                   "smallest masks and depths",
                   Texel, gnomon::rg32f, gnomon::rg16f) {
    dice roll(405);
    const gnomon::rule rules[] = {{},
                                  {.caster = gnomon::unbiased},
                                  {.caster = gnomon::towards_shadow},
                                  {.caster = {.caster_is_code = true}},
                                  {.caster = {.roundings = 0, .caster_is_code = true}},
                                  {.caster = {.depth = 1.5f}}};
    for (const gnomon::rule& r : rules) {
        std::vector<Texel> texels;
        std::vector<float> z;
        for (int i = 0; i < 3000; ++i) {
            // Masks down to nothing; depths that are nothing, all of the mask, or a share or some of it, of few or many bits.
            const float mask = std::ldexp(0.5f + roll.unit() / 2.0f, roll.one_in(2) ? -roll(0, 3) : -roll(0, 149));
            float share = roll.one_in(4) ? static_cast<float>(roll(0, 1))
                                         : (roll.one_in(2) ? roll.unit() : static_cast<float>(roll(0, 16)) / 16.0f);
            if (roll.one_in(4)) share *= 4.0f; // no caster, but what a texel may hold
            constexpr float place = std::same_as<Texel, gnomon::rg32f> ? 0x1p-23f : 0x1p-10f;
            if (roll.one_in(4)) share = 1.0f + static_cast<float>(roll(0, 16)) * place; // some bias makes the two one
            Texel t{};
            t.stored[1] = Texel::channel_type::encode(static_cast<double>(mask));
            t.stored[0] = Texel::channel_type::encode(static_cast<double>(Texel::channel_type::code(t.stored[1])) *
                                                      static_cast<double>(share));
            const float s = test::first_shadowed(t, r);
            for (const float at :
                 {std::nextafter(s, -1.0f), s, std::nextafter(s, 20.0f), 0x1p-149f, 0x1p-60f, 1.0f, std::nextafter(1.0f, 0.0f)}) {
                texels.push_back(t);
                z.push_back(at);
            }
        }
        std::vector<float> expected(z.size()), made(z.size());
        gnomon::receive(texels, z, expected, r);
        for_each_isa([&]<typename Isa>() {
            gnomon::receive(simd<Isa>{}, texels, z, made, r);
            CHECK(expected == made);
        });
    }
}

TEST_CASE("simd<> has lanes on the processors that gnomon knows lanes of, and named lanes are there on all") {
    static_assert(gnomon::detail::has_lanes<gnomon::best_isa> == (GNOMON_X86 != 0 || GNOMON_NEON != 0 || GNOMON_WASM != 0));
    static_assert(gnomon::detail::has_lanes<gnomon::emulated<16>>);
}

TEST_CASE("of no receivers nothing is read: spans may be of nothing") {
    const gnomon::strided_span<const rg8> texels;
    const gnomon::strided_span<const float> in;
    const gnomon::strided_span<float> out;
    const gnomon::image<rg8> map({4, 4}, rg8::clear());
    for_each_isa([&]<typename Isa>() {
        simd<Isa>{}.receive(texels, in, out, {});
        simd<Isa>{}.receive(map.view(), in, in, in, out, {});
    });
}

namespace {
/// Does a register of a lit and a shadowed receiver in turn, far from where either ends, leave the answer to lanes?
template <typename Texel, typename Depth> bool told_by_lanes(const gnomon::rule& r) {
    using by = gnomon::on_any::decision<gnomon::emulated<32>, Texel, Depth, float>;
    std::array<Texel, by::step> texels;
    std::array<Depth, by::step> depths;
    std::array<float, by::step> made;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        texels[i] = Texel::caster(0.5f);
        const float z = i % 2 == 0 ? 0.25f : 0.75f;
        depths[i] = std::same_as<Depth, float> ? static_cast<Depth>(z) : static_cast<Depth>(z * 65535.0f);
    }
    return by::one(by::of(r), texels[0].stored, depths.data(), made.data()) && made[0] < 0.5f && made[1] > 0.5f;
}
} // namespace

TEST_CASE_TEMPLATE("lanes tell of what is ordinary, and leave it to no loop of texels", Texel, rg8, gnomon::rg16, gnomon::rg16f,
                   gnomon::rg32f) {
    for (const auto towards : {gnomon::bias_towards::light, gnomon::bias_towards::shadow, gnomon::bias_towards::none}) {
        const gnomon::rule r{.caster = {.towards = towards}};
        CHECK(told_by_lanes<Texel, float>(r));
        CHECK(told_by_lanes<Texel, std::uint16_t>(r));
        const std::vector<Texel> casters(64, Texel::caster(0.5f));
        const std::vector<std::uint16_t> behind_all(64, 65535);
        std::vector<float> made(64);
        using by = gnomon::on_any::decision<gnomon::emulated<32>, Texel, std::uint16_t, float>;
        CHECK(by::one(by::of(r), casters[0].stored, behind_all.data(), made.data())); // moved beyond the range by some
    }
}

TEST_CASE_TEMPLATE("lanes tell of receivers that lie exactly on their caster, of whole codes, beside others that do not", Texel,
                   rg8, gnomon::rg16) {
    using by = gnomon::on_any::decision<gnomon::emulated<32>, Texel, std::uint16_t, float>;
    const std::vector<Texel> casters(8, Texel::caster(0.25f));
    const auto [e, m] = casters[0].stored;
    const auto on_it = static_cast<std::uint16_t>(65535 / m * (m - e));
    const auto before = static_cast<std::uint16_t>(on_it - 1), behind = static_cast<std::uint16_t>(on_it + 1);
    const std::array<std::uint16_t, 8> z{on_it, 0, on_it, 65535, before, on_it, behind, 30000};
    std::array<float, 8> made{};
    CHECK(by::one(by::of({.caster = gnomon::unbiased}), casters[0].stored, z.data(), made.data()));
    CHECK(made == std::array{0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f, 1.0f});
}

TEST_CASE_TEMPLATE(
    "lanes decide against depths in codes as the oracle does, however many roundings there were, of masks that their "
    "bias moves below nothing too, which are no loop's",
    Texel, rg8, gnomon::rg16, gnomon::rga8) {
    dice roll(408);
    for (const int roundings : {0, 1, 2, 4, 128, 1000})
        for (const auto towards : {gnomon::bias_towards::light, gnomon::bias_towards::none, gnomon::bias_towards::shadow}) {
            const gnomon::rule r{.caster = {.towards = towards, .roundings = roundings}};
            std::vector<Texel> texels(3000);
            std::vector<std::uint16_t> z(texels.size());
            for (std::size_t i = 0; i < texels.size(); ++i) {
                texels[i] = test::any_caster<Texel>(roll);
                if (roll.one_in(2)) texels[i].stored[1] = static_cast<typename Texel::storage>(roll(0, 3));
                if (texels[i].stored[0] > texels[i].stored[1]) texels[i].stored[0] = texels[i].stored[1];
                const float begins = gnomon::lesser(test::first_shadowed(texels[i], r), 1.0f);
                const int first = gnomon::unorm16::encode(static_cast<double>(begins));
                z[i] = static_cast<std::uint16_t>(roll.one_in(8) ? roll(0, 65535) : std::clamp(first + roll(-1, 1), 0, 65535));
            }
            const auto as_the_oracle = [&]<typename Intensity>(Intensity) {
                std::vector<Intensity> expected(z.size()), made(z.size());
                gnomon::receive(texels, z, expected, r);
                for_each_isa([&]<typename Isa>() {
                    gnomon::receive(simd<Isa>{}, texels, z, made, r);
                    CHECK(expected == made);
                });
            };
            as_the_oracle(float{});
            as_the_oracle(std::uint8_t{});
            as_the_oracle(std::uint16_t{});
        }
    using by = gnomon::on_any::decision<gnomon::emulated<32>, Texel, std::uint16_t, float>;
    std::array<Texel, 8> faint{};
    for (Texel& texel : faint) texel.stored[1] = 1;
    const std::array<std::uint16_t, 8> half{0x8000, 0x8000, 0x8000, 0x8000, 0x8000, 0x8000, 0x8000, 0x8000};
    std::array<float, 8> made{};
    CHECK(by::one(by::of({.caster = {.towards = gnomon::bias_towards::shadow, .roundings = 4}}), faint[0].stored, half.data(),
                  made.data()));
}

TEST_CASE("each register of receivers is answered once, by lanes") {
    const gnomon::image<rg8> map({64, 2}, rg8::caster(0.5f));
    const std::vector<float> z(64, 0.75f), at(64, 0.75f);
    const std::vector<std::uint16_t> codes(64, 0xC000);
    std::vector<float> made(64);
    const simd<test::counted_lanes> run;
    int& answers = test::counted_lanes::fractions;
    test::counted_lanes::forget();
    gnomon::receive(run, map.view().row_span(0), z, made);
    CHECK(std::exchange(answers, 0) == 64 / 4);
    gnomon::receive(run, map.view(), at, at, z, made);
    CHECK(std::exchange(answers, 0) == 64 / 4);
    gnomon::receive(run, map.view(), at, at, codes, made);
    CHECK(std::exchange(answers, 0) == 64 / 4);
}

namespace {
template <typename Texel, typename Depth, typename Intensity>
using chosen = gnomon::on_any::decision_for<gnomon::emulated<16>, Texel, Depth, Intensity>;
} // namespace

TEST_CASE(
    "pairs of codes against depths and intensities in codes are decided in whole numbers, a register of words by three loads") {
    using gnomon::rg16, gnomon::rga16, gnomon::on_any::word_decision;
    using code = std::uint16_t;
    using byte = std::uint8_t;
    static_assert(std::same_as<chosen<rg8, code, byte>, gnomon::on_any::byte_decision<gnomon::emulated<16>, rg8, byte>>);
    static_assert(std::same_as<chosen<rg8, code, float>, gnomon::on_any::byte_decision<gnomon::emulated<16>, rg8, float>>);
    static_assert(std::same_as<chosen<rg16, code, float>, word_decision<gnomon::emulated<16>, rg16, float>>);
    static_assert(std::same_as<chosen<rg16, code, code>, word_decision<gnomon::emulated<16>, rg16, code>>);
    static_assert(std::same_as<chosen<rg16, code, byte>, word_decision<gnomon::emulated<16>, rg16, byte>>);
    using gnomon::tm8, gnomon::tm16, gnomon::on_any::ratio_decision;
    static_assert(std::same_as<chosen<tm8, code, byte>, ratio_decision<gnomon::emulated<16>, tm8, byte>>);
    static_assert(std::same_as<chosen<tm8, code, code>, gnomon::on_any::decision<gnomon::emulated<16>, tm8, code, code>>);
    static_assert(std::same_as<chosen<tm16, code, byte>, ratio_decision<gnomon::emulated<16>, tm16, byte>>);
    static_assert(std::same_as<chosen<tm16, code, code>, ratio_decision<gnomon::emulated<16>, tm16, code>>);
    static_assert(std::same_as<chosen<tm16, code, float>, gnomon::on_any::decision<gnomon::emulated<16>, tm16, code, float>>);
    static_assert(std::same_as<chosen<rga16, code, code>, gnomon::on_any::decision<gnomon::emulated<16>, rga16, code, code>>);
    const gnomon::image<rg16> map({64, 1}, rg16::caster(0.5f));
    const std::vector<code> z(64, 0xC000);
    std::vector<code> made(64);
    test::counted_lanes::forget();
    gnomon::receive(simd<test::counted_lanes>{}, map.view().row_span(0), z, made);
    CHECK(std::exchange(test::counted_lanes::loads, 0) == 64 / 8 * 3);
    CHECK(made == std::vector<code>(64, 65535));
    std::vector<byte> bytes(64);
    gnomon::receive(simd<test::counted_lanes>{}, map.view().row_span(0), z, bytes);
    CHECK(test::counted_lanes::loads == 64 / 8 * 3);
    CHECK(bytes == std::vector<byte>(64, 255));
}

#if defined(GNOMON_TEST_IT_IS_THERE) // of lanes that are not there nothing is tested
TEST_CASE("the lanes that these tests are for are there") {
    CHECK(gnomon::best_lanes() >= gnomon::detail::level_needed<GNOMON_TEST_ONE_ISA>);
}
#endif

#if GNOMON_X86
TEST_CASE("simd<> goes by the lanes of the processor's level, and every level below is there to be chosen") {
    for (const gnomon::cpu_level level : {gnomon::cpu_level::sse2, gnomon::cpu_level::avx2, gnomon::cpu_level::avx512}) {
        const int bytes = gnomon::detail::with_lanes(level, []<typename Isa>() { return Isa::bytes; });
        CHECK(bytes == (level == gnomon::cpu_level::sse2 ? 16 : level == gnomon::cpu_level::avx2 ? 32 : 64));
    }
}
#elif GNOMON_NEON || GNOMON_WASM
TEST_CASE("where the build has lanes, simd<> goes by them without asking the processor") {
    const bool neon = GNOMON_NEON != 0;
    CHECK(gnomon::best_lanes() == (neon ? gnomon::cpu_level::neon : gnomon::cpu_level::wasm128));
    CHECK(
        gnomon::detail::with_lanes(gnomon::best_lanes(), []<typename Isa>() { return !std::same_as<Isa, gnomon::emulated<16>>; }));
}
#endif

TEST_CASE_TEMPLATE("a map that runs on lanes is the map that runs on plain loops, frame after frame", Texel, rg8, gnomon::rga16,
                   gnomon::rg32f) {
    constexpr gnomon::map_size size{.width = 96, .height = 80, .tile = 16};
    gnomon::soft_shadow_map<Texel, gnomon::binomial<2>> plain(size);
    gnomon::soft_shadow_map<Texel, gnomon::binomial<2>, simd<>> lanes(size);
    dice roll(406);
    std::vector<float> x(96), y(96), z(96), expected(96), made(96);
    for (int frame = 0; frame < 4; ++frame) {
        plain.clear();
        lanes.clear();
        for (int casters = 0; casters < 3; ++casters) {
            const gnomon::texel_rect r = roll.rect({96, 80}, 9);
            const float s = roll.unit();
            plain.cast(r, s);
            lanes.cast(r, s);
        }
        plain.filter();
        lanes.filter();
        for (std::size_t i = 0; i < 96; ++i) {
            x[i] = 96 * roll.unit();
            y[i] = 80 * roll.unit();
            z[i] = roll.unit();
        }
        plain.receive(x, y, z, expected);
        lanes.receive(x, y, z, made);
        CHECK(expected == made);
        plain.receive_row(40, z, expected);
        lanes.receive_row(40, z, made);
        CHECK(expected == made);
    }
}
