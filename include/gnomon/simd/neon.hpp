// gnomon: soft shadow maps. Lanes of NEON, which every 64-bit ARM has: 16 bytes at a time. See emulated.hpp for what they mean.
#pragma once

#include <gnomon/simd/region.hpp>
#if GNOMON_NEON
#include <gnomon/simd/emulated.hpp>

#include <arm_neon.h>
#include <concepts>
#include <cstdint>
#include <cstring>

namespace gnomon::inline GNOMON_BUILD {

struct neon {
    static constexpr int bytes = 16;
    static constexpr int float_lanes = 4;
    static constexpr int double_lanes = 2;
    using ints = uint8x16_t;
    using floats = float32x4_t;
    using masks = uint32x4_t;
    using doubles = float64x2_t;

    GNOMON_LANES ints load(const void* from) noexcept { return vld1q_u8(static_cast<const std::uint8_t*>(from)); }
    GNOMON_LANES_VOID void store(void* to, ints a) noexcept { vst1q_u8(static_cast<std::uint8_t*>(to), a); }
    GNOMON_LANES_VOID void stream(void* to, ints a) noexcept { store(to, a); }
    GNOMON_LANES_VOID void fence() noexcept {}
    GNOMON_LANES_VOID void prefetch(const void* from) noexcept { __builtin_prefetch(from, 0, 2); }
    GNOMON_LANES ints repeat32(std::uint32_t v) noexcept { return bytes_of(vdupq_n_u32(v)); }
    GNOMON_LANES ints exclusive_or(ints a, ints b) noexcept { return veorq_u8(a, b); }

    GNOMON_LANES ints even_pairs8(ints a, ints b) noexcept { return vtrn1q_u8(a, b); }
    GNOMON_LANES ints odd_pairs8(ints a, ints b) noexcept { return vtrn2q_u8(a, b); }
    GNOMON_LANES ints multiply_pairs8(ints weights, ints values) noexcept {
        const uint16x8_t w = vreinterpretq_u16_u8(weights);
        const int16x8_t v = vreinterpretq_s16_u8(values), even = vshrq_n_s16(vshlq_n_s16(v, 8), 8), odd = vshrq_n_s16(v, 8);
        const int16x8_t of_even = vmulq_s16(vreinterpretq_s16_u16(vandq_u16(w, vdupq_n_u16(255))), even);
        return bytes_of(vmlaq_s16(of_even, vreinterpretq_s16_u16(vshrq_n_u16(w, 8)), odd));
    }
    GNOMON_LANES ints low_pairs8(ints a, ints b) noexcept { return vzip1q_u8(a, b); }
    GNOMON_LANES ints high_pairs8(ints a, ints b) noexcept { return vzip2q_u8(a, b); }
    GNOMON_LANES ints low_pairs16(ints a, ints b) noexcept { return bytes_of(vzip1q_s16(words(a), words(b))); }
    GNOMON_LANES ints high_pairs16(ints a, ints b) noexcept { return bytes_of(vzip2q_s16(words(a), words(b))); }
    GNOMON_LANES ints first_half(ints low, ints) noexcept { return low; }
    GNOMON_LANES ints second_half(ints, ints high) noexcept { return high; }
    GNOMON_LANES ints add16(ints a, ints b) noexcept { return bytes_of(vaddq_s16(words(a), words(b))); }
    GNOMON_LANES ints add_dot16(ints sum, ints weights, ints values) noexcept {
        const int16x8_t w = words(weights), v = words(values);
        const int32x4_t low = vmull_s16(vget_low_s16(w), vget_low_s16(v)), high = vmull_high_s16(w, v);
        return bytes_of(vaddq_s32(vreinterpretq_s32_u8(sum), vpaddq_s32(low, high)));
    }
    template <int Bits> GNOMON_LANES ints shift_right32(ints a) noexcept {
        return bytes_of(vshrq_n_s32(vreinterpretq_s32_u8(a), Bits));
    }
    GNOMON_LANES ints narrow32(ints a, ints b) noexcept { return bytes_of(vuzp1q_s16(words(a), words(b))); }
    GNOMON_LANES ints narrow16(ints a, ints b) noexcept { return vuzp1q_u8(a, b); }
    GNOMON_LANES ints interleave_byte2(ints a, ints b, ints c, ints d) noexcept {
        const uint32x4_t ab = vsliq_n_u32(lowered<16>(a), lowered<16>(b), 8);
        return bytes_of(vsliq_n_u32(vsliq_n_u32(ab, lowered<16>(c), 16), lowered<16>(d), 24));
    }
    GNOMON_LANES ints even_words(ints a, ints b) noexcept { return bytes_of(vuzp1q_s16(words(a), words(b))); }
    GNOMON_LANES ints odd_words(ints a, ints b) noexcept { return bytes_of(vuzp2q_s16(words(a), words(b))); }
    GNOMON_LANES ints even_lanes(ints a, ints) noexcept { return a; }
    GNOMON_LANES ints odd_lanes(ints, ints b) noexcept { return b; }
    GNOMON_LANES ints low_pairs32(ints a, ints b) noexcept { return bytes_of(vzip1q_u32(whole(a), whole(b))); }
    GNOMON_LANES ints high_pairs32(ints a, ints b) noexcept { return bytes_of(vzip2q_u32(whole(a), whole(b))); }
    template <int Shift> GNOMON_LANES ints join_words(ints a, ints b) noexcept {
        return bytes_of(vsliq_n_u32(lowered<Shift>(a), lowered<Shift>(b), 16));
    }
    GNOMON_LANES ints add32(ints a, ints b) noexcept { return bytes_of(vaddq_u32(whole(a), whole(b))); }
    GNOMON_LANES ints subtract32(ints a, ints b) noexcept { return bytes_of(vsubq_u32(whole(a), whole(b))); }
    template <typename Storage> GNOMON_LANES ints widen32(const Storage* from) noexcept {
        if constexpr (sizeof(Storage) == 1) {
            std::uint32_t four;
            std::memcpy(&four, from, sizeof four);
            return bytes_of(vmovl_u16(vget_low_u16(vmovl_u8(vreinterpret_u8_u32(vdup_n_u32(four))))));
        } else {
            return bytes_of(vmovl_u16(vld1_u16(from)));
        }
    }
    template <typename Storage> GNOMON_LANES_VOID void store_low(Storage* to, ints a) noexcept {
        const uint16x4_t low = vmovn_u32(whole(a));
        if constexpr (sizeof(Storage) == 1) {
            const std::uint32_t four = vget_lane_u32(vreinterpret_u32_u8(vmovn_u16(vcombine_u16(low, low))), 0);
            std::memcpy(to, &four, sizeof four);
        } else {
            vst1_u16(to, low);
        }
    }
    template <int Places> GNOMON_LANES ints shift_up32(ints a) noexcept { return vextq_u8(vdupq_n_u8(0), a, 16 - 4 * Places); }
    template <int Count> GNOMON_LANES ints repeat_last32(ints a) noexcept {
        constexpr auto from = [](int i) { return 4 - Count + i % Count; };
        return bytes_of(__builtin_shufflevector(whole(a), whole(a), from(0), from(1), from(2), from(3)));
    }
    template <int Shift> GNOMON_LANES ints multiply_shift32(ints a, ints b) noexcept {
        const uint64x2_t low = vmull_u32(vget_low_u32(whole(a)), vget_low_u32(whole(b))), high = vmull_high_u32(whole(a), whole(b));
        return bytes_of(
            vuzp1q_u32(vreinterpretq_u32_u64(vshrq_n_u64(low, Shift)), vreinterpretq_u32_u64(vshrq_n_u64(high, Shift))));
    }
    GNOMON_LANES ints either(ints a, ints b) noexcept { return vorrq_u8(a, b); }
    GNOMON_LANES ints subtract16(ints a, ints b) noexcept { return bytes_of(vsubq_u16(codes16(a), codes16(b))); }
    GNOMON_LANES ints subtract_to_zero16(ints a, ints b) noexcept { return bytes_of(vqsubq_u16(codes16(a), codes16(b))); }
    GNOMON_LANES ints multiply_low16(ints a, ints b) noexcept { return bytes_of(vmulq_u16(codes16(a), codes16(b))); }
    GNOMON_LANES ints multiply_high16(ints a, ints b) noexcept {
        const uint32x4_t low = vmull_u16(vget_low_u16(codes16(a)), vget_low_u16(codes16(b)));
        return bytes_of(vuzp2q_u16(codes16(bytes_of(low)), codes16(bytes_of(vmull_high_u16(codes16(a), codes16(b))))));
    }
    template <int Bits> GNOMON_LANES ints shift_left16(ints a) noexcept { return bytes_of(vshlq_n_u16(codes16(a), Bits)); }
    template <int Bits> GNOMON_LANES ints shift_right16(ints a) noexcept { return bytes_of(vshrq_n_u16(codes16(a), Bits)); }
    GNOMON_LANES ints greater16(ints a, ints b) noexcept { return bytes_of(vcgtq_u16(codes16(a), codes16(b))); }
    GNOMON_LANES ints upper_where_greater16(ints values, ints a, ints b) noexcept {
        return bytes_of(vandq_u16(vcgtq_u16(codes16(a), codes16(b)), vshrq_n_u16(codes16(values), 8)));
    }
    GNOMON_LANES bool any_equal16(ints a, ints b, ints c, ints d) noexcept {
        return vmaxvq_u16(vorrq_u16(vceqq_u16(codes16(a), codes16(b)), vceqq_u16(codes16(c), codes16(d)))) != 0;
    }

    GNOMON_LANES ints both(ints a, ints b) noexcept { return vandq_u8(a, b); }
    GNOMON_LANES ints multiply32(ints a, ints b) noexcept { return bytes_of(vmulq_u32(whole(a), whole(b))); }
    GNOMON_LANES ints lesser32(ints a, ints b) noexcept { return bytes_of(vminq_s32(signed32(a), signed32(b))); }
    GNOMON_LANES ints greater32(ints a, ints b) noexcept { return bytes_of(vmaxq_s32(signed32(a), signed32(b))); }
    template <int Bits> GNOMON_LANES ints shift_left32(ints a) noexcept { return bytes_of(vshlq_n_u32(whole(a), Bits)); }
    GNOMON_LANES ints floor32(floats a) noexcept { // the conversion knows other results of NaN and of what is too much
        return bytes_of(vbslq_s32(vcltq_f32(a, vdupq_n_f32(0x1p31f)), vcvtmq_s32_f32(a), vdupq_n_s32(-0x7FFFFFFF - 1)));
    }

    GNOMON_LANES_VOID void settle(ints& a) noexcept { GNOMON_SETTLE(a); }

    GNOMON_LANES floats load(const float* from) noexcept { return vld1q_f32(from); }
    GNOMON_LANES_VOID void store(float* to, floats a) noexcept { vst1q_f32(to, a); }
    GNOMON_LANES floats repeat(float v) noexcept { return vdupq_n_f32(v); }
    GNOMON_LANES floats add(floats a, floats b) noexcept { return vaddq_f32(a, b); }
    GNOMON_LANES floats subtract(floats a, floats b) noexcept { return vsubq_f32(a, b); }
    GNOMON_LANES floats multiply(floats a, floats b) noexcept { return vmulq_f32(a, b); }
    GNOMON_LANES floats divide(floats a, floats b) noexcept { return vdivq_f32(a, b); }
    GNOMON_LANES floats add_product(floats sum, floats a, floats b) noexcept {
        floats product = vmulq_f32(a, b);
        GNOMON_SETTLE(product);
        return vaddq_f32(sum, product);
    }
    GNOMON_LANES floats fraction(floats a, float b) noexcept { return vdivq_f32(a, vdupq_n_f32(b)); }
    GNOMON_LANES masks greater(floats a, floats b) noexcept { return vcgtq_f32(a, b); }
    GNOMON_LANES masks not_greater(floats a, floats b) noexcept { return vmvnq_u32(vcgtq_f32(a, b)); }
    GNOMON_LANES masks positive(floats a, floats b,
                                floats c) noexcept { // in double: the product is exact, and a sum keeps its sign
        const doubles low = vfmaq_f64(vcvt_f64_f32(vget_low_f32(c)), vcvt_f64_f32(vget_low_f32(a)), vcvt_f64_f32(vget_low_f32(b)));
        const doubles high = vfmaq_f64(vcvt_high_f64_f32(c), vcvt_high_f64_f32(a), vcvt_high_f64_f32(b));
        return vuzp1q_u32(vreinterpretq_u32_u64(vcgtzq_f64(low)), vreinterpretq_u32_u64(vcgtzq_f64(high)));
    }
    GNOMON_LANES masks both(masks a, masks b) noexcept { return vandq_u32(a, b); }
    GNOMON_LANES floats keep(masks where, floats a) noexcept {
        return vreinterpretq_f32_u32(vandq_u32(where, vreinterpretq_u32_f32(a)));
    }
    GNOMON_LANES floats drop(masks where, floats a) noexcept {
        return vreinterpretq_f32_u32(vbicq_u32(vreinterpretq_u32_f32(a), where));
    }
    template <channel Channel, int Channels> GNOMON_LANES floats codes_of(const typename Channel::storage* from, int c) noexcept {
        if constexpr (std::same_as<Channel, unorm8> && Channels == 2) {
            const uint16x4_t pairs = vreinterpret_u16_u8(vld1_u8(from));
            return number(c == 0 ? vand_u16(pairs, vdup_n_u16(255)) : vshr_n_u16(pairs, 8));
        } else if constexpr (std::same_as<Channel, unorm16> && Channels == 2) {
            const uint16x4x2_t pairs = vld2_u16(from);
            return number(pairs.val[c]);
        } else if constexpr (std::same_as<Channel, float32> && Channels == 1) {
            return load(from);
        } else if constexpr (std::same_as<Channel, half16> && Channels == 1) {
            return vcvt_f32_f16(vreinterpret_f16_u16(vld1_u16(from)));
        } else if constexpr (std::same_as<Channel, unorm16> && Channels == 1) {
            return number(vld1_u16(from));
        } else if constexpr (std::same_as<Channel, float32> && Channels == 2) {
            const float32x4x2_t pairs = vld2q_f32(from);
            return pairs.val[c];
        } else if constexpr (Channel::whole_codes) {
            const auto* const codes = from + c;
            return number(uint16x4_t{codes[0], codes[Channels], codes[2 * Channels], codes[3 * Channels]});
        } else {
            const typename Channel::storage side_by_side[] = {from[c], from[c + Channels], from[c + 2 * Channels],
                                                              from[c + 3 * Channels]};
            return codes_of<Channel, 1>(side_by_side, 0);
        }
    }
    GNOMON_LANES floats numbers(ints a) noexcept { return vcvtq_f32_s32(signed32(a)); }
    GNOMON_LANES bool any(masks a) noexcept { return vmaxvq_u32(a) != 0; }
    GNOMON_LANES floats lesser(floats a, floats b) noexcept { return vbslq_f32(vcltq_f32(b, a), b, a); }
    GNOMON_LANES_VOID void settle(floats& a) noexcept { GNOMON_SETTLE(a); }
    GNOMON_LANES bool every(masks a) noexcept { return vminvq_u32(a) != 0; }

    GNOMON_LANES doubles load(const double* from) noexcept { return vld1q_f64(from); }
    GNOMON_LANES_VOID void store(double* to, doubles a) noexcept { vst1q_f64(to, a); }
    GNOMON_LANES doubles repeat(double v) noexcept { return vdupq_n_f64(v); }
    GNOMON_LANES doubles add(doubles a, doubles b) noexcept { return vaddq_f64(a, b); }
    GNOMON_LANES doubles subtract(doubles a, doubles b) noexcept { return vsubq_f64(a, b); }
    GNOMON_LANES doubles smaller(doubles a, doubles b) noexcept { return vbslq_f64(vcltq_f64(a, b), a, b); }
    GNOMON_LANES doubles larger(doubles a, doubles b) noexcept { return vbslq_f64(vcgtq_f64(a, b), a, b); }
    GNOMON_LANES doubles truncate(doubles a) noexcept { return vcvtq_f64_s64(vcvtq_s64_f64(a)); }
    GNOMON_LANES unsigned greater_bits(doubles a, doubles b) noexcept {
        const uint64x2_t is = vcgtq_f64(a, b);
        return static_cast<unsigned>((vgetq_lane_u64(is, 0) & 1) | (vgetq_lane_u64(is, 1) & 2));
    }
    GNOMON_LANES doubles keep_greater(doubles a, doubles b, doubles v) noexcept {
        return vreinterpretq_f64_u64(vandq_u64(vreinterpretq_u64_f64(v), vcgtq_f64(a, b)));
    }
    GNOMON_LANES doubles drop_greater(doubles a, doubles b, doubles v) noexcept {
        return vreinterpretq_f64_u64(vbicq_u64(vreinterpretq_u64_f64(v), vcgtq_f64(a, b)));
    }
    GNOMON_LANES_VOID void settle(doubles& a) noexcept { GNOMON_SETTLE(a); }
    GNOMON_LANES doubles multiply(doubles a, doubles b) noexcept { return vmulq_f64(a, b); }
    GNOMON_LANES doubles divide(doubles a, doubles b) noexcept { return vdivq_f64(a, b); }
    GNOMON_LANES doubles multiply_pairs(doubles a, double b) noexcept {
        return vmulq_f64(a, vcombine_f64(vget_high_f64(a), vdup_n_f64(b)));
    }
    GNOMON_LANES doubles add_product(doubles sum, doubles a, doubles b) noexcept { return vfmaq_f64(sum, a, b); }
    GNOMON_LANES doubles add_and_mask(doubles a, std::uint64_t addend, std::uint64_t mask) noexcept {
        const uint64x2_t sum = vaddq_u64(vreinterpretq_u64_f64(a), vdupq_n_u64(addend));
        return vreinterpretq_f64_u64(vandq_u64(sum, vdupq_n_u64(mask)));
    }

    template <channel Channel> GNOMON_LANES doubles codes(const typename Channel::storage* from) noexcept {
        if constexpr (std::same_as<Channel, half16>) {
            std::uint32_t two;
            std::memcpy(&two, from, sizeof two);
            return vcvt_f64_f32(vget_low_f32(vcvt_f32_f16(vreinterpret_f16_u32(vdup_n_u32(two)))));
        } else {
            const double two[2] = {static_cast<double>(Channel::code(from[0])), static_cast<double>(Channel::code(from[1]))};
            return vld1q_f64(two);
        }
    }
    template <channel Channel> GNOMON_LANES_VOID void store_codes(typename Channel::storage* to, floats a) noexcept {
        if constexpr (Channel::whole_codes)
            store_low(to, bytes_of(vcvtq_u32_f32(a)));
        else if constexpr (std::same_as<Channel, half16>)
            vst1_u16(to, vreinterpret_u16_f16(vcvt_f16_f32(a)));
        else
            store(to, add(a, vdupq_n_f32(0.0f)));
    }
    template <channel Channel> GNOMON_LANES_VOID void store_codes(typename Channel::storage* to, doubles a) noexcept {
        if constexpr (Channel::whole_codes) {
            const uint64x2_t code = vcvtq_u64_f64(a);
            to[0] = static_cast<typename Channel::storage>(vgetq_lane_u64(code, 0));
            to[1] = static_cast<typename Channel::storage>(vgetq_lane_u64(code, 1));
        } else if constexpr (std::same_as<Channel, half16>) { // to odd and then to nearest rounds once
            const float32x2_t odd = vcvtx_f32_f64(a);
            const std::uint32_t two = vget_lane_u32(vreinterpret_u32_f16(vcvt_f16_f32(vcombine_f32(odd, odd))), 0);
            std::memcpy(to, &two, sizeof two);
        } else {
            static_assert(std::same_as<Channel, float32>, "gnomon: lanes know unorm8, unorm16, half16 and float32");
            vst1_f32(to, vadd_f32(vcvt_f32_f64(a), vdup_n_f32(0.0f)));
        }
    }
    GNOMON_LANES doubles store_floats(float* to, doubles a) noexcept {
        const float32x2_t two = vadd_f32(vcvt_f32_f64(a), vdup_n_f32(0.0f));
        vst1_f32(to, two);
        return vcvt_f64_f32(two);
    }
    template <channel Channel>
    GNOMON_LANES_VOID void cast_pairs(typename Channel::storage* to, unsigned where, doubles codes) noexcept {
        emulated<bytes>::template cast_pairs<Channel>(to, where, {{vgetq_lane_f64(codes, 0), vgetq_lane_f64(codes, 1)}});
    }

  private:
    GNOMON_LANES ints bytes_of(uint16x8_t a) noexcept { return vreinterpretq_u8_u16(a); }
    GNOMON_LANES ints bytes_of(int16x8_t a) noexcept { return vreinterpretq_u8_s16(a); }
    GNOMON_LANES ints bytes_of(int32x4_t a) noexcept { return vreinterpretq_u8_s32(a); }
    GNOMON_LANES ints bytes_of(uint32x4_t a) noexcept { return vreinterpretq_u8_u32(a); }
    GNOMON_LANES int16x8_t words(ints a) noexcept { return vreinterpretq_s16_u8(a); }
    GNOMON_LANES uint16x8_t codes16(ints a) noexcept { return vreinterpretq_u16_u8(a); }
    GNOMON_LANES int32x4_t signed32(ints a) noexcept { return vreinterpretq_s32_u8(a); }
    GNOMON_LANES uint32x4_t whole(ints a) noexcept { return vreinterpretq_u32_u8(a); }
    template <int Shift> GNOMON_LANES uint32x4_t lowered(ints a) noexcept {
        if constexpr (Shift == 0)
            return whole(a);
        else
            return vshrq_n_u32(whole(a), Shift);
    }
    GNOMON_LANES floats number(uint16x4_t a) noexcept { return vcvtq_f32_u32(vmovl_u16(a)); }
};

} // namespace gnomon::inline GNOMON_BUILD
#endif
