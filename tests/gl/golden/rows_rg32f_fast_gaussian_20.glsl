// gnomon: rows of float32 (e, m) by 41 taps of together 65536
uniform usampler2D gnomon_sums;
layout(location = 0) out vec2 gnomon_texel;

const float[21] gnomon_weights = float[21](0.04156494, 0.041366577, 0.040740967, 0.039733887, 0.038375854, 0.03668213, 0.034729004, 0.03253174, 0.030181885, 0.02772522, 0.02520752, 0.022705078, 0.020233154, 0.017852783, 0.015609741, 0.0134887695,
    0.011566162, 0.009796143, 0.008224487, 0.0068359375, 0.005630493); // from the centre outwards

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
    gnomon_sum = 0.04156494 * gnomon_at(0);
    for (int away = 1; away <= 20; ++away) gnomon_add(gnomon_weights[abs(away)], away);
    gnomon_texel = gnomon_sum;
}
