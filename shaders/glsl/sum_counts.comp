#version 450
#extension GL_GOOGLE_include_directive : require
// First of the steps that turn counts into ranks: adds up each block of counts.
#include "layout.glsl"
#include "slice.glsl"
#include "sums.glsl"

layout(local_size_x = GROUP_SIZE) in;

layout(std430, set = 0, binding = BINDING_COUNTS) readonly buffer Counts { uint counts[]; };

void main() {
    uint block = gl_GlobalInvocationID.x;
    uint begin = block * uint(COUNTS_AT_ONCE);
    if (begin >= slice.count) {
        return;
    }
    uint end = min(begin + uint(COUNTS_AT_ONCE), slice.count);
    uint sum = 0u;
    for (uint k = begin; k < end; k++) {
        sum += counts[k];
    }
    sums[block] = sum;
}
