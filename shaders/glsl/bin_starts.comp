#version 450
#extension GL_GOOGLE_include_directive : require
// After sum_counts.comp and scan_sums.comp: where each bin begins, and which merges there will be.
// slice.first is the number of groups that a merge has, slice.count that of bins.
#include "layout.glsl"
#include "slice.glsl"
#include "sums.glsl"

layout(local_size_x = GROUP_SIZE) in;

layout(std430, set = 0, binding = BINDING_COUNTS) readonly buffer Counts { uint counts[]; };

// One more than there are bins.
layout(std430, set = 0, binding = BINDING_BINS) writeonly buffer Starts { uint start_of_bin[]; };

// Arguments of indirect dispatches, of which the first merges runs of RUN_SIZE sites, and each of the others
// runs four times as long as the one before. On entry none has any group.
layout(std430, set = 0, binding = BINDING_MERGES) buffer Merges { uint merges[]; };

void main() {
    uint block = gl_GlobalInvocationID.x;
    uint begin = block * uint(COUNTS_AT_ONCE);
    if (begin >= slice.count) {
        return;
    }
    uint end = min(begin + uint(COUNTS_AT_ONCE), slice.count);
    uint at = sums[block];
    uint largest = 0u;
    for (uint bin = begin; bin < end; bin++) {
        start_of_bin[bin] = at;
        at += counts[bin];
        largest = max(largest, counts[bin]);
    }
    if (end == slice.count) {
        start_of_bin[end] = at;
    }
    uint merge = 0u;
    for (uint run = uint(RUN_SIZE); run < largest; run *= 4u) {
        atomicMax(merges[3u * merge], slice.first);
        merge++;
    }
}
