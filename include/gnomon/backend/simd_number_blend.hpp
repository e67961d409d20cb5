// gnomon: soft shadow maps. Blends of four texels in lanes, second part: half and float. Included by simd_points.hpp after
// simd_rows.hpp, and in its way.

#include <gnomon/receive/receive.hpp>
#include <gnomon/simd/region.hpp>

#include <cstddef>
#include <cstring>
#include <limits>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// Pairs of half and float, summed in doubles in the order of `sample`. The decision takes a sum as a float, as that of rows does a
/// number.
template <typename Isa, texel_format Texel, typename Depth> struct number_blend {
    using ints = typename Isa::ints;
    using floats = typename Isa::floats;
    using masks = typename Isa::masks;
    using doubles = typename Isa::doubles;
    using number = float;
    using deciding = decision<Isa, Texel, Depth, float>;
    static constexpr int step = Isa::float_lanes;

    struct moving : deciding {
        template <texel_format, typename> [[nodiscard]] static moving of(const rule& r) noexcept { return {deciding::of(r)}; }
    };
    struct pair {
        floats e, m;
    };
    template <int Ring> struct fetched {
        Texel corner[4][static_cast<std::size_t>(Ring)];
        void take(int i, const std::byte* upper, const std::byte* lower) noexcept {
            for (int k = 0; k < 4; ++k)
                std::memcpy(corner[k] + i, (k < 2 ? upper : lower) + (k % 2) * static_cast<int>(sizeof(Texel)), sizeof(Texel));
        }
    };

    GNOMON_LANES floats weight(const ints& of_row) noexcept { return Isa::numbers(of_row); }

    template <int Ring>
    GNOMON_LANES pair blend(const fetched<Ring>& from, int i, const ints& across, const floats& here, const floats& next) noexcept {
        const auto all = corner_weights<Isa>(across, here, next);
        alignas(64) float weights[4][static_cast<std::size_t>(step)], made[2][static_cast<std::size_t>(step)];
        for (int k = 0; k < 4; ++k) Isa::store(weights[k], all.of[k]);
        GNOMON_UNROLL(2)
        for (int c = 0; c < 2; ++c) {
            alignas(64) float codes[4][static_cast<std::size_t>(step)];
            GNOMON_UNROLL(4)
            for (int k = 0; k < 4; ++k)
                Isa::store(codes[k], Isa::template codes_of<typename Texel::channel_type, 2>(from.corner[k][i].stored, c));
            for (int at = 0; at < step; at += Isa::double_lanes) {
                doubles sum = Isa::repeat(0.0);
                GNOMON_UNROLL(4)
                for (int k = 0; k < 4; ++k) // the products are exact
                    sum = Isa::add_product(sum, Isa::template codes<float32>(weights[k] + at),
                                           Isa::template codes<float32>(codes[k] + at));
                Isa::template store_codes<float32>(made[c] + at, Isa::multiply(sum, Isa::repeat(1.0 / 65536.0)));
            }
        }
        return {Isa::load(made[Texel::depth_index]), Isa::load(made[Texel::mask_index])};
    }

    /// What is infinite beside the map may have been weighed by nothing, and left none.
    GNOMON_LANES bool decided(const moving& by, const pair& blended, const Depth* depths, masks& shadowed) noexcept {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        return !Isa::any(Isa::not_greater(Isa::add(blended.e, blended.m), Isa::repeat(-infinity))) &&
               deciding::decided(by, blended.e, blended.m, deciding::loaded(depths), shadowed);
    }
    GNOMON_LANES_VOID void store(float* to, const masks& shadowed, const pair& blended) noexcept {
        deciding::store(to, Isa::keep(shadowed, blended.m));
    }
};

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
