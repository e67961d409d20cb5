// gnomon: rows of float32 (e, m) by 3 taps of together 3
// a / b, to the nearest float; inverse is 1 / b, which drivers compute with an error of some last places
float gnomon_divide(float a, float b, float inverse) {
    uint bits = floatBitsToUint(a * inverse) & 0xFFFFFFFEu; // the share as bits, for a product could be fused
    float share = uintBitsToFloat(bits), high = uintBitsToFloat(bits & 0xFFFFF000u), low = share - high;
    float b_high = uintBitsToFloat(floatBitsToUint(b) & 0xFFFFF000u), b_low = b - b_high;
    precise float rest = ((a - high * b_high) - high * b_low) - low * b_high - low * b_low; // exact, be it fused or not
    precise float quotient = share + rest * inverse;
    return quotient;
}

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
    gnomon_sum = 0.25 * gnomon_at(0);
    gnomon_add(0.25, 1);
    gnomon_sum = vec2(gnomon_divide(gnomon_sum.x, 0.5625, 1.7777778), gnomon_divide(gnomon_sum.y, 0.5625, 1.7777778));
    gnomon_texel = gnomon_sum;
}
