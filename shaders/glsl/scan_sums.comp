#version 450
#extension GL_GOOGLE_include_directive : require
// Second of the steps that turn counts into ranks, in a single group: replaces the sum of each block
// by that of all blocks before it. slice.count is the number of blocks.
#include "layout.glsl"
#include "slice.glsl"
#include "sums.glsl"

layout(local_size_x = GROUP_SIZE) in;

shared uint parts[GROUP_SIZE];

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint share = (slice.count + uint(GROUP_SIZE) - 1u) / uint(GROUP_SIZE);
    uint begin = min(lane * share, slice.count);
    uint end = min(begin + share, slice.count);
    uint part = 0u;
    for (uint k = begin; k < end; k++) {
        part += sums[k];
    }
    parts[lane] = part;
    barrier();
    uint before = 0u;
    uint all = 0u;
    for (uint other = 0u; other < uint(GROUP_SIZE); other++) {
        before += other < lane ? parts[other] : 0u;
        all += parts[other];
    }
    for (uint k = begin; k < end; k++) {
        uint sum = sums[k];
        sums[k] = before;
        before += sum;
    }
    if (lane == 0u) {
        index_count = 3u * all;
        instance_count = 1u;
        first_index = 0u;
        vertex_offset = 0u;
        first_instance = 0u;
    }
}
