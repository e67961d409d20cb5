// gnomon: rows of float32 (e, m, far bound, contribution) by 5 taps of together 65536
uniform usampler2D gnomon_sums;
layout(location = 0) out vec4 gnomon_texel;

precise vec4 gnomon_sum = vec4(0);
int gnomon_width = 0; // the map's

vec4 gnomon_at(int away) {
    ivec2 at = ivec2(gl_FragCoord) + ivec2(away, 0);
    if (at.x < 0 || at.x >= gnomon_width) return vec4(0);
    return uintBitsToFloat(uvec4(texelFetch(gnomon_sums, at, 0)));
}

void gnomon_add(float weight, int away) {
    precise vec4 both = gnomon_at(-away) + gnomon_at(away);
    precise vec4 product = weight * both;
    gnomon_sum = gnomon_sum + product;
}

void main() {
    gnomon_width = textureSize(gnomon_sums, 0).x;
    gnomon_sum = 0.4026184 * gnomon_at(0);
    gnomon_add(0.24420166, 1);
    gnomon_add(0.054489136, 2);
    gnomon_texel = gnomon_sum;
}
