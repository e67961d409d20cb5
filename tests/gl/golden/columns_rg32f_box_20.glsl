// gnomon: columns of float32 (e, m) by 41 taps of together 16777216
uniform sampler2D gnomon_texels;
layout(location = 0) out uvec2 gnomon_sums;

precise vec2 gnomon_sum = vec2(0);
int gnomon_height = 0; // the map's; asked once a fragment, since asking costs a GPU more than fetching a texel

vec2 gnomon_at(int away) {
    ivec2 at = ivec2(gl_FragCoord) + ivec2(0, away);
    if (at.y < 0 || at.y >= gnomon_height) return vec2(0);
    return vec2(texelFetch(gnomon_texels, at, 0));
}

void gnomon_add(float weight, int away) {
    precise vec2 both = gnomon_at(-away) + gnomon_at(away);
    precise vec2 product = weight * both;
    gnomon_sum = gnomon_sum + product;
}

void main() {
    gnomon_height = textureSize(gnomon_texels, 0).y;
    gnomon_sum = 0.02439022 * gnomon_at(0);
    for (int away = 1; away <= 20; ++away) gnomon_add(abs(away) <= 8 ? 0.02439028 : 0.02439022, away);
    gnomon_sums = floatBitsToUint(gnomon_sum);
}
