// gnomon: columns of unorm8 (t, m, far bound, contribution) by 5 taps of together 65536
uniform sampler2D gnomon_texels;
layout(location = 0) out uvec4 gnomon_sums;

uvec4 gnomon_sum = uvec4(0);
int gnomon_height = 0; // the map's; asked once a fragment, since asking costs a GPU more than fetching a texel

vec4 gnomon_at(int away) {
    ivec2 at = ivec2(gl_FragCoord) + ivec2(0, away);
    if (at.y < 0 || at.y >= gnomon_height) return vec4(0);
    return vec4(texelFetch(gnomon_texels, at, 0));
}

void gnomon_add(uint weight, int away) {
    uvec4 codes = uvec4(gnomon_at(away) * 255.0 + 0.5);
    gnomon_sum += weight * uvec4(codes.x * codes.y, codes.y, codes.z * codes.y, codes.w);
}

void main() {
    gnomon_height = textureSize(gnomon_texels, 0).y;
    gnomon_add(3571u, -2);
    gnomon_add(16004u, -1);
    gnomon_add(26386u, 0);
    gnomon_add(16004u, 1);
    gnomon_add(3571u, 2);
    gnomon_sums = gnomon_sum;
}
