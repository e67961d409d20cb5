// What the parts of the golden program share: lists of types with names, and one number for all that an operation answers.
//
// A part prints one line for each (operation, format, kernel). A new format is one line in its list here, a new operation one
// print(...) in a part. tests/data/golden.txt says where the expected lines come from.
#pragma once

#include "../support/bits.hpp"
#include "../support/dice.hpp"

#include <gnomon/filter/kernel.hpp>
#include <gnomon/texel/texel.hpp>

#include <bit>
#include <cinttypes>
#include <concepts>
#include <cstdint>
#include <cstdio>
#include <tuple>

namespace golden {

// The parts, one for each folder of include/gnomon, and one for the lanes of backend/.
void print_texel();
void print_filter();
void print_receive();
void print_grid();
void print_facade();
void print_lanes();
void print_geometry();

/// A type, and its name in golden.txt.
template <typename T> struct named {
    using type = T;
    const char* name;
};

using namespace gnomon;
inline constexpr effects plain{}, both{.far_bound = true, .translucency = true};
template <channel Channel, effects Effects = plain> using paper = texel<Channel, paper_depth_mask, Effects>;
template <channel Channel> using ratio = texel<Channel, depth_ratio, both>;

inline constexpr std::tuple channels{named<unorm8>{"unorm8"}, named<unorm16>{"unorm16"}, named<half16>{"half16"},
                                     named<float32>{"float32"}};

/// Every channel, every representation, every set of effects.
inline constexpr std::tuple texels{
    named<rg8>{"rg8"},
    named<rg16>{"rg16"},
    named<rg16f>{"rg16f"},
    named<rg32f>{"rg32f"},
    named<rgb8>{"rgb8"},
    named<rgb16>{"rgb16"},
    named<rgb16f>{"rgb16f"},
    named<rgb32f>{"rgb32f"},
    named<rga8>{"rga8"},
    named<rga16>{"rga16"},
    named<rga16f>{"rga16f"},
    named<rga32f>{"rga32f"},
    named<rgba8>{"rgba8"},
    named<rgba16>{"rgba16"},
    named<rgba16f>{"rgba16f"},
    named<rgba32f>{"rgba32f"},
    named<tm8>{"tm8"},
    named<tm16>{"tm16"},
    named<ratio<unorm8>>{"ratio_rgba8"},
    named<ratio<unorm16>>{"ratio_rgba16"},
    named<paper<unorm8>>{"paper_rg8"},
    named<paper<unorm16>>{"paper_rg16"},
    named<paper<half16>>{"paper_rg16f"},
    named<paper<float32>>{"paper_rg32f"},
    named<paper<unorm8, both>>{"paper_rgba8"},
    named<paper<unorm16, both>>{"paper_rgba16"},
    named<paper<half16, both>>{"paper_rgba16f"},
    named<paper<float32, both>>{"paper_rgba32f"},
};

/// A filter treats all channels of a texel alike, so those with most of them stand for all.
inline constexpr std::tuple filtered_texels{
    named<rgba8>{"rgba8"},
    named<rgba16>{"rgba16"},
    named<rgba16f>{"rgba16f"},
    named<rgba32f>{"rgba32f"},
    named<ratio<unorm8>>{"ratio_rgba8"},
    named<ratio<unorm16>>{"ratio_rgba16"},
    named<paper<unorm8, both>>{"paper_rgba8"},
    named<paper<unorm16, both>>{"paper_rgba16"},
    named<paper<half16, both>>{"paper_rgba16f"},
    named<paper<float32, both>>{"paper_rgba32f"},
};

inline constexpr std::tuple kernels{named<box<2>>{"box<2>"}, named<tent<4>>{"tent<4>"}, named<binomial<3>>{"binomial<3>"},
                                    named<gaussian<8>>{"gaussian<8>"}};

/// FNV-1a over numbers, their low bytes first, never over memory: the same on either endianness. -0 is told from 0, but every NaN is
/// one, since the sign and the digits of a NaN that was computed are the processor's own.
class hash {
  public:
    /// Adds numbers, in the order they are written.
    template <typename... Numbers> hash& add(Numbers... numbers) {
        (number(numbers), ...);
        return *this;
    }
    template <texel_format Texel> hash& add(const Texel& texel) {
        for (const auto stored : texel.stored) number(stored);
        return *this;
    }
    [[nodiscard]] std::uint64_t value() const { return h_; }

  private:
    template <std::integral Number> void number(Number v) { bytes(static_cast<std::uint64_t>(v), 8); }
    void number(float v) { bytes(std::bit_cast<std::uint32_t>(test::is_nan(v) ? test::nan<float> : v), 4); }
    void number(double v) { bytes(std::bit_cast<std::uint64_t>(test::is_nan(v) ? test::nan<double> : v), 8); }
    void number(texel_rect r) { add(r.x0, r.y0, r.x1, r.y1); }
    void number(tile_rect r) { add(r.x0, r.y0, r.x1, r.y1); }
    void number(depth_interval z) { add(z.nearest, z.farthest); }
    void bytes(std::uint64_t v, int count) {
        for (int byte = 0; byte < count; ++byte) h_ = (h_ ^ (v >> (8 * byte) & 0xFFu)) * 0x100000001B3u;
    }

    std::uint64_t h_ = 0xCBF29CE484222325u;
};

inline void print(const char* operation, const char* format, const char* kernel, std::uint64_t h) {
    std::printf("%s %s %s %016" PRIX64 "\n", operation, format, kernel, h);
}
inline void print(const char* operation, const char* format, const char* kernel, const hash& h) {
    print(operation, format, kernel, h.value());
}

/// A line for each type of a list: hash_of is a template lambda that is given a named<T>.
template <typename... Types, typename F> void print(const char* operation, const std::tuple<named<Types>...>& list, F&& hash_of) {
    (print(operation, std::get<named<Types>>(list).name, "-", hash_of(std::get<named<Types>>(list))), ...);
}
/// A line for each pair of types of two lists.
template <typename... Formats, typename... Kernels, typename F>
void print(const char* operation, const std::tuple<named<Formats>...>& formats, const std::tuple<named<Kernels>...>& all,
           F&& hash_of) {
    const auto with = [&](auto format) {
        (print(operation, format.name, std::get<named<Kernels>>(all).name, hash_of(format, std::get<named<Kernels>>(all))), ...);
    };
    (with(std::get<named<Formats>>(formats)), ...);
}

/// 32 random bits. (test::float_dice throws twice in one expression, and the order of that is the compiler's.)
inline std::uint32_t word(test::dice& roll) {
    const int high = roll(0, 0xFFFF), low = roll(0, 0xFFFF);
    return static_cast<std::uint32_t>(high) << 16 | static_cast<std::uint32_t>(low);
}
/// A double of random digits in [2^lowest, 2^highest).
inline double digits(test::dice& roll, int lowest, int highest) {
    const auto exponent = static_cast<std::uint64_t>(roll(lowest, highest - 1) + 1023);
    const std::uint64_t high = word(roll), low = word(roll);
    return std::bit_cast<double>(exponent << 52 | ((high << 32 | low) >> 12));
}
/// One that no optimiser knows: what is called through it is not folded into its caller, nor computed by the compiler.
template <typename F> [[nodiscard]] F* opaque(F* f) {
    F* volatile known_later = f;
    return known_later;
}

} // namespace golden
