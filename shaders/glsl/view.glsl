// What all entries share while they are drawn.
layout(std140, set = 0, binding = BINDING_VIEW) uniform View {
    vec2 scale;      // normalized device coordinates per scaled unit
    vec2 outset;     // by how much a cell is widened, or shrunk where it is negative, in scaled units
    vec2 half_size;  // pixels
    float margin;    // by how much a vertex may be off, in pixels
    float allowed;   // by how much floats may be off about a cell, in scaled units
    vec4 center;     // of what is seen, like a site of sites.glsl
} view;
