#version 450
// Colors a pixel of such a triangle. The panel's texture is white, of more or less alpha.
layout(location = 0) in vec2 texel;
layout(location = 1) in vec4 color;

layout(location = 0) out vec4 out_color;

layout(set = 0, binding = 0) uniform sampler2D surface;

void main() { out_color = color * texture(surface, texel); }
