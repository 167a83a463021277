#version 410

uniform samplerBuffer palette;

layout(location = 0) out vec4 out_color;
layout(location = 0) flat in uvec2 cell_mark;
layout(location = 1) out uint out_id;

void main()
{
    out_color = texelFetch(palette, int(cell_mark.y));
    out_id = cell_mark.x;
}

