#version 410

layout(location = 0) in vec2 in_position;
layout(location = 0) out vec2 texel;
layout(location = 1) in vec2 in_texel;
layout(location = 1) out vec4 color;
layout(location = 2) in vec4 in_color;

void main()
{
    gl_Position = vec4(in_position, 0.0, 1.0);
    texel = in_texel;
    color = in_color;
}

