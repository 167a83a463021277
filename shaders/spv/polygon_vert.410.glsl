#version 410

layout(location = 0) in vec2 in_position;
layout(location = 0) flat out uvec2 cell_mark;
layout(location = 1) in uvec2 in_mark;

void main()
{
    gl_Position = vec4(in_position, 0.0, 1.0);
    cell_mark = in_mark;
}

