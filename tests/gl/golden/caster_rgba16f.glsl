// gnomon: casters of half16 (e, m, far bound, contribution)
// v / 2^bits to nearest, ties to even
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

bool gnomon_is_number(float v) { return (floatBitsToUint(v) & 0x7FFFFFFFu) <= 0x7F800000u; }

// the half nearest to v
float gnomon_code(float v) {
    if (!gnomon_is_number(v) || v <= 0.0) return 0.0;
    return v < 1.0 ? gnomon_half(v) : 1.0;
}

// the half nearest to 1 - z, which a float cannot tell for all z before 1/2; whole numbers of 2^-25 can
float gnomon_complement(float z) {
    if (!gnomon_is_number(z) || z >= 1.0) return 0.0;
    if (z <= 0.0) return 1.0;
    if (z >= 0.5) return gnomon_half(1.0 - z);
    float units = z * 16777216.0;
    uint whole = uint(units), more = float(whole) < units ? 1u : 0u;
    return float(gnomon_nearest_even(33554432u - 2u * whole - more, 14)) * 0.00048828125;
}

layout(location = 0) out vec4 gnomon_texel;

// what is stored nearer to the light is more, of equals the more opaque; anything is more than the empty buffer
uint gnomon_rank(float v) { return v > 0.0 ? (floatBitsToUint(v) >> 13) - 105471u : 0u; } // of halves in [0, 1]
void gnomon_order(float complement, float contribution) {
    gl_FragDepth = uintBitsToFloat(0x800000u + gnomon_rank(complement) * 24578u + gnomon_rank(contribution));
}

void gnomon_caster(float s) {
    float complement = gnomon_complement(s);
    gnomon_order(complement, 1.0);
    gnomon_texel = vec4(complement, 1.0, 0.0, 1.0);
}

void gnomon_caster(float s, float opacity) {
    float complement = gnomon_complement(s), contribution = gnomon_code(opacity);
    gnomon_order(complement, contribution);
    gnomon_texel = vec4(complement, 1.0, 0.0, contribution);
}

void gnomon_bound(float z) {
    float complement = gnomon_complement(z);
    gnomon_order(complement, 0.0);
    gnomon_texel = vec4(0.0, 0.0, complement, 0.0);
}

flat in vec2 gnomon_depth_opacity;

void main() { gnomon_caster(gnomon_depth_opacity.x, gnomon_depth_opacity.y); }
