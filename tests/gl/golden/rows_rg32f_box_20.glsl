// gnomon: rows of float32 (e, m) by 41 taps of together 16777216
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
    gnomon_sum = 0.02439022 * gnomon_at(0);
    for (int away = 1; away <= 20; ++away) gnomon_add(abs(away) <= 8 ? 0.02439028 : 0.02439022, away);
    gnomon_texel = gnomon_sum;
}
