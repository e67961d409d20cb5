// gnomon: receivers behind casters of unorm8 (e, m, far bound, contribution)
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

// intensity of the shadow on a receiver at depth z, by the numbers of a filtered texel in codes
float gnomon_shadow(vec4 texel, float z) {
    if (!gnomon_is_number(z)) return 0.0;
    if (!(texel.y > 0.0 && z > 0.0 && !(z > 1.0))) return 0.0;
    precise float e = texel.x - 0.5;
    precise float m = texel.y + 0.5;
    precise float nearer_z = z - 0.0019608738;
    if (!(nearer_z < 0.5 ? gnomon_exceeds(m, nearer_z, m - e) : gnomon_exceeds(-m, 1.0 - nearer_z, -e))) return 0.0;
    precise float e_2 = texel.z + 0.5;
    precise float m_2 = texel.y + -0.5;
    precise float nearer_z_2 = z + 0.0019608738;
    precise float farther = m_2 * nearer_z_2;
    precise float passed = farther - (m_2 - e_2);
    precise float share = m_2 * 0.25;
    bool fades = share > 0.0;
    precise float left = 1.0 - passed / (fades ? share : 1.0);
    bool bounded = texel.z > 0.0 && (nearer_z_2 < 0.5 ? gnomon_exceeds(m_2, nearer_z_2, m_2 - e_2) : gnomon_exceeds(-m_2, 1.0 - nearer_z_2, -e_2));
    precise float kept = bounded ? (fades ? (left > 0.0 ? (left < 1.0 ? left : 1.0) : 0.0) : 0.0) : 1.0;
    precise float darkness = gnomon_divide(texel.w, 255.0, 0.003921569);
    return (darkness > 0.0 ? (darkness < 1.0 ? darkness : 1.0) : 0.0) * kept;
}

// a texel in codes; clear lies off the map
uvec4 gnomon_read(sampler2D map, ivec2 size, ivec2 at) {
    if (at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y) return uvec4(0);
    vec4 texel = vec4(texelFetch(map, at, 0));
    return uvec4(texel * 255.0 + 0.5);
}

// intensity at texel `at` of a map
float gnomon_shadow(sampler2D map, ivec2 at, float z) { return gnomon_shadow(vec4(gnomon_read(map, textureSize(map, 0), at)), z); }

// intensity at a position in texels, blended from four, in steps of 1/256; off the map is lit
float gnomon_shadow_at(sampler2D map, vec2 position, float z) {
    ivec2 size = textureSize(map, 0);
    vec2 end = vec2(size) + 1.0;
    if (!gnomon_is_number(position.x) || !gnomon_is_number(position.y)) return 0.0;
    if (position.x <= -1.0 || position.y <= -1.0 || position.x >= end.x || position.y >= end.y) return 0.0;
    ivec2 fine = (ivec2(floor(512.0 * position)) - 255) >> 1; // from the centre of texel 0
    ivec2 at = fine >> 8;
    uvec2 right = uvec2(fine & 255), left = 256u - right;
    uvec4 sum = (left.x * left.y) * gnomon_read(map, size, at);
    sum = sum + (right.x * left.y) * gnomon_read(map, size, at + ivec2(1, 0));
    sum = sum + (left.x * right.y) * gnomon_read(map, size, at + ivec2(0, 1));
    sum = sum + (right.x * right.y) * gnomon_read(map, size, at + ivec2(1, 1));
    return gnomon_shadow(vec4(sum) * 0.0000152587890625, z);
}
