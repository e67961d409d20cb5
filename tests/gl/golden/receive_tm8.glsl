// gnomon: receivers behind casters of unorm8 (t, m)
// a * b > c, exactly, which takes 48 bits where the two are nearly alike
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

bool gnomon_is_number(float v) { return (floatBitsToUint(v) & 0x7FFFFFFFu) <= 0x7F800000u; }

// a / b, to the nearest float; inverse is 1 / b, which drivers compute with an error of some last places
float gnomon_divide(float a, float b, float inverse) {
    uint bits = floatBitsToUint(a * inverse) & 0xFFFFFFFEu; // the share as bits, for a product could be fused
    float share = uintBitsToFloat(bits), high = uintBitsToFloat(bits & 0xFFFFF000u), low = share - high;
    float b_high = uintBitsToFloat(floatBitsToUint(b) & 0xFFFFF000u), b_low = b - b_high;
    precise float rest = ((a - high * b_high) - high * b_low) - low * b_high - low * b_low; // exact, be it fused or not
    precise float quotient = share + rest * inverse;
    return quotient;
}

// the size of v.x + v.y, in units of 2^-16: its whole part and the rest
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

// intensity of the shadow on a receiver at depth z, by the numbers of a filtered texel in codes
float gnomon_shadow(vec2 texel, float z) {
    if (!gnomon_is_number(z)) return 0.0;
    if (!(texel.y > 0.0 && z > 0.0)) return 0.0;
    if (!(z < 0.5 ? gnomon_exceeds(texel.y, z, texel.y - texel.x) : gnomon_exceeds(-texel.y, 1.0 - z, -texel.x))) return 0.0;
    precise float darkness = gnomon_divide(texel.y, 65025.0, 1.53787e-05);
    return darkness > 0.0 ? (darkness < 1.0 ? darkness : 1.0) : 0.0;
}

// the same by a blend, whose numbers are whole codes and their fractions
float gnomon_shadow_of_blend(vec2 whole, vec2 fraction, float z) {
    precise vec2 code_x = vec2(whole.x, fraction.x);
    precise vec2 code_y = vec2(whole.y, fraction.y);
    if (!gnomon_is_number(z)) return 0.0;
    if (!(code_y.x + code_y.y > 0.0 && z > 0.0)) return 0.0;
    if (!(z < 0.5 ? gnomon_exceeds(code_y, z, code_y - code_x) : gnomon_exceeds(-code_y, 1.0 - z, -code_x))) return 0.0;
    precise float darkness = gnomon_divide(code_y.x + code_y.y, 65025.0, 1.53787e-05);
    return darkness > 0.0 ? (darkness < 1.0 ? darkness : 1.0) : 0.0;
}

// a texel in codes; clear lies off the map
uvec2 gnomon_read(sampler2D map, ivec2 size, ivec2 at) {
    if (at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y) return uvec2(0);
    vec2 texel = vec2(texelFetch(map, at, 0));
    uvec2 codes = uvec2(texel * 255.0 + 0.5);
    return codes * uvec2(codes.y, 255u);
}

// intensity at texel `at` of a map
float gnomon_shadow(sampler2D map, ivec2 at, float z) { return gnomon_shadow(vec2(gnomon_read(map, textureSize(map, 0), at)), z); }

// intensity at a position in texels, blended from four, in steps of 1/256; off the map is lit
float gnomon_shadow_at(sampler2D map, vec2 position, float z) {
    ivec2 size = textureSize(map, 0);
    vec2 end = vec2(size) + 1.0;
    if (!gnomon_is_number(position.x) || !gnomon_is_number(position.y)) return 0.0;
    if (position.x <= -1.0 || position.y <= -1.0 || position.x >= end.x || position.y >= end.y) return 0.0;
    ivec2 fine = (ivec2(floor(512.0 * position)) - 255) >> 1; // from the centre of texel 0
    ivec2 at = fine >> 8;
    uvec2 right = uvec2(fine & 255), left = 256u - right;
    uvec2 sum = (left.x * left.y) * gnomon_read(map, size, at);
    sum = sum + (right.x * left.y) * gnomon_read(map, size, at + ivec2(1, 0));
    sum = sum + (left.x * right.y) * gnomon_read(map, size, at + ivec2(0, 1));
    sum = sum + (right.x * right.y) * gnomon_read(map, size, at + ivec2(1, 1));
    return gnomon_shadow_of_blend(vec2(sum >> 16), vec2(sum & 0xFFFFu) * 0.0000152587890625, z);
}
