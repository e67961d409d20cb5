// gnomon: rows of unorm8 (e, m) by 41 taps of together 65536
uniform usampler2D gnomon_sums;
layout(location = 0) out vec2 gnomon_texel;

const uint[21] gnomon_weights = uint[21](2724u, 2711u, 2670u, 2604u, 2515u, 2404u, 2276u, 2132u, 1978u, 1817u, 1652u, 1488u, 1326u, 1170u, 1023u, 884u,
    758u, 642u, 539u, 448u, 369u); // from the centre outwards

// the sums of a channel as two words, the high one first
uvec2 gnomon_words(uint low, uint high) {
    uint word = low + (high << 16);
    return uvec2((high >> 16) + (word < low ? 1u : 0u), word);
}

// a share of the whole, to nearest, halves upwards
uint gnomon_nearest(uvec2 sum) {
    uint word = sum.y + 2147483648u;
    return sum.x + (word < sum.y ? 1u : 0u);
}

uvec2 gnomon_low = uvec2(0), gnomon_high = uvec2(0); // sums of the low and the high 16 bits
int gnomon_width = 0; // the map's

uvec2 gnomon_at(int away) {
    ivec2 at = ivec2(gl_FragCoord) + ivec2(away, 0);
    if (at.x < 0 || at.x >= gnomon_width) return uvec2(0);
    return uvec2(texelFetch(gnomon_sums, at, 0));
}

void gnomon_add(uint weight, int away) {
    uvec2 sums = gnomon_at(away);
    gnomon_low += weight * (sums & 0xFFFFu);
    gnomon_high += weight * (sums >> 16);
}

void main() {
    gnomon_width = textureSize(gnomon_sums, 0).x;
    for (int away = -20; away <= 20; ++away) gnomon_add(gnomon_weights[abs(away)], away);
    uvec2 codes = uvec2(gnomon_nearest(gnomon_words(gnomon_low.x, gnomon_high.x)), gnomon_nearest(gnomon_words(gnomon_low.y, gnomon_high.y)));
    gnomon_texel = vec2(codes) / 255.0;
}
