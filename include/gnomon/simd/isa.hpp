// gnomon: soft shadow maps. Which lanes this program has, and which of them this processor has.
#pragma once

#include <gnomon/simd/avx2.hpp>
#include <gnomon/simd/avx512.hpp>
#include <gnomon/simd/emulated.hpp>
#include <gnomon/simd/neon.hpp>
#include <gnomon/simd/sse2.hpp>
#include <gnomon/simd/wasm.hpp>
#include <gnomon/texel/channel.hpp>

#include <concepts>
#include <cstdint>
#include <type_traits>
#if GNOMON_X86 && defined(_MSC_VER) && !defined(__clang__)
#include <intrin.h>
#elif GNOMON_X86
#include <cpuid.h>
#endif

namespace gnomon::inline GNOMON_BUILD {

/// Lanes that read and write the numbers of a channel.
template <typename Isa, typename Channel>
concept has_channel = requires(typename Channel::storage* to, const typename Channel::storage* from, typename Isa::floats f,
                               typename Isa::doubles d) {
    { Isa::template codes_of<Channel, 1>(from, 0) } -> std::same_as<typename Isa::floats>;
    { Isa::template codes_of<Channel, 2>(from, 1) } -> std::same_as<typename Isa::floats>;
    { Isa::template codes_of<Channel, 3>(from, 2) } -> std::same_as<typename Isa::floats>;
    { Isa::template codes_of<Channel, 4>(from, 3) } -> std::same_as<typename Isa::floats>;
    { Isa::template codes<Channel>(from) } -> std::same_as<typename Isa::doubles>;
    { Isa::template store_codes<Channel>(to, f) };
    { Isa::template store_codes<Channel>(to, d) };
};

/// A set of lanes. `emulated` says what each operation means; bring your own by answering the same list.
template <typename Isa>
concept simd_isa = requires(typename Isa::ints i, typename Isa::floats f, typename Isa::doubles d, typename Isa::masks m,
                            float number, double wide, void* memory, float* numbers, double* wides, std::uint8_t* codes,
                            std::uint16_t* words, std::uint64_t bits) {
    requires has_channel<Isa, unorm8> && has_channel<Isa, unorm16> && has_channel<Isa, half16> && has_channel<Isa, float32>;
    requires std::same_as<std::remove_cv_t<decltype(Isa::bytes)>, int>;
    requires std::same_as<std::remove_cv_t<decltype(Isa::float_lanes)>, int>;
    requires std::same_as<std::remove_cv_t<decltype(Isa::double_lanes)>, int>;
    { Isa::load(memory) } -> std::same_as<typename Isa::ints>;
    { Isa::store(memory, i) };
    { Isa::stream(memory, i) };
    { Isa::fence() };
    { Isa::prefetch(static_cast<const void*>(memory)) };
    { Isa::repeat32(std::uint32_t{}) } -> std::same_as<typename Isa::ints>;
    { Isa::exclusive_or(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::even_pairs8(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::odd_pairs8(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::multiply_pairs8(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::add16(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::add_dot16(i, i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::interleave_byte2(i, i, i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::low_pairs8(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::high_pairs8(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::low_pairs16(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::high_pairs16(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::first_half(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::second_half(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::narrow32(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::narrow16(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::even_words(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::odd_words(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::even_lanes(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::odd_lanes(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::low_pairs32(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::high_pairs32(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::template join_words<15>(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::add32(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::subtract32(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::widen32(static_cast<const std::uint8_t*>(codes)) } -> std::same_as<typename Isa::ints>;
    { Isa::widen32(static_cast<const std::uint16_t*>(words)) } -> std::same_as<typename Isa::ints>;
    { Isa::store_low(codes, i) };
    { Isa::store_low(words, i) };
    { Isa::template shift_up32<2>(i) } -> std::same_as<typename Isa::ints>;
    { Isa::template repeat_last32<2>(i) } -> std::same_as<typename Isa::ints>;
    { Isa::template multiply_shift32<28>(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::settle(i) };
    { Isa::either(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::subtract16(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::subtract_to_zero16(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::multiply_low16(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::multiply_high16(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::template shift_left16<8>(i) } -> std::same_as<typename Isa::ints>;
    { Isa::template shift_right16<8>(i) } -> std::same_as<typename Isa::ints>;
    { Isa::greater16(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::upper_where_greater16(i, i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::any_equal16(i, i, i, i) } -> std::same_as<bool>;
    { Isa::both(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::multiply32(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::lesser32(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::greater32(i, i) } -> std::same_as<typename Isa::ints>;
    { Isa::template shift_left32<8>(i) } -> std::same_as<typename Isa::ints>;
    { Isa::template shift_right32<8>(i) } -> std::same_as<typename Isa::ints>;
    { Isa::floor32(f) } -> std::same_as<typename Isa::ints>;
    { Isa::load(static_cast<const float*>(numbers)) } -> std::same_as<typename Isa::floats>;
    { Isa::store(numbers, f) };
    { Isa::repeat(number) } -> std::same_as<typename Isa::floats>;
    { Isa::add(f, f) } -> std::same_as<typename Isa::floats>;
    { Isa::subtract(f, f) } -> std::same_as<typename Isa::floats>;
    { Isa::multiply(f, f) } -> std::same_as<typename Isa::floats>;
    { Isa::divide(f, f) } -> std::same_as<typename Isa::floats>;
    { Isa::add_product(f, f, f) } -> std::same_as<typename Isa::floats>;
    { Isa::fraction(f, number) } -> std::same_as<typename Isa::floats>;
    { Isa::greater(f, f) } -> std::same_as<typename Isa::masks>;
    { Isa::not_greater(f, f) } -> std::same_as<typename Isa::masks>;
    { Isa::positive(f, f, f) } -> std::same_as<typename Isa::masks>;
    { Isa::both(m, m) } -> std::same_as<typename Isa::masks>;
    { Isa::keep(m, f) } -> std::same_as<typename Isa::floats>;
    { Isa::drop(m, f) } -> std::same_as<typename Isa::floats>;
    { Isa::numbers(i) } -> std::same_as<typename Isa::floats>;
    { Isa::any(m) } -> std::same_as<bool>;
    { Isa::lesser(f, f) } -> std::same_as<typename Isa::floats>;
    { Isa::settle(f) };
    { Isa::every(m) } -> std::same_as<bool>;
    { Isa::load(static_cast<const double*>(wides)) } -> std::same_as<typename Isa::doubles>;
    { Isa::store(wides, d) };
    { Isa::repeat(wide) } -> std::same_as<typename Isa::doubles>;
    { Isa::add(d, d) } -> std::same_as<typename Isa::doubles>;
    { Isa::multiply(d, d) } -> std::same_as<typename Isa::doubles>;
    { Isa::divide(d, d) } -> std::same_as<typename Isa::doubles>;
    { Isa::multiply_pairs(d, wide) } -> std::same_as<typename Isa::doubles>;
    { Isa::add_product(d, d, d) } -> std::same_as<typename Isa::doubles>;
    { Isa::add_and_mask(d, bits, bits) } -> std::same_as<typename Isa::doubles>;
    { Isa::subtract(d, d) } -> std::same_as<typename Isa::doubles>;
    { Isa::smaller(d, d) } -> std::same_as<typename Isa::doubles>;
    { Isa::larger(d, d) } -> std::same_as<typename Isa::doubles>;
    { Isa::truncate(d) } -> std::same_as<typename Isa::doubles>;
    { Isa::greater_bits(d, d) } -> std::same_as<unsigned>;
    { Isa::keep_greater(d, d, d) } -> std::same_as<typename Isa::doubles>;
    { Isa::drop_greater(d, d, d) } -> std::same_as<typename Isa::doubles>;
    { Isa::settle(d) };
    { Isa::store_floats(numbers, d) } -> std::same_as<typename Isa::doubles>;
    { Isa::template cast_pairs<unorm8>(codes, unsigned{}, d) };
    { Isa::template cast_pairs<unorm16>(words, unsigned{}, d) };
};

/// Lanes that sum four products of bytes at once. Optional: filters of bytes are quicker by them.
template <typename Isa>
concept sums_quads = simd_isa<Isa> && requires(typename Isa::ints i) {
    { Isa::add_dot8(i, i, i) } -> std::same_as<typename Isa::ints>;
};

/// Lanes that cut a register out of two. Optional: filters in floats and doubles are quicker by it where a load across two cache lines
/// takes the time of two.
template <typename Isa>
concept straddles = simd_isa<Isa> && requires(typename Isa::floats f, typename Isa::doubles d) {
    { Isa::template straddle<1>(f, f) } -> std::same_as<typename Isa::floats>;
    { Isa::template straddle<1>(d, d) } -> std::same_as<typename Isa::doubles>;
};

/// Which lanes a processor has: of x86 each level has those below it, elsewhere there is one.
enum class cpu_level { portable, wasm128, neon, sse2, avx2, avx512 };

namespace detail {

/// What an x86 processor says of itself, and its operating system of the registers that it keeps.
struct cpu_answers {
    std::uint32_t leaves; ///< cpuid(0).eax
    std::uint32_t ecx_of_1, ebx_of_7, ecx_of_7;
    std::uint32_t kept; ///< xgetbv(0)
};

/// AVX2 counts with FMA and F16C, AVX-512 with BW, DQ, VL and VNNI, and either only if its registers are kept.
[[nodiscard]] constexpr cpu_level level_of(const cpu_answers& cpu) noexcept {
    constexpr auto bit = [](int n) { return std::uint32_t{1} << n; };
    constexpr auto has = [](std::uint32_t bits, std::uint32_t all) { return (bits & all) == all; };
    constexpr std::uint32_t fma_xsave_avx_f16c = bit(12) | bit(27) | bit(28) | bit(29),
                            f_dq_bw_vl = bit(16) | bit(17) | bit(30) | bit(31);
    if (cpu.leaves < 7 || !has(cpu.ecx_of_1, fma_xsave_avx_f16c)) return cpu_level::sse2;
    if (!has(cpu.ebx_of_7, bit(5)) || !has(cpu.kept, 0x06)) return cpu_level::sse2;
    if (!has(cpu.ebx_of_7, f_dq_bw_vl) || !has(cpu.ecx_of_7, bit(11)) || !has(cpu.kept, 0xE6)) return cpu_level::avx2;
    return cpu_level::avx512;
}

#if GNOMON_X86 && defined(_MSC_VER) && !defined(__clang__)
inline void ask_cpuid(std::uint32_t leaf, std::uint32_t (&registers)[4]) noexcept {
    int r[4];
    __cpuidex(r, static_cast<int>(leaf), 0);
    for (int i = 0; i < 4; ++i) registers[i] = static_cast<std::uint32_t>(r[i]);
}
[[nodiscard]] inline std::uint32_t kept_registers() noexcept { return static_cast<std::uint32_t>(_xgetbv(0)); }
#elif GNOMON_X86
inline void ask_cpuid(std::uint32_t leaf, std::uint32_t (&r)[4]) noexcept { __cpuid_count(leaf, 0, r[0], r[1], r[2], r[3]); }
[[nodiscard]] inline std::uint32_t kept_registers() noexcept {
    std::uint32_t low, high;
    asm volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0)); // not volatile, it may be asked before OSXSAVE is
    return low;
}
#endif

#if GNOMON_X86
[[nodiscard]] inline cpu_level ask_cpu() noexcept {
    std::uint32_t leaf0[4], leaf1[4], leaf7[4]; // eax, ebx, ecx, edx
    ask_cpuid(0, leaf0);
    ask_cpuid(1, leaf1);
    ask_cpuid(7, leaf7);
    const bool says_what_it_keeps = (leaf1[2] >> 27 & 1) != 0; // without OSXSAVE there is no xgetbv
    return level_of({leaf0[0], leaf1[2], leaf7[1], leaf7[2], says_what_it_keeps ? kept_registers() : 0});
}
#elif GNOMON_NEON
[[nodiscard]] inline cpu_level ask_cpu() noexcept { return cpu_level::neon; }
#elif GNOMON_WASM
[[nodiscard]] inline cpu_level ask_cpu() noexcept { return cpu_level::wasm128; }
#else
[[nodiscard]] inline cpu_level ask_cpu() noexcept { return cpu_level::portable; }
#endif

} // namespace detail

/// The best lanes of this processor, which is asked once.
[[nodiscard]] inline cpu_level best_lanes() noexcept {
    static const cpu_level level = detail::ask_cpu();
    return level;
}

} // namespace gnomon::inline GNOMON_BUILD
