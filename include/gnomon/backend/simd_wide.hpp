// gnomon: soft shadow maps. The filter in lanes, first part: what all of it shares, and sums in doubles or floats. Included by
// simd_filter.hpp, and in its way.

#include <gnomon/filter/separable.hpp>
#include <gnomon/simd/region.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// Rows that are summed side by side; the bytes that a strip's sums of one row take, at most; and those of a row that pass the caches by
/// at a time.
inline constexpr int rows_at_once = detail::lane_rows, strip_bytes = detail::lane_strip_bytes, piece_bytes = 4096;

/// What is read is called for ahead of time in a map as large as this, by narrow regions in one a quarter as large; and a result as
/// large as that is written past the caches, whole rows if the map is. Both where filtering and receiving together gained by it.
inline constexpr std::int64_t prefetched_bytes = 4 << 20, streamed_bytes = 16 << 20;

/// Calls for what the next rows hold at `i`, if they are to be called for.
template <typename Isa, typename Storage> GNOMON_INLINE void call_for(const Storage* const* ahead, int i) noexcept {
    if (ahead == nullptr) return;
    GNOMON_UNROLL(4)
    for (int j = 0; j < rows_at_once; ++j) Isa::prefetch(ahead[j] + i);
}

/// Any texel that is filtered channel by channel: in doubles, whose sums are exact; or in floats, if that is what `fast` asks for (see
/// filter/separable.hpp), or if codes are bytes. Of these a line is exact in float too, below 255 * 65536, and so is a row if the total is
/// at most 256; of any other what is too near the middle of two codes is summed again.
template <typename Isa, kernel Kernel, texel_format Texel, typename Number> struct wide_filter {
    using by = detail::sums<Texel, Kernel>;
    using channel_type = typename Texel::channel_type;
    using storage = typename Texel::storage;
    using element = Number;
    using numbers = decltype(Isa::repeat(Number{}));
    static constexpr bool of_bytes = std::same_as<Number, float> && channel_type::whole_codes,
                          all_exact = of_bytes && static_cast<double>(by::whole) * 255.0 < 0x1p24; ///< rows too, of small totals

    static constexpr int step = Isa::bytes / static_cast<int>(sizeof(Number)); ///< channels that are made at a time
    static constexpr int planes = 1;                                           ///< that a line consists of
    static constexpr int piece = piece_bytes / static_cast<int>(sizeof(Number)) / Texel::channels * Texel::channels;
    static constexpr int margin = Kernel::radius * Texel::channels;
    static constexpr int taps = 2 * Kernel::radius + 1;
    [[nodiscard]] static constexpr int place(int i) noexcept { return i; }

    /// From the centre outwards.
    static constexpr auto weights = [] {
        std::array<Number, static_cast<std::size_t>(Kernel::radius + 1)> w{};
        for (int i = 0; i <= Kernel::radius; ++i) w[static_cast<std::size_t>(i)] = by::template weight<Number>(Kernel::radius + i);
        return w;
    }();
    GNOMON_LANES numbers weight(int distance) noexcept { return Isa::repeat(weights[static_cast<std::size_t>(distance)]); }
    /// What a sum begins with, rounded by itself.
    GNOMON_LANES numbers product(numbers w, numbers a) noexcept {
        numbers begun = Isa::multiply(w, a);
        Isa::settle(begun);
        return begun;
    }
    /// Two taps more of one weight. (See detail::sums.) Whole codes are summed first, for that rounds nothing and is quicker.
    GNOMON_LANES numbers add(numbers sum, numbers w, numbers a, numbers b) noexcept {
        if constexpr (by::in_floats || channel_type::whole_codes)
            return Isa::add_product(sum, w, Isa::add(a, b));
        else
            return Isa::add_product(Isa::add_product(sum, w, a), w, b);
    }
    GNOMON_LANES numbers codes(const storage* from) noexcept {
        if constexpr (of_bytes)
            return Isa::numbers(Isa::widen32(from));
        else if constexpr (by::in_floats)
            return Isa::template codes_of<channel_type, 1>(from, 0);
        else if constexpr (Texel::representation_type::premultiplied)
            return Isa::template codes<channel_type>(from);
        else
            return Isa::multiply_pairs(Isa::template codes<channel_type>(from), static_cast<double>(channel_type::scale));
    }

    static void columns(const storage* const* rows, const storage* const* ahead, Number* line, int plane, int count) noexcept {
        for (int at = 0; at < count; at += step) {
            const int i = lesser(at, count - step);
            call_for<Isa>(ahead, i);
            numbers values[static_cast<std::size_t>(taps + rows_at_once - 1)];
            GNOMON_UNROLL(16)
            for (int t = 0; t < taps + rows_at_once - 1; ++t) values[t] = codes(rows[t] + i);
            GNOMON_UNROLL(4)
            for (int j = 0; j < rows_at_once; ++j) {
                const numbers* const centre = values + j + Kernel::radius;
                numbers sum = product(weight(0), *centre);
                GNOMON_UNROLL(16)
                for (int d = 1; d <= Kernel::radius; ++d) sum = add(sum, weight(d), centre[-d], centre[d]);
                if constexpr (!channel_type::whole_codes && !by::in_floats) { // detail::to_bits<36>
                    constexpr std::uint64_t dropped = (1 << 17) - 1;
                    sum = Isa::add_and_mask(sum, dropped / 2 + 1, ~dropped);
                }
                Isa::store(line + j * plane + i, sum);
            }
        }
    }

    static void clear(Number* line, int, int first, int last) noexcept {
        for (int i = first; i < last; ++i) {
            const auto code = Texel::clear().template linear<Number>(i % Texel::channels);
            line[i] = static_cast<Number>(by::weights_of::total / by::unit) * code;
        }
    }

    /// The two taps so near a row's centre that registers on either side of it hold them too.
    template <int Distance> GNOMON_LANES numbers add_near(numbers sum, numbers before, numbers here, numbers behind) noexcept {
        constexpr int away = Distance * Texel::channels;
        return add(sum, weight(Distance), Isa::template straddle<step - away>(before, here),
                   Isa::template straddle<away>(here, behind));
    }

    /// What is a float and at most 2^22, to nearest.
    GNOMON_LANES numbers nearest(numbers a) noexcept {
        const numbers units = Isa::repeat(0x1.8p23f); // times which a float is a whole number
        return Isa::subtract(Isa::add(a, units), units);
    }
    /// Codes of sums that are exact in float, halves upwards: it is the nearest of a quarter less, or one more.
    GNOMON_LANES numbers rounded(numbers sum) noexcept {
        constexpr auto whole = static_cast<float>(by::whole);
        const numbers code = nearest(Isa::add_product(Isa::repeat(-0.25f), sum, Isa::repeat(1.0f / whole)));
        const numbers rest = Isa::add_product(sum, code, Isa::repeat(-whole));
        return Isa::add(code, Isa::keep(Isa::not_greater(Isa::repeat(whole / 2.0f), rest), Isa::repeat(1.0f)));
    }
    /// A register of codes, if none is in doubt. A sum of positive numbers is rounded R+4 times on its way to a code, each time by 2^-24
    /// of itself; so no code is off by (R+5) 2^-16.
    GNOMON_LANES bool told(numbers sum, storage* to) noexcept {
        constexpr float sure = 0.5f - static_cast<float>(Kernel::radius + 5) * 0x1p-16f;
        const numbers code = Isa::multiply(sum, Isa::repeat(static_cast<float>(1.0 / static_cast<double>(by::whole))));
        const numbers made = nearest(code), rest = Isa::subtract(code, made);
        if (Isa::any(Isa::greater(Isa::multiply(rest, rest), Isa::repeat(sure * sure)))) return false;
        Isa::template store_codes<channel_type>(to, made);
        return true;
    }
    /// The same in doubles, where each step is exact.
    static void again(const Number* line, storage* to) noexcept {
        for (int k = 0; k < step; k += Isa::double_lanes) {
            const Number* const centre = line + k + margin;
            auto sum = Isa::multiply(Isa::repeat(static_cast<double>(weights[0])), Isa::template codes<float32>(centre));
            GNOMON_UNROLL(16)
            for (int d = 1; d <= Kernel::radius; ++d) {
                const auto both = Isa::add(Isa::template codes<float32>(centre - d * Texel::channels),
                                           Isa::template codes<float32>(centre + d * Texel::channels));
                sum = Isa::add_product(sum, Isa::repeat(static_cast<double>(weights[static_cast<std::size_t>(d)])), both);
            }
            Isa::template store_codes<channel_type>(to + k, quotient(sum));
        }
    }
    /// Of a whole number: halves upwards, then down. The quarter keeps what is whole from being rounded below itself: sum and whole are
    /// whole, and a quarter of 1/whole is more than the product can be wrong by, for every total there is.
    GNOMON_LANES auto quotient(decltype(Isa::repeat(0.0)) sum) noexcept {
        constexpr auto whole = static_cast<double>(by::whole);
        return Isa::multiply(Isa::add(sum, Isa::repeat(static_cast<double>(by::whole / 2) + 0.25)), Isa::repeat(1.0 / whole));
    }

    /// Pairs of a ratio, a register of sums.
    static void store_ratios(const double* sums, storage* to) noexcept {
        for (int k = 0; k < step; k += 2) {
            const std::uint64_t linear[] = {static_cast<std::uint64_t>(sums[k]), static_cast<std::uint64_t>(sums[k + 1])};
            const Texel made = Texel::from_linear(linear, by::whole);
            to[k] = made.stored[0];
            to[k + 1] = made.stored[1];
        }
    }

    GNOMON_LANES_VOID void row(const Number* line, int, storage* to) noexcept {
        constexpr auto whole = static_cast<Number>(by::whole);
        const Number* const centre = line + margin;
        const numbers here = Isa::load(centre);
        numbers sum = product(weight(0), here);
        constexpr int held = straddles<Isa> ? lesser(Kernel::radius, lesser(2, (step - 1) / Texel::channels)) : 0;
        if constexpr (held > 0) {
            const numbers before = Isa::load(centre - step), behind = Isa::load(centre + step);
            sum = add_near<1>(sum, before, here, behind);
            if constexpr (held > 1) sum = add_near<2>(sum, before, here, behind);
        }
        GNOMON_UNROLL(16)
        for (int d = held + 1; d <= Kernel::radius; ++d)
            sum = add(sum, weight(d), Isa::load(centre - d * Texel::channels), Isa::load(centre + d * Texel::channels));
        if constexpr (all_exact) {
            sum = rounded(sum);
        } else if constexpr (of_bytes) {
            if (!told(sum, to)) again(line, to);
            return;
        } else if constexpr (!Texel::representation_type::premultiplied) {
            double sums[static_cast<std::size_t>(step)];
            Isa::store(sums, sum);
            store_ratios(sums, to);
            return;
        } else if constexpr (channel_type::whole_codes) {
            sum = quotient(sum);
        } else if constexpr (!by::in_floats) {
            sum = Isa::divide(sum, Isa::repeat(whole));
        }
        if constexpr (by::in_floats && std::same_as<channel_type, half16>) // no zero has a sign; floats lose it as they are stored
            sum = Isa::add(sum, Isa::repeat(0.0f));
        Isa::template store_codes<channel_type>(to, sum);
    }
};

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
