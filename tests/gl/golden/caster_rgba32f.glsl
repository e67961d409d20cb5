// gnomon: casters of float32 (e, m, far bound, contribution)
bool gnomon_is_number(float v) { return (floatBitsToUint(v) & 0x7FFFFFFFu) <= 0x7F800000u; }

float gnomon_code(float v) {
    if (!gnomon_is_number(v) || v <= 0.0) return 0.0;
    return v < 1.0 ? v : 1.0;
}

float gnomon_complement(float z) {
    if (!gnomon_is_number(z) || z >= 1.0) return 0.0;
    return z > 0.0 ? 1.0 - z : 1.0;
}

layout(location = 0) out vec4 gnomon_texel;

// what is stored nearer to the light is more, of equals the more opaque; anything is more than the empty buffer
void gnomon_order(float complement, float contribution) {
    gl_FragDepth = uintBitsToFloat(0x800000u + uint(complement * 16777216.0) * 62u + uint(contribution * 61.0));
}

void gnomon_caster(float s) {
    float complement = gnomon_complement(s);
    gnomon_order(complement, 1.0);
    gnomon_texel = vec4(complement, 1.0, 0.0, 1.0);
}

void gnomon_caster(float s, float opacity) {
    float complement = gnomon_complement(s), contribution = gnomon_code(opacity);
    gnomon_order(complement, contribution);
    gnomon_texel = vec4(complement, 1.0, 0.0, contribution);
}

void gnomon_bound(float z) {
    float complement = gnomon_complement(z);
    gnomon_order(complement, 0.0);
    gnomon_texel = vec4(0.0, 0.0, complement, 0.0);
}

flat in vec2 gnomon_depth_opacity;

void main() { gnomon_caster(gnomon_depth_opacity.x, gnomon_depth_opacity.y); }
