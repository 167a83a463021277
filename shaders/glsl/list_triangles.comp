#version 450
#extension GL_GOOGLE_include_directive : require
// Last of the steps that make a list of triangles out of polygons: each block writes the indices of its
// triangles, in the order of the entries. The triangles of a polygon are those of a strip.
// The build gives MAX_EDGES, the vertices of a polygon in memory.
#include "layout.glsl"
#include "slice.glsl"
#include "sums.glsl"
#include "strip.glsl"

layout(local_size_x = GROUP_SIZE) in;

layout(std430, set = 0, binding = BINDING_COUNTS) readonly buffer Counts { uint triangles_of[]; };
layout(std430, set = 0, binding = BINDING_INDICES) writeonly buffer Indices { uint indices[]; };

void main() {
    uint block = gl_GlobalInvocationID.x;
    uint begin = block * uint(COUNTS_AT_ONCE);
    if (begin >= slice.count) {
        return;
    }
    uint end = min(begin + uint(COUNTS_AT_ONCE), slice.count);
    uint at = 3u * sums[block];
    for (uint entry = begin; entry < end; entry++) {
        int triangles = int(triangles_of[entry]);
        for (int k = 0; k < triangles; k++) {
            for (int corner = 0; corner < 3; corner++) {
                indices[at] = entry * uint(MAX_EDGES) + uint(rankInStrip(k + corner, triangles + 2));
                at++;
            }
        }
    }
}
