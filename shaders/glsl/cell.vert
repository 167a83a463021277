#version 450
// Hands one entry of a batch, as it stands in the vertex buffer, to the geometry shader.
layout(location = 0) in vec4 in_walls;   // west, south, east, north of the origin
layout(location = 1) in vec2 in_bounds;  // reach, origin_offset
layout(location = 2) in uvec2 in_lines;  // first, count
layout(location = 3) in vec2 in_origin;  // normalized device coordinates
layout(location = 4) in uvec2 in_mark;   // id, palette index

layout(location = 0) flat out vec4 entry_walls;
layout(location = 1) flat out vec2 entry_bounds;
layout(location = 2) flat out uvec2 entry_lines;
layout(location = 3) flat out vec2 entry_origin;
layout(location = 4) flat out uvec2 entry_mark;
layout(location = 5) flat out uint entry_index;

void main() {
    entry_walls = in_walls;
    entry_bounds = in_bounds;
    entry_lines = in_lines;
    entry_origin = in_origin;
    entry_mark = in_mark;
    entry_index = uint(gl_VertexIndex);
}
