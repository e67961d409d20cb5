// gnomon: soft shadow maps. The decision in lanes, second part: what is left of a shadow and how it is stored, in doubles, by the formulas
// of receive/decide.hpp. Included by simd_receive.hpp after simd_decision.hpp, and in its way.

#include <gnomon/receive/receive.hpp>
#include <gnomon/simd/region.hpp>

#include <concepts>
#include <cstdint>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// As many receivers as there are lanes of doubles.
template <typename Isa, texel_format Texel, typename Intensity> struct shade {
    using doubles = typename Isa::doubles;
    static constexpr double full = Texel::linear_scale;

    GNOMON_LANES doubles wide(const float* from) noexcept { return Isa::template codes<float32>(from); }
    GNOMON_LANES doubles wide(const double* from) noexcept { return Isa::load(from); }
    GNOMON_LANES doubles wide(const std::uint16_t* from) noexcept { return Isa::template codes<unorm16>(from); }

    /// `v` within [0, most]; NaN is nothing.
    GNOMON_LANES doubles within(const doubles& v, double most) noexcept {
        return Isa::smaller(Isa::larger(v, Isa::repeat(0.0)), Isa::repeat(most));
    }
    /// Where a > b `v`, else `other`.
    GNOMON_LANES doubles where_greater(const doubles& a, const doubles& b, const doubles& v, const doubles& other) noexcept {
        return Isa::add(Isa::keep_greater(a, b, v), Isa::drop_greater(a, b, other));
    }
    /// a b, rounded before anything is added.
    GNOMON_LANES doubles times(const doubles& a, const doubles& b) noexcept {
        doubles product = Isa::multiply(a, b);
        Isa::settle(product);
        return product;
    }

    /// What before_far_bound leaves of a shadow past its bound.
    GNOMON_LANES doubles faded(const doubles& e, const doubles& m, const doubles& z, float fade) noexcept {
        const doubles passed = Isa::subtract(times(m, z), Isa::subtract(m, e)),
                      share = times(m, Isa::repeat(static_cast<double>(fade)));
        const doubles left = Isa::subtract(Isa::repeat(1.0), Isa::divide(passed, share));
        return Isa::keep_greater(share, Isa::repeat(0.0), within(left, 1.0));
    }

    GNOMON_LANES doubles of_full(const doubles& v) noexcept {
        if constexpr (Texel::channel_type::whole_codes)
            return Isa::divide(v, Isa::repeat(full));
        else
            return v;
    }
    /// stored_intensity.
    GNOMON_LANES_VOID void store(Intensity* to, const doubles& darkness, const doubles& left) noexcept {
        if constexpr (std::same_as<Intensity, float>) {
            Isa::template store_codes<float32>(to, Isa::multiply(within(of_full(darkness), 1.0), left));
        } else {
            using code = unorm<Intensity>;
            const doubles last = Isa::repeat(static_cast<double>(code::scale));
            const doubles share = times(of_full(Isa::multiply(within(darkness, full), last)), left);
            Isa::template store_codes<code>(to, Isa::add(share, Isa::repeat(0.5)));
        }
    }
};

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
