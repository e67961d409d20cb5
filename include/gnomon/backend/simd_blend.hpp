// gnomon: soft shadow maps. Blends of four texels in lanes, and the decision on them, first part: whole codes. Included by simd_points.hpp
// after simd_decision.hpp, and in its way.
//
// Blends of whole codes are whole numbers, 65536 to a code. A decision is a sum in floats: where its sign may be another one without what
// was rounded, whole numbers tell if depths are codes, and doubles if a blend has more bits than a float; what these leave, a register
// of receivers, goes by `sample` and `shadow`.

#include <gnomon/receive/receive.hpp>
#include <gnomon/simd/region.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

inline constexpr float blend_whole = 65536.0f; ///< the sum of the four weights

/// The weights of four corners, 65536 together: whole numbers, from those across in words and those down the columns.
template <typename Isa> struct four_weights {
    typename Isa::floats of[4];
};
template <typename Isa>
[[nodiscard]] GNOMON_INLINE four_weights<Isa> corner_weights(const typename Isa::ints& across, const typename Isa::floats& here,
                                                             const typename Isa::floats& next) noexcept {
    const auto left = Isa::numbers(Isa::both(across, Isa::repeat32(0xFFFF)));
    const auto right = Isa::numbers(Isa::template shift_right32<16>(across));
    return {{Isa::multiply(left, here), Isa::multiply(right, here), Isa::multiply(left, next), Isa::multiply(right, next)}};
}

/// What a bias does to a blend, and which depths it leaves lit.
template <typename Isa> struct blend_rule {
    typename Isa::floats e, m, z; ///< what pair and receiver are moved by
    typename Isa::floats before;  ///< a depth in codes there, once moved, is lit
    bool lit_beyond;
    bool by_half_a_code; ///< at most, to either side

    template <texel_format Texel, typename Depth> [[nodiscard]] static blend_rule of(const rule& r) noexcept {
        const biased<> moved = apply<Texel>(r.caster, 0.0, 0.0, 0.0f);
        const int codes = codes_towards_light<Texel>(r.caster);
        return {Isa::repeat(static_cast<float>(moved.e) * blend_whole),
                Isa::repeat(static_cast<float>(moved.m) * blend_whole),
                Isa::repeat(std::same_as<Depth, std::uint16_t> ? static_cast<float>(-codes) : moved.z),
                Isa::repeat(static_cast<float>(greater(0, -codes))),
                r.lit_beyond,
                moved.m <= 0.5 && moved.m >= -0.5};
    }
};

/// decided_by_codes of a blend: m and rest, 65536 to a code, and the pair as it was before it was moved, in whole numbers modulo 2^32,
/// which tell of a receiver that has a mask and lies within `doubt` of nothing.
template <typename Isa>
GNOMON_INLINE typename Isa::masks decided_by_codes(const blend_rule<Isa>& by, typename Isa::floats m, typename Isa::floats rest,
                                                   typename Isa::floats mask, typename Isa::ints whole_e,
                                                   typename Isa::ints whole_m, const std::uint16_t* depths, float doubt) noexcept {
    const auto z = Isa::add(Isa::template codes_of<unorm16, 1>(depths, 0), by.z);
    const auto there = Isa::both(Isa::greater(mask, Isa::repeat(0.0f)), Isa::greater(z, by.before));
    typename Isa::masks shadowed;
    const auto in_doubt = decided_by_codes<Isa>(m, rest, z, Isa::repeat(doubt), there, shadowed);
    if (Isa::any(in_doubt)) {
        whole_m = Isa::add32(whole_m, Isa::floor32(by.m));
        whole_e = Isa::add32(whole_e, Isa::floor32(by.e));
        settle_doubt<Isa>(in_doubt, sum_modulo<Isa>(whole_m, Isa::subtract32(whole_e, whole_m), z), shadowed);
    }
    return shadowed;
}

/// Pairs of bytes. Both texels of a row come in one load of 32 bits; a blend is below 2^24 and so exact in float.
template <typename Isa, texel_format Texel> struct byte_blend {
    using ints = typename Isa::ints;
    using floats = typename Isa::floats;
    using masks = typename Isa::masks;
    using moving = blend_rule<Isa>;
    using number = float;                  ///< of the weights down the columns
    static constexpr float doubt = 0x1p3f; ///< an 8192nd of a code

    struct pair {
        floats e, m;
    };
    template <int Ring> struct fetched {
        std::uint32_t above[static_cast<std::size_t>(Ring)], below[static_cast<std::size_t>(Ring)];
        void take(int i, const std::byte* upper, const std::byte* lower) noexcept {
            std::memcpy(above + i, upper, sizeof above[i]);
            std::memcpy(below + i, lower, sizeof below[i]);
        }
    };

    GNOMON_LANES floats weight(const ints& of_row) noexcept { return Isa::numbers(of_row); }

    template <int Ring>
    GNOMON_LANES pair blend(const fetched<Ring>& from, int i, const ints& across, const floats& here, const floats& next) noexcept {
        const ints above = Isa::load(from.above + i), below = Isa::load(from.below + i);
        const ints low = Isa::repeat32(0x00FF00FF), none = Isa::repeat32(0);
        const floats e = Isa::numbers(Isa::add_dot16(none, across, Isa::both(above, low)));
        const floats m = Isa::numbers(Isa::add_dot16(none, across, Isa::template shift_right16<8>(above)));
        const floats e_next = Isa::numbers(Isa::add_dot16(none, across, Isa::both(below, low)));
        const floats m_next = Isa::numbers(Isa::add_dot16(none, across, Isa::template shift_right16<8>(below)));
        return {Isa::add_product(Isa::multiply(e, here), e_next, next), Isa::add_product(Isa::multiply(m, here), m_next, next)};
    }

    /// m z + (e-m) > 0. Moved by half a code a pair stays below 2^24, and this is exact; by 64, below 2^25, so that one of e and m, e-m,
    /// and m z where it cancels are rounded by 1 each.
    GNOMON_LANES bool decided(const blend_rule<Isa>& by, const pair& blended, const float* depths, masks& shadowed) noexcept {
        const floats e = Isa::add(blended.e, by.e), m = Isa::add(blended.m, by.m), rest = Isa::subtract(e, m);
        const floats depth = Isa::load(depths), z = Isa::add(depth, by.z);
        const masks asked = may_be_shadowed<Isa>(Isa::greater(blended.m, Isa::repeat(0.0f)), depth, by.lit_beyond);
        if (!by.by_half_a_code)
            return !Isa::any(positive_or_in_doubt<Isa>(Isa::add_product(rest, m, z), Isa::repeat(doubt), asked, shadowed));
        shadowed = Isa::both(asked, Isa::positive(m, z, rest));
        return true;
    }
    /// The same with terms of 2^41, which are rounded by 2^16 each.
    GNOMON_LANES bool decided(const blend_rule<Isa>& by, const pair& blended, const std::uint16_t* depths,
                              masks& shadowed) noexcept {
        const floats e = Isa::add(blended.e, by.e), m = Isa::add(blended.m, by.m);
        shadowed = decided_by_codes(by, m, Isa::subtract(e, m), blended.m, Isa::floor32(blended.e), Isa::floor32(blended.m), depths,
                                    doubt * 0x1p17f);
        return true;
    }

    GNOMON_LANES_VOID void store(float* to, const masks& shadowed, const pair& blended) noexcept {
        Isa::store(to, Isa::keep(shadowed, Isa::fraction(blended.m, unorm8::scale * blend_whole)));
    }
    GNOMON_LANES_VOID void store(std::uint8_t* to, const masks& shadowed, const pair& blended) noexcept {
        const floats code = Isa::add(Isa::multiply(blended.m, Isa::repeat(1.0f / blend_whole)), Isa::repeat(0.5f)); // exact
        Isa::template store_codes<unorm8>(to, Isa::keep(shadowed, code));
    }
    GNOMON_LANES_VOID void store(std::uint16_t* to, const masks& shadowed, const pair& blended) noexcept {
        const ints mask = Isa::floor32(Isa::keep(shadowed, blended.m)); // times 257 it still has 32 bits
        const ints code = Isa::add32(Isa::multiply32(mask, Isa::repeat32(257)), Isa::repeat32(1u << 15));
        Isa::store_low(to, Isa::template shift_right32<16>(code));
    }
};

/// Pairs of 16 bits. A blend has 32 bits and is exact modulo 2^32; floats of it are rounded once.
template <typename Isa, texel_format Texel> struct word_blend {
    using ints = typename Isa::ints;
    using floats = typename Isa::floats;
    using masks = typename Isa::masks;
    using moving = blend_rule<Isa>;
    using number = std::uint32_t;
    static constexpr int step = Isa::float_lanes;
    static constexpr float doubt = 0x1p12f; ///< of floats, a 16th of a code

    struct pair {
        ints e, m;
    };
    template <int Ring> struct fetched {
        std::uint32_t left[2][static_cast<std::size_t>(Ring)], right[2][static_cast<std::size_t>(Ring)];
        void take(int i, const std::byte* upper, const std::byte* lower) noexcept {
            for (int row = 0; row < 2; ++row) {
                const std::byte* const from = row == 0 ? upper : lower;
                std::memcpy(left[row] + i, from, sizeof left[row][i]);
                std::memcpy(right[row] + i, from + sizeof left[row][i], sizeof right[row][i]);
            }
        }
    };

    GNOMON_LANES ints weight(const ints& of_row) noexcept { return of_row; }

    /// Codes less 2^15, since lanes multiply signed words, and what that takes away put back.
    template <int Ring>
    GNOMON_LANES pair row(const fetched<Ring>& from, int which, int i, const ints& across, const ints& taken) noexcept {
        const ints left = Isa::load(from.left[which] + i), right = Isa::load(from.right[which] + i);
        const ints low = Isa::repeat32(0xFFFF), high = Isa::repeat32(0xFFFF0000), middle = Isa::repeat32(0x80008000);
        const ints e = Isa::either(Isa::both(left, low), Isa::template shift_left32<16>(right));
        const ints m = Isa::either(upper(left), Isa::both(right, high));
        return {Isa::add_dot16(taken, across, Isa::exclusive_or(e, middle)),
                Isa::add_dot16(taken, across, Isa::exclusive_or(m, middle))};
    }
    template <int Ring>
    GNOMON_LANES pair blend(const fetched<Ring>& from, int i, const ints& across, const ints& here, const ints& next) noexcept {
        const ints taken = Isa::template shift_left32<15>(Isa::add32(lower(across), upper(across)));
        const pair above = row(from, 0, i, across, taken), below = row(from, 1, i, across, taken);
        return {Isa::add32(Isa::multiply32(above.e, here), Isa::multiply32(below.e, next)),
                Isa::add32(Isa::multiply32(above.m, here), Isa::multiply32(below.m, next))};
    }

    GNOMON_LANES ints lower(const ints& a) noexcept { return Isa::both(a, Isa::repeat32(0xFFFF)); }
    GNOMON_LANES ints upper(const ints& a) noexcept { return Isa::both(Isa::template shift_right32<16>(a), Isa::repeat32(0xFFFF)); }
    /// high 65536 + low, rounded once.
    GNOMON_LANES floats joined(const floats& high, const floats& low) noexcept {
        return Isa::add(Isa::multiply(high, Isa::repeat(blend_whole)), low);
    }
    /// The mask and e - m, once moved, each as 65536 times one number and another.
    struct moved {
        floats m_high, m_low, rest_high, rest_low;
    };
    GNOMON_LANES moved move(const blend_rule<Isa>& by, const pair& blended) noexcept {
        const floats e_high = Isa::numbers(upper(blended.e)), m_high = Isa::numbers(upper(blended.m));
        const floats e_low = Isa::add(Isa::numbers(lower(blended.e)), by.e), m_low = Isa::add(Isa::numbers(lower(blended.m)), by.m);
        return {m_high, m_low, Isa::subtract(e_high, m_high), Isa::subtract(e_low, m_low)};
    }
    GNOMON_LANES floats mask_of(const pair& blended) noexcept {
        return joined(Isa::numbers(upper(blended.m)), Isa::numbers(lower(blended.m)));
    }

    /// m z + (e-m) > 0. Where the two cancel they are less than 2^34, and all that is rounded of them less than 2^11.
    GNOMON_LANES bool decided(const blend_rule<Isa>& by, const pair& blended, const float* depths, masks& shadowed) noexcept {
        const moved of = move(by, blended);
        const floats depth = Isa::load(depths), z = Isa::add(depth, by.z);
        const floats sum = Isa::add_product(joined(of.rest_high, of.rest_low), joined(of.m_high, of.m_low), z);
        const masks asked = may_be_shadowed<Isa>(Isa::greater(mask_of(blended), Isa::repeat(0.0f)), depth, by.lit_beyond);
        const masks in_doubt = positive_or_in_doubt<Isa>(sum, Isa::repeat(doubt), asked, shadowed);
        if (!Isa::any(in_doubt)) return true;
        const floats again = in_doubles(of, z);
        settle_doubt<Isa>(in_doubt, again, shadowed);
        return !Isa::any(Isa::both(in_doubt, Isa::not_greater(Isa::multiply(again, again), Isa::repeat(0x1p-32f))));
    }
    GNOMON_LANES bool decided(const blend_rule<Isa>& by, const pair& blended, const std::uint16_t* depths,
                              masks& shadowed) noexcept {
        const moved of = move(by, blended);
        shadowed = decided_by_codes(by, joined(of.m_high, of.m_low), joined(of.rest_high, of.rest_low), mask_of(blended), blended.e,
                                    blended.m, depths, doubt * 0x1p16f);
        return true;
    }
    /// The same sum, wrong by less than 2^-18 where it is near nothing.
    GNOMON_LANES floats in_doubles(const moved& of, const floats& z) noexcept {
        alignas(64) float m[2][static_cast<std::size_t>(step)], rest[2][static_cast<std::size_t>(step)];
        alignas(64) float depths[static_cast<std::size_t>(step)], sums[static_cast<std::size_t>(step)];
        Isa::store(m[0], of.m_high);
        Isa::store(m[1], of.m_low);
        Isa::store(rest[0], of.rest_high);
        Isa::store(rest[1], of.rest_low);
        Isa::store(depths, z);
        for (int i = 0; i < step; i += Isa::double_lanes) {
            const auto depth = Isa::template codes<float32>(depths + i);
            const auto high =
                Isa::add_product(Isa::template codes<float32>(rest[0] + i), Isa::template codes<float32>(m[0] + i), depth);
            const auto low =
                Isa::add_product(Isa::template codes<float32>(rest[1] + i), Isa::template codes<float32>(m[1] + i), depth);
            Isa::template store_codes<float32>(sums + i, Isa::add(Isa::multiply(high, Isa::repeat(65536.0)), low));
        }
        return Isa::load(sums);
    }

    /// The mask where there is shadow, else nothing.
    GNOMON_LANES ints kept(const masks& shadowed, const ints& mask) noexcept {
        return Isa::both(mask, Isa::subtract32(Isa::repeat32(0), Isa::floor32(Isa::keep(shadowed, Isa::repeat(1.0f)))));
    }
    /// In twice as many steps as there are codes.
    GNOMON_LANES ints halves(const ints& mask) noexcept {
        return Isa::both(Isa::template shift_right32<15>(mask), Isa::repeat32(0x1FFFF));
    }
    /// A quotient of 32 bits by 65535 is no nearer to the middle of two floats than 2^-41 of it: so it may be rounded before.
    GNOMON_LANES_VOID void store(float* to, const masks& shadowed, const pair& blended) noexcept {
        alignas(64) std::uint32_t mask[static_cast<std::size_t>(Isa::float_lanes)];
        Isa::store(mask, kept(shadowed, blended.m));
        GNOMON_UNROLL(4)
        for (int i = 0; i < Isa::float_lanes; ++i)
            to[i] = static_cast<float>(static_cast<double>(mask[i]) * (1.0 / (65535.0 * 65536.0)));
    }
    GNOMON_LANES_VOID void store(std::uint16_t* to, const masks& shadowed, const pair& blended) noexcept {
        const ints code = Isa::add32(halves(kept(shadowed, blended.m)), Isa::repeat32(1));
        Isa::store_low(to, Isa::template shift_right32<1>(code));
    }
    /// (2m + 257) / 514, by a factor that is too large by less than what is left of any quotient.
    GNOMON_LANES_VOID void store(std::uint8_t* to, const masks& shadowed, const pair& blended) noexcept {
        constexpr std::uint32_t factor = ((1u << 28) + 513) / 514;
        const ints sum = Isa::add32(halves(kept(shadowed, blended.m)), Isa::repeat32(257));
        Isa::store_low(to, Isa::template multiply_shift32<28>(sum, Isa::repeat32(factor)));
    }
};

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
