#version 410

layout(location = 0) flat out uint entry_index;
layout(location = 1) flat out uint entry_site;
layout(location = 0) in uint in_site;

void main()
{
    entry_index = uint(gl_VertexID);
    entry_site = in_site;
}

