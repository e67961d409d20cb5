// gnomon: columns of float32 (e, m, far bound, contribution) by 5 taps of together 65536
uniform sampler2D gnomon_texels;
layout(location = 0) out uvec4 gnomon_sums;

precise vec4 gnomon_sum = vec4(0);
int gnomon_height = 0; // the map's; asked once a fragment, since asking costs a GPU more than fetching a texel

vec4 gnomon_at(int away) {
    ivec2 at = ivec2(gl_FragCoord) + ivec2(0, away);
    if (at.y < 0 || at.y >= gnomon_height) return vec4(0);
    return vec4(texelFetch(gnomon_texels, at, 0));
}

void gnomon_add(float weight, int away) {
    precise vec4 both = gnomon_at(-away) + gnomon_at(away);
    precise vec4 product = weight * both;
    gnomon_sum = gnomon_sum + product;
}

void main() {
    gnomon_height = textureSize(gnomon_texels, 0).y;
    gnomon_sum = 0.4026184 * gnomon_at(0);
    gnomon_add(0.24420166, 1);
    gnomon_add(0.054489136, 2);
    gnomon_sums = floatBitsToUint(gnomon_sum);
}
