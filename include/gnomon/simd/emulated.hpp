// gnomon: soft shadow maps. Lanes that are arrays: what every operation means, on any machine and at any width.
#pragma once

#include <gnomon/simd/region.hpp>
#include <gnomon/texel/channel.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace gnomon::inline GNOMON_BUILD {

/// A register of `Bytes` bytes: whole numbers of 8, 16 or 32 bits in one type, as processors have it, and doubles.
///
/// This is the list of a `simd_isa`, and its specification: each target gives the same bits. Loads and stores take any alignment.
template <int Bytes> struct emulated {
    static_assert(Bytes >= 16 && Bytes % 16 == 0, "gnomon: emulated<Bytes>: a register has 16 bytes or a multiple of it");
    static constexpr int bytes = Bytes;
    static constexpr int float_lanes = Bytes / 4;
    static constexpr int double_lanes = Bytes / 8;

    struct ints {
        std::uint8_t byte[static_cast<std::size_t>(Bytes)];
    };
    struct floats {
        float lane[static_cast<std::size_t>(float_lanes)];
    };
    struct masks {
        bool lane[static_cast<std::size_t>(float_lanes)];
    };
    struct doubles {
        double lane[static_cast<std::size_t>(double_lanes)];
    };

    [[nodiscard]] static ints load(const void* from) noexcept { return copied<ints>(from); }
    static void store(void* to, ints a) noexcept { std::memcpy(to, &a, sizeof a); }
    /// Stores past the caches, where there is such a way; what is stored so others see after a fence. \pre aligned to a register
    static void stream(void* to, ints a) noexcept { store(to, a); }
    static void fence() noexcept {}
    /// Calls for memory that will be read before long, into the second of the caches; any address will do.
    static void prefetch(const void*) noexcept {}
    /// The same 32 bits again and again.
    [[nodiscard]] static ints repeat32(std::uint32_t v) noexcept {
        return each<std::uint32_t>([v](int) { return v; });
    }
    [[nodiscard]] static ints exclusive_or(ints a, ints b) noexcept {
        return each<std::uint8_t>([&](int i) { return a.byte[i] ^ b.byte[i]; });
    }

    /// 16 bits: byte 0, 2, 4 ... of `a`, and the same byte of `b` above it; and byte 1, 3, 5 ...
    [[nodiscard]] static ints even_pairs8(ints a, ints b) noexcept {
        return each<std::uint16_t>([&](int i) { return a.byte[2 * i] | b.byte[2 * i] << 8; });
    }
    [[nodiscard]] static ints odd_pairs8(ints a, ints b) noexcept {
        return each<std::uint16_t>([&](int i) { return a.byte[2 * i + 1] | b.byte[2 * i + 1] << 8; });
    }
    /// 16 bits: the sum of two products, unsigned weight times signed value, of the lower bytes and of the upper ones. \pre it fits
    [[nodiscard]] static ints multiply_pairs8(ints weights, ints values) noexcept {
        return each<std::uint16_t>([&](int i) {
            const std::uint16_t w = at<std::uint16_t>(weights, i), v = at<std::uint16_t>(values, i);
            return (w & 255) * static_cast<std::int8_t>(v & 255) + (w >> 8) * static_cast<std::int8_t>(v >> 8);
        });
    }
    [[nodiscard]] static ints add16(ints a, ints b) noexcept {
        return each<std::uint16_t>([&](int i) { return at<std::uint16_t>(a, i) + at<std::uint16_t>(b, i); });
    }
    /// 32 bits: `sum`, and two neighbours' products with the lower and the upper 16 bits of a weight, all signed, modulo 2^32.
    [[nodiscard]] static ints add_dot16(ints sum, ints weights, ints values) noexcept {
        return each<std::uint32_t>([&](int i) {
            const std::uint32_t pair = at<std::uint32_t>(weights, i);
            const auto product = [&](std::uint32_t weight, int k) {
                return static_cast<std::uint32_t>(static_cast<std::int16_t>(weight & 0xFFFF) * at<std::int16_t>(values, k));
            };
            return at<std::uint32_t>(sum, i) + product(pair, 2 * i) + product(pair >> 16, 2 * i + 1);
        });
    }
    /// Of each 32 bits the third byte, of four registers side by side: a b c d a b c d ... \pre the fourth is 0
    [[nodiscard]] static ints interleave_byte2(ints a, ints b, ints c, ints d) noexcept {
        const ints* const from[4] = {&a, &b, &c, &d};
        return each<std::uint8_t>([&](int i) { return at<std::uint32_t>(*from[i % 4], i / 4) >> 16; });
    }
    /// In each 16 bytes: the lower eight bytes of `a` in turn with those of `b`; and the upper eight.
    [[nodiscard]] static ints low_pairs8(ints a, ints b) noexcept { return paired<std::uint8_t>(a, b, 0); }
    [[nodiscard]] static ints high_pairs8(ints a, ints b) noexcept { return paired<std::uint8_t>(a, b, 8); }
    /// The same of 16 bits.
    [[nodiscard]] static ints low_pairs16(ints a, ints b) noexcept { return paired<std::uint16_t>(a, b, 0); }
    [[nodiscard]] static ints high_pairs16(ints a, ints b) noexcept { return paired<std::uint16_t>(a, b, 8); }
    /// 16 bytes of `low` in turn with 16 of `high`: what low_pairs and high_pairs made, in order again, in two registers.
    [[nodiscard]] static ints first_half(ints low, ints high) noexcept { return in_turn(low, high, 0); }
    [[nodiscard]] static ints second_half(ints low, ints high) noexcept { return in_turn(low, high, Bytes); }
    /// 32 bits, signed: divided by 2^Bits, rounded down.
    template <int Bits> [[nodiscard]] static ints shift_right32(ints a) noexcept {
        return each<std::int32_t>([&](int i) { return at<std::int32_t>(a, i) >> Bits; });
    }
    /// In each 16 bytes: four signed 32 bits of `a`, then four of `b`, in 16. \pre they fit
    [[nodiscard]] static ints narrow32(ints a, ints b) noexcept {
        return each<std::int16_t>([&](int i) { return at<std::int32_t>(i % 8 < 4 ? a : b, i / 8 * 4 + i % 4); });
    }
    /// The 16 bits of `a`, then those of `b`, in eight. \pre they fit
    [[nodiscard]] static ints narrow16(ints a, ints b) noexcept {
        return each<std::uint8_t>([&](int i) { return at<std::uint16_t>(i < Bytes / 2 ? a : b, i % (Bytes / 2)); });
    }
    /// 32 bits: `sum`, and four neighbours' products, signed weight times unsigned value, modulo 2^32.
    [[nodiscard]] static ints add_dot8(ints sum, ints weights, ints values) noexcept {
        return each<std::uint32_t>([&](int i) {
            std::uint32_t total = at<std::uint32_t>(sum, i);
            for (int k = 4 * i; k < 4 * i + 4; ++k)
                total += static_cast<std::uint32_t>(static_cast<std::int8_t>(weights.byte[k]) * values.byte[k]);
            return total;
        });
    }
    /// In each 16 bytes, and in order over these: 16 bits 0, 2, 4 and 6 of `a`, then those of `b`; and 1, 3, 5 and 7. So of what
    /// even_lanes and odd_lanes make of two registers of pairs all first numbers, and all second ones.
    [[nodiscard]] static ints even_words(ints a, ints b) noexcept { return words(a, b, 0); }
    [[nodiscard]] static ints odd_words(ints a, ints b) noexcept { return words(a, b, 1); }
    /// Of each two groups of 16 bytes the first: of `a`, then of `b`; and the second. (16 bytes: `a`, and `b`.)
    [[nodiscard]] static ints even_lanes(ints a, ints b) noexcept { return lanes(a, b, 0); }
    [[nodiscard]] static ints odd_lanes(ints a, ints b) noexcept { return lanes(a, b, 16); }
    /// In each 16 bytes: the lower two 32 bits of `a` in turn with those of `b`; and the upper two.
    [[nodiscard]] static ints low_pairs32(ints a, ints b) noexcept { return paired<std::uint32_t>(a, b, 0); }
    [[nodiscard]] static ints high_pairs32(ints a, ints b) noexcept { return paired<std::uint32_t>(a, b, 8); }
    /// 32 bits: 16 from bit `Shift` of `a` on, and 16 of `b` above them. Shift < 16
    template <int Shift> [[nodiscard]] static ints join_words(ints a, ints b) noexcept {
        return each<std::uint32_t>(
            [&](int i) { return (at<std::uint32_t>(a, i) >> Shift & 0xFFFF) | (at<std::uint32_t>(b, i) >> Shift & 0xFFFF) << 16; });
    }
    [[nodiscard]] static ints add32(ints a, ints b) noexcept {
        return each<std::uint32_t>([&](int i) { return at<std::uint32_t>(a, i) + at<std::uint32_t>(b, i); });
    }
    [[nodiscard]] static ints subtract32(ints a, ints b) noexcept {
        return each<std::uint32_t>([&](int i) { return at<std::uint32_t>(a, i) - at<std::uint32_t>(b, i); });
    }
    /// Bytes or 16 bits, one to each 32 bits; and back, the lowest of each.
    template <typename Storage> [[nodiscard]] static ints widen32(const Storage* from) noexcept {
        return each<std::uint32_t>([&](int i) { return from[i]; });
    }
    template <typename Storage> static void store_low(Storage* to, ints a) noexcept {
        for (int i = 0; i < float_lanes; ++i) to[i] = static_cast<Storage>(at<std::uint32_t>(a, i));
    }
    /// Each 32 bits so many places on, zeros before them.
    template <int Places> [[nodiscard]] static ints shift_up32(ints a) noexcept {
        return each<std::uint32_t>([&](int i) { return i < Places ? 0u : at<std::uint32_t>(a, i - Places); });
    }
    /// The last `Count` of 32 bits, again and again from the first place on.
    template <int Count> [[nodiscard]] static ints repeat_last32(ints a) noexcept {
        return each<std::uint32_t>([&](int i) { return at<std::uint32_t>(a, float_lanes - Count + i % Count); });
    }
    /// a * b / 2^Shift, unsigned, rounded down. \pre it fits, and 28 <= Shift < 64
    template <int Shift> [[nodiscard]] static ints multiply_shift32(ints a, ints b) noexcept {
        return each<std::uint32_t>(
            [&](int i) { return std::uint64_t{at<std::uint32_t>(a, i)} * at<std::uint32_t>(b, i) >> Shift; });
    }
    /// Nothing. Where a compiler would sum products as a tree, which takes more registers than there are, it keeps their order.
    static void settle(ints&) noexcept {}

    /// 16 bits, unsigned: bits of either; a - b modulo 2^16, and 0 instead of less; both halves of a product.
    [[nodiscard]] static ints either(ints a, ints b) noexcept {
        return each<std::uint8_t>([&](int i) { return a.byte[i] | b.byte[i]; });
    }
    [[nodiscard]] static ints subtract16(ints a, ints b) noexcept {
        return each<std::uint16_t>([&](int i) { return at<std::uint16_t>(a, i) - at<std::uint16_t>(b, i); });
    }
    [[nodiscard]] static ints subtract_to_zero16(ints a, ints b) noexcept {
        return each<std::uint16_t>([&](int i) {
            const int difference = at<std::uint16_t>(a, i) - at<std::uint16_t>(b, i);
            return difference > 0 ? difference : 0;
        });
    }
    [[nodiscard]] static ints multiply_low16(ints a, ints b) noexcept {
        return each<std::uint16_t>([&](int i) { return std::uint32_t{at<std::uint16_t>(a, i)} * at<std::uint16_t>(b, i); });
    }
    [[nodiscard]] static ints multiply_high16(ints a, ints b) noexcept {
        return each<std::uint16_t>([&](int i) { return std::uint32_t{at<std::uint16_t>(a, i)} * at<std::uint16_t>(b, i) >> 16; });
    }
    template <int Bits> [[nodiscard]] static ints shift_left16(ints a) noexcept {
        return each<std::uint16_t>([&](int i) { return at<std::uint16_t>(a, i) << Bits; });
    }
    template <int Bits> [[nodiscard]] static ints shift_right16(ints a) noexcept {
        return each<std::uint16_t>([&](int i) { return at<std::uint16_t>(a, i) >> Bits; });
    }
    /// 16 bits, unsigned: all ones where a > b, else nothing; and there the upper byte of `values`, as a number of 16 bits.
    [[nodiscard]] static ints greater16(ints a, ints b) noexcept {
        return each<std::uint16_t>([&](int i) { return at<std::uint16_t>(a, i) > at<std::uint16_t>(b, i) ? 0xFFFF : 0; });
    }
    [[nodiscard]] static ints upper_where_greater16(ints values, ints a, ints b) noexcept {
        return each<std::uint16_t>(
            [&](int i) { return at<std::uint16_t>(a, i) > at<std::uint16_t>(b, i) ? at<std::uint16_t>(values, i) >> 8 : 0; });
    }
    /// Are any 16 bits the same in `a` and `b`, or in `c` and `d`?
    [[nodiscard]] static bool any_equal16(ints a, ints b, ints c, ints d) noexcept {
        bool any = false;
        for (int i = 0; i < Bytes / 2; ++i)
            any |= at<std::uint16_t>(a, i) == at<std::uint16_t>(b, i) || at<std::uint16_t>(c, i) == at<std::uint16_t>(d, i);
        return any;
    }

    /// Bits of both; and 32 bits, signed, modulo 2^32.
    [[nodiscard]] static ints both(ints a, ints b) noexcept {
        return each<std::uint8_t>([&](int i) { return a.byte[i] & b.byte[i]; });
    }
    [[nodiscard]] static ints multiply32(ints a, ints b) noexcept {
        return each<std::uint32_t>([&](int i) { return at<std::uint32_t>(a, i) * at<std::uint32_t>(b, i); });
    }
    [[nodiscard]] static ints lesser32(ints a, ints b) noexcept {
        return each<std::int32_t>([&](int i) { return gnomon::lesser(at<std::int32_t>(a, i), at<std::int32_t>(b, i)); });
    }
    [[nodiscard]] static ints greater32(ints a, ints b) noexcept {
        return each<std::int32_t>([&](int i) { return gnomon::greater(at<std::int32_t>(a, i), at<std::int32_t>(b, i)); });
    }
    template <int Bits> [[nodiscard]] static ints shift_left32(ints a) noexcept {
        return each<std::uint32_t>([&](int i) { return at<std::uint32_t>(a, i) << Bits; });
    }
    /// The largest whole number of 32 bits that is not greater; -2^31 of what is beyond them, and of NaN.
    [[nodiscard]] static ints floor32(floats a) noexcept {
        return each<std::int32_t>([&](int i) {
            const float v = a.lane[i];
            if (!(v >= -0x1p31f && v < 0x1p31f)) return std::int32_t{-0x7FFFFFFF - 1};
            const auto whole = static_cast<std::int32_t>(v);
            return static_cast<float>(whole) > v ? whole - 1 : whole;
        });
    }

    [[nodiscard]] static floats load(const float* from) noexcept { return copied<floats>(from); }
    static void store(float* to, floats a) noexcept { std::memcpy(to, &a, sizeof a); }
    [[nodiscard]] static floats repeat(float v) noexcept {
        return of_floats<floats>([v](int) { return v; });
    }
    /// The lanes from `Places` on, of `a` and then of `b`. \pre 0 < Places < the lanes there are
    template <int Places> [[nodiscard]] static floats straddle(floats a, floats b) noexcept {
        return of_floats<floats>(
            [&](int i) { return i + Places < float_lanes ? a.lane[i + Places] : b.lane[i + Places - float_lanes]; });
    }
    [[nodiscard]] static floats add(floats a, floats b) noexcept {
        return of_floats<floats>([&](int i) { return a.lane[i] + b.lane[i]; });
    }
    [[nodiscard]] static floats subtract(floats a, floats b) noexcept {
        return of_floats<floats>([&](int i) { return a.lane[i] - b.lane[i]; });
    }
    [[nodiscard]] static floats multiply(floats a, floats b) noexcept {
        return of_floats<floats>([&](int i) { return a.lane[i] * b.lane[i]; });
    }
    [[nodiscard]] static floats divide(floats a, floats b) noexcept {
        return of_floats<floats>([&](int i) { return a.lane[i] / b.lane[i]; });
    }
    /// sum + a * b, the product rounded and then the sum, whatever a compiler may fuse.
    [[nodiscard]] static floats add_product(floats sum, floats a, floats b) noexcept {
        return of_floats<floats>([&](int i) {
            float product = a.lane[i] * b.lane[i];
            GNOMON_SETTLE(product);
            return sum.lane[i] + product;
        });
    }
    /// a / b, correctly rounded. \pre `a` is a whole number in [0, b], and b = 255, 65535, or 255 * 65536
    [[nodiscard]] static floats fraction(floats a, float b) noexcept {
        return of_floats<floats>([&](int i) { return a.lane[i] / b; });
    }
    [[nodiscard]] static masks greater(floats a, floats b) noexcept {
        return of_floats<masks>([&](int i) { return a.lane[i] > b.lane[i]; });
    }
    /// Set for NaN.
    [[nodiscard]] static masks not_greater(floats a, floats b) noexcept {
        return of_floats<masks>([&](int i) { return !(a.lane[i] > b.lane[i]); });
    }
    /// a b + c > 0, of the exact product and sum. \pre the sum is nothing, or not below the least float
    [[nodiscard]] static masks positive(floats a, floats b, floats c) noexcept {
        return of_floats<masks>([&](int i) {
            return static_cast<double>(a.lane[i]) * static_cast<double>(b.lane[i]) + static_cast<double>(c.lane[i]) > 0.0;
        });
    }
    [[nodiscard]] static masks both(masks a, masks b) noexcept {
        return of_floats<masks>([&](int i) { return a.lane[i] && b.lane[i]; });
    }
    /// `a` where the mask is set, else 0.
    [[nodiscard]] static floats keep(masks where, floats a) noexcept {
        return of_floats<floats>([&](int i) { return where.lane[i] ? a.lane[i] : 0.0f; });
    }
    /// 0 where the mask is set, else `a`.
    [[nodiscard]] static floats drop(masks where, floats a) noexcept {
        return of_floats<floats>([&](int i) { return where.lane[i] ? 0.0f : a.lane[i]; });
    }
    /// The codes of channel `c` of `float_lanes` texels that lie side by side, `Channels` each.
    template <channel Channel, int Channels>
    [[nodiscard]] static floats codes_of(const typename Channel::storage* from, int c) noexcept {
        return of_floats<floats>([&](int i) { return Channel::code(from[i * Channels + c]); });
    }

    /// Whole numbers of 32 bits as floats, rounded to nearest.
    [[nodiscard]] static floats numbers(ints a) noexcept {
        return of_floats<floats>([&](int i) { return static_cast<float>(at<std::int32_t>(a, i)); });
    }
    /// b where it is less, else a.
    [[nodiscard]] static floats lesser(floats a, floats b) noexcept {
        return of_floats<floats>([&](int i) { return gnomon::lesser(a.lane[i], b.lane[i]); });
    }
    /// Nothing. Where a compiler would fuse a product with what is added to it, it is rounded first.
    static void settle(floats& a) noexcept {
        for (int i = 0; i < float_lanes; ++i) GNOMON_SETTLE(a.lane[i]);
    }
    [[nodiscard]] static bool every(masks a) noexcept {
        bool each = true;
        for (int i = 0; i < float_lanes; ++i) each &= a.lane[i];
        return each;
    }
    [[nodiscard]] static bool any(masks a) noexcept {
        bool one = false;
        for (int i = 0; i < float_lanes; ++i) one |= a.lane[i];
        return one;
    }

    [[nodiscard]] static doubles load(const double* from) noexcept { return copied<doubles>(from); }
    static void store(double* to, doubles a) noexcept { std::memcpy(to, &a, sizeof a); }
    [[nodiscard]] static doubles repeat(double v) noexcept {
        return each([v](int) { return v; });
    }
    template <int Places> [[nodiscard]] static doubles straddle(doubles a, doubles b) noexcept {
        return each([&](int i) { return i + Places < double_lanes ? a.lane[i + Places] : b.lane[i + Places - double_lanes]; });
    }
    [[nodiscard]] static doubles add(doubles a, doubles b) noexcept {
        return each([&](int i) { return a.lane[i] + b.lane[i]; });
    }
    [[nodiscard]] static doubles multiply(doubles a, doubles b) noexcept {
        return each([&](int i) { return a.lane[i] * b.lane[i]; });
    }
    [[nodiscard]] static doubles divide(doubles a, doubles b) noexcept {
        return each([&](int i) { return a.lane[i] / b.lane[i]; });
    }
    /// Of each two neighbours the product, and the second one times `b`.
    [[nodiscard]] static doubles multiply_pairs(doubles a, double b) noexcept {
        return each([&](int i) { return a.lane[i] * (i % 2 == 0 ? a.lane[i + 1] : b); });
    }
    /// sum + a * b, \pre a * b is exact, so that it does not matter who fuses them.
    [[nodiscard]] static doubles add_product(doubles sum, doubles a, doubles b) noexcept {
        return each([&](int i) { return sum.lane[i] + a.lane[i] * b.lane[i]; });
    }
    /// Bits modulo 2^64, then masked: detail::to_bits in lanes.
    [[nodiscard]] static doubles add_and_mask(doubles a, std::uint64_t addend, std::uint64_t mask) noexcept {
        return each([&](int i) { return std::bit_cast<double>((std::bit_cast<std::uint64_t>(a.lane[i]) + addend) & mask); });
    }

    [[nodiscard]] static doubles subtract(doubles a, doubles b) noexcept {
        return each([&](int i) { return a.lane[i] - b.lane[i]; });
    }
    /// The smaller and the larger of two; `b` if they are equal or one is NaN.
    [[nodiscard]] static doubles smaller(doubles a, doubles b) noexcept {
        return each([&](int i) { return a.lane[i] < b.lane[i] ? a.lane[i] : b.lane[i]; });
    }
    [[nodiscard]] static doubles larger(doubles a, doubles b) noexcept {
        return each([&](int i) { return a.lane[i] > b.lane[i] ? a.lane[i] : b.lane[i]; });
    }
    /// Without what follows the point. \pre -2^31 < a < 2^31
    [[nodiscard]] static doubles truncate(doubles a) noexcept {
        return each([&](int i) { return static_cast<double>(static_cast<std::int32_t>(a.lane[i])); });
    }
    /// Bit i is set where lane i of `a` is greater.
    [[nodiscard]] static unsigned greater_bits(doubles a, doubles b) noexcept {
        unsigned bits = 0;
        for (int i = 0; i < double_lanes; ++i) bits |= (a.lane[i] > b.lane[i] ? 1u : 0u) << i;
        return bits;
    }
    /// `v` where a > b, else 0; and 0 where a > b, else `v`.
    [[nodiscard]] static doubles keep_greater(doubles a, doubles b, doubles v) noexcept {
        return each([&](int i) { return a.lane[i] > b.lane[i] ? v.lane[i] : 0.0; });
    }
    [[nodiscard]] static doubles drop_greater(doubles a, doubles b, doubles v) noexcept {
        return each([&](int i) { return a.lane[i] > b.lane[i] ? 0.0 : v.lane[i]; });
    }
    /// Nothing. Where a compiler would fuse a product with the sum it goes into, it keeps the product's own rounding.
    static void settle(doubles&) noexcept {}

    /// Codes of stored channels, exactly.
    template <channel Channel> [[nodiscard]] static doubles codes(const typename Channel::storage* from) noexcept {
        return each([&](int i) { return static_cast<double>(Channel::code(from[i])); });
    }
    /// Stores numbers rounded once: whole codes downwards, \pre within the code's range; half and float as `Channel::store`, but for
    /// what is left of a NaN, which is any NaN.
    template <channel Channel> static void store_codes(typename Channel::storage* to, floats a) noexcept {
        for (int i = 0; i < float_lanes; ++i) to[i] = stored<Channel>(static_cast<double>(a.lane[i]));
    }
    template <channel Channel> static void store_codes(typename Channel::storage* to, doubles a) noexcept {
        for (int i = 0; i < double_lanes; ++i) to[i] = stored<Channel>(a.lane[i]);
    }
    /// Stores the nearest floats, -0 as 0, and returns them.
    [[nodiscard]] static doubles store_floats(float* to, doubles a) noexcept {
        store_codes<float32>(to, a);
        return codes<float32>(to);
    }
    /// Casts onto texels of two channels that lie side by side, depth and mask, of whole codes: where a bit is set and the mask is 0
    /// or the depth less than the code (rounded down), it becomes the depth, and the mask full. Nothing else is read or written.
    template <channel Channel> static void cast_pairs(typename Channel::storage* to, unsigned where, doubles codes) noexcept {
        for (int i = 0; i < double_lanes; ++i) {
            const auto code = static_cast<typename Channel::storage>(codes.lane[i]);
            if ((where >> i & 1) == 0 || (to[2 * i + 1] != 0 && code <= to[2 * i])) continue;
            to[2 * i] = code;
            to[2 * i + 1] = static_cast<typename Channel::storage>(Channel::scale);
        }
    }

  private:
    template <channel Channel> [[nodiscard]] static typename Channel::storage stored(double code) noexcept {
        if constexpr (Channel::whole_codes)
            return static_cast<typename Channel::storage>(code);
        else
            return Channel::store(code);
    }
    template <typename T> [[nodiscard]] static T copied(const void* from) noexcept {
        T t;
        std::memcpy(&t, from, sizeof t);
        return t;
    }
    template <typename T> [[nodiscard]] static T at(const ints& a, int i) noexcept {
        return copied<T>(a.byte + static_cast<std::size_t>(i) * sizeof(T));
    }
    /// A register whose element i is f(i).
    template <typename T, typename F> [[nodiscard]] static ints each(F&& f) noexcept {
        ints a;
        for (int i = 0; i < Bytes / static_cast<int>(sizeof(T)); ++i) {
            const T v = static_cast<T>(f(i));
            std::memcpy(a.byte + static_cast<std::size_t>(i) * sizeof(T), &v, sizeof v);
        }
        return a;
    }
    /// Eight bytes of `a` in turn with eight of `b`, of each 16 those from `first` on.
    template <typename T> [[nodiscard]] static ints paired(ints a, ints b, int first) noexcept {
        constexpr int size = static_cast<int>(sizeof(T)), lane = 16 / size;
        return each<T>([&](int i) { return at<T>(i % 2 == 0 ? a : b, i / lane * lane + first / size + i % lane / 2); });
    }
    [[nodiscard]] static ints words(ints a, ints b, int odd) noexcept {
        return each<std::uint16_t>([&](int i) { return at<std::uint16_t>(i % 8 < 4 ? a : b, i / 8 * 8 + i % 4 * 2 + odd); });
    }
    [[nodiscard]] static ints lanes(ints a, ints b, int first) noexcept {
        return each<std::uint8_t>([&](int i) {
            const int from = (i / 16 * 32 + first + i % 16);
            return (from < Bytes ? a : b).byte[from % Bytes];
        });
    }
    [[nodiscard]] static ints in_turn(ints low, ints high, int first) noexcept {
        return each<std::uint8_t>([&](int i) {
            const int from = first + i;
            return (from / 16 % 2 == 0 ? low : high).byte[from / 32 * 16 + from % 16];
        });
    }
    template <typename T, typename F> [[nodiscard]] static T of_floats(F&& f) noexcept {
        T a;
        for (int i = 0; i < float_lanes; ++i) a.lane[i] = f(i);
        return a;
    }
    template <typename F> [[nodiscard]] static doubles each(F&& f) noexcept {
        doubles a;
        for (int i = 0; i < double_lanes; ++i) a.lane[i] = f(i);
        return a;
    }
};

} // namespace gnomon::inline GNOMON_BUILD
