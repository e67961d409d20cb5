// gnomon: soft shadow maps. The separable filter: columns into one wide line, the line into a row, one rounding.
#pragma once

#include <gnomon/filter/fast.hpp>
#include <gnomon/filter/kernel.hpp>
#include <gnomon/texel/image.hpp>
#include <gnomon/texel/texel.hpp>

#include <bit>
#include <concepts>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace gnomon::inline GNOMON_BUILD {

/// What a line between the passes holds: whole numbers where codes are whole (exact), doubles otherwise.
template <texel_format Texel>
using line_element =
    std::conditional_t<!Texel::channel_type::whole_codes, double,
                       std::conditional_t<(Texel::linear_scale * kernel_total_limit < 0x1p32), std::uint32_t, std::uint64_t>>;

namespace detail {

template <texel_format Texel>
inline constexpr bool premultiplied_bytes =
    std::same_as<typename Texel::channel_type, unorm8> && Texel::representation_type::premultiplied;

/// What lanes that go channel by channel count in: floats, which hold every column of bytes, or if that is what `fast` asks for.
template <texel_format Texel, kernel Kernel>
using lane_number = std::conditional_t<premultiplied_bytes<Texel> || plan<Texel, Kernel>::how != arithmetic::exact, float, double>;

/// Rows that lanes sum side by side, and the bytes that a strip's sums of one row take, at most.
inline constexpr int lane_rows = 4, lane_strip_bytes = 32768;

} // namespace detail

/// The memory a filter needs beside its images, in elements, for a map of `width` texels: room for a line of wide sums, or for lanes
/// that sum four rows at once, 32 kB of each. Nothing is read from it that the same call did not write, so it may hold anything.
template <texel_format Texel, kernel Kernel> [[nodiscard]] constexpr std::size_t filter_scratch_size(int width) noexcept {
    constexpr std::size_t number = sizeof(detail::lane_number<Texel, Kernel>), margin = std::size_t{Kernel::radius};
    constexpr std::size_t strip = detail::lane_strip_bytes / number / Texel::channels, lines = detail::lane_rows + 1;
    const auto texels = static_cast<std::size_t>(greater(width, 0));
    // A line a row, which begins on a cache line, and one of nothing, for what lies off the map; and what registers reach beyond the ends.
    const std::size_t lanes = (lesser(texels, strip) + 3 * margin) * lines * number / sizeof(line_element<Texel>);
    return (greater(texels + 2 * margin, lanes) + 512) * static_cast<std::size_t>(Texel::channels);
}

/// Owns that memory; allocates in its constructor and never again.
template <texel_format Texel, kernel Kernel> class filter_scratch {
  public:
    filter_scratch() = default;
    explicit filter_scratch(int width) : line_(filter_scratch_size<Texel, Kernel>(width)) {}
    [[nodiscard]] std::span<line_element<Texel>> line() noexcept { return line_; }

  private:
    std::vector<line_element<Texel>> line_;
};

namespace detail {

/// A double cut to so many significant bits, to nearest, halves upwards, by integer arithmetic: times a weight of the 53 - Bits
/// that are left it is then exact, so a sum of such products has the same bits whether or not a compiler fuses multiply and add.
/// Monotone; relative error 2^-Bits.
template <int Bits> [[nodiscard]] constexpr double to_bits(double v) noexcept {
    constexpr std::uint64_t dropped = (std::uint64_t{1} << (53 - Bits)) - 1;
    return std::bit_cast<double>((std::bit_cast<std::uint64_t>(v) + (dropped + 1) / 2) & ~dropped);
}

/// How a texel's filter computes, by the weights it uses: what a sum begins with, two taps more of one weight, what is left of a sum
/// between the passes, and what 1 is at the end. Sums go from the centre outwards.
template <texel_format Texel, kernel Kernel> struct sums {
    using chosen = plan<Texel, Kernel>;
    using weights_of = typename chosen::weights_of;
    using element = line_element<Texel>;
    using wide = typename Texel::linear_sum;
    static constexpr bool in_floats = chosen::how == arithmetic::single, stored_between = chosen::how == arithmetic::stored;

    /// What weights are divided by: floats are weighed by parts of one.
    static constexpr int unit = in_floats ? weights_of::total : 1;
    template <typename Number> [[nodiscard]] static constexpr Number weight(int tap) noexcept {
        return static_cast<Number>(weights_of::weights[static_cast<std::size_t>(tap)]) / static_cast<Number>(unit);
    }
    /// The weights of both passes.
    static constexpr wide whole = [] {
        constexpr auto total = static_cast<wide>(weights_of::total / unit);
        return stored_between ? total : total * total;
    }();

    template <typename Number> [[nodiscard]] static constexpr Number product(Number w, Number v) noexcept {
        // w v is exact, and rounded by `store` in a way that no compiler fuses with a sum
        if constexpr (in_floats) return static_cast<Number>(float32::store(static_cast<double>(w * v)));
        return w * v;
    }
    template <typename Number> [[nodiscard]] static constexpr Number add(Number sum, Number w, Number a, Number b) noexcept {
        if constexpr (in_floats) {
            const auto both = static_cast<Number>(static_cast<float>(a) + static_cast<float>(b));
            return static_cast<Number>(static_cast<float>(sum) + static_cast<float>(product(w, both)));
        }
        return sum + w * a + w * b;
    }
    [[nodiscard]] static constexpr element between(element sum) noexcept {
        if constexpr (stored_between)
            return (sum + weights_of::total / 2) / weights_of::total;
        else if constexpr (is_narrow<Kernel>)
            return static_cast<element>(Texel::channel_type::code(Texel::channel_type::store(sum)));
        else if constexpr (Texel::channel_type::whole_codes || in_floats)
            return sum;
        else
            return to_bits<36>(sum);
    }
};

/// The first pass: for the columns [x0, x1) the weighted sums of the 2R+1 rows around `y`. What lies off the map is clear.
template <kernel Kernel, texel_format Texel>
void sum_columns(image_view<const Texel> from, int y, int x0, int x1, std::span<line_element<Texel>> line) noexcept {
    using element = line_element<Texel>;
    using by = sums<Texel, Kernel>;
    constexpr int channels = Texel::channels;
    constexpr Texel clear = Texel::clear();
    struct texels {
        const Texel* first;
        int step; // none, where they are all one
        [[nodiscard]] element code(int x, int c) const noexcept {
            return first[static_cast<std::ptrdiff_t>(x) * step].template linear<element>(c);
        }
    };
    const texels nothing{&clear, 0};
    const auto row = [&](int at) { return at < 0 || at >= from.height() ? nothing : texels{from.row(at), 1}; };
    const int inside0 = lesser(greater(x0, 0), x1), inside1 = greater(lesser(x1, from.width()), inside0);
    const auto add = [&line, x0](int distance, int first, int last, texels above, texels below) {
        const auto weight = by::template weight<element>(Kernel::radius + distance);
        element* sum = line.data() + static_cast<std::ptrdiff_t>(first - x0) * channels;
        for (int x = first; x < last; ++x)
            for (int c = 0; c < channels; ++c, ++sum)
                *sum = distance == 0 ? by::product(weight, above.code(x, c))
                                     : by::add(*sum, weight, above.code(x, c), below.code(x, c));
    };
    for (int distance = 0; distance <= Kernel::radius; ++distance) {
        add(distance, x0, inside0, nothing, nothing);
        add(distance, inside0, inside1, row(y - distance), row(y + distance));
        add(distance, inside1, x1, nothing, nothing);
    }
    const auto count = static_cast<std::size_t>(x1 - x0) * channels;
    for (std::size_t i = 0; i < count; ++i) line[i] = by::between(line[i]);
}

/// The second pass and the last rounding: `width` texels out of a line that begins Kernel::radius columns before them.
template <kernel Kernel, texel_format Texel>
void sum_row(std::span<const line_element<Texel>> line, Texel* to, int width) noexcept {
    constexpr int channels = Texel::channels;
    using by = sums<Texel, Kernel>;
    using wide = typename by::wide;
    for (int x = 0; x < width; ++x) {
        wide sum[static_cast<std::size_t>(channels)];
        for (int c = 0; c < channels; ++c) {
            const auto tap = [&](int i) {
                return static_cast<wide>(line[static_cast<std::size_t>((std::int64_t{x} + i) * channels + c)]);
            };
            sum[c] = by::product(by::template weight<wide>(Kernel::radius), tap(Kernel::radius));
            for (int i = 1; i <= Kernel::radius; ++i)
                sum[c] = by::add(sum[c], by::template weight<wide>(Kernel::radius + i), tap(Kernel::radius - i),
                                 tap(Kernel::radius + i));
        }
        to[x] = Texel::from_linear(sum, by::whole);
    }
}

} // namespace detail

/// Filters the texels of `region` from one image into another of the same size; everything outside the region is left alone.
///
/// Beyond the map's edge lies clear, never a repeated edge. Unorm results are the exact rational convolution rounded once, halves
/// upwards. Half and float results are rounded once from a sum within 2^-35 of it, relatively. Clear stays exactly clear, a uniform
/// region stays exactly itself, and e <= m holds at every texel, the paper's pair in half and float excepted. `scratch` is trusted for nothing.
/// \pre `from` and `to` share no texel; an image is not filtered into itself, and asking for it does nothing.
/// Cost: 2 (2R+1) multiply-adds a channel of a texel, and half of that for 2R columns beside the region.
template <kernel Kernel, texel_format Texel>
void filter_region(std::type_identity_t<image_view<const Texel>> from, image_view<Texel> to, texel_rect region,
                   filter_scratch<Texel, Kernel>& scratch) noexcept {
    static_assert(kernel_is_sound<Kernel>());
    region = clip(clip(region, to.size()), from.size());
    const bool apart = !share_texels<Texel>(from, to);
    GNOMON_ASSERT(apart || region.empty(), "gnomon: a filter reads one image and writes another: give it two that share no texel");
    if (!apart) return;
    // Too narrow a scratch cuts the region into strips; one without room for a single texel leaves it alone.
    const int widest = static_cast<int>(scratch.line().size() / static_cast<std::size_t>(Texel::channels)) - 2 * Kernel::radius;
    GNOMON_ASSERT(region.empty() || widest > 0,
                  "gnomon: the filter's scratch has no room for a texel; make it for the map's width");
    if (region.empty() || widest <= 0) return;
    for (int x0 = region.x0; x0 < region.x1; x0 += widest) {
        const int x1 = lesser(region.x1, x0 + widest);
        for (int y = region.y0; y < region.y1; ++y) {
            detail::sum_columns<Kernel, Texel>(from, y, x0 - Kernel::radius, x1 + Kernel::radius, scratch.line());
            detail::sum_row<Kernel, Texel>(scratch.line(), to.row(y) + x0, x1 - x0);
        }
    }
}

} // namespace gnomon::inline GNOMON_BUILD
