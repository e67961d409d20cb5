// gnomon: rows of unorm8 (e, m, far bound, contribution) by 3 taps of together 3
uniform sampler2D gnomon_sums;
layout(location = 0) out vec4 gnomon_texel;

uvec4 gnomon_sum = uvec4(0);
int gnomon_width = 0; // the map's

uvec4 gnomon_at(int away) {
    ivec2 at = ivec2(gl_FragCoord) + ivec2(away, 0);
    if (at.x < 0 || at.x >= gnomon_width) return uvec4(0);
    return uvec4(vec4(texelFetch(gnomon_sums, at, 0)) * 255.0 + 0.5);
}

void gnomon_add(uint weight, int away) {
    gnomon_sum += weight * gnomon_at(away);
}

void main() {
    gnomon_width = textureSize(gnomon_sums, 0).x;
    gnomon_add(1u, -1);
    gnomon_add(1u, 0);
    gnomon_add(1u, 1);
    uvec4 codes = (gnomon_sum + 1u) / 3u;
    gnomon_texel = vec4(codes) / 255.0;
}
