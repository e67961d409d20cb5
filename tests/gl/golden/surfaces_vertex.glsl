// gnomon: rectangles of texels and their depths, one an instance, a strip of four vertices each
layout(location = 0) in ivec4 gnomon_rectangle; // x0, y0, x1, y1
layout(location = 1) in vec2 gnomon_surface;    // depth, opacity
uniform ivec2 gnomon_size;                      // of the target
flat out vec2 gnomon_depth_opacity;

void main() {
    ivec2 corner = ivec2((gl_VertexID & 1) == 0 ? gnomon_rectangle.x : gnomon_rectangle.z,
                         (gl_VertexID & 2) == 0 ? gnomon_rectangle.y : gnomon_rectangle.w);
    gl_Position = vec4(2.0 * vec2(corner) / vec2(gnomon_size) - 1.0, 0.0, 1.0);
    gnomon_depth_opacity = gnomon_surface;
}
