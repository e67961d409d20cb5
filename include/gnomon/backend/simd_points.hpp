// gnomon: soft shadow maps. The decision in lanes, for receivers anywhere on a map. Included like simd_receive.hpp, and after it.

#include <gnomon/backend/lane_formats.hpp>
#include <gnomon/backend/simd_blend.hpp>
#include <gnomon/backend/simd_number_blend.hpp>
#include <gnomon/backend/simd_texel_blend.hpp>
#include <gnomon/backend/stretch.hpp>
#include <gnomon/receive/receive.hpp>
#include <gnomon/simd/region.hpp>

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// What blends and decides.
template <typename Isa, texel_format Texel, typename Depth, typename Intensity> consteval auto choose_blend() {
    if constexpr (detail::byte_pairs<Texel>)
        return std::type_identity<byte_blend<Isa, Texel>>{};
    else if constexpr (detail::pairs_of<Texel, unorm16>)
        return std::type_identity<word_blend<Isa, Texel>>{};
    else if constexpr (detail::pairs_of<Texel, typename Texel::channel_type> && std::same_as<Intensity, float> &&
                       !Texel::channel_type::whole_codes)
        return std::type_identity<number_blend<Isa, Texel, Depth>>{};
    else
        return std::type_identity<texel_blend<Isa, Texel, Depth, Intensity>>{};
}

/// Receivers anywhere on a map, a register at a time.
template <typename Isa, texel_format Texel, typename Depth, typename Intensity> struct blended_decision {
    using blending = typename decltype(choose_blend<Isa, Texel, Depth, Intensity>())::type;
    using ints = typename Isa::ints;
    using floats = typename Isa::floats;
    using masks = typename Isa::masks;
    static constexpr int step = Isa::float_lanes;

    /// Where a tap lies in one direction: its texel, and the weights of that and of the next.
    struct taps {
        ints texel, here, next;
    };

    /// A few registers of receivers on their way from place to texels to decision. They pause before either, for what is stored as a
    /// whole and loaded piece by piece, or the other way round, takes its time, and so do texels that are not in the first cache.
    static constexpr int pause = 3 * step, ring = 8 * step;
    struct work {
        int at[static_cast<std::size_t>(ring)]; ///< bytes from the map to the upper left texel
        std::uint32_t across[static_cast<std::size_t>(ring)];
        typename blending::number here[static_cast<std::size_t>(ring)], next[static_cast<std::size_t>(ring)];
        typename blending::template fetched<ring> texels;
    };
    /// Results are called for so many bytes ahead: stores reach the cache in their order, and those to `work` would wait for a result
    /// that is not in it. It may lie beyond the last result.
    static constexpr std::uintptr_t ahead = 512;

    const void* map;
    ints last_column, last_row, stride; ///< the last texel that has a next one, and bytes from row to row
    std::ptrdiff_t next_row;            ///< in bytes
    floats right, bottom;               ///< left of and above these lie texels that have a next one
    typename blending::moving by_rule;

    [[nodiscard]] static blended_decision of(image_view<const Texel> map, const rule& r) noexcept {
        const auto word = [](int n) { return static_cast<std::uint32_t>(n); };
        return {map.data(),
                Isa::repeat32(word(map.width() - 2)),
                Isa::repeat32(word(map.height() - 2)),
                Isa::repeat32(word(static_cast<int>(map.stride()))),
                map.stride(),
                Isa::repeat(static_cast<float>(map.width() - 1)),
                Isa::repeat(static_cast<float>(map.height() - 1)),
                blending::moving::template of<Texel, Depth>(r)};
    }

    /// A position in 1/256 texel right of the centre of texel 0, floor(256 x + 1/2) - 128 as `sample` has it. 256 x is exact, and what
    /// is beyond 2^30 lies off every map.
    GNOMON_LANES ints fixed(const floats& x) noexcept {
        const ints doubled = Isa::floor32(Isa::multiply(x, Isa::repeat(512.0f)));
        return Isa::template shift_right32<1>(Isa::subtract32(doubled, Isa::repeat32(255)));
    }
    /// Between the centres of the first and the last texel.
    GNOMON_LANES taps within(const ints& p) noexcept {
        const ints next = Isa::both(p, Isa::repeat32(255));
        return {Isa::template shift_right32<8>(p), Isa::subtract32(Isa::repeat32(256), next), next};
    }
    /// Anywhere. A texel's weight is 256 less its distance, and nothing from 256 on: so weights fade out by themselves where the two
    /// texels that are read are not those beside the position, because one of these is not there.
    GNOMON_LANES taps anywhere(const ints& p, const ints& last) noexcept {
        const ints none = Isa::repeat32(0), one = Isa::repeat32(256);
        const ints texel = Isa::greater32(Isa::lesser32(Isa::template shift_right32<8>(p), last), none);
        const ints right = Isa::subtract32(p, Isa::template shift_left32<8>(texel)); // of the texel
        const ints here = Isa::lesser32(Isa::subtract32(one, right), Isa::add32(one, right));
        const ints next = Isa::lesser32(right, Isa::subtract32(Isa::repeat32(512), right));
        return {texel, Isa::greater32(here, none), Isa::greater32(next, none)};
    }

    GNOMON_LANES_VOID void note(const blended_decision& by, const taps& across, const taps& down, work& w, int i) noexcept {
        constexpr int doublings = std::countr_zero(sizeof(Texel));
        constexpr std::uint32_t odd = sizeof(Texel) >> doublings;
        const ints column = odd == 1 ? across.texel : Isa::multiply32(across.texel, Isa::repeat32(odd));
        Isa::store(w.at + i, Isa::add32(Isa::multiply32(down.texel, by.stride), Isa::template shift_left32<doublings>(column)));
        Isa::store(w.across + i, Isa::either(across.here, Isa::template shift_left32<16>(across.next)));
        Isa::store(w.here + i, blending::weight(down.here));
        Isa::store(w.next + i, blending::weight(down.next));
    }
    /// Offsets and weights of a register of receivers.
    GNOMON_LANES_VOID void locate(const blended_decision& by, const float* xs, const float* ys, work& w, int i) noexcept {
        const floats x = Isa::load(xs), y = Isa::load(ys), half = Isa::repeat(0.5f);
        const masks inside = Isa::both(Isa::both(Isa::greater(x, half), Isa::greater(by.right, x)),
                                       Isa::both(Isa::greater(y, half), Isa::greater(by.bottom, y)));
        if (Isa::every(inside))
            note(by, within(fixed(x)), within(fixed(y)), w, i);
        else
            note(by, anywhere(fixed(x), by.last_column), anywhere(fixed(y), by.last_row), w, i);
    }
    /// The texels there. Plain loads: as fast as gathers, or twice as fast, depending on the processor.
    GNOMON_LANES_VOID void fetch(const blended_decision& by, work& w, int first) noexcept {
        const auto* const above = static_cast<const std::byte*>(by.map);
        const auto* const below = above + by.next_row;
        GNOMON_UNROLL(4)
        for (int i = first; i < first + step; ++i) {
            std::ptrdiff_t at = w.at[i];
            GNOMON_ALONE(at);
            w.texels.take(i, above + at, below + at);
        }
    }

    /// False, and nothing stored, if lanes do not tell.
    template <typename Blended>
    GNOMON_LANES bool answered(const blended_decision& by, const Blended& blended, const Depth* z, Intensity* to) noexcept {
        if constexpr (std::same_as<blending, texel_blend<Isa, Texel, Depth, Intensity>>) {
            return blending::answered(by.by_rule, blended, z, to);
        } else {
            masks shadowed;
            if (!blending::decided(by.by_rule, blended, z, shadowed)) return false;
            blending::store(to, shadowed, blended);
            return true;
        }
    }

    /// \pre count is a multiple of `step`
    static void some(const blended_decision& by, image_view<const Texel> map, const float* x, const float* y, const Depth* z,
                     Intensity* to, int count, const rule& r) noexcept {
        alignas(64) work w;
        for (int first = 0; first < count + 2 * pause; first += step) {
            if (first < count) locate(by, x + first, y + first, w, first % ring);
            if (first >= pause && first < count + pause) fetch(by, w, (first - pause) % ring);
            const int i = first - 2 * pause;
            if (i < 0) continue;
            Isa::prefetch(reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(to + i) + ahead));
            const int k = i % ring;
            const auto blended =
                blending::blend(w.texels, k, Isa::load(w.across + k), Isa::load(w.here + k), Isa::load(w.next + k));
            if (!answered(by, blended, z + i, to + i))
                for (int j = i; j < i + step; ++j) to[j] = shadow_as<Intensity>(sample(map, x[j], y[j]), detail::as_depth(z[j]), r);
        }
    }
};

/// Receivers anywhere. \pre detail::blended_on
template <typename Isa, texel_format Texel, typename Depth, typename Intensity>
void receive_points(image_view<const Texel> map, strided_span<const float> x, strided_span<const float> y,
                    strided_span<const Depth> z, strided_span<Intensity> intensity, const rule& r) noexcept {
    using blended = blended_decision<Isa, Texel, Depth, Intensity>;
    using part = detail::stretch<blended::step, 256>;
    const auto by = blended::of(map, r);
    const int count = lesser(lesser(x.size(), y.size()), lesser(z.size(), intensity.size()));
    GNOMON_ASSERT(!detail::overtakes(intensity, x, count) && !detail::overtakes(intensity, y, count) &&
                      !detail::overtakes(intensity, z, count),
                  detail::overtaken);
    const bool side_by_side = x.contiguous() && y.contiguous() && z.contiguous() && intensity.contiguous();
    typename part::template buffer<float> px, py;
    typename part::template buffer<Depth> depth;
    typename part::template buffer<Intensity> made;
    for (int i = 0; i < count;) {
        const part now(i, count, side_by_side);
        blended::some(by, map, now.of(x, px), now.of(y, py), now.of(z, depth), now.to(intensity, made), now.filled(), r);
        now.put(intensity, made);
        i += now.count;
    }
}

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
