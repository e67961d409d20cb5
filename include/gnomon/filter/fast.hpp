// gnomon: soft shadow maps. How exactly a filter computes: the kernel as it is, or fast, with the error it may then make.
#pragma once

#include <gnomon/filter/kernel.hpp>
#include <gnomon/texel/texel.hpp>

#include <bit>
#include <concepts>
#include <cstddef>
#include <type_traits>

namespace gnomon::inline GNOMON_BUILD {

/// Any kernel, where accuracy may be traded for time: filter_scratch<rg16, fast<gaussian<4>>>. What that means depends on the texel.
///
///     unorm8       weights of eight bits (see eight_bit), and then no error but the one rounding; the kernel as it is if it is a
///                  box, if 256 is a multiple of its total, or if it is wider than R = 32
///     unorm16      weights of 15 bits, and rounded twice, after the columns and after the row: at most one code off instead of half
///     half, float  weights of 24 bits if the total is no power of two, and single precision: every product and every sum is rounded,
///                  R+2 times a pass; a box of radius 12 and more is quicker without, where its sums run (see backend/simd_double_box.hpp)
///     depth_ratio  in 16 bits weights of ten bits, up to R = 128, and then no error but the two roundings; in 8 bits the kernel as it is
///
/// Weights are within one unit of the kernel's proportions, and these errors are against what such weights give; how far that may
/// be from what the kernel itself gives, `filter_deviation` tells. e and m are weighed alike, so no false shadow comes of it.
/// Everything else that a filter promises still holds, in every bit on every processor: clear stays clear, e <= m, and in unorm a
/// uniform region stays itself. `filter_roundings` tells bias the rest.
template <kernel Kernel> struct fast {
    static_assert(
        !requires { typename Kernel::within; }, "gnomon: fast<narrow<Kernel>>: narrow says how already; take one of the two");
    static constexpr int radius = Kernel::radius;
    static constexpr int total = Kernel::total;
    static constexpr auto weights = Kernel::weights;
    using exact = Kernel;
};

/// Any kernel, where nothing wider than the map itself may lie between the passes, as on a GPU short of memory or of formats:
/// filter_scratch<rg8, narrow<binomial<3>>>. Columns are rounded to the texel's own numbers, then rows: so a pair is rounded twice, and
/// unorm codes are at most one off instead of half. Half and float are computed in single precision. Not for depth_ratio.
template <kernel Kernel> struct narrow {
    static_assert(
        !requires { typename Kernel::exact; }, "gnomon: narrow<fast<Kernel>>: narrow is as fast already; take one of the two");
    static constexpr int radius = Kernel::radius;
    static constexpr int total = Kernel::total;
    static constexpr auto weights = Kernel::weights;
    using within = Kernel;
};

namespace detail {

template <kernel Kernel> inline constexpr bool is_narrow = requires { typename Kernel::within; };
template <kernel Kernel> inline constexpr bool is_fast = requires { typename Kernel::exact; };
/// Every tap the same, and one: not what has their sum alone, as (1, 0, 3, 0, 1).
template <kernel Kernel>
inline constexpr bool is_box = [] {
    for (const int w : Kernel::weights)
        if (w != 1) return false;
    return true;
}();

/// A kernel by weights of such a total: itself, if that is its own.
template <kernel Kernel, int Total> using of_total = std::conditional_t<Total == Kernel::total, Kernel, in_units<Kernel, Total>>;
/// The total that floats weigh by. Its parts and their sums are floats: so one stays one, and nothing is left to divide by.
template <kernel Kernel>
inline constexpr int total_in_floats = std::has_single_bit(static_cast<unsigned>(Kernel::total)) ? Kernel::total : 1 << 24;

enum class arithmetic {
    exact,  ///< sums without error, one rounding
    stored, ///< sums without error, rounded to storage after each pass
    single, ///< floats
};

/// What a filter does with a texel and a kernel: in which arithmetic, by which weights.
template <texel_format Texel, kernel Kernel> struct plan {
    static constexpr auto how = arithmetic::exact;
    using weights_of = Kernel;
};
template <texel_format Texel, kernel Kernel>
    requires is_fast<Kernel>
struct plan<Texel, Kernel> {
    using channel_type = typename Texel::channel_type;
    using given = typename Kernel::exact;
    static constexpr bool is_unorm8 = std::same_as<channel_type, unorm8>, is_unorm16 = std::same_as<channel_type, unorm16>,
                          is_float = std::same_as<channel_type, half16> || std::same_as<channel_type, float32>,
                          is_ratio = !Texel::representation_type::premultiplied,
                          as_it_is = Kernel::radius == 0 || (channel_type::whole_codes && is_box<given>);
    static constexpr auto how = as_it_is || is_ratio ? arithmetic::exact
                                : is_unorm16         ? arithmetic::stored
                                : is_float           ? arithmetic::single
                                                     : arithmetic::exact;
    static constexpr bool bytes = is_unorm8 && !is_ratio && !as_it_is && Kernel::radius <= 32 && 256 % Kernel::total != 0,
                          ratios = is_unorm16 && is_ratio && !as_it_is && Kernel::radius <= 128 && Kernel::total > 1024;
    static constexpr int total = how == arithmetic::stored   ? 1 << 15
                                 : how == arithmetic::single ? total_in_floats<given>
                                 : bytes                     ? 256
                                 : ratios                    ? 1024
                                                             : given::total;
    using weights_of = of_total<given, total>;
};

template <texel_format Texel, kernel Kernel>
    requires is_narrow<Kernel>
struct plan<Texel, Kernel> {
    static_assert(
        Texel::representation_type::premultiplied,
        "gnomon: narrow<Kernel>: a ratio of depth and mask is made from sums of both passes; filter it by the kernel itself");
    static constexpr auto how = Texel::channel_type::whole_codes ? arithmetic::stored : arithmetic::single;
    using within = typename Kernel::within;
    using weights_of = of_total<within, how == arithmetic::single ? total_in_floats<within> : within::total>;
};

} // namespace detail

/// How far a filtered number may lie from what the kernel itself gives, in parts of the range and beside all rounding, since `fast` has
/// weights of its own: 2 g, if these gain g on the kernel's in one pass. For two passes differ by f f - k k = f (f-k) + (f-k) k, and
/// of numbers in [0, 1] each term makes g at most; of a ratio, of its mask. Maps made for it reach half of that and more, others far less.
template <texel_format Texel, kernel Kernel>
inline constexpr double filter_deviation = [] {
    using chosen = typename detail::plan<Texel, Kernel>::weights_of;
    double gained = 0.0;
    for (std::size_t i = 0; i < Kernel::weights.size(); ++i)
        gained += greater(0.0, static_cast<double>(chosen::weights[i]) / chosen::total -
                                   static_cast<double>(Kernel::weights[i]) / Kernel::total);
    return 2.0 * gained;
}();

/// How many roundings of the texel's channel a filter's error amounts to: `bias::roundings`, unless more is stored between.
template <texel_format Texel, kernel Kernel>
inline constexpr int filter_roundings = [] {
    using chosen = detail::plan<Texel, Kernel>;
    if (chosen::how == detail::arithmetic::exact) return 1;
    if (chosen::how == detail::arithmetic::stored) return 2;
    // Each tap is rounded with the one across, as a product and in at most R sums.
    constexpr int roundings = 2 * (Kernel::radius + 2);
    return std::same_as<typename Texel::channel_type, float32>
               ? roundings + 1
               : (detail::is_narrow<Kernel> ? 3 : 2); // of 2^-24 each: in halves less than one
}();

} // namespace gnomon::inline GNOMON_BUILD
