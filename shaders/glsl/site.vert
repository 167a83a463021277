#version 450
// Hands one site, which the vertex buffer names, to the geometry shader.
layout(location = 0) in uint in_site;

layout(location = 0) flat out uint entry_index;
layout(location = 1) flat out uint entry_site;

void main() {
    entry_index = uint(gl_VertexIndex);
    entry_site = in_site;
}
