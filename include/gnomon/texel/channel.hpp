// gnomon: soft shadow maps. A channel: how one number in [0, 1] is stored.
//
// A channel answers in three voices, and no function mixes them:
//   storage   the bits in memory: std::uint8_t, std::uint16_t or float. Never used as a depth.
//   value     the number those bits stand for, in [0, 1].
//   code      the value times `scale`: a whole number for unorm, the value itself for half and float. Filters and
//             decisions work on codes, because a decision is homogeneous: e > m r  <=>  E > M r, and codes are exact.
#pragma once

#include <gnomon/texel/half.hpp>
#include <gnomon/unit.hpp>

#include <concepts>
#include <cstdint>
#include <type_traits>

namespace gnomon::inline GNOMON_BUILD {

/// A code c that was rounded once from an exact x satisfies |c - x| <= relative * x + absolute.
struct rounding_error {
    float relative;
    float absolute;
};

/// A caster's depth may be stored so much nearer to the light than it is, or farther from it.
struct caster_rounding {
    float nearer;
    float farther;
};

/// How one number in [0, 1] is stored. Write your own by answering this list.
///
/// `encode` rounds to the nearest stored value, is monotone, reaches every stored value in [0, 1], clamps, and takes NaN to 0.
/// `max_error` bounds |decode(encode(v)) - v| over [0, 1]; `rounding` bounds the error of a code. Bias is derived from both.
template <typename C>
concept channel = requires(typename C::storage stored, double value) {
    requires std::same_as<std::remove_cv_t<decltype(C::max_error)>, float>;
    requires std::same_as<std::remove_cv_t<decltype(C::scale)>, float>;
    requires std::same_as<std::remove_cv_t<decltype(C::rounding)>, rounding_error>;
    requires std::same_as<std::remove_cv_t<decltype(C::whole_codes)>, bool>;
    { C::encode(value) } noexcept -> std::same_as<typename C::storage>;
    { C::store(value) } noexcept -> std::same_as<typename C::storage>;
    { C::code(stored) } noexcept -> std::same_as<float>;
    { C::decode(stored) } noexcept -> std::same_as<float>;
};

/// A whole number 0..N standing for 0..1, as GPUs read UNORM: 8 or 16 bits, N = 255 or 65535.
template <typename Storage> struct unorm {
    static_assert(std::same_as<Storage, std::uint8_t> || std::same_as<Storage, std::uint16_t>,
                  "gnomon: unorm<Storage> takes std::uint8_t or std::uint16_t; for 32 bits use float32");
    using storage = Storage;

    static constexpr bool whole_codes = true;
    static constexpr float scale = sizeof(Storage) == 1 ? 255.0f : 65535.0f;
    static constexpr rounding_error rounding{.relative = 0.0f, .absolute = 0.5f};
    /// Half a code, and 2^-25 for the rounding of `decode`.
    static constexpr float max_error = 0.5f / scale + 0x1p-25f;

    /// The code nearest to scale * v; exact for every float `v` (a double within 2^-50 of a tie may take either side).
    [[nodiscard]] static constexpr storage encode(double v) noexcept {
        return static_cast<storage>(saturate(v) * static_cast<double>(scale) + 0.5);
    }
    /// The storage of a code that is already in [0, scale], rounded to nearest, halves upwards; a code within 2^-37 of a half may take either side.
    [[nodiscard]] static constexpr storage store(double code) noexcept { return static_cast<storage>(code + 0.5); }
    [[nodiscard]] static constexpr float code(storage c) noexcept { return static_cast<float>(c); }
    /// Correctly rounded: one division of two exact numbers.
    [[nodiscard]] static constexpr float decode(storage c) noexcept { return static_cast<float>(c) / scale; }
};

using unorm8 = unorm<std::uint8_t>;
using unorm16 = unorm<std::uint16_t>;

/// IEEE binary16: relative precision 2^-11 down to 2^-14, then absolute 2^-25.
struct half16 {
    using storage = std::uint16_t;

    static constexpr bool whole_codes = false;
    static constexpr float scale = 1.0f;
    static constexpr rounding_error rounding{.relative = 0x1p-11f, .absolute = 0x1p-25f};
    /// Half an ulp in [1/2, 1).
    static constexpr float max_error = 0x1p-12f;

    [[nodiscard]] static constexpr storage encode(double v) noexcept { return half_from(saturate(v)); }
    [[nodiscard]] static constexpr storage store(double code) noexcept { return half_from(code); }
    /// Any pattern is read as it is, NaN and infinity too: a decision has the guard, not the decode.
    [[nodiscard]] static constexpr float code(storage c) noexcept { return half_to_float(c); }
    [[nodiscard]] static constexpr float decode(storage c) noexcept { return half_to_float(c); }
};

/// IEEE binary32: relative precision 2^-24.
struct float32 {
    using storage = float;

    static constexpr bool whole_codes = false;
    static constexpr float scale = 1.0f;
    static constexpr rounding_error rounding{.relative = 0x1p-24f, .absolute = 0x1p-149f};
    /// Half an ulp in [1/2, 1).
    static constexpr float max_error = 0x1p-25f;

    [[nodiscard]] static constexpr storage encode(double v) noexcept { return store(saturate(v)); }
    /// The addition keeps g++ 12 from dropping the rounding of two numbers that are stored and read again side by side.
    [[nodiscard]] static constexpr storage store(double code) noexcept { return static_cast<float>(code) + 0.0f; }
    [[nodiscard]] static constexpr float code(storage c) noexcept { return c; }
    [[nodiscard]] static constexpr float decode(storage c) noexcept { return c; }
};

static_assert(channel<unorm8> && channel<unorm16> && channel<half16> && channel<float32>);

} // namespace gnomon::inline GNOMON_BUILD
