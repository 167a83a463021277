#version 450
#extension GL_GOOGLE_include_directive : require
// Colors a pixel by its cell's palette index and writes down whose cell it is.
#include "layout.glsl"

layout(location = 0) flat in uvec2 cell_mark;  // id, palette index

layout(location = 0) out vec4 out_color;
layout(location = 1) out uint out_id;

layout(set = 0, binding = BINDING_PALETTE) uniform samplerBuffer palette;

void main() {
    out_color = texelFetch(palette, int(cell_mark.y));
    out_id = cell_mark.x;
}
