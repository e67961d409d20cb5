// gnomon: soft shadow maps. Lanes of SSE2, which every x86-64 has: 16 bytes at a time. See emulated.hpp for what they mean.
#pragma once

#include <gnomon/simd/region.hpp>
#if GNOMON_X86
#include <gnomon/simd/emulated.hpp>

#include <concepts>
#include <cstdint>
#include <cstring>
#include <emmintrin.h>

namespace gnomon::inline GNOMON_BUILD {

struct sse2 {
    static constexpr int bytes = 16;
    static constexpr int float_lanes = 4;
    static constexpr int double_lanes = 2;
    using ints = __m128i;
    using floats = __m128;
    using masks = __m128;
    using doubles = __m128d;

    GNOMON_LANES ints load(const void* from) noexcept { return _mm_loadu_si128(static_cast<const __m128i*>(from)); }
    GNOMON_LANES_VOID void store(void* to, ints a) noexcept { _mm_storeu_si128(static_cast<__m128i*>(to), a); }
    GNOMON_LANES_VOID void stream(void* to, ints a) noexcept { _mm_stream_si128(static_cast<__m128i*>(to), a); }
    GNOMON_LANES_VOID void fence() noexcept { _mm_sfence(); }
    GNOMON_LANES_VOID void prefetch(const void* from) noexcept { _mm_prefetch(static_cast<const char*>(from), _MM_HINT_T1); }
    GNOMON_LANES ints repeat32(std::uint32_t v) noexcept { return _mm_set1_epi32(static_cast<int>(v)); }
    GNOMON_LANES ints exclusive_or(ints a, ints b) noexcept { return _mm_xor_si128(a, b); }

    GNOMON_LANES ints even_pairs8(ints a, ints b) noexcept {
        return _mm_or_si128(_mm_and_si128(a, _mm_set1_epi16(255)), _mm_slli_epi16(b, 8));
    }
    GNOMON_LANES ints odd_pairs8(ints a, ints b) noexcept {
        return _mm_or_si128(_mm_srli_epi16(a, 8), _mm_andnot_si128(_mm_set1_epi16(255), b));
    }
    GNOMON_LANES ints multiply_pairs8(ints weights, ints values) noexcept {
        const ints even =
            _mm_mullo_epi16(_mm_and_si128(weights, _mm_set1_epi16(255)), _mm_srai_epi16(_mm_slli_epi16(values, 8), 8));
        return _mm_add_epi16(even, _mm_mullo_epi16(_mm_srli_epi16(weights, 8), _mm_srai_epi16(values, 8)));
    }
    GNOMON_LANES ints add16(ints a, ints b) noexcept { return _mm_add_epi16(a, b); }
    GNOMON_LANES ints add_dot16(ints sum, ints weights, ints values) noexcept {
        return _mm_add_epi32(sum, _mm_madd_epi16(weights, values));
    }
    GNOMON_LANES ints interleave_byte2(ints a, ints b, ints c, ints d) noexcept {
        const ints ab = _mm_or_si128(_mm_srli_epi32(a, 16), _mm_and_si128(_mm_srli_epi32(b, 8), _mm_set1_epi32(0xFF00)));
        const ints cd = _mm_or_si128(_mm_and_si128(c, _mm_set1_epi32(0xFF0000)), _mm_slli_epi32(_mm_srli_epi32(d, 16), 24));
        return _mm_or_si128(ab, cd);
    }
    GNOMON_LANES ints low_pairs8(ints a, ints b) noexcept { return _mm_unpacklo_epi8(a, b); }
    GNOMON_LANES ints high_pairs8(ints a, ints b) noexcept { return _mm_unpackhi_epi8(a, b); }
    GNOMON_LANES ints low_pairs16(ints a, ints b) noexcept { return _mm_unpacklo_epi16(a, b); }
    GNOMON_LANES ints high_pairs16(ints a, ints b) noexcept { return _mm_unpackhi_epi16(a, b); }
    GNOMON_LANES ints first_half(ints low, ints) noexcept { return low; }
    GNOMON_LANES ints second_half(ints, ints high) noexcept { return high; }
    template <int Bits> GNOMON_LANES ints shift_right32(ints a) noexcept { return _mm_srai_epi32(a, Bits); }
    GNOMON_LANES ints narrow32(ints a, ints b) noexcept { return _mm_packs_epi32(a, b); }
    GNOMON_LANES ints narrow16(ints a, ints b) noexcept { return _mm_packus_epi16(a, b); }
    GNOMON_LANES ints even_words(ints a, ints b) noexcept {
        return _mm_packs_epi32(_mm_srai_epi32(_mm_slli_epi32(a, 16), 16), _mm_srai_epi32(_mm_slli_epi32(b, 16), 16));
    }
    GNOMON_LANES ints odd_words(ints a, ints b) noexcept { return _mm_packs_epi32(_mm_srai_epi32(a, 16), _mm_srai_epi32(b, 16)); }
    GNOMON_LANES ints even_lanes(ints a, ints) noexcept { return a; }
    GNOMON_LANES ints odd_lanes(ints, ints b) noexcept { return b; }
    GNOMON_LANES ints low_pairs32(ints a, ints b) noexcept { return _mm_unpacklo_epi32(a, b); }
    GNOMON_LANES ints high_pairs32(ints a, ints b) noexcept { return _mm_unpackhi_epi32(a, b); }
    template <int Shift> GNOMON_LANES ints join_words(ints a, ints b) noexcept {
        return _mm_or_si128(_mm_and_si128(_mm_srli_epi32(a, Shift), _mm_set1_epi32(0xFFFF)),
                            _mm_slli_epi32(_mm_srli_epi32(b, Shift), 16));
    }
    GNOMON_LANES ints add32(ints a, ints b) noexcept { return _mm_add_epi32(a, b); }
    GNOMON_LANES ints subtract32(ints a, ints b) noexcept { return _mm_sub_epi32(a, b); }
    template <typename Storage> GNOMON_LANES ints widen32(const Storage* from) noexcept {
        const ints none = _mm_setzero_si128();
        if constexpr (sizeof(Storage) == 1) {
            int four;
            std::memcpy(&four, from, sizeof four);
            return _mm_unpacklo_epi16(_mm_unpacklo_epi8(_mm_cvtsi32_si128(four), none), none);
        } else {
            return _mm_unpacklo_epi16(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)), none);
        }
    }
    template <typename Storage> GNOMON_LANES_VOID void store_low(Storage* to, ints a) noexcept {
        const ints words = _mm_packs_epi32(_mm_srai_epi32(_mm_slli_epi32(a, 16), 16), a);
        if constexpr (sizeof(Storage) == 1) {
            const int four = _mm_cvtsi128_si32(_mm_packus_epi16(_mm_and_si128(words, _mm_set1_epi16(255)), words));
            std::memcpy(to, &four, sizeof four);
        } else {
            _mm_storel_epi64(reinterpret_cast<__m128i*>(to), words);
        }
    }
    template <int Places> GNOMON_LANES ints shift_up32(ints a) noexcept { return _mm_slli_si128(a, 4 * Places); }
    template <int Count> GNOMON_LANES ints repeat_last32(ints a) noexcept {
        constexpr auto from = [](int i) { return 4 - Count + i % Count; };
        constexpr int order = from(0) | from(1) << 2 | from(2) << 4 | from(3) << 6; // by name: g++ -O0 takes no expression
        return _mm_shuffle_epi32(a, order);
    }
    template <int Shift> GNOMON_LANES ints multiply_shift32(ints a, ints b) noexcept {
        const ints even = _mm_srli_epi64(_mm_mul_epu32(a, b), Shift);
        const ints odd = _mm_srli_epi64(_mm_mul_epu32(_mm_srli_epi64(a, 32), _mm_srli_epi64(b, 32)), Shift);
        return _mm_or_si128(even, _mm_slli_epi64(odd, 32));
    }
    GNOMON_LANES_VOID void settle(ints& a) noexcept { GNOMON_SETTLE(a); }

    GNOMON_LANES ints either(ints a, ints b) noexcept { return _mm_or_si128(a, b); }
    GNOMON_LANES ints subtract16(ints a, ints b) noexcept { return _mm_sub_epi16(a, b); }
    GNOMON_LANES ints subtract_to_zero16(ints a, ints b) noexcept { return _mm_subs_epu16(a, b); }
    GNOMON_LANES ints multiply_low16(ints a, ints b) noexcept { return _mm_mullo_epi16(a, b); }
    GNOMON_LANES ints multiply_high16(ints a, ints b) noexcept { return _mm_mulhi_epu16(a, b); }
    template <int Bits> GNOMON_LANES ints shift_left16(ints a) noexcept { return _mm_slli_epi16(a, Bits); }
    template <int Bits> GNOMON_LANES ints shift_right16(ints a) noexcept { return _mm_srli_epi16(a, Bits); }
    GNOMON_LANES ints greater16(ints a, ints b) noexcept {
        const ints sign = _mm_set1_epi16(-32768);
        return _mm_cmpgt_epi16(_mm_xor_si128(a, sign), _mm_xor_si128(b, sign));
    }
    GNOMON_LANES ints upper_where_greater16(ints values, ints a, ints b) noexcept {
        const ints lit = _mm_cmpeq_epi16(_mm_subs_epu16(a, b), _mm_setzero_si128());
        return _mm_srli_epi16(_mm_andnot_si128(lit, values), 8);
    }
    GNOMON_LANES bool any_equal16(ints a, ints b, ints c, ints d) noexcept {
        return _mm_movemask_epi8(_mm_or_si128(_mm_cmpeq_epi16(a, b), _mm_cmpeq_epi16(c, d))) != 0;
    }

    GNOMON_LANES ints both(ints a, ints b) noexcept { return _mm_and_si128(a, b); }
    GNOMON_LANES ints multiply32(ints a, ints b) noexcept {
        const ints even = _mm_mul_epu32(a, b), odd = _mm_mul_epu32(_mm_srli_epi64(a, 32), _mm_srli_epi64(b, 32));
        return _mm_unpacklo_epi32(_mm_shuffle_epi32(even, 0x08), _mm_shuffle_epi32(odd, 0x08));
    }
    GNOMON_LANES ints lesser32(ints a, ints b) noexcept { return chosen(_mm_cmpgt_epi32(a, b), b, a); }
    GNOMON_LANES ints greater32(ints a, ints b) noexcept { return chosen(_mm_cmpgt_epi32(a, b), a, b); }
    template <int Bits> GNOMON_LANES ints shift_left32(ints a) noexcept { return _mm_slli_epi32(a, Bits); }
    GNOMON_LANES ints floor32(floats a) noexcept { // of NaN and what is too little the maximum is -2^31, which stays as it is
        const floats bounded = _mm_max_ps(a, _mm_set1_ps(-0x1p31f));
        const ints whole = _mm_cvttps_epi32(bounded);
        const ints up = _mm_castps_si128(_mm_cmpgt_ps(_mm_cvtepi32_ps(whole), bounded));
        return _mm_add_epi32(whole, up);
    }

    GNOMON_LANES floats load(const float* from) noexcept { return _mm_loadu_ps(from); }
    GNOMON_LANES_VOID void store(float* to, floats a) noexcept { _mm_storeu_ps(to, a); }
    GNOMON_LANES floats repeat(float v) noexcept { return _mm_set1_ps(v); }
    GNOMON_LANES floats add(floats a, floats b) noexcept { return _mm_add_ps(a, b); }
    GNOMON_LANES floats subtract(floats a, floats b) noexcept { return _mm_sub_ps(a, b); }
    GNOMON_LANES floats multiply(floats a, floats b) noexcept { return _mm_mul_ps(a, b); }
    GNOMON_LANES floats divide(floats a, floats b) noexcept { return _mm_div_ps(a, b); }
    GNOMON_LANES floats add_product(floats sum, floats a, floats b) noexcept {
        floats product = _mm_mul_ps(a, b);
        GNOMON_SETTLE(product);
        return _mm_add_ps(sum, product);
    }
    GNOMON_LANES floats fraction(floats a, float b) noexcept { return _mm_div_ps(a, _mm_set1_ps(b)); }
    GNOMON_LANES masks greater(floats a, floats b) noexcept { return _mm_cmpgt_ps(a, b); }
    GNOMON_LANES masks not_greater(floats a, floats b) noexcept { return _mm_cmpngt_ps(a, b); }
    GNOMON_LANES masks positive(floats a, floats b,
                                floats c) noexcept { // in double: the product is exact, and a sum keeps its sign
        const doubles low = _mm_add_pd(_mm_mul_pd(_mm_cvtps_pd(a), _mm_cvtps_pd(b)), _mm_cvtps_pd(c));
        const doubles high = _mm_add_pd(_mm_mul_pd(upper(a), upper(b)), upper(c));
        return _mm_shuffle_ps(_mm_castpd_ps(_mm_cmpgt_pd(low, _mm_setzero_pd())),
                              _mm_castpd_ps(_mm_cmpgt_pd(high, _mm_setzero_pd())), 0x88);
    }
    GNOMON_LANES masks both(masks a, masks b) noexcept { return _mm_and_ps(a, b); }
    GNOMON_LANES floats keep(masks where, floats a) noexcept { return _mm_and_ps(where, a); }
    GNOMON_LANES floats drop(masks where, floats a) noexcept { return _mm_andnot_ps(where, a); }
    template <channel Channel, int Channels> GNOMON_LANES floats codes_of(const typename Channel::storage* from, int c) noexcept {
        if constexpr (std::same_as<Channel, unorm8> && Channels == 2) {
            const ints pairs = _mm_unpacklo_epi16(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)), _mm_setzero_si128());
            return _mm_cvtepi32_ps(c == 0 ? _mm_and_si128(pairs, _mm_set1_epi32(255)) : _mm_srli_epi32(pairs, 8));
        } else if constexpr (std::same_as<Channel, unorm16> && Channels == 2) {
            const ints pairs = load(from);
            return _mm_cvtepi32_ps(c == 0 ? _mm_and_si128(pairs, _mm_set1_epi32(65535)) : _mm_srli_epi32(pairs, 16));
        } else if constexpr (std::same_as<Channel, float32> && Channels == 1) {
            return load(from);
        } else if constexpr (std::same_as<Channel, unorm16> && Channels == 1) {
            return numbers(widen32(from));
        } else if constexpr (std::same_as<Channel, float32> && Channels == 2) {
            return c == 0 ? _mm_shuffle_ps(load(from), load(from + 4), 0x88) : _mm_shuffle_ps(load(from), load(from + 4), 0xDD);
        } else if constexpr (Channel::whole_codes) {
            const auto* const codes = from + c;
            return numbers(_mm_setr_epi32(codes[0], codes[Channels], codes[2 * Channels], codes[3 * Channels]));
        } else if constexpr (std::same_as<Channel, float32>) {
            return _mm_setr_ps(from[c], from[c + Channels], from[c + 2 * Channels], from[c + 3 * Channels]);
        } else {
            return load(emulated<bytes>::template codes_of<Channel, Channels>(from, c).lane);
        }
    }

    GNOMON_LANES floats numbers(ints a) noexcept { return _mm_cvtepi32_ps(a); }
    GNOMON_LANES bool any(masks a) noexcept { return _mm_movemask_ps(a) != 0; }
    GNOMON_LANES floats lesser(floats a, floats b) noexcept { return _mm_min_ps(b, a); }
    GNOMON_LANES_VOID void settle(floats& a) noexcept { GNOMON_SETTLE(a); }
    GNOMON_LANES bool every(masks a) noexcept { return _mm_movemask_ps(a) == 15; }

    GNOMON_LANES doubles load(const double* from) noexcept { return _mm_loadu_pd(from); }
    GNOMON_LANES_VOID void store(double* to, doubles a) noexcept { _mm_storeu_pd(to, a); }
    GNOMON_LANES doubles repeat(double v) noexcept { return _mm_set1_pd(v); }
    GNOMON_LANES doubles add(doubles a, doubles b) noexcept { return _mm_add_pd(a, b); }
    GNOMON_LANES doubles multiply(doubles a, doubles b) noexcept { return _mm_mul_pd(a, b); }
    GNOMON_LANES doubles divide(doubles a, doubles b) noexcept { return _mm_div_pd(a, b); }
    GNOMON_LANES doubles multiply_pairs(doubles a, double b) noexcept {
        return _mm_mul_pd(a, _mm_shuffle_pd(a, _mm_set1_pd(b), 1));
    }
    GNOMON_LANES doubles add_product(doubles sum, doubles a, doubles b) noexcept { return _mm_add_pd(sum, _mm_mul_pd(a, b)); }
    GNOMON_LANES doubles add_and_mask(doubles a, std::uint64_t addend, std::uint64_t mask) noexcept {
        const ints sum = _mm_add_epi64(_mm_castpd_si128(a), _mm_set1_epi64x(static_cast<long long>(addend)));
        return _mm_castsi128_pd(_mm_and_si128(sum, _mm_set1_epi64x(static_cast<long long>(mask))));
    }

    GNOMON_LANES doubles subtract(doubles a, doubles b) noexcept { return _mm_sub_pd(a, b); }
    GNOMON_LANES doubles smaller(doubles a, doubles b) noexcept { return _mm_min_pd(a, b); }
    GNOMON_LANES doubles larger(doubles a, doubles b) noexcept { return _mm_max_pd(a, b); }
    GNOMON_LANES doubles truncate(doubles a) noexcept { return _mm_cvtepi32_pd(_mm_cvttpd_epi32(a)); }
    GNOMON_LANES unsigned greater_bits(doubles a, doubles b) noexcept {
        return static_cast<unsigned>(_mm_movemask_pd(_mm_cmpgt_pd(a, b)));
    }
    GNOMON_LANES doubles keep_greater(doubles a, doubles b, doubles v) noexcept { return _mm_and_pd(_mm_cmpgt_pd(a, b), v); }
    GNOMON_LANES doubles drop_greater(doubles a, doubles b, doubles v) noexcept { return _mm_andnot_pd(_mm_cmpgt_pd(a, b), v); }
    GNOMON_LANES_VOID void settle(doubles& a) noexcept { GNOMON_SETTLE(a); }

    template <channel Channel> GNOMON_LANES doubles codes(const typename Channel::storage* from) noexcept {
        return _mm_set_pd(static_cast<double>(Channel::code(from[1])), static_cast<double>(Channel::code(from[0])));
    }
    template <channel Channel> GNOMON_LANES_VOID void store_codes(typename Channel::storage* to, floats a) noexcept {
        if constexpr (Channel::whole_codes) {
            store_low(to, _mm_cvttps_epi32(a));
        } else if constexpr (std::same_as<Channel, float32>) {
            store(to, add(a, _mm_setzero_ps()));
        } else {
            emulated<bytes>::floats numbers;
            store(numbers.lane, a);
            emulated<bytes>::template store_codes<Channel>(to, numbers);
        }
    }
    template <channel Channel> GNOMON_LANES_VOID void store_codes(typename Channel::storage* to, doubles a) noexcept {
        const double lane[2] = {_mm_cvtsd_f64(a), _mm_cvtsd_f64(_mm_unpackhi_pd(a, a))};
        for (int i = 0; i < 2; ++i)
            if constexpr (Channel::whole_codes)
                to[i] = static_cast<typename Channel::storage>(lane[i]);
            else
                to[i] = Channel::store(lane[i]);
    }
    GNOMON_LANES doubles store_floats(float* to, doubles a) noexcept {
        const floats two = _mm_add_ps(_mm_cvtpd_ps(a), _mm_setzero_ps());
        _mm_storel_pi(reinterpret_cast<__m64*>(to), two);
        return _mm_cvtps_pd(two);
    }
    template <channel Channel>
    GNOMON_LANES_VOID void cast_pairs(typename Channel::storage* to, unsigned where, doubles codes) noexcept {
        emulated<bytes>::template cast_pairs<Channel>(to, where,
                                                      {{_mm_cvtsd_f64(codes), _mm_cvtsd_f64(_mm_unpackhi_pd(codes, codes))}});
    }

  private:
    GNOMON_LANES ints chosen(ints mask, ints a, ints b) noexcept {
        return _mm_or_si128(_mm_and_si128(mask, a), _mm_andnot_si128(mask, b));
    }
    GNOMON_LANES doubles upper(floats a) noexcept { return _mm_cvtps_pd(_mm_movehl_ps(a, a)); }
};

} // namespace gnomon::inline GNOMON_BUILD
#endif
