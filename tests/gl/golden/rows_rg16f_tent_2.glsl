// gnomon: rows of half16 (e, m) by 5 taps of together 16777216
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

uniform usampler2D gnomon_sums;
layout(location = 0) out vec2 gnomon_texel;

precise vec2 gnomon_sum = vec2(0);
int gnomon_width = 0; // the map's

vec2 gnomon_at(int away) {
    ivec2 at = ivec2(gl_FragCoord) + ivec2(away, 0);
    if (at.x < 0 || at.x >= gnomon_width) return vec2(0);
    return uintBitsToFloat(uvec2(texelFetch(gnomon_sums, at, 0)));
}

void gnomon_add(float weight, int away) {
    precise vec2 both = gnomon_at(-away) + gnomon_at(away);
    precise vec2 product = weight * both;
    gnomon_sum = gnomon_sum + product;
}

void main() {
    gnomon_width = textureSize(gnomon_sums, 0).x;
    gnomon_sum = 0.33333337 * gnomon_at(0);
    gnomon_add(0.22222221, 1);
    gnomon_add(0.111111104, 2);
    gnomon_texel = vec2(gnomon_half(gnomon_sum.x), gnomon_half(gnomon_sum.y));
}
