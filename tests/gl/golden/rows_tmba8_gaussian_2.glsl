// gnomon: rows of unorm8 (t, m, far bound, contribution) by 5 taps of together 65536
uniform usampler2D gnomon_sums;
layout(location = 0) out vec4 gnomon_texel;

// the sums of a channel as two words, the high one first
uvec2 gnomon_words(uint low, uint high) {
    uint word = low + (high << 16);
    return uvec2((high >> 16) + (word < low ? 1u : 0u), word);
}

// n / d rounded down, below 2^16; of numbers of two words, the high one first
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

// a share of the whole, to nearest, halves upwards
uint gnomon_nearest(uvec2 sum) {
    uint word = sum.y + 2147483648u;
    return sum.x + (word < sum.y ? 1u : 0u);
}

uvec4 gnomon_low = uvec4(0), gnomon_high = uvec4(0); // sums of the low and the high 16 bits
int gnomon_width = 0; // the map's

uvec4 gnomon_at(int away) {
    ivec2 at = ivec2(gl_FragCoord) + ivec2(away, 0);
    if (at.x < 0 || at.x >= gnomon_width) return uvec4(0);
    return uvec4(texelFetch(gnomon_sums, at, 0));
}

void gnomon_add(uint weight, int away) {
    uvec4 sums = gnomon_at(away);
    gnomon_low += weight * (sums & 0xFFFFu);
    gnomon_high += weight * (sums >> 16);
}

void main() {
    gnomon_width = textureSize(gnomon_sums, 0).x;
    gnomon_add(3571u, -2);
    gnomon_add(16004u, -1);
    gnomon_add(26386u, 0);
    gnomon_add(16004u, 1);
    gnomon_add(3571u, 2);
    if (gnomon_nearest(gnomon_words(gnomon_low.y, gnomon_high.y)) == 0u) {
        gnomon_texel = vec4(0);
        return;
    }
    uvec4 codes = uvec4(gnomon_quotient(gnomon_words(gnomon_low.x, gnomon_high.x), gnomon_words(gnomon_low.y, gnomon_high.y)), gnomon_nearest(gnomon_words(gnomon_low.y, gnomon_high.y)), gnomon_quotient(gnomon_words(gnomon_low.z, gnomon_high.z), gnomon_words(gnomon_low.y, gnomon_high.y)), gnomon_nearest(gnomon_words(gnomon_low.w, gnomon_high.w)));
    gnomon_texel = vec4(codes) / 255.0;
}
