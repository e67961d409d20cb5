// What every fuzz target is made of: a program read from the fuzzer's bytes, and the sentence with which it fails.
// Comes before every header of gnomon, whose asserts it takes for its own.
#pragma once

#define GNOMON_ASSERT(condition, sentence) ::fuzz::assert_right_call((condition), (sentence))

#include "../support/bits.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace fuzz {

/// Ends the process unless `holds`: the fuzzer then keeps the bytes that led here.
inline void demand(bool holds, const char* sentence) {
    if (holds) return;
    std::fprintf(stderr, "gnomon: fuzz: this does not hold: %s\n", sentence);
    std::abort();
}

/// A wrong call has a written result, which a target may ask for: the library's asserts are silent while a `wrong_call` lives.
class wrong_call {
  public:
    wrong_call() noexcept { ++alive; }
    wrong_call(const wrong_call&) = delete;
    wrong_call& operator=(const wrong_call&) = delete;
    ~wrong_call() { --alive; }

    static inline int alive = 0;
};
inline void assert_right_call(bool holds, const char* sentence) { demand(holds || wrong_call::alive > 0, sentence); }

/// The fuzzer's bytes, front to back. Past the end come zeros, so that every input is a whole program and a short one stays short.
class bytes {
  public:
    bytes(const std::uint8_t* data, std::size_t size) noexcept : next_(data), end_(data + size) {}

    [[nodiscard]] bool empty() const noexcept { return next_ == end_; }
    [[nodiscard]] std::size_t left() const noexcept { return static_cast<std::size_t>(end_ - next_); }
    [[nodiscard]] const std::uint8_t* data() const noexcept { return next_; }

    std::uint8_t byte() noexcept { return empty() ? std::uint8_t{0} : *next_++; }
    bool flip() noexcept { return (byte() & 1) != 0; }
    std::uint32_t word() noexcept {
        std::uint32_t w = 0;
        for (int i = 0; i < 4; ++i) w = w << 8 | byte();
        return w;
    }
    /// A whole number in [low, high]; one byte where that is enough.
    int within(int low, int high) noexcept {
        const auto sides = static_cast<std::uint64_t>(std::int64_t{high} - low) + 1;
        const std::uint64_t thrown = sides <= 256 ? byte() : word();
        return static_cast<int>(low + static_cast<std::int64_t>(thrown % sides));
    }
    template <typename T, std::size_t N> T one_of(const T (&choices)[N]) noexcept { return choices[byte() % N]; }

    /// Any of the 2^32 patterns, or one of those that nobody likes, or a number such as scenes are made of.
    float any_float() noexcept {
        const std::uint8_t kind = byte();
        if (kind < 64) return std::bit_cast<float>(word());
        if (kind < 128) return test::hostile_floats[kind % test::hostile_floats.size()];
        return unit();
    }
    double any_double() noexcept {
        const std::uint8_t kind = byte();
        if (kind >= 128) return static_cast<double>(any_float());
        const std::uint64_t high = word();
        return std::bit_cast<double>(high << 32 | word());
    }
    /// A multiple of 2^-8 or of 2^-24 in [0, 1].
    float unit() noexcept {
        const std::uint8_t coarse = byte();
        if (coarse < 255) return static_cast<float>(coarse < 128 ? coarse * 2 : coarse + 1) / 256.0f;
        return static_cast<float>(word() >> 8) * 0x1p-24f;
    }

  private:
    const std::uint8_t* next_;
    const std::uint8_t* end_;
};

} // namespace fuzz
