// gnomon: casters of float32 (e, m)
bool gnomon_is_number(float v) { return (floatBitsToUint(v) & 0x7FFFFFFFu) <= 0x7F800000u; }

float gnomon_code(float v) {
    if (!gnomon_is_number(v) || v <= 0.0) return 0.0;
    return v < 1.0 ? v : 1.0;
}

float gnomon_complement(float z) {
    if (!gnomon_is_number(z) || z >= 1.0) return 0.0;
    return z > 0.0 ? 1.0 - z : 1.0;
}

layout(location = 0) out vec2 gnomon_texel;

// what is stored nearer to the light is more, and anything is more than the empty buffer
void gnomon_order(float complement) { gl_FragDepth = max(complement, 2.98023224e-8); }

void gnomon_caster(float s) {
    float complement = gnomon_complement(s);
    gnomon_order(complement);
    gnomon_texel = vec2(complement, 1.0);
}

flat in vec2 gnomon_depth_opacity;

void main() { gnomon_caster(gnomon_depth_opacity.x); }
