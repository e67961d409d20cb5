// Every set of lanes that the machine under test can run, and memory that holds anything.
#pragma once

#include "images.hpp"
#include "one_isa.hpp"

#include <gnomon/backend/reconstruct.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace test {

/// Calls f.template operator()<Isa>(), if that one is asked.
template <typename Isa, typename F> void for_isa(F&& f) {
    if constexpr (is_asked<Isa>) f.template operator()<Isa>();
}

/// Calls f.template operator()<Isa>() for what the processor has, by name and as the best of them, and for lanes that are arrays: on x86,
/// which has no use for them, only if they are asked for, since they take longer than all the others.
template <typename F> void for_each_isa(F&& f) {
    for_isa<gnomon::best_isa>(f);
#if !GNOMON_X86 || defined(GNOMON_TEST_ARRAYS)
    for_isa<gnomon::emulated<48>>(f);
#endif
#if GNOMON_X86
    for_isa<gnomon::sse2>(f);
    if (gnomon::best_lanes() >= gnomon::cpu_level::avx2) for_isa<gnomon::avx2>(f);
    if (gnomon::best_lanes() >= gnomon::cpu_level::avx512) for_isa<gnomon::avx512>(f);
#elif GNOMON_NEON
    for_isa<gnomon::neon>(f);
#elif GNOMON_WASM
    for_isa<gnomon::wasm128>(f);
#endif
}

/// Elements that begin so many bytes past a cache line, as near as they may, in memory that holds something else around them.
template <typename T> class past_a_line {
  public:
    past_a_line(int bytes, int count) : memory_(static_cast<std::size_t>(count) * sizeof(T) + 4 * 64, 0x5A) {
        const auto begin = (reinterpret_cast<std::uintptr_t>(memory_.data()) + 127) / 64 * 64;
        data_ = reinterpret_cast<T*>(begin + static_cast<std::size_t>(bytes) / alignof(T) * alignof(T));
        size_ = static_cast<std::size_t>(count);
    }
    [[nodiscard]] std::span<T> elements() noexcept { return {data_, size_}; }
    /// Is what lies around them as it was?
    [[nodiscard]] bool is_alone() const noexcept {
        const auto* const first = reinterpret_cast<const unsigned char*>(data_);
        const auto untouched = [](const unsigned char* from, const unsigned char* to) {
            return std::all_of(from, to, [](unsigned char byte) { return byte == 0x5A; });
        };
        return untouched(memory_.data(), first) && untouched(first + size_ * sizeof(T), memory_.data() + memory_.size());
    }

  private:
    std::vector<unsigned char> memory_;
    T* data_;
    std::size_t size_;
};

/// Calls f(count, bytes) for every count to 67 and every alignment within a cache line, but not for all of each with all of the other.
template <typename F> void for_each_alignment(F&& f) {
    for (int count = 0; count <= 67; ++count)
        for (int bytes = count % 9 == 0 ? 0 : count % 17; bytes < 64; bytes += count % 9 == 0 ? 1 : 17) f(count, bytes);
}

/// Lanes that count what they are asked to do.
struct counted_lanes : gnomon::emulated<16> {
    static inline int loads = 0, prefetches = 0, streams = 0, fences = 0, fractions = 0;
    static void forget() noexcept { loads = prefetches = streams = fences = fractions = 0; }
    template <typename T> static auto load(const T* from) noexcept {
        ++loads;
        return emulated::load(from);
    }
    static void prefetch(const void*) noexcept { ++prefetches; }
    static void stream(void* to, ints a) noexcept {
        ++streams;
        store(to, a);
    }
    static void fence() noexcept { ++fences; }
    static floats fraction(floats a, float b) noexcept {
        ++fractions;
        return emulated::fraction(a, b);
    }
};

/// Lanes that no processor has. They would do.
struct lanes_to_come : counted_lanes {};

/// Any bits at all, so for half and float infinities, NaN and numbers beyond [0, 1] too.
template <typename Texel> void fill_with_bits(dice& roll, gnomon::image_view<Texel> to) {
    for_each_texel(whole(to.size()), [&](int x, int y) {
        for (auto& stored : to(x, y).stored) {
            std::uint32_t bits = static_cast<std::uint32_t>(roll(0, 65535));
            bits = bits << 16 | static_cast<std::uint32_t>(roll(0, 65535));
            std::memcpy(&stored, &bits, sizeof stored);
        }
    });
}
} // namespace test

template <>
inline constexpr gnomon::cpu_level gnomon::detail::level_needed<test::lanes_to_come> =
    static_cast<gnomon::cpu_level>(static_cast<int>(gnomon::cpu_level::avx512) + 1);
