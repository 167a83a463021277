#version 450
#extension GL_GOOGLE_include_directive : require
// Writes down what the device computes, for Vulkan.
#include "layout.glsl"
#include "slice.glsl"
#include "arithmetic.glsl"

layout(local_size_x = GROUP_SIZE) in;

layout(std430, set = 0, binding = BINDING_ENTRIES) readonly buffer Operands { vec4 operands[]; };
layout(std430, set = 0, binding = BINDING_STATUS) writeonly buffer Results { vec4 results[]; };

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= slice.count) {
        return;
    }
    Computed found = computed(operands[row]);
    results[2u * row] = found.first;
    results[2u * row + 1u] = found.second;
}
