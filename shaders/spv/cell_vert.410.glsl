#version 410

layout(location = 0) flat out vec4 entry_walls;
layout(location = 0) in vec4 in_walls;
layout(location = 1) flat out vec2 entry_bounds;
layout(location = 1) in vec2 in_bounds;
layout(location = 2) flat out uvec2 entry_lines;
layout(location = 2) in uvec2 in_lines;
layout(location = 3) flat out vec2 entry_origin;
layout(location = 3) in vec2 in_origin;
layout(location = 4) flat out uvec2 entry_mark;
layout(location = 4) in uvec2 in_mark;
layout(location = 5) flat out uint entry_index;

void main()
{
    entry_walls = in_walls;
    entry_bounds = in_bounds;
    entry_lines = in_lines;
    entry_origin = in_origin;
    entry_mark = in_mark;
    entry_index = uint(gl_VertexID);
}

