// gnomon: columns of unorm8 (e, m) by 41 taps of together 65536
uniform sampler2D gnomon_texels;
layout(location = 0) out uvec2 gnomon_sums;

const uint[21] gnomon_weights = uint[21](2724u, 2711u, 2670u, 2604u, 2515u, 2404u, 2276u, 2132u, 1978u, 1817u, 1652u, 1488u, 1326u, 1170u, 1023u, 884u,
    758u, 642u, 539u, 448u, 369u); // from the centre outwards

uvec2 gnomon_sum = uvec2(0);
int gnomon_height = 0; // the map's; asked once a fragment, since asking costs a GPU more than fetching a texel

vec2 gnomon_at(int away) {
    ivec2 at = ivec2(gl_FragCoord) + ivec2(0, away);
    if (at.y < 0 || at.y >= gnomon_height) return vec2(0);
    return vec2(texelFetch(gnomon_texels, at, 0));
}

void gnomon_add(uint weight, int away) {
    gnomon_sum += weight * uvec2(gnomon_at(away) * 255.0 + 0.5);
}

void main() {
    gnomon_height = textureSize(gnomon_texels, 0).y;
    for (int away = -20; away <= 20; ++away) gnomon_add(gnomon_weights[abs(away)], away);
    gnomon_sums = gnomon_sum;
}
