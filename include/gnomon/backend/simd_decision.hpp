// gnomon: soft shadow maps. The decision in lanes, first part: who lies behind a surface, by floats, of any pair and depth. Included by
// simd_receive.hpp, and in its way.

#include <gnomon/receive/receive.hpp>
#include <gnomon/simd/region.hpp>

#include <concepts>
#include <cstdint>
#include <limits>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// Those of `asked` that lie where shadow may fall at all.
template <typename Isa>
GNOMON_INLINE typename Isa::masks may_be_shadowed(const typename Isa::masks& asked, const typename Isa::floats& depth,
                                                  bool lit_beyond) noexcept {
    const auto there = Isa::both(asked, Isa::greater(depth, Isa::repeat(0.0f)));
    return lit_beyond ? Isa::both(there, Isa::not_greater(depth, Isa::repeat(1.0f))) : there;
}

/// Whose sums are above nothing, of those `asked`, and in the result those of them that lie within `doubt` of it.
template <typename Isa>
GNOMON_INLINE typename Isa::masks positive_or_in_doubt(const typename Isa::floats& sum, const typename Isa::floats& doubt,
                                                       const typename Isa::masks& asked, typename Isa::masks& positive) noexcept {
    positive = Isa::both(asked, Isa::not_greater(Isa::subtract(Isa::repeat(0.0f), doubt), sum));
    return Isa::both(positive, Isa::not_greater(sum, doubt));
}

/// The same of m z + rest times 65535, z in codes of 16 bits. Who is moved behind every caster is shadowed.
template <typename Isa>
GNOMON_INLINE typename Isa::masks decided_by_codes(const typename Isa::floats& m, const typename Isa::floats& rest,
                                                   const typename Isa::floats& z, const typename Isa::floats& doubt,
                                                   const typename Isa::masks& asked, typename Isa::masks& shadowed) noexcept {
    const auto last = Isa::repeat(static_cast<float>(depth16::last));
    const auto behind_all = Isa::keep(Isa::greater(z, last), Isa::repeat(std::numeric_limits<float>::infinity()));
    const auto sum = Isa::add(Isa::add_product(Isa::multiply(rest, last), m, z), behind_all);
    return positive_or_in_doubt<Isa>(sum, doubt, asked, shadowed);
}

/// m z + rest times 65535 of whole numbers modulo 2^32: exact where floats are in doubt, for it is near nothing there.
template <typename Isa>
GNOMON_INLINE typename Isa::floats sum_modulo(const typename Isa::ints& m, const typename Isa::ints& rest,
                                              const typename Isa::floats& z) noexcept {
    const auto rest_times = Isa::subtract32(Isa::template shift_left32<16>(rest), rest);
    return Isa::numbers(Isa::add32(Isa::multiply32(m, Isa::floor32(z)), rest_times));
}
/// Takes away those in doubt whose sums are not above nothing after all.
template <typename Isa>
GNOMON_INLINE void settle_doubt(const typename Isa::masks& in_doubt, const typename Isa::floats& sum,
                                typename Isa::masks& positive) noexcept {
    const auto others = Isa::drop(in_doubt, Isa::repeat(1.0f)), asked = Isa::keep(in_doubt, sum);
    positive = Isa::both(positive, Isa::greater(Isa::add(others, asked), Isa::repeat(0.0f)));
}

/// Who lies behind the surface that a pair holds, a caster or a far bound: e > m (1-z), see receive/decide.hpp. Of a biased pair and depth
/// the sign of a product and a sum, exact wherever one of the functions below says that it is. What is left goes by the scalar loop:
///
///     float depths      of unorm nothing; of half and float m <= 2^-50, and z that is moved towards the light by more than the range,
///                       or lies within 2^-50 of nothing when it has been moved by less than 2^-26
///     depths in codes   of unorm nothing; of half and float one receiver in a million, or all that lie exactly where their shadow begins,
///                       m <= 2^-50, and in float m > 2^100
///
/// A depth_ratio is a pair whose m is full: the oracle's products of t m and m have 56 bits, but differ by 2^-40 of themselves or not at
/// all.
template <typename Isa, texel_format Texel, typename Depth> struct surface {
    using channel_type = typename Texel::channel_type;
    using ints = typename Isa::ints;
    using floats = typename Isa::floats;
    using masks = typename Isa::masks;
    static constexpr bool whole_codes = channel_type::whole_codes;

    floats depth_less, depth_share, mask_more, mask_share, nearer; ///< the bias
    floats before;                                                 ///< a depth in codes there, once moved, is lit
    floats least_mask;                                             ///< what float decides of
    bool next_to_nothing; ///< may a float depth be, once moved? Then it tells where e = m, and the scalar loop sees to it.

    struct pair {
        floats e, m;
    };

    [[nodiscard]] static surface of(const bias& b) noexcept {
        const auto steps = bias_steps<Texel>::of(b);
        constexpr float nothing = std::numeric_limits<float>::infinity();
        const float moved = std::same_as<Depth, float> ? steps.nearer : static_cast<float>(codes_towards_light<Texel>(b));
        return {Isa::repeat(static_cast<float>(steps.depth_less)),
                Isa::repeat(static_cast<float>(steps.depth_share)),
                Isa::repeat(static_cast<float>(steps.mask_more)),
                Isa::repeat(static_cast<float>(steps.mask_share)),
                Isa::repeat(moved),
                Isa::repeat(greater(0.0f, -moved)),
                Isa::repeat(whole_codes ? 0.0f : (moved > 1.0f && std::same_as<Depth, float> ? nothing : 0x1p-50f)),
                moved < 0x1p-26f && moved > -0x1p-26f}; // beyond, what is left of a difference is more
    }

    /// a share, rounded before anything is added, which g++ would fuse with it from -O2 on.
    GNOMON_LANES floats times(const floats& a, const floats& share) noexcept {
        floats product = Isa::multiply(a, share);
        Isa::settle(product);
        return product;
    }
    /// As `apply` has them. In float what a bias adds is 2^-149 a rounding, which moves no mask above 2^-50, and of depths beside such a
    /// mask the sign of the least; so it is added last, and not to empty texels: of what is denormal a product takes ten times as long.
    GNOMON_LANES pair moved(const surface& by, const floats& depth, const floats& mask, const masks& there) noexcept {
        if constexpr (!Texel::representation_type::premultiplied)
            return {depth, Isa::repeat(channel_type::scale)}; // which is not biased
        else if constexpr (whole_codes)                       // the shares are 1
            return {Isa::subtract(depth, by.depth_less), Isa::add(mask, by.mask_more)};
        else if constexpr (std::same_as<channel_type, float32>)
            return {Isa::subtract(times(depth, by.depth_share), Isa::keep(there, by.depth_less)), times(mask, by.mask_share)};
        else
            return {times(Isa::subtract(depth, by.depth_less), by.depth_share), times(Isa::add(mask, by.mask_more), by.mask_share)};
    }

    /// m z + (e-m) > 0. Codes, and the halves they are biased by, keep e-m exact, and the product is asked for its sign.
    GNOMON_LANES masks by_codes(const surface& by, const pair& of, const floats& depth) noexcept {
        const floats rest = Isa::subtract(of.e, of.m);
        // Doubled they are whole, and times the least depth there is still something.
        return Isa::positive(Isa::add(of.m, of.m), Isa::subtract(depth, by.nearer), Isa::add(rest, rest));
    }
    /// For z < 1/2 the same: e-m is exact if m/2 <= e <= 2m, and if e is less, m z < m/2 is less than m-e either way, if more, all from
    /// z = -1 on are shadowed. Else m (z-1) + e > 0, where z-1 is exact up to 2^24, and beyond that everything is behind every caster
    /// but those of e <= -2^24 m.
    GNOMON_LANES bool by_floats(const surface& by, const pair& of, const masks& there, const floats& depth,
                                masks& behind) noexcept {
        const floats zero = Isa::repeat(0.0f), half = Isa::repeat(0.5f);
        const floats z = Isa::subtract(depth, by.nearer);
        const masks first_half = Isa::greater(half, z);
        const floats beyond = Isa::subtract(z, Isa::drop(first_half, Isa::repeat(1.0f)));
        const floats rest = Isa::subtract(of.e, Isa::keep(first_half, of.m));
        behind = Isa::both(there, Isa::positive(of.m, beyond, rest));
        return !Isa::any(Isa::both(there, Isa::not_greater(of.m, by.least_mask))) &&
               !(by.next_to_nothing && Isa::any(Isa::both(Isa::greater(z, zero), Isa::greater(Isa::repeat(0x1p-50f), z))));
    }
    /// m z + (e-m) 65535 > 0, z in codes. Three roundings are wrong by 3 * 2^-24 * 65535 m < m/64 at most where the two cancel; so
    /// within m/16 of nothing the sum says nothing. Whole codes m that a bias moves below nothing have e > 0, and a sum far above it.
    GNOMON_LANES bool by_sums(const surface& by, const pair& of, const masks& there, const floats& depth, masks& behind) noexcept {
        const floats z = Isa::subtract(depth, by.nearer);
        const floats rest = Isa::subtract(of.e, of.m), doubt = Isa::multiply(of.m, Isa::repeat(0.0625f));
        const masks asked = Isa::both(there, Isa::greater(z, by.before));
        const masks in_doubt = decided_by_codes<Isa>(of.m, rest, z, doubt, asked, behind);
        if constexpr (whole_codes) {
            if (Isa::any(in_doubt)) { // doubled, for then it is whole
                const ints twice_m = Isa::floor32(Isa::add(of.m, of.m)), twice_rest = Isa::floor32(Isa::add(rest, rest));
                settle_doubt<Isa>(in_doubt, sum_modulo<Isa>(twice_m, twice_rest, z), behind);
            }
            return true;
        } else {
            return !Isa::any(in_doubt) && !Isa::any(Isa::both(asked, Isa::not_greater(of.m, by.least_mask))) &&
                   !(std::same_as<channel_type, float32> && Isa::any(Isa::both(asked, Isa::greater(of.m, Isa::repeat(0x1p100f)))));
        }
    }

    /// Who of those that are `there` lies behind it, at a depth as it is or in codes. Of whole codes at depths as they are nobody asks who
    /// is there. False if lanes do not tell.
    GNOMON_LANES bool decided(const surface& by, const floats& depth_code, const floats& mask, const masks& there, const floats& z,
                              masks& behind) noexcept {
        const pair of = moved(by, depth_code, mask, there);
        if constexpr (std::same_as<Depth, std::uint16_t>)
            return by_sums(by, of, there, z, behind);
        else if constexpr (!whole_codes)
            return by_floats(by, of, there, z, behind);
        else
            return behind = by_codes(by, of, z), true;
    }
};

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
