// gnomon: casters of unorm8 (e, m, far bound)
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

// the code nearest to 255.0 v, halves upwards; 0 if v is not a number
float gnomon_code(float v) {
    if (!gnomon_is_number(v) || v <= 0.0) return 0.0;
    if (v >= 1.0) return 255.0;
    float code = floor(255.0 * v + 0.5); // or one more: rounding keeps the order, so never less
    return gnomon_exceeds(-255.0, v, 0.5 - code) ? code - 1.0 : code;
}

// the code nearest to 255.0 (1 - z); the only tie is half way, and goes upwards
float gnomon_complement(float z) {
    if (!gnomon_is_number(z) || z >= 1.0) return 0.0;
    return z == 0.5 ? 128.0 : 255.0 - gnomon_code(z);
}

layout(location = 0) out vec4 gnomon_texel;

// what is stored nearer to the light is more, and anything is more than the empty buffer
void gnomon_order(float complement) { gl_FragDepth = max(complement * 0.00390625, 2.98023224e-8); }

void gnomon_caster(float s) {
    float complement = gnomon_complement(s);
    gnomon_order(complement);
    gnomon_texel = vec4(complement / 255.0, 1.0, 0.0, 0.0);
}

void gnomon_bound(float z) {
    float complement = gnomon_complement(z);
    gnomon_order(complement);
    gnomon_texel = vec4(0.0, 0.0, complement / 255.0, 0.0);
}

flat in vec2 gnomon_depth_opacity;

void main() { gnomon_bound(gnomon_depth_opacity.x); }
