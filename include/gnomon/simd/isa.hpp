// gnomon: soft shadow maps. Which lanes this program has, and which of them this processor has.
#pragma once

#include <gnomon/simd/avx2.hpp>
#include <gnomon/simd/avx512.hpp>
#include <gnomon/simd/emulated.hpp>
#include <gnomon/simd/sse2.hpp>

#include <concepts>
#include <cstdint>
#include <type_traits>
#if GNOMON_X86 && defined(_MSC_VER)
#include <intrin.h>
#elif GNOMON_X86
#include <cpuid.h>
#endif

namespace gnomon {

/// A set of lanes. `emulated` says what each operation means; bring your own by answering the same list.
template <typename Isa>
concept simd_isa =
    requires(typename Isa::ints i, typename Isa::floats f, typename Isa::doubles d, typename Isa::masks m, float number,
             double wide, void* memory, float* numbers, double* wides, std::uint8_t* codes, std::uint64_t bits) {
        requires std::same_as<std::remove_cv_t<decltype(Isa::bytes)>, int>;
        requires std::same_as<std::remove_cv_t<decltype(Isa::float_lanes)>, int>;
        requires std::same_as<std::remove_cv_t<decltype(Isa::double_lanes)>, int>;
        { Isa::load(memory) } -> std::same_as<typename Isa::ints>;
        { Isa::store(memory, i) };
        { Isa::repeat32(std::uint32_t{}) } -> std::same_as<typename Isa::ints>;
        { Isa::exclusive_or(i, i) } -> std::same_as<typename Isa::ints>;
        { Isa::even_pairs8(i, i) } -> std::same_as<typename Isa::ints>;
        { Isa::odd_pairs8(i, i) } -> std::same_as<typename Isa::ints>;
        { Isa::multiply_pairs8(i, i) } -> std::same_as<typename Isa::ints>;
        { Isa::add16(i, i) } -> std::same_as<typename Isa::ints>;
        { Isa::add_dot16(i, i, i) } -> std::same_as<typename Isa::ints>;
        { Isa::interleave_byte2(i, i, i, i) } -> std::same_as<typename Isa::ints>;
        { Isa::settle(i) };
        { Isa::load(static_cast<const float*>(numbers)) } -> std::same_as<typename Isa::floats>;
        { Isa::store(numbers, f) };
        { Isa::repeat(number) } -> std::same_as<typename Isa::floats>;
        { Isa::add(f, f) } -> std::same_as<typename Isa::floats>;
        { Isa::subtract(f, f) } -> std::same_as<typename Isa::floats>;
        { Isa::fraction(f, number) } -> std::same_as<typename Isa::floats>;
        { Isa::greater(f, f) } -> std::same_as<typename Isa::masks>;
        { Isa::not_greater(f, f) } -> std::same_as<typename Isa::masks>;
        { Isa::positive(f, f, f) } -> std::same_as<typename Isa::masks>;
        { Isa::both(m, m) } -> std::same_as<typename Isa::masks>;
        { Isa::keep(m, f) } -> std::same_as<typename Isa::floats>;
        { Isa::template codes_of<unorm8, 2>(codes, 0) } -> std::same_as<typename Isa::floats>;
        { Isa::load(static_cast<const double*>(wides)) } -> std::same_as<typename Isa::doubles>;
        { Isa::store(wides, d) };
        { Isa::repeat(wide) } -> std::same_as<typename Isa::doubles>;
        { Isa::add(d, d) } -> std::same_as<typename Isa::doubles>;
        { Isa::multiply(d, d) } -> std::same_as<typename Isa::doubles>;
        { Isa::divide(d, d) } -> std::same_as<typename Isa::doubles>;
        { Isa::add_product(d, d, d) } -> std::same_as<typename Isa::doubles>;
        { Isa::add_and_mask(d, bits, bits) } -> std::same_as<typename Isa::doubles>;
        { Isa::template codes<unorm8>(codes) } -> std::same_as<typename Isa::doubles>;
        { Isa::template store_codes<unorm8>(codes, d) };
    };

/// The best lanes of this processor, asked for once.
enum class cpu_level { portable, sse2, avx2, avx512 };

namespace detail {

#if GNOMON_X86
struct cpuid_answer {
    std::uint32_t eax, ebx, ecx, edx;
};
[[nodiscard]] inline cpuid_answer cpuid(unsigned leaf) noexcept {
#if defined(_MSC_VER) && !defined(__clang__)
    int r[4];
    __cpuidex(r, static_cast<int>(leaf), 0);
    return {static_cast<std::uint32_t>(r[0]), static_cast<std::uint32_t>(r[1]), static_cast<std::uint32_t>(r[2]),
            static_cast<std::uint32_t>(r[3])};
#else
    cpuid_answer a{};
    __cpuid_count(leaf, 0, a.eax, a.ebx, a.ecx, a.edx);
    return a;
#endif
}
/// Which registers the operating system keeps. \pre the processor has XSAVE
[[nodiscard]] inline std::uint32_t kept_registers() noexcept {
#if defined(_MSC_VER) && !defined(__clang__)
    return static_cast<std::uint32_t>(_xgetbv(0));
#else
    std::uint32_t low, high;
    asm("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return low;
#endif
}
[[nodiscard]] inline cpu_level ask_cpu() noexcept {
    constexpr auto bit = [](int n) { return std::uint32_t{1} << n; };
    constexpr std::uint32_t fma_xsave_avx_f16c = bit(12) | bit(27) | bit(28) | bit(29),
                            f_dq_bw_vl = bit(16) | bit(17) | bit(30) | bit(31);
    const auto has = [](std::uint32_t bits, std::uint32_t all) { return (bits & all) == all; };
    if (cpuid(0).eax < 7 || !has(cpuid(1).ecx, fma_xsave_avx_f16c)) return cpu_level::sse2;
    const cpuid_answer more = cpuid(7);
    if (!has(kept_registers(), 0x06) || !has(more.ebx, bit(5))) return cpu_level::sse2;
    const bool vnni = has(more.ecx, bit(11));
    return has(kept_registers(), 0xE6) && has(more.ebx, f_dq_bw_vl) && vnni ? cpu_level::avx512 : cpu_level::avx2;
}
#else
[[nodiscard]] inline cpu_level ask_cpu() noexcept { return cpu_level::portable; }
#endif

} // namespace detail

[[nodiscard]] inline cpu_level best_lanes() noexcept {
    static const cpu_level level = detail::ask_cpu();
    return level;
}

} // namespace gnomon
