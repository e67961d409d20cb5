// gnomon: soft shadow maps. Lanes of AVX-512 as of Ice Lake and Zen 4: 64 bytes at a time. See emulated.hpp for what they mean.
#pragma once

#include <gnomon/simd/region.hpp>
#if GNOMON_X86
#include <gnomon/simd/avx2.hpp>
#include <gnomon/simd/emulated.hpp>

#include <array>
#include <concepts>
#include <cstdint>
#include <immintrin.h>

#define GNOMON_AVX512 "avx2,fma,f16c,avx512f,avx512bw,avx512dq,avx512vl,avx512vnni"
GNOMON_TARGET_BEGIN(GNOMON_AVX512)
namespace gnomon::inline GNOMON_BUILD {

struct avx512 {
    static constexpr int bytes = 64;
    static constexpr int float_lanes = 16;
    static constexpr int double_lanes = 8;
    using ints = __m512i;
    using floats = __m512;
    using masks = __mmask16;
    using doubles = __m512d;

    GNOMON_LANES ints load(const void* from) noexcept { return _mm512_loadu_si512(from); }
    GNOMON_LANES_VOID void store(void* to, ints a) noexcept { _mm512_storeu_si512(to, a); }
    GNOMON_LANES_VOID void stream(void* to, ints a) noexcept { _mm512_stream_si512(static_cast<__m512i*>(to), a); }
    GNOMON_LANES_VOID void fence() noexcept { _mm_sfence(); }
    GNOMON_LANES_VOID void prefetch(const void* from) noexcept { _mm_prefetch(static_cast<const char*>(from), _MM_HINT_T1); }
    GNOMON_LANES ints repeat32(std::uint32_t v) noexcept { return _mm512_set1_epi32(static_cast<int>(v)); }
    GNOMON_LANES ints exclusive_or(ints a, ints b) noexcept { return _mm512_xor_si512(a, b); }

    GNOMON_LANES ints even_pairs8(ints a, ints b) noexcept { return chosen(_mm512_set1_epi16(255), a, _mm512_slli_epi16(b, 8)); }
    GNOMON_LANES ints odd_pairs8(ints a, ints b) noexcept { return chosen(_mm512_set1_epi16(255), _mm512_srli_epi16(a, 8), b); }
    GNOMON_LANES ints multiply_pairs8(ints weights, ints values) noexcept { return _mm512_maddubs_epi16(weights, values); }
    GNOMON_LANES ints add16(ints a, ints b) noexcept { return _mm512_add_epi16(a, b); }
    GNOMON_LANES ints add_dot16(ints sum, ints weights, ints values) noexcept { return _mm512_dpwssd_epi32(sum, weights, values); }
    GNOMON_LANES ints interleave_byte2(ints a, ints b, ints c, ints d) noexcept {
        const ints ab = chosen(_mm512_set1_epi32(0xFF00), _mm512_maskz_srli_epi32(all, b, 8), _mm512_maskz_srli_epi32(all, a, 16));
        const ints cd = chosen(_mm512_set1_epi32(0xFF0000), c, _mm512_maskz_slli_epi32(all, d, 8));
        return chosen(_mm512_set1_epi32(0xFFFF), ab, cd);
    }
    GNOMON_LANES ints low_pairs8(ints a, ints b) noexcept { return _mm512_unpacklo_epi8(a, b); }
    GNOMON_LANES ints high_pairs8(ints a, ints b) noexcept { return _mm512_unpackhi_epi8(a, b); }
    GNOMON_LANES ints low_pairs16(ints a, ints b) noexcept { return _mm512_unpacklo_epi16(a, b); }
    GNOMON_LANES ints high_pairs16(ints a, ints b) noexcept { return _mm512_unpackhi_epi16(a, b); }
    GNOMON_LANES ints first_half(ints low, ints high) noexcept {
        return _mm512_permutex2var_epi64(low, _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11), high);
    }
    GNOMON_LANES ints second_half(ints low, ints high) noexcept {
        return _mm512_permutex2var_epi64(low, _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15), high);
    }
    template <int Bits> GNOMON_LANES ints shift_right32(ints a) noexcept { return _mm512_maskz_srai_epi32(all, a, Bits); }
    GNOMON_LANES ints narrow32(ints a, ints b) noexcept { return _mm512_packs_epi32(a, b); }
    GNOMON_LANES ints narrow16(ints a, ints b) noexcept {
        return _mm512_maskz_permutexvar_epi64(eight, _mm512_setr_epi64(0, 2, 4, 6, 1, 3, 5, 7), _mm512_packus_epi16(a, b));
    }
    GNOMON_LANES ints add_dot8(ints sum, ints weights, ints values) noexcept { return _mm512_dpbusd_epi32(sum, values, weights); }
    GNOMON_LANES ints even_words(ints a, ints b) noexcept { return _mm512_permutex2var_epi16(a, word_order(0), b); }
    GNOMON_LANES ints odd_words(ints a, ints b) noexcept { return _mm512_permutex2var_epi16(a, word_order(1), b); }
    GNOMON_LANES ints even_lanes(ints a, ints b) noexcept { return _mm512_maskz_shuffle_i64x2(eight, a, b, 0x88); }
    GNOMON_LANES ints odd_lanes(ints a, ints b) noexcept { return _mm512_maskz_shuffle_i64x2(eight, a, b, 0xDD); }
    GNOMON_LANES ints low_pairs32(ints a, ints b) noexcept { return _mm512_maskz_unpacklo_epi32(all, a, b); }
    GNOMON_LANES ints high_pairs32(ints a, ints b) noexcept { return _mm512_maskz_unpackhi_epi32(all, a, b); }
    template <int Shift> GNOMON_LANES ints join_words(ints a, ints b) noexcept {
        return chosen(_mm512_set1_epi32(0xFFFF), _mm512_maskz_srli_epi32(all, a, Shift),
                      _mm512_maskz_slli_epi32(all, b, 16 - Shift));
    }
    GNOMON_LANES ints add32(ints a, ints b) noexcept { return _mm512_add_epi32(a, b); }
    GNOMON_LANES ints subtract32(ints a, ints b) noexcept { return _mm512_sub_epi32(a, b); }
    template <typename Storage> GNOMON_LANES ints widen32(const Storage* from) noexcept {
        if constexpr (sizeof(Storage) == 1)
            return _mm512_maskz_cvtepu8_epi32(all, _mm_loadu_si128(reinterpret_cast<const __m128i*>(from)));
        else
            return _mm512_maskz_cvtepu16_epi32(all, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)));
    }
    template <typename Storage> GNOMON_LANES_VOID void store_low(Storage* to, ints a) noexcept {
        if constexpr (sizeof(Storage) == 1)
            _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm512_maskz_cvtepi32_epi8(all, a));
        else
            _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm512_maskz_cvtepi32_epi16(all, a));
    }
    template <int Places> GNOMON_LANES ints shift_up32(ints a) noexcept {
        return _mm512_maskz_alignr_epi32(all, a, _mm512_setzero_si512(), 16 - Places);
    }
    template <int Count> GNOMON_LANES ints repeat_last32(ints a) noexcept {
        alignas(64) static constexpr auto from = [] {
            std::array<std::int32_t, 16> places{};
            for (int i = 0; i < 16; ++i) places[static_cast<std::size_t>(i)] = 16 - Count + i % Count;
            return places;
        }();
        return _mm512_maskz_permutexvar_epi32(all, load(from.data()), a);
    }
    template <int Shift> GNOMON_LANES ints multiply_shift32(ints a, ints b) noexcept {
        const ints even = _mm512_maskz_srli_epi64(eight, _mm512_maskz_mul_epu32(eight, a, b), Shift);
        const ints upper_a = _mm512_maskz_srli_epi64(eight, a, 32), upper_b = _mm512_maskz_srli_epi64(eight, b, 32);
        const ints odd = _mm512_maskz_srli_epi64(eight, _mm512_maskz_mul_epu32(eight, upper_a, upper_b), Shift);
        return _mm512_or_si512(even, _mm512_maskz_slli_epi64(eight, odd, 32));
    }
    template <int Places> GNOMON_LANES floats straddle(floats a, floats b) noexcept {
        return _mm512_castsi512_ps(_mm512_maskz_alignr_epi32(all, _mm512_castps_si512(b), _mm512_castps_si512(a), Places));
    }
    template <int Places> GNOMON_LANES doubles straddle(doubles a, doubles b) noexcept {
        return _mm512_castsi512_pd(_mm512_maskz_alignr_epi64(eight, _mm512_castpd_si512(b), _mm512_castpd_si512(a), Places));
    }
    GNOMON_LANES_VOID void settle(ints& a) noexcept { GNOMON_SETTLE(a); }

    GNOMON_LANES ints either(ints a, ints b) noexcept { return _mm512_or_si512(a, b); }
    GNOMON_LANES ints subtract16(ints a, ints b) noexcept { return _mm512_sub_epi16(a, b); }
    GNOMON_LANES ints subtract_to_zero16(ints a, ints b) noexcept { return _mm512_subs_epu16(a, b); }
    GNOMON_LANES ints multiply_low16(ints a, ints b) noexcept { return _mm512_mullo_epi16(a, b); }
    GNOMON_LANES ints multiply_high16(ints a, ints b) noexcept { return _mm512_mulhi_epu16(a, b); }
    template <int Bits> GNOMON_LANES ints shift_left16(ints a) noexcept { return _mm512_slli_epi16(a, Bits); }
    template <int Bits> GNOMON_LANES ints shift_right16(ints a) noexcept { return _mm512_srli_epi16(a, Bits); }
    GNOMON_LANES ints greater16(ints a, ints b) noexcept { return _mm512_movm_epi16(_mm512_cmpgt_epu16_mask(a, b)); }
    GNOMON_LANES ints upper_where_greater16(ints values, ints a, ints b) noexcept {
        return _mm512_maskz_srli_epi16(_mm512_cmpgt_epu16_mask(a, b), values, 8);
    }
    GNOMON_LANES bool any_equal16(ints a, ints b, ints c, ints d) noexcept {
        return (_mm512_cmpeq_epi16_mask(a, b) | _mm512_cmpeq_epi16_mask(c, d)) != 0;
    }

    GNOMON_LANES ints both(ints a, ints b) noexcept { return _mm512_and_si512(a, b); }
    GNOMON_LANES ints multiply32(ints a, ints b) noexcept { return _mm512_mullo_epi32(a, b); }
    GNOMON_LANES ints lesser32(ints a, ints b) noexcept { return _mm512_maskz_min_epi32(all, a, b); }
    GNOMON_LANES ints greater32(ints a, ints b) noexcept { return _mm512_maskz_max_epi32(all, a, b); }
    template <int Bits> GNOMON_LANES ints shift_left32(ints a) noexcept { return _mm512_maskz_slli_epi32(all, a, Bits); }
    GNOMON_LANES ints floor32(floats a) noexcept { return _mm512_maskz_cvttps_epi32(all, _mm512_floor_ps(a)); }

    GNOMON_LANES floats load(const float* from) noexcept { return _mm512_loadu_ps(from); }
    GNOMON_LANES_VOID void store(float* to, floats a) noexcept { _mm512_storeu_ps(to, a); }
    GNOMON_LANES floats repeat(float v) noexcept { return _mm512_set1_ps(v); }
    GNOMON_LANES floats add(floats a, floats b) noexcept { return _mm512_add_ps(a, b); }
    GNOMON_LANES floats subtract(floats a, floats b) noexcept { return _mm512_sub_ps(a, b); }
    GNOMON_LANES floats multiply(floats a, floats b) noexcept { return _mm512_mul_ps(a, b); }
    GNOMON_LANES floats divide(floats a, floats b) noexcept { return _mm512_div_ps(a, b); }
    GNOMON_LANES floats add_product(floats sum, floats a, floats b) noexcept {
        floats product = _mm512_mul_ps(a, b);
        GNOMON_SETTLE(product);
        return _mm512_add_ps(sum, product);
    }
    GNOMON_LANES floats fraction(floats a, float b) noexcept { // the product is within an ulp, and what it lacks is exact
        const floats by = _mm512_set1_ps(b), inverse = _mm512_set1_ps(1.0f / b), q = _mm512_mul_ps(a, inverse);
        return _mm512_fmadd_ps(_mm512_fnmadd_ps(q, by, a), inverse, q);
    }
    GNOMON_LANES masks greater(floats a, floats b) noexcept { return _mm512_cmp_ps_mask(a, b, _CMP_GT_OQ); }
    GNOMON_LANES masks not_greater(floats a, floats b) noexcept { return _mm512_cmp_ps_mask(a, b, _CMP_NGT_UQ); }
    GNOMON_LANES masks positive(floats a, floats b, floats c) noexcept { // rounded once, a sum keeps its sign
        return greater(_mm512_fmadd_ps(a, b, c), _mm512_setzero_ps());
    }
    GNOMON_LANES masks both(masks a, masks b) noexcept { return static_cast<masks>(a & b); }
    GNOMON_LANES floats keep(masks where, floats a) noexcept { return _mm512_maskz_mov_ps(where, a); }
    GNOMON_LANES floats drop(masks where, floats a) noexcept { return _mm512_maskz_mov_ps(_knot_mask16(where), a); }
    template <channel Channel, int Channels> GNOMON_LANES floats codes_of(const typename Channel::storage* from, int c) noexcept {
        if constexpr (std::same_as<Channel, unorm8> && Channels == 2) {
            const ints pairs = _mm512_maskz_cvtepu16_epi32(all, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)));
            return numbers(c == 0 ? _mm512_and_si512(pairs, _mm512_set1_epi32(255)) : _mm512_maskz_srli_epi32(all, pairs, 8));
        } else if constexpr (std::same_as<Channel, unorm16> && Channels == 2) {
            const ints pairs = load(from);
            return numbers(c == 0 ? _mm512_and_si512(pairs, _mm512_set1_epi32(65535)) : _mm512_maskz_srli_epi32(all, pairs, 16));
        } else if constexpr (std::same_as<Channel, float32> && Channels == 1) {
            return load(from);
        } else if constexpr (std::same_as<Channel, half16> && Channels == 1) {
            return _mm512_maskz_cvtph_ps(all, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)));
        } else if constexpr (Channel::whole_codes && Channels == 1) {
            return numbers(widen32(from));
        } else if constexpr (std::same_as<Channel, float32> && Channels == 2) {
            return channel_of_pairs(load(from), load(from + 16), c);
        } else if constexpr (std::same_as<Channel, half16> && Channels == 2) {
            const auto* const pairs = reinterpret_cast<const __m256i*>(from);
            return channel_of_pairs(_mm512_maskz_cvtph_ps(all, _mm256_loadu_si256(pairs)),
                                    _mm512_maskz_cvtph_ps(all, _mm256_loadu_si256(pairs + 1)), c);
        } else if constexpr (Channel::whole_codes && Channels == 3) {
            const ints first = _mm512_maskz_broadcast_i64x4(0x0F, avx2::thirds(from + c));
            return numbers(_mm512_mask_broadcast_i64x4(first, 0xF0, avx2::thirds(from + c + 24)));
        } else if constexpr (std::same_as<Channel, unorm8> && Channels == 4) {
            return numbers(
                _mm512_and_si512(_mm512_maskz_srl_epi32(all, load(from), _mm_cvtsi32_si128(8 * c)), _mm512_set1_epi32(255)));
        } else if constexpr (std::same_as<Channel, unorm16> && Channels == 4) {
            const ints words = _mm512_castps_si512(codes_of<float32, 2>(reinterpret_cast<const float*>(from), c / 2));
            return numbers(c % 2 == 0 ? _mm512_and_si512(words, _mm512_set1_epi32(65535))
                                      : _mm512_maskz_srli_epi32(all, words, 16));
        } else { // copied side by side
            alignas(64) typename Channel::storage side_by_side[static_cast<std::size_t>(float_lanes)];
            GNOMON_UNROLL(16)
            for (int i = 0; i < float_lanes; ++i) side_by_side[i] = from[i * Channels + c];
            return codes_of<Channel, 1>(side_by_side, 0);
        }
    }

    GNOMON_LANES floats numbers(ints a) noexcept { return _mm512_maskz_cvtepi32_ps(all, a); }
    GNOMON_LANES bool any(masks a) noexcept { return a != 0; }
    GNOMON_LANES floats lesser(floats a, floats b) noexcept { return _mm512_maskz_min_ps(all, b, a); }
    GNOMON_LANES_VOID void settle(floats& a) noexcept { GNOMON_SETTLE(a); }
    GNOMON_LANES bool every(masks a) noexcept { return a == 0xFFFF; }

    GNOMON_LANES doubles load(const double* from) noexcept { return _mm512_loadu_pd(from); }
    GNOMON_LANES_VOID void store(double* to, doubles a) noexcept { _mm512_storeu_pd(to, a); }
    GNOMON_LANES doubles repeat(double v) noexcept { return _mm512_set1_pd(v); }
    GNOMON_LANES doubles add(doubles a, doubles b) noexcept { return _mm512_add_pd(a, b); }
    GNOMON_LANES doubles multiply(doubles a, doubles b) noexcept { return _mm512_mul_pd(a, b); }
    GNOMON_LANES doubles divide(doubles a, doubles b) noexcept { return _mm512_div_pd(a, b); }
    GNOMON_LANES doubles multiply_pairs(doubles a, double b) noexcept {
        return _mm512_mul_pd(a, _mm512_mask_mov_pd(_mm512_set1_pd(b), 0x55, _mm512_maskz_permute_pd(eight, a, 0x55)));
    }
    GNOMON_LANES doubles add_product(doubles sum, doubles a, doubles b) noexcept { return _mm512_fmadd_pd(a, b, sum); }
    GNOMON_LANES doubles add_and_mask(doubles a, std::uint64_t addend, std::uint64_t mask) noexcept {
        const ints sum = _mm512_add_epi64(_mm512_castpd_si512(a), _mm512_set1_epi64(static_cast<long long>(addend)));
        return _mm512_castsi512_pd(_mm512_and_si512(sum, _mm512_set1_epi64(static_cast<long long>(mask))));
    }

    GNOMON_LANES doubles subtract(doubles a, doubles b) noexcept { return _mm512_sub_pd(a, b); }
    GNOMON_LANES doubles smaller(doubles a, doubles b) noexcept { return _mm512_maskz_min_pd(eight, a, b); }
    GNOMON_LANES doubles larger(doubles a, doubles b) noexcept { return _mm512_maskz_max_pd(eight, a, b); }
    GNOMON_LANES doubles truncate(doubles a) noexcept {
        return _mm512_maskz_cvtepi32_pd(eight, _mm512_maskz_cvttpd_epi32(eight, a));
    }
    GNOMON_LANES unsigned greater_bits(doubles a, doubles b) noexcept { return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ); }
    GNOMON_LANES doubles keep_greater(doubles a, doubles b, doubles v) noexcept {
        return _mm512_maskz_mov_pd(_mm512_cmp_pd_mask(a, b, _CMP_GT_OQ), v);
    }
    GNOMON_LANES doubles drop_greater(doubles a, doubles b, doubles v) noexcept {
        return _mm512_maskz_mov_pd(_mm512_cmp_pd_mask(a, b, _CMP_NGT_UQ), v);
    }
    GNOMON_LANES_VOID void settle(doubles& a) noexcept { GNOMON_SETTLE(a); }

    template <channel Channel> GNOMON_LANES doubles codes(const typename Channel::storage* from) noexcept {
        if constexpr (std::same_as<Channel, unorm8>) {
            return _mm512_maskz_cvtepi32_pd(eight, _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from))));
        } else if constexpr (std::same_as<Channel, unorm16>) {
            return _mm512_maskz_cvtepi32_pd(eight, _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))));
        } else if constexpr (std::same_as<Channel, half16>) {
            return _mm512_maskz_cvtps_pd(eight, _mm256_cvtph_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))));
        } else {
            static_assert(std::same_as<Channel, float32>, "gnomon: lanes know unorm8, unorm16, half16 and float32");
            return _mm512_maskz_cvtps_pd(eight, _mm256_loadu_ps(from));
        }
    }
    template <channel Channel> GNOMON_LANES_VOID void store_codes(typename Channel::storage* to, floats a) noexcept {
        if constexpr (Channel::whole_codes)
            store_low(to, _mm512_maskz_cvttps_epi32(all, a));
        else if constexpr (std::same_as<Channel, half16>)
            _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                                _mm512_maskz_cvtps_ph(all, a, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
        else
            store(to, add(a, _mm512_setzero_ps()));
    }
    template <channel Channel> GNOMON_LANES_VOID void store_codes(typename Channel::storage* to, doubles a) noexcept {
        if constexpr (std::same_as<Channel, unorm8>) {
            _mm_storel_epi64(reinterpret_cast<__m128i*>(to),
                             _mm256_maskz_cvtepi32_epi8(eight, _mm512_maskz_cvttpd_epi32(eight, a)));
        } else if constexpr (std::same_as<Channel, unorm16>) {
            _mm_storeu_si128(reinterpret_cast<__m128i*>(to),
                             _mm256_maskz_cvtepi32_epi16(eight, _mm512_maskz_cvttpd_epi32(eight, a)));
        } else if constexpr (std::same_as<Channel, half16>) {
            const __m128i halves =
                _mm256_cvtps_ph(_mm512_maskz_cvtpd_ps(eight, to_odd(a)), _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
            _mm_storeu_si128(reinterpret_cast<__m128i*>(to), halves);
        } else {
            static_assert(std::same_as<Channel, float32>, "gnomon: lanes know unorm8, unorm16, half16 and float32");
            _mm256_storeu_ps(to, _mm256_add_ps(_mm512_maskz_cvtpd_ps(eight, a), _mm256_setzero_ps()));
        }
    }
    GNOMON_LANES doubles store_floats(float* to, doubles a) noexcept {
        const __m256 values = _mm256_add_ps(_mm512_maskz_cvtpd_ps(eight, a), _mm256_setzero_ps());
        _mm256_storeu_ps(to, values);
        return _mm512_maskz_cvtps_pd(eight, values);
    }
    template <channel Channel>
    GNOMON_LANES_VOID void cast_pairs(typename Channel::storage* to, unsigned where, doubles codes) noexcept {
        constexpr int bits = 8 * sizeof(typename Channel::storage), full = (1 << bits) - 1;
        const __mmask8 asked = static_cast<__mmask8>(where);
        const __m256i code = _mm512_maskz_cvttpd_epi32(eight, codes), depth = _mm256_set1_epi32(full);
        const __m256i old =
            bits == 8 ? _mm256_cvtepu16_epi32(_mm_maskz_loadu_epi16(asked, to)) : _mm256_maskz_loadu_epi32(asked, to);
        const __mmask8 take = _kor_mask8(_mm256_mask_cmpgt_epi32_mask(asked, code, _mm256_and_si256(old, depth)),
                                         _mm256_mask_testn_epi32_mask(asked, old, _mm256_slli_epi32(depth, bits)));
        const __m256i pairs = _mm256_or_si256(code, _mm256_slli_epi32(depth, bits));
        if constexpr (bits == 8)
            _mm_mask_storeu_epi16(to, take, _mm256_maskz_cvtepi32_epi16(eight, pairs));
        else
            _mm256_mask_storeu_epi32(to, take, pairs);
    }

  private:
    /// Word 0, 2, 4, 6 of each 16 bytes of the first of two registers, then of the second.
    GNOMON_LANES ints word_order(int odd) noexcept {
        alignas(64) static constexpr std::int16_t order[32] = {0,  2,  4,  6,  32, 34, 36, 38, 8,  10, 12, 14, 40, 42, 44, 46,
                                                               16, 18, 20, 22, 48, 50, 52, 54, 24, 26, 28, 30, 56, 58, 60, 62};
        return _mm512_add_epi16(load(order), _mm512_set1_epi16(static_cast<short>(odd)));
    }
    static constexpr __mmask8 eight = 0xFF;
    static constexpr __mmask16 all = 0xFFFF; // g++ 12 warns of the undefined register that the forms without a mask begin with
    GNOMON_LANES floats channel_of_pairs(floats a, floats b, int c) noexcept {
        const ints even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
        return _mm512_permutex2var_ps(a, c == 0 ? even : _mm512_or_si512(even, _mm512_set1_epi32(1)), b);
    }
    /// `a` where the mask has ones, `b` where it has none.
    GNOMON_LANES ints chosen(ints mask, ints a, ints b) noexcept { return _mm512_ternarylogic_epi32(mask, a, b, 0xCA); }
    /// Cut to the 24 bits of a float, the last one set if anything was lost: rounding that to a half rounds once.
    GNOMON_LANES doubles to_odd(doubles a) noexcept {
        const ints lost = _mm512_set1_epi64((1 << 29) - 1), bits = _mm512_castpd_si512(a);
        const ints carried = _mm512_add_epi64(_mm512_and_si512(bits, lost), lost);
        return _mm512_castsi512_pd(chosen(lost, _mm512_setzero_si512(), _mm512_or_si512(bits, carried)));
    }
};

} // namespace gnomon::inline GNOMON_BUILD
GNOMON_TARGET_END
#endif
