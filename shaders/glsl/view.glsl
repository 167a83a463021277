// What all entries share while they are drawn.
layout(std140, set = 0, binding = BINDING_VIEW) uniform View {
    vec2 scale;      // normalized device coordinates per scaled unit
    vec2 outset;     // half a step of the vertex grid, in scaled units
    vec2 half_size;  // pixels
    float margin;    // by how much a vertex may be off, in pixels
    vec4 center;     // of what is seen, like a site of sites.glsl
} view;
