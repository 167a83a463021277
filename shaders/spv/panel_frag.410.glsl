#version 410

uniform sampler2D surface;

layout(location = 0) out vec4 out_color;
layout(location = 1) in vec4 color;
layout(location = 0) in vec2 texel;

void main()
{
    out_color = color * texture(surface, texel);
}

