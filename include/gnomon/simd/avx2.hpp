// gnomon: soft shadow maps. Lanes of AVX2, FMA and F16C: 32 bytes at a time. See emulated.hpp for what they mean.
#pragma once

#include <gnomon/simd/region.hpp>
#if GNOMON_X86
#include <gnomon/simd/emulated.hpp>

#include <concepts>
#include <cstdint>
#include <cstring>
#include <immintrin.h>

#define GNOMON_AVX2 "avx2,fma,f16c"
GNOMON_TARGET_BEGIN(GNOMON_AVX2)
namespace gnomon::inline GNOMON_BUILD {

struct avx2 {
    static constexpr int bytes = 32;
    static constexpr int float_lanes = 8;
    static constexpr int double_lanes = 4;
    using ints = __m256i;
    using floats = __m256;
    using masks = __m256;
    using doubles = __m256d;

    GNOMON_LANES ints load(const void* from) noexcept { return _mm256_loadu_si256(static_cast<const __m256i*>(from)); }
    GNOMON_LANES_VOID void store(void* to, ints a) noexcept { _mm256_storeu_si256(static_cast<__m256i*>(to), a); }
    GNOMON_LANES_VOID void stream(void* to, ints a) noexcept { _mm256_stream_si256(static_cast<__m256i*>(to), a); }
    GNOMON_LANES_VOID void fence() noexcept { _mm_sfence(); }
    GNOMON_LANES_VOID void prefetch(const void* from) noexcept { _mm_prefetch(static_cast<const char*>(from), _MM_HINT_T1); }
    GNOMON_LANES ints repeat32(std::uint32_t v) noexcept { return _mm256_set1_epi32(static_cast<int>(v)); }
    GNOMON_LANES ints exclusive_or(ints a, ints b) noexcept { return _mm256_xor_si256(a, b); }

    GNOMON_LANES ints even_pairs8(ints a, ints b) noexcept {
        return _mm256_blendv_epi8(_mm256_slli_epi16(b, 8), a, _mm256_set1_epi16(255));
    }
    GNOMON_LANES ints odd_pairs8(ints a, ints b) noexcept {
        return _mm256_blendv_epi8(b, _mm256_srli_epi16(a, 8), _mm256_set1_epi16(255));
    }
    GNOMON_LANES ints multiply_pairs8(ints weights, ints values) noexcept { return _mm256_maddubs_epi16(weights, values); }
    GNOMON_LANES ints add16(ints a, ints b) noexcept { return _mm256_add_epi16(a, b); }
    GNOMON_LANES ints add_dot16(ints sum, ints weights, ints values) noexcept {
        return _mm256_add_epi32(sum, _mm256_madd_epi16(weights, values));
    }
    GNOMON_LANES ints interleave_byte2(ints a, ints b, ints c, ints d) noexcept {
        const ints even = _mm256_blend_epi16(_mm256_srli_epi32(a, 16), b, 0xAA),
                   odd = _mm256_blend_epi16(_mm256_srli_epi32(c, 16), d, 0xAA);
        const __m128i in_turn = _mm_setr_epi8(0, 1, 8, 9, 2, 3, 10, 11, 4, 5, 12, 13, 6, 7, 14, 15);
        return _mm256_shuffle_epi8(_mm256_packus_epi16(even, odd), _mm256_broadcastsi128_si256(in_turn));
    }
    GNOMON_LANES ints low_pairs8(ints a, ints b) noexcept { return _mm256_unpacklo_epi8(a, b); }
    GNOMON_LANES ints high_pairs8(ints a, ints b) noexcept { return _mm256_unpackhi_epi8(a, b); }
    GNOMON_LANES ints low_pairs16(ints a, ints b) noexcept { return _mm256_unpacklo_epi16(a, b); }
    GNOMON_LANES ints high_pairs16(ints a, ints b) noexcept { return _mm256_unpackhi_epi16(a, b); }
    GNOMON_LANES ints first_half(ints low, ints high) noexcept { return _mm256_permute2x128_si256(low, high, 0x20); }
    GNOMON_LANES ints second_half(ints low, ints high) noexcept { return _mm256_permute2x128_si256(low, high, 0x31); }
    template <int Bits> GNOMON_LANES ints shift_right32(ints a) noexcept { return _mm256_srai_epi32(a, Bits); }
    GNOMON_LANES ints narrow32(ints a, ints b) noexcept { return _mm256_packs_epi32(a, b); }
    GNOMON_LANES ints narrow16(ints a, ints b) noexcept { return _mm256_permute4x64_epi64(_mm256_packus_epi16(a, b), 0xD8); }
    GNOMON_LANES ints even_words(ints a, ints b) noexcept { return _mm256_unpacklo_epi64(words_apart(a), words_apart(b)); }
    GNOMON_LANES ints odd_words(ints a, ints b) noexcept { return _mm256_unpackhi_epi64(words_apart(a), words_apart(b)); }
    GNOMON_LANES ints even_lanes(ints a, ints b) noexcept { return _mm256_permute2x128_si256(a, b, 0x20); }
    GNOMON_LANES ints odd_lanes(ints a, ints b) noexcept { return _mm256_permute2x128_si256(a, b, 0x31); }
    GNOMON_LANES ints low_pairs32(ints a, ints b) noexcept { return _mm256_unpacklo_epi32(a, b); }
    GNOMON_LANES ints high_pairs32(ints a, ints b) noexcept { return _mm256_unpackhi_epi32(a, b); }
    template <int Shift> GNOMON_LANES ints join_words(ints a, ints b) noexcept {
        return _mm256_blend_epi16(_mm256_srli_epi32(a, Shift), _mm256_slli_epi32(b, 16 - Shift), 0xAA);
    }
    GNOMON_LANES ints add32(ints a, ints b) noexcept { return _mm256_add_epi32(a, b); }
    GNOMON_LANES ints subtract32(ints a, ints b) noexcept { return _mm256_sub_epi32(a, b); }
    template <typename Storage> GNOMON_LANES ints widen32(const Storage* from) noexcept {
        if constexpr (sizeof(Storage) == 1)
            return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)));
        else
            return _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from)));
    }
    template <typename Storage> GNOMON_LANES_VOID void store_low(Storage* to, ints a) noexcept {
        constexpr int bits = 8 * static_cast<int>(sizeof(Storage));
        const ints low = _mm256_and_si256(a, _mm256_set1_epi32((1 << bits) - 1));
        const __m128i words = _mm_packus_epi32(_mm256_castsi256_si128(low), _mm256_extracti128_si256(low, 1));
        if constexpr (sizeof(Storage) == 1)
            _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm_packus_epi16(words, words));
        else
            _mm_storeu_si128(reinterpret_cast<__m128i*>(to), words);
    }
    template <int Places> GNOMON_LANES ints shift_up32(ints a) noexcept {
        const ints below = _mm256_permute2x128_si256(a, a, 0x08); // nothing, and the lower half above it
        if constexpr (Places >= 4)
            return _mm256_slli_si256(below, 4 * (Places - 4));
        else
            return _mm256_alignr_epi8(a, below, 16 - 4 * Places);
    }
    template <int Count> GNOMON_LANES ints repeat_last32(ints a) noexcept {
        constexpr auto from = [](int i) { return 8 - Count + i % Count; };
        return _mm256_permutevar8x32_epi32(
            a, _mm256_setr_epi32(from(0), from(1), from(2), from(3), from(4), from(5), from(6), from(7)));
    }
    template <int Shift> GNOMON_LANES ints multiply_shift32(ints a, ints b) noexcept {
        const ints even = _mm256_srli_epi64(_mm256_mul_epu32(a, b), Shift);
        const ints odd = _mm256_srli_epi64(_mm256_mul_epu32(_mm256_srli_epi64(a, 32), _mm256_srli_epi64(b, 32)), Shift);
        return _mm256_or_si256(even, _mm256_slli_epi64(odd, 32));
    }
    GNOMON_LANES_VOID void settle(ints& a) noexcept { GNOMON_SETTLE(a); }

    GNOMON_LANES ints either(ints a, ints b) noexcept { return _mm256_or_si256(a, b); }
    GNOMON_LANES ints subtract16(ints a, ints b) noexcept { return _mm256_sub_epi16(a, b); }
    GNOMON_LANES ints subtract_to_zero16(ints a, ints b) noexcept { return _mm256_subs_epu16(a, b); }
    GNOMON_LANES ints multiply_low16(ints a, ints b) noexcept { return _mm256_mullo_epi16(a, b); }
    GNOMON_LANES ints multiply_high16(ints a, ints b) noexcept { return _mm256_mulhi_epu16(a, b); }
    template <int Bits> GNOMON_LANES ints shift_left16(ints a) noexcept { return _mm256_slli_epi16(a, Bits); }
    template <int Bits> GNOMON_LANES ints shift_right16(ints a) noexcept { return _mm256_srli_epi16(a, Bits); }
    GNOMON_LANES ints greater16(ints a, ints b) noexcept {
        const ints sign = _mm256_set1_epi16(-32768);
        return _mm256_cmpgt_epi16(_mm256_xor_si256(a, sign), _mm256_xor_si256(b, sign));
    }
    GNOMON_LANES ints upper_where_greater16(ints values, ints a, ints b) noexcept {
        const ints lit = _mm256_cmpeq_epi16(_mm256_subs_epu16(a, b), _mm256_setzero_si256());
        return _mm256_srli_epi16(_mm256_andnot_si256(lit, values), 8);
    }
    GNOMON_LANES bool any_equal16(ints a, ints b, ints c, ints d) noexcept {
        return _mm256_movemask_epi8(_mm256_or_si256(_mm256_cmpeq_epi16(a, b), _mm256_cmpeq_epi16(c, d))) != 0;
    }

    GNOMON_LANES ints both(ints a, ints b) noexcept { return _mm256_and_si256(a, b); }
    GNOMON_LANES ints multiply32(ints a, ints b) noexcept { return _mm256_mullo_epi32(a, b); }
    GNOMON_LANES ints lesser32(ints a, ints b) noexcept { return _mm256_min_epi32(a, b); }
    GNOMON_LANES ints greater32(ints a, ints b) noexcept { return _mm256_max_epi32(a, b); }
    template <int Bits> GNOMON_LANES ints shift_left32(ints a) noexcept { return _mm256_slli_epi32(a, Bits); }
    GNOMON_LANES ints floor32(floats a) noexcept { return _mm256_cvttps_epi32(_mm256_floor_ps(a)); }

    GNOMON_LANES floats load(const float* from) noexcept { return _mm256_loadu_ps(from); }
    GNOMON_LANES_VOID void store(float* to, floats a) noexcept { _mm256_storeu_ps(to, a); }
    GNOMON_LANES floats repeat(float v) noexcept { return _mm256_set1_ps(v); }
    GNOMON_LANES floats add(floats a, floats b) noexcept { return _mm256_add_ps(a, b); }
    GNOMON_LANES floats subtract(floats a, floats b) noexcept { return _mm256_sub_ps(a, b); }
    GNOMON_LANES floats multiply(floats a, floats b) noexcept { return _mm256_mul_ps(a, b); }
    GNOMON_LANES floats divide(floats a, floats b) noexcept { return _mm256_div_ps(a, b); }
    GNOMON_LANES floats add_product(floats sum, floats a, floats b) noexcept {
        floats product = _mm256_mul_ps(a, b);
        GNOMON_SETTLE(product);
        return _mm256_add_ps(sum, product);
    }
    GNOMON_LANES floats fraction(floats a, float b) noexcept { // the product is within an ulp, and what it lacks is exact
        const floats by = _mm256_set1_ps(b), inverse = _mm256_set1_ps(1.0f / b), q = _mm256_mul_ps(a, inverse);
        return _mm256_fmadd_ps(_mm256_fnmadd_ps(q, by, a), inverse, q);
    }
    GNOMON_LANES masks greater(floats a, floats b) noexcept { return _mm256_cmp_ps(a, b, _CMP_GT_OQ); }
    GNOMON_LANES masks not_greater(floats a, floats b) noexcept { return _mm256_cmp_ps(a, b, _CMP_NGT_UQ); }
    GNOMON_LANES masks positive(floats a, floats b, floats c) noexcept { // rounded once, a sum keeps its sign
        return greater(_mm256_fmadd_ps(a, b, c), _mm256_setzero_ps());
    }
    GNOMON_LANES masks both(masks a, masks b) noexcept { return _mm256_and_ps(a, b); }
    GNOMON_LANES floats keep(masks where, floats a) noexcept { return _mm256_and_ps(where, a); }
    GNOMON_LANES floats drop(masks where, floats a) noexcept { return _mm256_andnot_ps(where, a); }
    template <channel Channel, int Channels> GNOMON_LANES floats codes_of(const typename Channel::storage* from, int c) noexcept {
        if constexpr (std::same_as<Channel, unorm8> && Channels == 2) {
            const ints pairs = _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from)));
            return _mm256_cvtepi32_ps(c == 0 ? _mm256_and_si256(pairs, _mm256_set1_epi32(255)) : _mm256_srli_epi32(pairs, 8));
        } else if constexpr (std::same_as<Channel, unorm16> && Channels == 2) {
            const ints pairs = load(from);
            return _mm256_cvtepi32_ps(c == 0 ? _mm256_and_si256(pairs, _mm256_set1_epi32(65535)) : _mm256_srli_epi32(pairs, 16));
        } else if constexpr (std::same_as<Channel, float32> && Channels == 1) {
            return load(from);
        } else if constexpr (std::same_as<Channel, half16> && Channels == 1) {
            return _mm256_cvtph_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from)));
        } else if constexpr (Channel::whole_codes && Channels == 1) {
            return numbers(widen32(from));
        } else if constexpr (std::same_as<Channel, float32> && Channels == 2) {
            return channel_of_pairs(two_quarters(from, from + 8), two_quarters(from + 4, from + 12), c);
        } else if constexpr (std::same_as<Channel, half16> && Channels == 2) {
            const auto* const pairs = reinterpret_cast<const __m128i*>(from);
            const __m128i first = _mm_loadu_si128(pairs), second = _mm_loadu_si128(pairs + 1);
            return channel_of_pairs(_mm256_cvtph_ps(_mm_unpacklo_epi64(first, second)),
                                    _mm256_cvtph_ps(_mm_unpackhi_epi64(first, second)), c);
        } else if constexpr (Channel::whole_codes && Channels == 3) {
            return numbers(thirds(from + c));
        } else if constexpr (std::same_as<Channel, unorm8> && Channels == 4) {
            return numbers(_mm256_and_si256(_mm256_srl_epi32(load(from), _mm_cvtsi32_si128(8 * c)), _mm256_set1_epi32(255)));
        } else if constexpr (std::same_as<Channel, unorm16> && Channels == 4) {
            const ints words = _mm256_castps_si256(codes_of<float32, 2>(reinterpret_cast<const float*>(from), c / 2));
            return numbers(c % 2 == 0 ? _mm256_and_si256(words, _mm256_set1_epi32(65535)) : _mm256_srli_epi32(words, 16));
        } else { // copied side by side
            alignas(64) typename Channel::storage side_by_side[static_cast<std::size_t>(float_lanes)];
            GNOMON_UNROLL(16)
            for (int i = 0; i < float_lanes; ++i) side_by_side[i] = from[i * Channels + c];
            return codes_of<Channel, 1>(side_by_side, 0);
        }
    }

    /// Codes 0, 3, 6, 9, 12, 15, 18 and 21; none behind them is read.
    GNOMON_LANES ints thirds(const std::uint8_t* from) noexcept {
        const __m128i low = sixteen_bytes(from), high = sixteen_bytes(from + 6);
        return both_halves(_mm_shuffle_epi8(low, _mm_setr_epi32(byte(0), byte(3), byte(6), byte(9))),
                           _mm_shuffle_epi8(high, _mm_setr_epi32(byte(6), byte(9), byte(12), byte(15))));
    }
    GNOMON_LANES ints thirds(const std::uint16_t* from) noexcept {
        const __m128i low = sixteen_bytes(from), middle = sixteen_bytes(from + 8), high = sixteen_bytes(from + 14);
        return both_halves(_mm_or_si128(_mm_shuffle_epi8(low, _mm_setr_epi32(word(0), word(3), word(6), -1)),
                                        _mm_shuffle_epi8(middle, _mm_setr_epi32(-1, -1, -1, word(1)))),
                           _mm_or_si128(_mm_shuffle_epi8(middle, _mm_setr_epi32(word(4), word(7), -1, -1)),
                                        _mm_shuffle_epi8(high, _mm_setr_epi32(-1, -1, word(4), word(7)))));
    }

    GNOMON_LANES floats numbers(ints a) noexcept { return _mm256_cvtepi32_ps(a); }
    GNOMON_LANES bool any(masks a) noexcept { return _mm256_movemask_ps(a) != 0; }
    GNOMON_LANES floats lesser(floats a, floats b) noexcept { return _mm256_min_ps(b, a); }
    GNOMON_LANES_VOID void settle(floats& a) noexcept { GNOMON_SETTLE(a); }
    GNOMON_LANES bool every(masks a) noexcept { return _mm256_movemask_ps(a) == 255; }

    GNOMON_LANES doubles load(const double* from) noexcept { return _mm256_loadu_pd(from); }
    GNOMON_LANES_VOID void store(double* to, doubles a) noexcept { _mm256_storeu_pd(to, a); }
    GNOMON_LANES doubles repeat(double v) noexcept { return _mm256_set1_pd(v); }
    GNOMON_LANES doubles add(doubles a, doubles b) noexcept { return _mm256_add_pd(a, b); }
    GNOMON_LANES doubles multiply(doubles a, doubles b) noexcept { return _mm256_mul_pd(a, b); }
    GNOMON_LANES doubles divide(doubles a, doubles b) noexcept { return _mm256_div_pd(a, b); }
    GNOMON_LANES doubles multiply_pairs(doubles a, double b) noexcept {
        return _mm256_mul_pd(a, _mm256_blend_pd(_mm256_permute_pd(a, 0x5), _mm256_set1_pd(b), 0xA));
    }
    GNOMON_LANES doubles add_product(doubles sum, doubles a, doubles b) noexcept { return _mm256_fmadd_pd(a, b, sum); }
    GNOMON_LANES doubles add_and_mask(doubles a, std::uint64_t addend, std::uint64_t mask) noexcept {
        const ints sum = _mm256_add_epi64(_mm256_castpd_si256(a), _mm256_set1_epi64x(static_cast<long long>(addend)));
        return _mm256_castsi256_pd(_mm256_and_si256(sum, _mm256_set1_epi64x(static_cast<long long>(mask))));
    }

    GNOMON_LANES doubles subtract(doubles a, doubles b) noexcept { return _mm256_sub_pd(a, b); }
    GNOMON_LANES doubles smaller(doubles a, doubles b) noexcept { return _mm256_min_pd(a, b); }
    GNOMON_LANES doubles larger(doubles a, doubles b) noexcept { return _mm256_max_pd(a, b); }
    GNOMON_LANES doubles truncate(doubles a) noexcept { return _mm256_cvtepi32_pd(_mm256_cvttpd_epi32(a)); }
    GNOMON_LANES unsigned greater_bits(doubles a, doubles b) noexcept {
        return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_GT_OQ)));
    }
    GNOMON_LANES doubles keep_greater(doubles a, doubles b, doubles v) noexcept {
        return _mm256_and_pd(_mm256_cmp_pd(a, b, _CMP_GT_OQ), v);
    }
    GNOMON_LANES doubles drop_greater(doubles a, doubles b, doubles v) noexcept {
        return _mm256_andnot_pd(_mm256_cmp_pd(a, b, _CMP_GT_OQ), v);
    }
    GNOMON_LANES_VOID void settle(doubles& a) noexcept { GNOMON_SETTLE(a); }

    template <channel Channel> GNOMON_LANES doubles codes(const typename Channel::storage* from) noexcept {
        if constexpr (std::same_as<Channel, unorm8>) {
            int four;
            std::memcpy(&four, from, sizeof four);
            return _mm256_cvtepi32_pd(_mm_cvtepu8_epi32(_mm_cvtsi32_si128(four)));
        } else if constexpr (std::same_as<Channel, unorm16>) {
            return _mm256_cvtepi32_pd(_mm_cvtepu16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from))));
        } else if constexpr (std::same_as<Channel, half16>) {
            return _mm256_cvtps_pd(_mm_cvtph_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from))));
        } else {
            static_assert(std::same_as<Channel, float32>, "gnomon: lanes know unorm8, unorm16, half16 and float32");
            return _mm256_cvtps_pd(_mm_loadu_ps(from));
        }
    }
    template <channel Channel> GNOMON_LANES_VOID void store_codes(typename Channel::storage* to, floats a) noexcept {
        if constexpr (Channel::whole_codes)
            store_low(to, _mm256_cvttps_epi32(a));
        else if constexpr (std::same_as<Channel, half16>)
            _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm256_cvtps_ph(a, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
        else
            store(to, add(a, _mm256_setzero_ps()));
    }
    template <channel Channel> GNOMON_LANES_VOID void store_codes(typename Channel::storage* to, doubles a) noexcept {
        if constexpr (std::same_as<Channel, unorm8>) {
            const __m128i words = _mm_packus_epi32(_mm256_cvttpd_epi32(a), _mm_setzero_si128());
            const int four = _mm_cvtsi128_si32(_mm_packus_epi16(words, words));
            std::memcpy(to, &four, sizeof four);
        } else if constexpr (std::same_as<Channel, unorm16>) {
            const __m128i words = _mm_packus_epi32(_mm256_cvttpd_epi32(a), _mm_setzero_si128());
            _mm_storel_epi64(reinterpret_cast<__m128i*>(to), words);
        } else if constexpr (std::same_as<Channel, half16>) {
            const __m128i halves = _mm_cvtps_ph(_mm256_cvtpd_ps(to_odd(a)), _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
            _mm_storel_epi64(reinterpret_cast<__m128i*>(to), halves);
        } else {
            static_assert(std::same_as<Channel, float32>, "gnomon: lanes know unorm8, unorm16, half16 and float32");
            _mm_storeu_ps(to, _mm_add_ps(_mm256_cvtpd_ps(a), _mm_setzero_ps()));
        }
    }
    GNOMON_LANES doubles store_floats(float* to, doubles a) noexcept {
        const __m128 four = _mm_add_ps(_mm256_cvtpd_ps(a), _mm_setzero_ps());
        _mm_storeu_ps(to, four);
        return _mm256_cvtps_pd(four);
    }
    template <channel Channel>
    GNOMON_LANES_VOID void cast_pairs(typename Channel::storage* to, unsigned where, doubles codes) noexcept {
        constexpr int bits = 8 * sizeof(typename Channel::storage), full = (1 << bits) - 1;
        if (bits == 8 && where != 0xF) { // no part of a register is stored by itself
            double lane[4];
            store(lane, codes);
            emulated<bytes>::template cast_pairs<Channel>(to, where, {{lane[0], lane[1], lane[2], lane[3]}});
            return;
        }
        const __m128i code = _mm256_cvttpd_epi32(codes), each = _mm_setr_epi32(1, 2, 4, 8);
        const __m128i asked = _mm_cmpeq_epi32(_mm_and_si128(_mm_set1_epi32(static_cast<int>(where)), each), each);
        const __m128i old = bits == 8 ? _mm_cvtepu16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(to)))
                                      : _mm_maskload_epi32(reinterpret_cast<const int*>(to), asked);
        const __m128i empty = _mm_cmpeq_epi32(_mm_srli_epi32(old, bits), _mm_setzero_si128());
        const __m128i nearer = _mm_cmpgt_epi32(code, _mm_and_si128(old, _mm_set1_epi32(full)));
        const __m128i take = _mm_and_si128(_mm_or_si128(empty, nearer), asked);
        const __m128i pairs = _mm_or_si128(code, _mm_slli_epi32(_mm_set1_epi32(full), bits));
        if constexpr (bits == 8)
            _mm_storel_epi64(reinterpret_cast<__m128i*>(to),
                             _mm_packus_epi32(_mm_blendv_epi8(old, pairs, take), _mm_setzero_si128()));
        else
            _mm_maskstore_epi32(reinterpret_cast<int*>(to), take, pairs);
    }

  private:
    GNOMON_LANES __m128i sixteen_bytes(const void* from) noexcept { return _mm_loadu_si128(static_cast<const __m128i*>(from)); }
    GNOMON_LANES ints both_halves(__m128i low, __m128i high) noexcept {
        return _mm256_inserti128_si256(_mm256_castsi128_si256(low), high, 1);
    }
    /// Where a shuffle of bytes takes a number of 32 bits from: the `i`th of 16 bytes, or of 8 words.
    [[nodiscard]] static constexpr int byte(int i) noexcept { return static_cast<int>(0x80808000u | static_cast<unsigned>(i)); }
    [[nodiscard]] static constexpr int word(int i) noexcept {
        return static_cast<int>(0x80800100u | static_cast<unsigned>(2 * i) * 0x101u);
    }
    /// In each 16 bytes: words 0, 2, 4, 6, and 1, 3, 5, 7 behind them.
    GNOMON_LANES ints words_apart(ints a) noexcept {
        return _mm256_shuffle_epi8(
            a, _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 1, 4, 5, 8, 9, 12, 13, 2, 3, 6, 7, 10, 11, 14, 15)));
    }
    GNOMON_LANES floats two_quarters(const float* low, const float* high) noexcept {
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high), 1);
    }
    /// Of the pairs 0, 1, 4, 5, and 2, 3, 6, 7.
    GNOMON_LANES floats channel_of_pairs(floats a, floats b, int c) noexcept {
        return c == 0 ? _mm256_shuffle_ps(a, b, 0x88) : _mm256_shuffle_ps(a, b, 0xDD);
    }
    /// Cut to the 24 bits of a float, the last one set if anything was lost: rounding that to a half rounds once.
    GNOMON_LANES doubles to_odd(doubles a) noexcept {
        const ints lost = _mm256_set1_epi64x((1 << 29) - 1), bits = _mm256_castpd_si256(a);
        const ints carried = _mm256_add_epi64(_mm256_and_si256(bits, lost), lost);
        return _mm256_castsi256_pd(_mm256_andnot_si256(lost, _mm256_or_si256(bits, carried)));
    }
};

} // namespace gnomon::inline GNOMON_BUILD
GNOMON_TARGET_END
#endif
