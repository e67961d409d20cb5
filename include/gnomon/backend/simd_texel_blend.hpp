// gnomon: soft shadow maps. Blends of four texels in lanes, third part: texels of any format, and what any number is stored as, decided
// in doubles. Included by simd_points.hpp after simd_shade.hpp, and in its way.

#include <gnomon/receive/receive.hpp>
#include <gnomon/simd/region.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// `sample` and `shadow_as` themselves, lane by lane: in doubles, but for sums of bytes, which floats hold. Only blends that are no number
/// go by the scalar loop.
template <typename Isa, texel_format Texel, typename Depth, typename Intensity> struct texel_blend {
    using channel_type = typename Texel::channel_type;
    using ints = typename Isa::ints;
    using floats = typename Isa::floats;
    using doubles = typename Isa::doubles;
    using shades = shade<Isa, Texel, Intensity>;
    using number = float; ///< of the weights down the columns
    static constexpr int step = Isa::float_lanes, channels = Texel::channels;
    static constexpr auto lanes = static_cast<std::size_t>(step), numbers = static_cast<std::size_t>(channels);
    static constexpr bool whole_codes = channel_type::whole_codes, in_codes = std::same_as<Depth, std::uint16_t>;
    static constexpr bool premultiplied = Texel::representation_type::premultiplied;
    static constexpr int darkness = Texel::effects.translucency ? Texel::contribution_index : Texel::mask_index;

    struct moving {
        bias_steps<Texel> caster, far_bound;
        double codes_nearer; ///< by which a depth in codes is moved
        float fade;
        bool lit_beyond;

        template <texel_format, typename> [[nodiscard]] static moving of(const rule& r) noexcept {
            return {bias_steps<Texel>::of(r.caster), bias_steps<Texel>::of(r.far_bound),
                    static_cast<double>(codes_towards_light<Texel>(r.caster)), r.fade, r.lit_beyond};
        }
    };
    /// Texels of three numbers have room for four, of which lanes take one more easily.
    static constexpr int room = channels == 3 ? 4 : channels;
    template <int Ring> struct fetched {
        typename Texel::storage corner[4][static_cast<std::size_t>(Ring)][static_cast<std::size_t>(room)];
        void take(int i, const std::byte* upper, const std::byte* lower) noexcept {
            for (int k = 0; k < 4; ++k)
                std::memcpy(corner[k][i], (k < 2 ? upper : lower) + (k % 2) * static_cast<int>(sizeof(Texel)), sizeof(Texel));
        }
    };
    /// filtered<Texel>, of a register of receivers.
    struct blended {
        alignas(64) double code[numbers][lanes];
    };
    struct pair {
        doubles e, m;
    };

    GNOMON_LANES floats weight(const ints& of_row) noexcept { return Isa::numbers(of_row); }

    template <int Ring>
    GNOMON_LANES blended blend(const fetched<Ring>& from, int i, const ints& across, const floats& here,
                               const floats& next) noexcept {
        const auto weights = corner_weights<Isa>(across, here, next);
        blended made;
        if constexpr (std::same_as<channel_type, unorm8> && premultiplied)
            blend_bytes(from, i, weights, made);
        else
            blend_numbers(from, i, weights, made);
        return made;
    }
    template <int Ring> GNOMON_LANES floats codes(const fetched<Ring>& from, int k, int i, int c) noexcept {
        return Isa::template codes_of<channel_type, room>(from.corner[k][i], c);
    }
    /// Sums below 2^24.
    template <int Ring>
    GNOMON_LANES_VOID void blend_bytes(const fetched<Ring>& from, int i, const four_weights<Isa>& weights, blended& made) noexcept {
        GNOMON_UNROLL(4)
        for (int c = 0; c < channels; ++c) {
            floats sum = Isa::multiply(codes(from, 0, i, c), weights.of[0]);
            GNOMON_UNROLL(4)
            for (int k = 1; k < 4; ++k) sum = Isa::add_product(sum, codes(from, k, i, c), weights.of[k]);
            alignas(64) float sums[lanes];
            Isa::store(sums, sum);
            for (int at = 0; at < step; at += Isa::double_lanes) keep(made, c, at, shades::wide(sums + at));
        }
    }
    /// Products below 2^48, or of 41 bits.
    template <int Ring>
    GNOMON_LANES_VOID void blend_numbers(const fetched<Ring>& from, int i, const four_weights<Isa>& weights,
                                         blended& made) noexcept {
        alignas(64) float weight[4][lanes], code[4][numbers][lanes];
        GNOMON_UNROLL(4)
        for (int k = 0; k < 4; ++k) {
            Isa::store(weight[k], weights.of[k]);
            GNOMON_UNROLL(4)
            for (int c = 0; c < channels; ++c) Isa::store(code[k][c], codes(from, k, i, c));
        }
        GNOMON_UNROLL(4)
        for (int c = 0; c < channels; ++c)
            for (int at = 0; at < step; at += Isa::double_lanes) {
                doubles sum = Isa::repeat(0.0);
                GNOMON_UNROLL(4)
                for (int k = 0; k < 4; ++k) {
                    doubles linear = shades::wide(code[k][c] + at);
                    if constexpr (!premultiplied)
                        linear =
                            Isa::multiply(linear, c == Texel::depth_index ? shades::wide(code[k][Texel::mask_index] + at)
                                                                          : Isa::repeat(static_cast<double>(channel_type::scale)));
                    sum = Isa::add_product(sum, shades::wide(weight[k] + at), linear);
                }
                keep(made, c, at, sum);
            }
    }
    GNOMON_LANES_VOID void keep(blended& made, int c, int at, const doubles& sum) noexcept {
        Isa::store(made.code[c] + at, Isa::multiply(sum, Isa::repeat(1.0 / 65536.0)));
    }

    /// As floats have it, and -0 as 0.
    GNOMON_LANES doubles rounded(const doubles& v) noexcept {
        alignas(64) float made[lanes];
        return Isa::store_floats(made, v);
    }
    /// `apply`, in floats where the channel has no codes; sums and products of floats are rounded once though doubles are between. Empty
    /// texels are not moved: of what is denormal a product takes ten times as long.
    GNOMON_LANES pair moved(const bias_steps<Texel>& by, const double* depth, const double* mask) noexcept {
        const doubles e = Isa::load(depth), m = Isa::load(mask);
        if constexpr (whole_codes) { // the shares are 1
            return {Isa::subtract(e, Isa::repeat(by.depth_less)), Isa::add(m, Isa::repeat(by.mask_more))};
        } else {
            const doubles none = Isa::repeat(0.0);
            const doubles less = Isa::keep_greater(m, none, Isa::repeat(static_cast<double>(by.depth_less))),
                          more = Isa::keep_greater(m, none, Isa::repeat(static_cast<double>(by.mask_more)));
            const doubles lower = rounded(Isa::subtract(rounded(e), less)), upper = rounded(Isa::add(rounded(m), more));
            return {rounded(Isa::multiply(lower, Isa::repeat(static_cast<double>(by.depth_share)))),
                    rounded(Isa::multiply(upper, Isa::repeat(static_cast<double>(by.mask_share))))};
        }
    }

    /// Above nothing where depth_mask::behind holds.
    GNOMON_LANES doubles behind(const pair& of, const doubles& z) noexcept {
        const doubles& e = of.e;
        const doubles& m = of.m;
        const doubles half = Isa::repeat(0.5);
        const doubles near_half = Isa::subtract(shades::times(m, z), Isa::subtract(m, e));
        const doubles far_half = Isa::subtract(e, shades::times(m, Isa::subtract(Isa::repeat(1.0), z)));
        return shades::where_greater(half, z, near_half, far_half);
    }
    /// `left` where behind_caster of a depth16 holds.
    GNOMON_LANES doubles left_behind_codes(const moving& by, const pair& of, const doubles& z, const doubles& left) noexcept {
        const doubles none = Isa::repeat(0.0), last = Isa::repeat(static_cast<double>(depth16::last));
        const doubles depth = Isa::subtract(z, Isa::repeat(by.codes_nearer)), rest = Isa::subtract(last, depth);
        const doubles e = Isa::larger(of.e, none), m = Isa::larger(of.m, none);
        const doubles kept =
            Isa::keep_greater(shades::times(e, last), shades::times(m, rest), Isa::keep_greater(depth, none, left));
        return shades::where_greater(none, rest, left, kept);
    }
    /// Has every sum a number? What is infinite beside the map may have been weighed by nothing, and left none.
    GNOMON_LANES bool are_numbers(const blended& of) noexcept {
        const doubles least = Isa::repeat(-std::numeric_limits<double>::infinity());
        const unsigned all = Isa::greater_bits(Isa::repeat(0.0), least);
        bool each = true;
        for (int i = 0; i < step; i += Isa::double_lanes) {
            doubles sum = Isa::repeat(0.0);
            for (int c = 0; c < channels; ++c) sum = Isa::add(sum, Isa::load(of.code[c] + i));
            each &= Isa::greater_bits(sum, least) == all;
        }
        return each;
    }

    GNOMON_LANES floats as_unit(const float* depths) noexcept { return Isa::load(depths); }
    GNOMON_LANES floats as_unit(const std::uint16_t* depths) noexcept {
        return Isa::fraction(Isa::template codes_of<unorm16, 1>(depths, 0), unorm16::scale);
    }

    /// False, and nothing stored, if it does not tell.
    GNOMON_LANES bool answered(const moving& by, const blended& of, const Depth* depths, Intensity* to) noexcept {
        if constexpr (!whole_codes)
            if (!are_numbers(of)) return false;
        alignas(64) float caster_z[lanes], bound_z[lanes];
        Isa::store(caster_z, Isa::subtract(as_unit(depths), Isa::repeat(by.caster.nearer)));
        Isa::store(bound_z, Isa::subtract(as_unit(depths), Isa::repeat(by.far_bound.nearer)));
        for (int i = 0; i < step; i += Isa::double_lanes) {
            const doubles none = Isa::repeat(0.0), all = Isa::repeat(1.0), depth = shades::wide(depths + i);
            const double* const mask = of.code[Texel::mask_index] + i;
            doubles left = all;
            if constexpr (Texel::effects.far_bound) {
                const double* const far_bound = of.code[Texel::far_index] + i;
                const pair bound = moved(by.far_bound, far_bound, mask);
                const doubles z = shades::wide(bound_z + i);
                const doubles faded = by.fade > 0.0f ? shades::faded(bound.e, bound.m, z, by.fade) : none;
                left = shades::where_greater(behind(bound, z), none, faded, all);
                left = shades::where_greater(Isa::load(far_bound), none, left, all);
            }
            const pair caster = moved(by.caster, of.code[Texel::depth_index] + i, mask);
            if constexpr (in_codes) {
                left = left_behind_codes(by, caster, depth, left);
            } else {
                left = Isa::keep_greater(behind(caster, shades::wide(caster_z + i)), none, left);
                if (by.lit_beyond) left = Isa::drop_greater(depth, all, left);
            }
            left = Isa::keep_greater(Isa::load(mask), none, Isa::keep_greater(depth, none, left));
            shades::store(to + i, Isa::load(of.code[darkness] + i), left);
        }
        return true;
    }
};

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
