#version 450
// Hands on a vertex as polygons.comp wrote it.
layout(location = 0) in vec2 in_position;  // normalized device coordinates
layout(location = 1) in uvec2 in_mark;     // id, palette index

out gl_PerVertex { vec4 gl_Position; };
layout(location = 0) flat out uvec2 cell_mark;

void main() {
    gl_Position = vec4(in_position, 0.0, 1.0);
    cell_mark = in_mark;
}
