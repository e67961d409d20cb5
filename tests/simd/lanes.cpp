// Every operation of every target against `emulated`, which says what it means; on random bits, and on numbers near a rounding.
#include <gnomon/simd/isa.hpp>

#include "../support/dice.hpp"
#include "../support/formats.hpp"
#include "../support/one_isa.hpp"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

namespace {
/// A register's worth of bytes, every second one at an odd address.
struct memory {
    unsigned char filler;
    unsigned char byte[64];
};

/// The comparisons of one set of lanes; each counts wrong answers.
struct checks_of {
    int float_lanes;
    int double_lanes;
    int (*ints)(const memory*);
    int (*words)(const memory*);
    int (*longs)(const memory*);
    int (*doubles)(const double*);
    int (*products)(const double*, const double*);
    int (*floats)(const float*);
    int (*whole)(const float*);
    int (*blends)(int);
    int (*channels8)(const std::uint8_t*);
    int (*channels16)(const std::uint16_t*);
    int (*channels_half)(const std::uint16_t*);
    int (*channels_float)(const float*);
    int (*unorm8)(const std::uint8_t*, const double*);
    int (*unorm16)(const std::uint16_t*, const double*);
    int (*half16)(const std::uint16_t*, const double*);
    int (*float32)(const float*, const double*);
    int (*comparisons)(const double*, const double*);
    int (*casts8)(const std::uint8_t*, unsigned, const double*, std::uint8_t*);
    int (*casts16)(const std::uint16_t*, unsigned, const double*, std::uint16_t*);
};
} // namespace

#define CHECKS_ON plain
#include "lanes_checks.inl"
#undef CHECKS_ON
#if GNOMON_X86
GNOMON_TARGET_BEGIN(GNOMON_AVX2)
#define CHECKS_ON with_avx2
#include "lanes_checks.inl"
#undef CHECKS_ON
GNOMON_TARGET_END
GNOMON_TARGET_BEGIN(GNOMON_AVX512)
#define CHECKS_ON with_avx512
#include "lanes_checks.inl"
#undef CHECKS_ON
GNOMON_TARGET_END
#endif

namespace test {
/// Lanes that know bytes alone.
struct lanes_of_bytes : gnomon::emulated<16> {
    template <typename Channel, int Channels>
        requires std::same_as<Channel, gnomon::unorm8>
    static floats codes_of(const std::uint8_t* stored, int index) noexcept;
};
} // namespace test

namespace {
using gnomon::cpu_level;
using gnomon::simd_isa;

static_assert(simd_isa<gnomon::emulated<16>> && simd_isa<gnomon::emulated<64>> && !simd_isa<int> && !simd_isa<gnomon::half16>);
static_assert(gnomon::has_channel<test::lanes_of_bytes, gnomon::unorm8> &&
              !gnomon::has_channel<test::lanes_of_bytes, gnomon::unorm16>);
static_assert(!simd_isa<test::lanes_of_bytes>);
#if GNOMON_X86
static_assert(simd_isa<gnomon::sse2> && simd_isa<gnomon::avx2> && simd_isa<gnomon::avx512>);
static_assert(gnomon::straddles<gnomon::avx512> && gnomon::sums_quads<gnomon::avx512>);
#elif GNOMON_NEON
static_assert(simd_isa<gnomon::neon>);
#elif GNOMON_WASM
static_assert(simd_isa<gnomon::wasm128>);
#endif

/// Calls f(checks) for each target that this processor has.
template <typename F> void for_each_target(F&& f) {
#if GNOMON_X86
    if constexpr (test::is_asked<gnomon::sse2>) f(plain::all<gnomon::sse2>);
    if constexpr (test::is_asked<gnomon::avx2>)
        if (gnomon::best_lanes() >= cpu_level::avx2) f(with_avx2::all<gnomon::avx2>);
    if constexpr (test::is_asked<gnomon::avx512>)
        if (gnomon::best_lanes() >= cpu_level::avx512) f(with_avx512::all<gnomon::avx512>);
#elif GNOMON_NEON
    f(plain::all<gnomon::neon>);
#elif GNOMON_WASM
    f(plain::all<gnomon::wasm128>);
#endif
    if constexpr (test::is_asked<gnomon::emulated<32>>) f(plain::all<gnomon::emulated<32>>); // the checks pass what is right
}
} // namespace

TEST_CASE("arrays round downwards and take what has no whole number of 32 bits to the least") {
    using lanes = gnomon::emulated<16>;
    constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
    const auto floors = [](lanes::floats a) { return std::bit_cast<std::array<std::int32_t, 4>>(lanes::floor32(a)); };
    CHECK(floors({{-2.5f, -2.0f, 2.5f, 0x1p30f}}) == std::array<std::int32_t, 4>{-3, -2, 2, 1 << 30});
    CHECK(floors({{-0x1p31f, -3e9f, 0x1p31f, std::numeric_limits<float>::quiet_NaN()}}) ==
          std::array<std::int32_t, 4>{least, least, least, least});
}

TEST_CASE("arrays settle every lane and cast into every pair and do nothing beside them") { // which sanitizers see
    using lanes = gnomon::emulated<16>;
    const auto settled = std::make_unique<lanes::floats>(lanes::floats{{1.0f, 2.0f, 3.0f, 4.0f}});
    lanes::settle(*settled);
    CHECK(std::bit_cast<std::array<std::uint32_t, 4>>(*settled) ==
          std::array<std::uint32_t, 4>{0x3F800000, 0x40000000, 0x40400000, 0x40800000});
    std::uint8_t pairs[4] = {};
    lanes::cast_pairs<gnomon::unorm8>(pairs, 3, {{7.0, 9.0}});
    CHECK((pairs[0] == 7 && pairs[1] == 255 && pairs[2] == 9 && pairs[3] == 255));
}

TEST_CASE("operations on whole numbers give the bits of the emulated ones") {
    test::dice roll(411);
    for_each_target([&](const checks_of& target) {
        int wrong = 0;
        for (int n = 0; n < 2000; ++n) {
            memory m[4];
            for (memory& each : m)
                for (unsigned char& byte : each.byte)
                    byte = static_cast<unsigned char>(roll(0, 3) == 0 ? 128 * roll(0, 1) + 127 * roll(0, 1) : roll(0, 255));
            wrong += target.ints(m) + target.longs(m);
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE("operations on numbers of 16 bits give the results of the emulated ones, of equal numbers and neighbours too") {
    test::dice roll(414);
    for_each_target([&](const checks_of& target) {
        int wrong = 0;
        for (int n = 0; n < 4000; ++n) {
            std::uint16_t words[4][32];
            for (auto& row : words)
                for (std::uint16_t& word : row) word = static_cast<std::uint16_t>(roll.one_in(4) ? -roll(0, 2) : roll(0, 65535));
            for (int i = 0; i < 32; ++i) // the first pair has neighbours, and now and then one that is equal, as the second has
                if (roll.one_in(2))
                    words[1][i] = static_cast<std::uint16_t>(words[0][i] + (roll.one_in(16) ? 0 : 1 - 2 * roll(0, 1)));
            if (roll.one_in(2)) words[3][roll(0, 31)] = words[2][0];
            memory m[4];
            for (int i = 0; i < 4; ++i) std::memcpy(m[i].byte, words[i], sizeof words[i]);
            wrong += target.words(m);
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE("arithmetic on doubles gives the bits of the emulated one") {
    test::dice roll(412);
    for_each_target([&](const checks_of& target) {
        int wrong = 0;
        for (int n = 0; n < 2000; ++n) {
            double numbers[16], whole[16];
            for (double& each : numbers)
                each =
                    std::ldexp(1.0 + static_cast<double>(roll.unit()) + static_cast<double>(roll.unit()) * 0x1p-24, roll(-40, 40));
            for (double& each : whole) each = roll(0, 65536);
            wrong += target.doubles(numbers) + target.products(numbers, whole);
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE("arithmetic and comparisons of floats give the bits of the emulated ones, for infinities, NaN and all between") {
    test::dice roll(413);
    constexpr float odd[] = {0.0f,
                             -0.0f,
                             1.0f,
                             -1.0f,
                             std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::quiet_NaN(),
                             3e38f,
                             0x1p31f,
                             -0x1p31f,
                             -3e38f,
                             2147483520.0f,
                             -2147483520.0f};
    for_each_target([&](const checks_of& target) {
        int wrong = 0;
        for (int n = 0; n < 4000; ++n) {
            float numbers[48];
            for (int i = 0; i < 48; ++i) {
                numbers[i] = roll.one_in(4) ? odd[roll(0, 12)] : std::ldexp(roll.unit() - 0.5f, roll(-20, 33));
                // The two sides of a difference that is nothing, or all but nothing: a whole number times a depth, and what it equals.
                if (i < 32 || roll.one_in(2)) continue;
                numbers[i - 32] = static_cast<float>(roll(1, 511));
                numbers[i] = -numbers[i - 32] * numbers[i - 16];
            }
            wrong += target.floats(numbers);
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE("products that are exact are added, and codes stored rounded down, whole ones and just below them") {
    test::dice roll(415);
    for_each_target([&](const checks_of& target) {
        int wrong = 0;
        for (int n = 0; n < 4000; ++n) {
            float numbers[64];
            for (int i = 0; i < 16; ++i) {
                numbers[i] = static_cast<float>(roll(0, 4095));
                numbers[16 + i] = static_cast<float>(roll(-4096, 4096));
                for (const int row : {32, 48}) {
                    const float whole = static_cast<float>(roll(0, row == 32 ? 255 : 65535));
                    numbers[row + i] = whole + (roll.one_in(2) ? 0.0f : 0.9921875f);
                }
            }
            wrong += target.whole(numbers);
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE("every blend of bytes over its scale is rounded correctly") {
    for_each_target([&](const checks_of& target) {
        int wrong = 0;
        for (int first = 0; first <= 255 * 65536; first += target.float_lanes) wrong += target.blends(first);
        CHECK(wrong == 0);
    });
}

TEST_CASE("halves and floats are read as they are, whichever channel of a texel they are: any bits") {
    test::dice roll(416);
    for_each_target([&](const checks_of& target) {
        int wrong = 0;
        for (int n = 0; n < 4000; ++n) {
            std::uint16_t words[128];
            for (std::uint16_t& word : words) word = static_cast<std::uint16_t>(roll(0, 65535));
            float floats[64];
            std::memcpy(floats, words, sizeof words);
            wrong += target.channels_half(words) + target.channels_float(floats);
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE(
    "every code of 8 and 16 bits is read as it is, and over its scale rounded correctly, whichever channel of a texel it is") {
    for_each_target([&](const checks_of& target) {
        int wrong = 0;
        for (int first = 0; first < 65536; ++first) {
            std::uint8_t bytes[64];
            std::uint16_t words[64];
            for (int i = 0; i < 64; ++i) {
                words[i] = static_cast<std::uint16_t>(first + i);
                bytes[i] = static_cast<std::uint8_t>(first + i);
            }
            wrong += target.channels16(words) + (first < 256 ? target.channels8(bytes) : 0);
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE("every stored code is read as it is") {
    const double numbers[8]{};
    for_each_target([&](const checks_of& target) {
        int wrong = 0;
        for (int code = 0; code < 65536; code += target.double_lanes) {
            std::uint8_t bytes[8];
            std::uint16_t words[8];
            float floats[8];
            for (int i = 0; i < 8; ++i) {
                words[i] = static_cast<std::uint16_t>(code + i);
                bytes[i] = static_cast<std::uint8_t>(code + i);
                floats[i] = std::bit_cast<float>(std::uint32_t{words[i]} << 16 | 0x8001u);
            }
            wrong += target.unorm8(bytes, numbers) + target.unorm16(words, numbers) + target.half16(words, numbers) +
                     target.float32(floats, numbers);
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE("codes are stored rounded down, halves and floats to nearest: on, just before and just after every step and every tie") {
    const std::uint16_t words[8]{};
    const std::uint8_t bytes[8]{};
    const float floats[8]{};
    for_each_target([&](const checks_of& target) {
        int wrong = 0;
        for (int code = 0; code < 65536; ++code) {
            // The half with this pattern and the middle between it and the next, in units of the last place of a double around them.
            const double half = static_cast<double>(gnomon::half_to_float(static_cast<std::uint16_t>(code)));
            const double next =
                static_cast<double>(gnomon::half_to_float(static_cast<std::uint16_t>(code == 65535 ? 0 : code + 1)));
            const double tie = half / 2 + next / 2;
            const auto beside = [](double v, int steps) { return std::bit_cast<double>(std::bit_cast<std::int64_t>(v) + steps); };
            const double halves[8] = {half,
                                      tie,
                                      beside(tie, 1),
                                      tie > 0.0 ? beside(tie, -1) : tie,
                                      beside(half, 1),
                                      tie * (1 + 0x1p-30),
                                      tie * (1 - 0x1p-30),
                                      tie * (1 + 0x1p-25)};
            const double c16 = code, c8 = code % 256;
            const double codes16[8] = {c16, c16 + 0.25, c16 + 0.999999, beside(c16 + 1.0, -1), c16, c16, c16, c16};
            const double codes8[8] = {c8, c8 + 0.25, c8 + 0.999999, beside(c8 + 1.0, -1), c8, c8, c8, c8};
            const float f = std::bit_cast<float>(static_cast<std::uint32_t>(code) << 15 | 0x4321u);
            const double g = static_cast<double>(f), middle = std::bit_cast<double>(std::bit_cast<std::uint64_t>(g) + (1u << 28));
            const double numbers[8] = {g, middle, beside(middle, 1), beside(middle, -1), -0.0, 0.0, g * 1.1, g * 0.9};
            for (int at = 0; at < 8; at += target.double_lanes)
                wrong += target.half16(words, halves + at) + target.unorm16(words, codes16 + at) +
                         target.unorm8(bytes, codes8 + at) + target.float32(floats, numbers + at);
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE("doubles are compared, truncated and stored as floats as the emulated ones are, for infinities, NaN and all between") {
    test::dice roll(414);
    constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double odd[] = {0.0, -0.0, 1.0, -1.0, infinity, -infinity, nan, 0x1p-1074};
    for_each_target([&](const checks_of& target) {
        int wrong = 0;
        for (int n = 0; n < 4000; ++n) {
            double numbers[16], fitting[8];
            for (double& each : numbers)
                each = roll.one_in(3) ? odd[roll(0, 7)]
                                      : std::ldexp(static_cast<double>(roll.unit()) - 0.5 + roll(-9, 9) * 0x1p-40, roll(-140, 20));
            for (double& each : fitting)
                each =
                    roll.one_in(3) ? roll(-5, 5) + roll(-1, 1) * 0x1p-50 : (static_cast<double>(roll.unit()) - 0.5) * 0x1.fffffp31;
            wrong += target.comparisons(numbers, fitting);
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE("casters go onto pairs as the emulated lanes cast them: nearer ones, onto empty ones, where they are asked to, and not "
          "beside") {
    test::dice roll(415);
    for_each_target([&](const checks_of& target) {
        int wrong = 0;
        for (int n = 0; n < 20000; ++n) {
            std::uint8_t bytes[32];
            std::uint16_t words[32];
            double codes8[8], codes16[8];
            const bool few = roll.one_in(2); // codes that are often equal
            for (int i = 0; i < 32; ++i) {
                const bool mask = i % 2 == 1 && roll.one_in(2);
                bytes[i] = static_cast<std::uint8_t>(mask ? 255 * roll(0, 1) : few ? roll(0, 3) : roll(0, 255));
                words[i] = static_cast<std::uint16_t>(mask ? 65535 * roll(0, 1) : few ? roll(0, 3) : roll(0, 65535));
            }
            for (double& each : codes8) each = (few ? roll(0, 3) : roll(0, 255)) + 0.999 * roll(0, 1);
            for (double& each : codes16) each = (few ? roll(0, 3) : roll(0, 65535)) + 0.999 * roll(0, 1);
            const unsigned where = static_cast<unsigned>(roll.one_in(3) ? 255 : roll(0, 255)) & ((1u << target.double_lanes) - 1);
            const auto asked = 2 * static_cast<std::size_t>(std::bit_width(where));
            const auto asked_bytes = std::make_unique<std::uint8_t[]>(asked);
            const auto asked_words = std::make_unique<std::uint16_t[]>(asked);
            wrong +=
                target.casts8(bytes, where, codes8, asked_bytes.get()) + target.casts16(words, where, codes16, asked_words.get());
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE("a processor has the lanes whose every bit it shows, and whose registers its system keeps") {
    using gnomon::detail::cpu_answers;
    using gnomon::detail::level_of;
    constexpr auto bit = [](int n) { return std::uint32_t{1} << n; };
    // Intel's manual, CPUID: 1.ecx FMA 12, OSXSAVE 27, AVX 28, F16C 29; 7.ebx AVX2 5, F 16, DQ 17, BW 30, VL 31; 7.ecx VNNI 11; and
    // XGETBV: SSE 1, AVX 2, opmask 5, the upper halves of zmm 6, zmm16 and up 7.
    const cpu_answers all{7, bit(12) | bit(27) | bit(28) | bit(29), bit(5) | bit(16) | bit(17) | bit(30) | bit(31), bit(11), 0xE7};
    CHECK(level_of(all) == cpu_level::avx512);
    CHECK(level_of({0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF}) == cpu_level::avx512);
    CHECK(level_of({6, all.ecx_of_1, all.ebx_of_7, all.ecx_of_7, all.kept}) == cpu_level::sse2); // leaf 7 answers for another
    const auto without = [&all](std::uint32_t cpu_answers::* which, int n) {
        cpu_answers cpu = all;
        cpu.*which &= ~(std::uint32_t{1} << n);
        return level_of(cpu);
    };
    for (const int n : {12, 27, 28, 29}) CHECK(without(&cpu_answers::ecx_of_1, n) == cpu_level::sse2);
    CHECK(without(&cpu_answers::ebx_of_7, 5) == cpu_level::sse2);
    for (const int n : {1, 2}) CHECK(without(&cpu_answers::kept, n) == cpu_level::sse2);
    for (const int n : {16, 17, 30, 31}) CHECK(without(&cpu_answers::ebx_of_7, n) == cpu_level::avx2);
    CHECK(without(&cpu_answers::ecx_of_7, 11) == cpu_level::avx2);
    for (const int n : {5, 6, 7}) CHECK(without(&cpu_answers::kept, n) == cpu_level::avx2);
    CHECK(without(&cpu_answers::kept, 0) == cpu_level::avx512); // that of x87 is nothing to lanes
    CHECK(gnomon::best_lanes() == gnomon::detail::ask_cpu());
}

#if GNOMON_X86 && defined(__GNUC__)
TEST_CASE("this processor has the lanes that the compiler's own library finds in it") {
    __builtin_cpu_init();
    const auto both = [](bool a, bool b) { return a && b; };
    const bool avx2 = both(__builtin_cpu_supports("avx2"), __builtin_cpu_supports("fma"));
    const bool words = both(__builtin_cpu_supports("avx512bw"), __builtin_cpu_supports("avx512vl"));
    const bool avx512 = both(words, both(__builtin_cpu_supports("avx512dq"), __builtin_cpu_supports("avx512vnni")));
    CHECK(gnomon::best_lanes() == (both(avx2, avx512) ? cpu_level::avx512 : avx2 ? cpu_level::avx2 : cpu_level::sse2));
}
#endif
