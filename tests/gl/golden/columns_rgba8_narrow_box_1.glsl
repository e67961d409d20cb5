// gnomon: columns of unorm8 (e, m, far bound, contribution) by 3 taps of together 3
uniform sampler2D gnomon_texels;
layout(location = 0) out vec4 gnomon_sums;

uvec4 gnomon_sum = uvec4(0);
int gnomon_height = 0; // the map's; asked once a fragment, since asking costs a GPU more than fetching a texel

vec4 gnomon_at(int away) {
    ivec2 at = ivec2(gl_FragCoord) + ivec2(0, away);
    if (at.y < 0 || at.y >= gnomon_height) return vec4(0);
    return vec4(texelFetch(gnomon_texels, at, 0));
}

void gnomon_add(uint weight, int away) {
    gnomon_sum += weight * uvec4(gnomon_at(away) * 255.0 + 0.5);
}

void main() {
    gnomon_height = textureSize(gnomon_texels, 0).y;
    gnomon_add(1u, -1);
    gnomon_add(1u, 0);
    gnomon_add(1u, 1);
    gnomon_sums = vec4((gnomon_sum + 1u) / 3u) / 255.0;
}
