// gnomon: soft shadow maps. The decision in lanes, for receivers anywhere on a map. Included like simd_receive.hpp, and after it.

#include <gnomon/receive/receive.hpp>
#include <gnomon/simd/region.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// One register of receivers anywhere on a map of pairs of bytes. Both texels of a row come in one load of 32 bits; a blend is a whole
/// number, the code times 65536, below 2^24 and so exact in float, as is all that is asked of it.
template <typename Isa, texel_format Texel, typename Depth, typename Intensity> struct blended_decision {
    using ints = typename Isa::ints;
    using floats = typename Isa::floats;
    using masks = typename Isa::masks;
    static constexpr int step = Isa::float_lanes;
    static constexpr float whole = 65536.0f; ///< the sum of the four weights

    struct pair {
        floats e, m;
    };
    /// Where a tap lies in one direction: its texel, and the weights of that and of the next.
    struct taps {
        ints texel, here, next;
    };

    /// A few registers of receivers on their way from place to texels to decision. They pause before either, for what is stored as a
    /// whole and loaded piece by piece, or the other way round, takes its time, and so do texels that are not in the first cache.
    static constexpr int pause = 3 * step, ring = 8 * step;
    struct work {
        int at[static_cast<std::size_t>(ring)]; ///< bytes from the map to the upper left texel
        std::uint32_t across[static_cast<std::size_t>(ring)], above[static_cast<std::size_t>(ring)],
            below[static_cast<std::size_t>(ring)];
        float here[static_cast<std::size_t>(ring)], next[static_cast<std::size_t>(ring)];
    };
    /// Results are called for so many bytes ahead: stores reach the cache in their order, and those to `work` would wait for a result
    /// that is not in it. It may lie beyond the last result.
    static constexpr std::uintptr_t ahead = 512;

    const void* map;
    ints last_column, last_row, stride; ///< the last texel that has a next one, and bytes from row to row
    std::ptrdiff_t next_row;            ///< in bytes
    floats right, bottom;               ///< left of and above these lie texels that have a next one
    floats e, m, z;                     ///< the bias: what pair and receiver are moved by
    floats before;                      ///< a depth in codes there, once moved, is lit
    bool lit_beyond;

    /// Biases of one rounding keep the pair below 2^24. Offsets are of 32 bits, and a row has two texels for a load.
    [[nodiscard]] static bool serves(image_view<const Texel> map, const rule& r) noexcept {
        constexpr int most = 1 << 21;
        const std::ptrdiff_t row = map.stride() < 0 ? -map.stride() : map.stride();
        return r.caster.roundings <= 1 && map.width() >= 2 && map.height() >= 2 && map.width() <= most && map.height() <= most &&
               row <= (0x7FFFFFFF - 2 * map.width()) / map.height();
    }
    [[nodiscard]] static blended_decision of(image_view<const Texel> map, const rule& r) noexcept {
        const biased<> moved = apply<Texel>(r.caster, 0.0, 0.0, 0.0f);
        const int codes = codes_towards_light<Texel>(r.caster);
        constexpr bool whole_depth = std::same_as<Depth, std::uint16_t>;
        const auto word = [](int n) { return static_cast<std::uint32_t>(n); };
        return {map.data(),
                Isa::repeat32(word(map.width() - 2)),
                Isa::repeat32(word(map.height() - 2)),
                Isa::repeat32(word(static_cast<int>(map.stride()))),
                map.stride(),
                Isa::repeat(static_cast<float>(map.width() - 1)),
                Isa::repeat(static_cast<float>(map.height() - 1)),
                Isa::repeat(static_cast<float>(moved.e) * whole),
                Isa::repeat(static_cast<float>(moved.m) * whole),
                Isa::repeat(whole_depth ? static_cast<float>(-codes) : moved.z),
                Isa::repeat(static_cast<float>(greater(0, -codes))),
                r.lit_beyond};
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
        Isa::store(w.at + i, Isa::add32(Isa::multiply32(down.texel, by.stride), Isa::template shift_left32<1>(across.texel)));
        Isa::store(w.across + i, Isa::either(across.here, Isa::template shift_left32<16>(across.next)));
        Isa::store(w.here + i, Isa::numbers(down.here));
        Isa::store(w.next + i, Isa::numbers(down.next));
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
            std::memcpy(w.above + i, above + at, sizeof w.above[i]);
            std::memcpy(w.below + i, below + at, sizeof w.below[i]);
        }
    }
    GNOMON_LANES pair blend(const work& w, int i) noexcept {
        const ints across = Isa::load(w.across + i), above = Isa::load(w.above + i), below = Isa::load(w.below + i);
        const floats here = Isa::load(w.here + i), next = Isa::load(w.next + i);
        const ints low = Isa::repeat32(0x00FF00FF), none = Isa::repeat32(0);
        const floats e = Isa::numbers(Isa::add_dot16(none, across, Isa::both(above, low)));
        const floats m = Isa::numbers(Isa::add_dot16(none, across, Isa::template shift_right16<8>(above)));
        const floats e_next = Isa::numbers(Isa::add_dot16(none, across, Isa::both(below, low)));
        const floats m_next = Isa::numbers(Isa::add_dot16(none, across, Isa::template shift_right16<8>(below)));
        return {Isa::add_product(Isa::multiply(e, here), e_next, next), Isa::add_product(Isa::multiply(m, here), m_next, next)};
    }

    /// m z + (e-m) > 0, as above; where there is no mask there is no intensity either.
    GNOMON_LANES bool decided(const blended_decision& by, const pair& moved, const floats&, const float* depths,
                              masks& shadowed) noexcept {
        const floats zero = Isa::repeat(0.0f), depth = Isa::load(depths);
        shadowed = Isa::positive(moved.m, Isa::add(depth, by.z), Isa::subtract(moved.e, moved.m));
        shadowed = Isa::both(shadowed, Isa::greater(depth, zero));
        if (by.lit_beyond) shadowed = Isa::both(shadowed, Isa::not_greater(depth, Isa::repeat(1.0f)));
        return true;
    }
    /// The same times 65535, where sums of 2^40 are rounded three times, each time by 2^16 at most: within 2^18 of nothing they say
    /// nothing. False if a receiver that has a mask lies there, or is moved behind every caster.
    GNOMON_LANES bool decided(const blended_decision& by, const pair& moved, const floats& mask, const std::uint16_t* depths,
                              masks& shadowed) noexcept {
        const floats depth = Isa::add(Isa::template codes_of<unorm16, 1>(depths, 0), by.z);
        const floats rest = Isa::multiply(Isa::subtract(moved.e, moved.m), Isa::repeat(static_cast<float>(depth16::last)));
        const floats sum = Isa::add_product(rest, moved.m, depth);
        const masks there = Isa::both(Isa::greater(mask, Isa::repeat(0.0f)), Isa::greater(depth, by.before));
        shadowed = Isa::both(there, Isa::not_greater(Isa::repeat(-0x1p18f), sum));
        return !Isa::any(Isa::both(shadowed, Isa::not_greater(sum, Isa::repeat(0x1p18f)))) &&
               !Isa::any(Isa::both(there, Isa::greater(depth, Isa::repeat(static_cast<float>(depth16::last)))));
    }

    GNOMON_LANES_VOID void store(float* to, const masks& shadowed, const floats& mask) noexcept {
        Isa::store(to, Isa::keep(shadowed, Isa::fraction(mask, unorm8::scale * whole)));
    }
    GNOMON_LANES_VOID void store(std::uint8_t* to, const masks& shadowed, const floats& mask) noexcept {
        const floats code = Isa::add(Isa::multiply(mask, Isa::repeat(1.0f / whole)), Isa::repeat(0.5f)); // exact
        Isa::template store_codes<unorm8>(to, Isa::keep(shadowed, code));
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
            const pair blended = blend(w, i % ring);
            masks shadowed;
            if (decided(by, {Isa::add(blended.e, by.e), Isa::add(blended.m, by.m)}, blended.m, z + i, shadowed))
                store(to + i, shadowed, blended.m);
            else // float does not tell
                for (int k = i; k < i + step; ++k) to[k] = shadow_as<Intensity>(sample(map, x[k], y[k]), detail::as_depth(z[k]), r);
        }
    }
};

/// What lanes blend and decide.
template <texel_format Texel, typename Depth, typename Intensity>
inline constexpr bool blended_in_lanes =
    byte_pairs<Texel> && (std::same_as<Intensity, float> || std::same_as<Intensity, std::uint8_t>);

/// Receivers anywhere, spans of any stride. False, and nothing done, where the lanes do not serve.
template <typename Isa, texel_format Texel, typename Depth, typename Intensity>
bool receive_points(image_view<const Texel> map, strided_span<const float> x, strided_span<const float> y,
                    strided_span<const Depth> z, strided_span<Intensity> intensity, const rule& r) noexcept {
    using blended = blended_decision<Isa, Texel, Depth, Intensity>;
    constexpr int step = blended::step;
    if (!blended::serves(map, r)) return false;
    const auto by = blended::of(map, r);
    const int count = lesser(lesser(x.size(), y.size()), lesser(z.size(), intensity.size()));
    const bool side_by_side = x.contiguous() && y.contiguous() && z.contiguous() && intensity.contiguous();
    const int together = side_by_side ? count - count % step : 0;
    constexpr int at_once = 1 << 30; // so that no count overflows
    for (int i = 0, here; i < together; i += here) {
        here = lesser(at_once, together - i);
        blended::some(by, map, &x[i], &y[i], &z[i], &intensity[i], here, r);
    }
    for (int i = together, here; i < count; i += here) {
        here = lesser(step, count - i);
        float px[static_cast<std::size_t>(step)]{}, py[static_cast<std::size_t>(step)]{};
        Depth depth[static_cast<std::size_t>(step)]{};
        Intensity made[static_cast<std::size_t>(step)];
        for (int k = 0; k < here; ++k) px[k] = x[i + k], py[k] = y[i + k], depth[k] = z[i + k];
        blended::some(by, map, px, py, depth, made, step, r);
        for (int k = 0; k < here; ++k) intensity[i + k] = made[k];
    }
    return true;
}

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
