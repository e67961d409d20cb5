// gnomon: soft shadow maps. Lanes of WebAssembly's SIMD128: 16 bytes at a time. See emulated.hpp for what they mean.
#pragma once

#include <gnomon/simd/region.hpp>
#if GNOMON_WASM
#include <gnomon/simd/emulated.hpp>

#include <concepts>
#include <cstdint>
#include <wasm_simd128.h>

namespace gnomon::inline GNOMON_BUILD {

struct wasm128 {
    static constexpr int bytes = 16;
    static constexpr int float_lanes = 4;
    static constexpr int double_lanes = 2;
    using ints = v128_t;
    using floats [[gnu::vector_size(16)]] = float;
    using masks [[gnu::vector_size(16)]] = unsigned;
    using doubles [[gnu::vector_size(16)]] = double;

    GNOMON_LANES ints load(const void* from) noexcept { return wasm_v128_load(from); }
    GNOMON_LANES_VOID void store(void* to, ints a) noexcept { wasm_v128_store(to, a); }
    GNOMON_LANES_VOID void stream(void* to, ints a) noexcept { store(to, a); }
    GNOMON_LANES_VOID void fence() noexcept {}
    GNOMON_LANES_VOID void prefetch(const void*) noexcept {}
    GNOMON_LANES ints repeat32(std::uint32_t v) noexcept { return wasm_u32x4_splat(v); }
    GNOMON_LANES ints exclusive_or(ints a, ints b) noexcept { return a ^ b; }

    GNOMON_LANES ints even_pairs8(ints a, ints b) noexcept {
        return wasm_i8x16_shuffle(a, b, 0, 16, 2, 18, 4, 20, 6, 22, 8, 24, 10, 26, 12, 28, 14, 30);
    }
    GNOMON_LANES ints odd_pairs8(ints a, ints b) noexcept {
        return wasm_i8x16_shuffle(a, b, 1, 17, 3, 19, 5, 21, 7, 23, 9, 25, 11, 27, 13, 29, 15, 31);
    }
    GNOMON_LANES ints multiply_pairs8(ints weights, ints values) noexcept {
        const ints even = wasm_i16x8_mul(weights & wasm_u16x8_splat(255), wasm_i16x8_shr(wasm_i16x8_shl(values, 8), 8));
        return wasm_i16x8_add(even, wasm_i16x8_mul(wasm_u16x8_shr(weights, 8), wasm_i16x8_shr(values, 8)));
    }
    GNOMON_LANES ints low_pairs8(ints a, ints b) noexcept {
        return wasm_i8x16_shuffle(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    }
    GNOMON_LANES ints high_pairs8(ints a, ints b) noexcept {
        return wasm_i8x16_shuffle(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
    }
    GNOMON_LANES ints low_pairs16(ints a, ints b) noexcept { return wasm_i16x8_shuffle(a, b, 0, 8, 1, 9, 2, 10, 3, 11); }
    GNOMON_LANES ints high_pairs16(ints a, ints b) noexcept { return wasm_i16x8_shuffle(a, b, 4, 12, 5, 13, 6, 14, 7, 15); }
    GNOMON_LANES ints first_half(ints low, ints) noexcept { return low; }
    GNOMON_LANES ints second_half(ints, ints high) noexcept { return high; }
    GNOMON_LANES ints add16(ints a, ints b) noexcept { return wasm_i16x8_add(a, b); }
    GNOMON_LANES ints add_dot16(ints sum, ints weights, ints values) noexcept {
        return wasm_i32x4_add(sum, wasm_i32x4_dot_i16x8(weights, values));
    }
    template <int Bits> GNOMON_LANES ints shift_right32(ints a) noexcept { return wasm_i32x4_shr(a, Bits); }
    GNOMON_LANES ints narrow32(ints a, ints b) noexcept { return wasm_i16x8_narrow_i32x4(a, b); }
    GNOMON_LANES ints narrow16(ints a, ints b) noexcept { return wasm_u8x16_narrow_i16x8(a, b); }
    GNOMON_LANES ints interleave_byte2(ints a, ints b, ints c, ints d) noexcept {
        const ints ab = wasm_i8x16_shuffle(a, b, 2, 18, 0, 0, 6, 22, 0, 0, 10, 26, 0, 0, 14, 30, 0, 0);
        const ints cd = wasm_i8x16_shuffle(c, d, 0, 0, 2, 18, 0, 0, 6, 22, 0, 0, 10, 26, 0, 0, 14, 30);
        return wasm_i16x8_shuffle(ab, cd, 0, 9, 2, 11, 4, 13, 6, 15);
    }
    GNOMON_LANES ints even_words(ints a, ints b) noexcept { return wasm_i16x8_shuffle(a, b, 0, 2, 4, 6, 8, 10, 12, 14); }
    GNOMON_LANES ints odd_words(ints a, ints b) noexcept { return wasm_i16x8_shuffle(a, b, 1, 3, 5, 7, 9, 11, 13, 15); }
    GNOMON_LANES ints even_lanes(ints a, ints) noexcept { return a; }
    GNOMON_LANES ints odd_lanes(ints, ints b) noexcept { return b; }
    GNOMON_LANES ints low_pairs32(ints a, ints b) noexcept { return wasm_i32x4_shuffle(a, b, 0, 4, 1, 5); }
    GNOMON_LANES ints high_pairs32(ints a, ints b) noexcept { return wasm_i32x4_shuffle(a, b, 2, 6, 3, 7); }
    template <int Shift> GNOMON_LANES ints join_words(ints a, ints b) noexcept {
        return (wasm_u32x4_shr(a, Shift) & wasm_u32x4_splat(0xFFFF)) | wasm_i32x4_shl(wasm_u32x4_shr(b, Shift), 16);
    }
    GNOMON_LANES ints add32(ints a, ints b) noexcept { return wasm_i32x4_add(a, b); }
    GNOMON_LANES ints subtract32(ints a, ints b) noexcept { return wasm_i32x4_sub(a, b); }
    template <typename Storage> GNOMON_LANES ints widen32(const Storage* from) noexcept {
        if constexpr (sizeof(Storage) == 1)
            return wasm_u32x4_extend_low_u16x8(wasm_u16x8_extend_low_u8x16(wasm_v128_load32_zero(from)));
        else
            return wasm_u32x4_extend_low_u16x8(wasm_v128_load64_zero(from));
    }
    template <typename Storage> GNOMON_LANES_VOID void store_low(Storage* to, ints a) noexcept {
        if constexpr (sizeof(Storage) == 1)
            wasm_v128_store32_lane(to, wasm_i8x16_shuffle(a, a, 0, 4, 8, 12, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0), 0);
        else
            wasm_v128_store64_lane(to, even_words(a, a), 0);
    }
    template <int Places> GNOMON_LANES ints shift_up32(ints a) noexcept {
        return wasm_i32x4_shuffle(repeat32(0), a, 4 - Places, 5 - Places, 6 - Places, 7 - Places);
    }
    template <int Count> GNOMON_LANES ints repeat_last32(ints a) noexcept {
        constexpr auto from = [](int i) { return 4 - Count + i % Count; };
        return wasm_i32x4_shuffle(a, a, from(0), from(1), from(2), from(3));
    }
    template <int Shift> GNOMON_LANES ints multiply_shift32(ints a, ints b) noexcept {
        const ints low = wasm_u64x2_shr(wasm_u64x2_extmul_low_u32x4(a, b), Shift);
        return wasm_i32x4_shuffle(low, wasm_u64x2_shr(wasm_u64x2_extmul_high_u32x4(a, b), Shift), 0, 2, 4, 6);
    }
    GNOMON_LANES ints either(ints a, ints b) noexcept { return a | b; }
    GNOMON_LANES ints subtract16(ints a, ints b) noexcept { return wasm_i16x8_sub(a, b); }
    GNOMON_LANES ints subtract_to_zero16(ints a, ints b) noexcept { return wasm_u16x8_sub_sat(a, b); }
    GNOMON_LANES ints multiply_low16(ints a, ints b) noexcept { return wasm_i16x8_mul(a, b); }
    GNOMON_LANES ints multiply_high16(ints a, ints b) noexcept {
        return odd_words(wasm_u32x4_extmul_low_u16x8(a, b), wasm_u32x4_extmul_high_u16x8(a, b));
    }
    template <int Bits> GNOMON_LANES ints shift_left16(ints a) noexcept { return wasm_i16x8_shl(a, Bits); }
    template <int Bits> GNOMON_LANES ints shift_right16(ints a) noexcept { return wasm_u16x8_shr(a, Bits); }
    GNOMON_LANES ints greater16(ints a, ints b) noexcept { return wasm_u16x8_gt(a, b); }
    GNOMON_LANES ints upper_where_greater16(ints values, ints a, ints b) noexcept {
        return wasm_u16x8_shr(values, 8) & wasm_u16x8_gt(a, b);
    }
    GNOMON_LANES bool any_equal16(ints a, ints b, ints c, ints d) noexcept {
        return wasm_v128_any_true(wasm_i16x8_eq(a, b) | wasm_i16x8_eq(c, d));
    }

    GNOMON_LANES ints both(ints a, ints b) noexcept { return a & b; }
    GNOMON_LANES ints multiply32(ints a, ints b) noexcept { return wasm_i32x4_mul(a, b); }
    GNOMON_LANES ints lesser32(ints a, ints b) noexcept { return wasm_i32x4_min(a, b); }
    GNOMON_LANES ints greater32(ints a, ints b) noexcept { return wasm_i32x4_max(a, b); }
    template <int Bits> GNOMON_LANES ints shift_left32(ints a) noexcept { return wasm_i32x4_shl(a, Bits); }
    GNOMON_LANES ints floor32(floats a) noexcept { // the conversion knows other results of NaN and of what is too much
        const ints whole = wasm_i32x4_trunc_sat_f32x4(wasm_f32x4_floor(bits_of(a)));
        return wasm_v128_bitselect(whole, repeat32(0x80000000u), wasm_f32x4_lt(bits_of(a), bits_of(repeat(0x1p31f))));
    }

    GNOMON_LANES_VOID void settle(ints&) noexcept {}

    GNOMON_LANES floats load(const float* from) noexcept { return floats_of(wasm_v128_load(from)); }
    GNOMON_LANES_VOID void store(float* to, floats a) noexcept { wasm_v128_store(to, bits_of(a)); }
    GNOMON_LANES floats repeat(float v) noexcept { return floats{v, v, v, v}; }
    GNOMON_LANES floats add(floats a, floats b) noexcept { return a + b; }
    GNOMON_LANES floats subtract(floats a, floats b) noexcept { return a - b; }
    GNOMON_LANES floats multiply(floats a, floats b) noexcept { return a * b; }
    GNOMON_LANES floats divide(floats a, floats b) noexcept { return a / b; }
    GNOMON_LANES floats add_product(floats sum, floats a, floats b) noexcept { return sum + a * b; } // nothing fuses them here
    GNOMON_LANES floats fraction(floats a, float b) noexcept { return a / repeat(b); }
    GNOMON_LANES masks greater(floats a, floats b) noexcept { return masks_of(wasm_f32x4_gt(bits_of(a), bits_of(b))); }
    GNOMON_LANES masks not_greater(floats a, floats b) noexcept { return ~greater(a, b); }
    GNOMON_LANES masks positive(floats a, floats b,
                                floats c) noexcept { // in double: the product is exact, and a sum keeps its sign
        const doubles low = lower(a) * lower(b) + lower(c), high = lower(upper(a)) * lower(upper(b)) + lower(upper(c));
        const doubles zero = repeat(0.0);
        return wasm_i32x4_shuffle(wasm_f64x2_gt(bits_of(low), bits_of(zero)), wasm_f64x2_gt(bits_of(high), bits_of(zero)), 0, 2, 4,
                                  6);
    }
    GNOMON_LANES masks both(masks a, masks b) noexcept { return a & b; }
    GNOMON_LANES floats keep(masks where, floats a) noexcept { return floats_of(bits_of(where) & bits_of(a)); }
    GNOMON_LANES floats drop(masks where, floats a) noexcept { return floats_of(wasm_v128_andnot(bits_of(a), bits_of(where))); }
    template <channel Channel, int Channels> GNOMON_LANES floats codes_of(const typename Channel::storage* from, int c) noexcept {
        if constexpr (std::same_as<Channel, unorm8> && Channels == 2) {
            const ints pairs = wasm_u32x4_extend_low_u16x8(wasm_v128_load64_zero(from));
            return number(c == 0 ? pairs & wasm_u32x4_splat(255) : wasm_u32x4_shr(pairs, 8));
        } else if constexpr (std::same_as<Channel, unorm16> && Channels == 2) {
            const ints pairs = load(from);
            return number(c == 0 ? pairs & wasm_u32x4_splat(65535) : wasm_u32x4_shr(pairs, 16));
        } else if constexpr (std::same_as<Channel, float32> && Channels == 1) {
            return load(from);
        } else if constexpr (std::same_as<Channel, unorm16> && Channels == 1) {
            return number(wasm_u32x4_extend_low_u16x8(wasm_v128_load64_zero(from)));
        } else if constexpr (std::same_as<Channel, float32> && Channels == 2) {
            const ints low = wasm_v128_load(from), high = wasm_v128_load(from + 4);
            return floats_of(c == 0 ? wasm_i32x4_shuffle(low, high, 0, 2, 4, 6) : wasm_i32x4_shuffle(low, high, 1, 3, 5, 7));
        } else if constexpr (Channel::whole_codes) {
            const auto* const codes = from + c;
            return number(wasm_u32x4_make(codes[0], codes[Channels], codes[2 * Channels], codes[3 * Channels]));
        } else if constexpr (std::same_as<Channel, float32>) {
            return floats_of(wasm_f32x4_make(from[c], from[c + Channels], from[c + 2 * Channels], from[c + 3 * Channels]));
        } else {
            return load(emulated<bytes>::template codes_of<Channel, Channels>(from, c).lane);
        }
    }
    GNOMON_LANES floats numbers(ints a) noexcept { return floats_of(wasm_f32x4_convert_i32x4(a)); }
    GNOMON_LANES bool any(masks a) noexcept { return wasm_v128_any_true(bits_of(a)); }
    GNOMON_LANES floats lesser(floats a, floats b) noexcept { return floats_of(wasm_f32x4_pmin(bits_of(a), bits_of(b))); }
    GNOMON_LANES_VOID void settle(floats&) noexcept {}
    GNOMON_LANES bool every(masks a) noexcept { return wasm_i32x4_all_true(bits_of(a)); }

    GNOMON_LANES doubles load(const double* from) noexcept { return doubles_of(wasm_v128_load(from)); }
    GNOMON_LANES_VOID void store(double* to, doubles a) noexcept { wasm_v128_store(to, bits_of(a)); }
    GNOMON_LANES doubles repeat(double v) noexcept { return doubles{v, v}; }
    GNOMON_LANES doubles add(doubles a, doubles b) noexcept { return a + b; }
    GNOMON_LANES doubles subtract(doubles a, doubles b) noexcept { return a - b; }
    GNOMON_LANES doubles smaller(doubles a, doubles b) noexcept { return doubles_of(wasm_f64x2_pmin(bits_of(b), bits_of(a))); }
    GNOMON_LANES doubles larger(doubles a, doubles b) noexcept { return doubles_of(wasm_f64x2_pmax(bits_of(b), bits_of(a))); }
    GNOMON_LANES doubles truncate(doubles a) noexcept {
        return doubles_of(wasm_f64x2_convert_low_i32x4(wasm_i32x4_trunc_sat_f64x2_zero(bits_of(a))));
    }
    GNOMON_LANES unsigned greater_bits(doubles a, doubles b) noexcept {
        return static_cast<unsigned>(wasm_i64x2_bitmask(wasm_f64x2_gt(bits_of(a), bits_of(b))));
    }
    GNOMON_LANES doubles keep_greater(doubles a, doubles b, doubles v) noexcept {
        return doubles_of(wasm_f64x2_gt(bits_of(a), bits_of(b)) & bits_of(v));
    }
    GNOMON_LANES doubles drop_greater(doubles a, doubles b, doubles v) noexcept {
        return doubles_of(wasm_v128_andnot(bits_of(v), wasm_f64x2_gt(bits_of(a), bits_of(b))));
    }
    GNOMON_LANES_VOID void settle(doubles&) noexcept {}
    GNOMON_LANES doubles multiply(doubles a, doubles b) noexcept { return a * b; }
    GNOMON_LANES doubles divide(doubles a, doubles b) noexcept { return a / b; }
    GNOMON_LANES doubles multiply_pairs(doubles a, double b) noexcept {
        return doubles_of(wasm_f64x2_mul(bits_of(a), wasm_i64x2_shuffle(bits_of(a), wasm_f64x2_splat(b), 1, 2)));
    }
    GNOMON_LANES doubles add_product(doubles sum, doubles a, doubles b) noexcept { return sum + a * b; }
    GNOMON_LANES doubles add_and_mask(doubles a, std::uint64_t addend, std::uint64_t mask) noexcept {
        return doubles_of(wasm_i64x2_add(bits_of(a), wasm_u64x2_splat(addend)) & wasm_u64x2_splat(mask));
    }

    template <channel Channel> GNOMON_LANES doubles codes(const typename Channel::storage* from) noexcept {
        return doubles{static_cast<double>(Channel::code(from[0])), static_cast<double>(Channel::code(from[1]))};
    }
    template <channel Channel> GNOMON_LANES_VOID void store_codes(typename Channel::storage* to, floats a) noexcept {
        if constexpr (Channel::whole_codes)
            store_low(to, wasm_u32x4_trunc_sat_f32x4(bits_of(a)));
        else if constexpr (std::same_as<Channel, float32>)
            store(to, a + repeat(0.0f));
        else
            for (int i = 0; i < float_lanes; ++i) to[i] = Channel::store(static_cast<double>(a[i]));
    }
    template <channel Channel> GNOMON_LANES_VOID void store_codes(typename Channel::storage* to, doubles a) noexcept {
        for (int i = 0; i < double_lanes; ++i)
            if constexpr (Channel::whole_codes)
                to[i] = static_cast<typename Channel::storage>(a[i]);
            else
                to[i] = Channel::store(a[i]);
    }
    GNOMON_LANES doubles store_floats(float* to, doubles a) noexcept {
        const floats two = floats_of(wasm_f32x4_demote_f64x2_zero(bits_of(a))) + repeat(0.0f);
        wasm_v128_store64_lane(to, bits_of(two), 0);
        return lower(two);
    }
    template <channel Channel>
    GNOMON_LANES_VOID void cast_pairs(typename Channel::storage* to, unsigned where, doubles codes) noexcept {
        emulated<bytes>::template cast_pairs<Channel>(to, where, {{codes[0], codes[1]}});
    }

  private:
    GNOMON_LANES ints bits_of(masks a) noexcept { return reinterpret_cast<ints>(a); }
    GNOMON_LANES masks masks_of(ints a) noexcept { return reinterpret_cast<masks>(a); }
    GNOMON_LANES ints bits_of(floats a) noexcept { return reinterpret_cast<ints>(a); }
    GNOMON_LANES ints bits_of(doubles a) noexcept { return reinterpret_cast<ints>(a); }
    GNOMON_LANES floats floats_of(ints a) noexcept { return reinterpret_cast<floats>(a); }
    GNOMON_LANES doubles doubles_of(ints a) noexcept { return reinterpret_cast<doubles>(a); }
    GNOMON_LANES doubles lower(floats a) noexcept { return doubles_of(wasm_f64x2_promote_low_f32x4(bits_of(a))); }
    GNOMON_LANES floats upper(floats a) noexcept { return floats_of(wasm_i64x2_shuffle(bits_of(a), bits_of(a), 1, 1)); }
    GNOMON_LANES floats number(ints a) noexcept { return floats_of(wasm_f32x4_convert_u32x4(a)); }
};

} // namespace gnomon::inline GNOMON_BUILD
#endif
