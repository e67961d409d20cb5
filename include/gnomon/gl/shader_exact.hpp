// gnomon: soft shadow maps. What GLSL lacks and an exact shader needs: a comparison with a product, quotients, halves, what is a number.
//
// Each is a text in whole numbers of 32 bits, or in floats whose roundings do not show, so every GL computes it alike.
#pragma once

#include <gnomon/gl/glsl_text.hpp>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

/// `bool gnomon_exceeds(float a, float b, float c)`: is a b > c? As if computed without rounding, which no float can.
///
/// As comparing doubles would have it: false if one is NaN, or if a b is, infinity times nothing; else an infinite product exceeds
/// all that is not the same infinity. Subnormals count, where the driver leaves them what they are. Floats tell wherever the two differ
/// by a millionth, sixteen times what they round; so it costs about 8 operations, and 60 more for a receiver at the threshold itself.
inline constexpr std::string_view exceeds_text = R"(// a * b > c, exactly, which takes 48 bits where the two are nearly alike
bool gnomon_exceeds(float a, float b, float c) {
    float product = a * b;
    if (abs(product - c) > abs(product) * 0.000001 + 1e-30) return product > c;
    uint x = floatBitsToUint(a), y = floatBitsToUint(b), z = floatBitsToUint(c);
    bool below = ((x ^ y) >> 31) != 0u, c_below = (z >> 31) != 0u; // zero, so the product and c
    x &= 0x7FFFFFFFu;
    y &= 0x7FFFFFFFu;
    z &= 0x7FFFFFFFu;
    const uint infinity = 0x7F800000u;
    if (x > infinity || y > infinity || z > infinity) return false; // not a number
    if (x == infinity || y == infinity) return x != 0u && y != 0u && !below && (c_below || z != infinity);
    if (x == 0u || y == 0u) return c_below && z != 0u;
    if (z == 0u) return !below;
    if (z == infinity || below != c_below) return c_below;

    // The significands; their product, and c moved to the left until the last places are of one size, in two limbs of 24 bits.
    uint e = max(x >> 23, 1u) + max(y >> 23, 1u), f = max(z >> 23, 1u) + 150u;
    x = (x & 0x7FFFFFu) | (x >> 23 != 0u ? 0x800000u : 0u);
    y = (y & 0x7FFFFFu) | (y >> 23 != 0u ? 0x800000u : 0u);
    z = (z & 0x7FFFFFu) | (z >> 23 != 0u ? 0x800000u : 0u);
    uint cross = (x >> 12) * (y & 0xFFFu) + (x & 0xFFFu) * (y >> 12);
    uint low = (x & 0xFFFu) * (y & 0xFFFu) + ((cross & 0xFFFu) << 12);
    uint high = (x >> 12) * (y >> 12) + (cross >> 12) + (low >> 24);
    low &= 0xFFFFFFu;
    if (f < e) return !below; // all of c is less than the product
    uint shift = f - e;
    if (shift >= 48u) return below;
    uint c_high = z >> (24u - shift % 24u), c_low = (z << (shift % 24u)) & 0xFFFFFFu;
    if (shift >= 24u) {
        if (c_high != 0u) return below;
        c_high = c_low;
        c_low = 0u;
    }
    if (high != c_high) return (high > c_high) != below;
    return low != c_low && (low > c_low) != below;
}
)";

/// `bool gnomon_exceeds(vec2 a, float b, vec2 c)`: the same of numbers that no float holds, blends of 16-bit codes: a is a.x + a.y,
/// a whole or half number below 2^18 and a multiple of 2^-16 below 1. Cost: about 10 operations, and 100 more at the threshold.
inline constexpr std::string_view exceeds_blend_text = R"(// the size of v.x + v.y, in units of 2^-16: its whole part and the rest
uvec2 gnomon_units(vec2 v) {
    if (v.x + v.y < 0.0) v = -v;
    precise float rest = v.x - floor(v.x) + v.y;
    return uvec2(uint(floor(v.x) + floor(rest)), uint((rest - floor(rest)) * 65536.0));
}

// n + v * 2^shift, the high word first
uvec2 gnomon_add_shifted(uvec2 n, uint v, int shift) {
    uint low = n.y + (v << shift);
    return uvec2(n.x + (v >> (32 - shift)) + (low < n.y ? 1u : 0u), low);
}

// n * 2^shift as three words, the highest first
uvec3 gnomon_shifted(uvec2 n, int shift) {
    int bits = shift & 31;
    uvec3 words = uvec3(0u, n.x, n.y);
    if (bits != 0) words = uvec3(n.x >> (32 - bits), n.x << bits | n.y >> (32 - bits), n.y << bits);
    return shift < 32 ? words : uvec3(words.y, words.z, 0u);
}

// a * b > c, exactly; a and c are sums of a number in halves and one in parts of 2^16
bool gnomon_exceeds(vec2 a, float b, vec2 c) {
    float product = (a.x + a.y) * b, sum = c.x + c.y;
    if (abs(product - sum) > abs(product) * 0.000001 + 1e-30) return product > sum;
    uint bits = floatBitsToUint(b), y = bits & 0x7FFFFFFFu;
    bool below = (a.x + a.y < 0.0) != (y != bits), c_below = c.x + c.y < 0.0; // zero, so the product and c
    uvec2 x = gnomon_units(a), z = gnomon_units(c);
    bool nothing = (x.x | x.y) == 0u;
    if (y > 0x7F800000u || (nothing && y == 0x7F800000u)) return false; // not a number
    if (nothing || y == 0u || below != c_below) return c_below;

    // Beyond 2^35 and before 2^-35 all b are alike. The product of units and the significand, and c, with one last place.
    y = max(min(y, 0x51000000u), 0x2E000000u);
    int shift = 150 - int(y >> 23);
    y = (y & 0x7FFFFFu) | 0x800000u;
    uvec2 units = uvec2(0u, x.y * (y & 0xFFFu));
    units = gnomon_add_shifted(units, x.y * (y >> 12), 12);
    units = gnomon_add_shifted(units, x.x * (y & 0xFFFu), 16);
    units = gnomon_add_shifted(units, x.x * (y >> 12), 28);
    uvec3 left = gnomon_shifted(units, max(-shift, 0));
    uvec3 right = gnomon_shifted(uvec2(z.x >> 16, z.x << 16 | z.y), max(shift, 0));
    if (left.x != right.x) return (left.x > right.x) != below;
    if (left.y != right.y) return (left.y > right.y) != below;
    return below ? left.z < right.z : left.z > right.z;
}
)";

/// `bool gnomon_is_number(float v)`: by its bits. A driver may write !(v > 0) as v <= 0, as NVIDIA's does, which lets a NaN pass.
inline constexpr std::string_view is_number_text = R"(
bool gnomon_is_number(float v) { return (floatBitsToUint(v) & 0x7FFFFFFFu) <= 0x7F800000u; }
)";

/// `float gnomon_divide(float a, float b, float inverse)`: a / b to the nearest float, by 1 / b within three last places; a driver's own
/// quotient may be 2.5 off. The remainder a - share b is exact, taken in halves of 12 bits, and corrects the share. So for finite a and a / b
/// that are 0 or beyond 2^-78, and b of at most 16 bits; of more, it may be the neighbour. Cost: about 14 operations.
inline constexpr std::string_view divide_text = R"(
// a / b, to the nearest float; inverse is 1 / b, which drivers compute with an error of some last places
float gnomon_divide(float a, float b, float inverse) {
    uint bits = floatBitsToUint(a * inverse) & 0xFFFFFFFEu; // the share as bits, for a product could be fused
    float share = uintBitsToFloat(bits), high = uintBitsToFloat(bits & 0xFFFFF000u), low = share - high;
    float b_high = uintBitsToFloat(floatBitsToUint(b) & 0xFFFFF000u), b_low = b - b_high;
    precise float rest = ((a - high * b_high) - high * b_low) - low * b_high - low * b_low; // exact, be it fused or not
    precise float quotient = share + rest * inverse;
    return quotient;
}
)";

/// `float gnomon_half(float v)`: the half nearest to v, ties to even, as a float, so that whichever way a driver rounds what it
/// stores, it rounds nothing. `uint gnomon_nearest_even(uint v, int bits)`: v / 2^bits to nearest, ties to even, 1 to 31 bits.
inline constexpr std::string_view half_text = R"(// v / 2^bits to nearest, ties to even
uint gnomon_nearest_even(uint v, int bits) {
    uint kept = v >> bits, rest = v - (kept << bits), tie = 1u << (bits - 1);
    return kept + (rest > tie || (rest == tie && (kept & 1u) != 0u) ? 1u : 0u);
}

// the half nearest to v, ties to even, which a driver then stores as it is
float gnomon_half(float v) {
    uint bits = floatBitsToUint(v), size = bits & 0x7FFFFFFFu, sign = bits ^ size;
    if (size >= 0x7F800000u) return v;                                           // infinite, or not a number
    if (size < 0x33000000u) return uintBitsToFloat(sign);                        // less than half of the least half
    if (size < 0x38800000u) {                                                    // a multiple of 2^-24
        uint units = gnomon_nearest_even((size & 0x7FFFFFu) | 0x800000u, 126 - int(size >> 23));
        return (sign != 0u ? -1.0 : 1.0) * float(units) * 0.000000059604644775390625;
    }
    size = gnomon_nearest_even(size, 13) << 13;
    return uintBitsToFloat(sign | (size >= 0x47800000u ? 0x7F800000u : size)); // beyond the last half is infinity
}
)";

/// `uint gnomon_quotient(uvec2 n, uvec2 d)`: n / d rounded down, of numbers of two words, the high one first. \pre the quotient is
/// less than 2^16, and d less than 2^48
inline constexpr std::string_view quotient_text = R"(// n / d rounded down, below 2^16; of numbers of two words, the high one first
uint gnomon_quotient(uvec2 n, uvec2 d) {
    uint quotient = 0u;
    for (int bit = 15; bit >= 0; --bit) {
        uvec2 part = bit == 0 ? d : uvec2(d.x << bit | d.y >> (32 - bit), d.y << bit);
        if (n.x < part.x || (n.x == part.x && n.y < part.y)) continue;
        n = uvec2(n.x - part.x - (n.y < part.y ? 1u : 0u), n.y - part.y);
        quotient |= 1u << bit;
    }
    return quotient;
}
)";

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
