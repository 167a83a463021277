#version 450
#extension GL_GOOGLE_include_directive : require
// Hands on what the device computes, to be captured, for OpenGL.
#include "arithmetic.glsl"

layout(location = 0) in vec4 operands;

layout(location = 0) flat out vec4 computed_first;
layout(location = 1) flat out vec4 computed_second;

out gl_PerVertex { vec4 gl_Position; };

void main() {
    Computed found = computed(operands);
    computed_first = found.first;
    computed_second = found.second;
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
