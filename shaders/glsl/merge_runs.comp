#version 450
#extension GL_GOOGLE_include_directive : require
// After order_runs.comp, for crowded bins alone: merges sorted runs of slice.first ranks two by two. Before a
// site come those before it in its own run, and those less than it in the other, counted by bisection.
#include "layout.glsl"
#include "slice.glsl"
#include "ordering.glsl"

layout(local_size_x = GROUP_SIZE) in;

// How many sites of a sorted run come before `site`.
uint countBefore(Ranks run, uint site) {
    uint low = run.first;
    uint high = run.behind;
    while (low < high) {
        uint middle = (low + high) / 2u;
        bool before = from[middle] < site;
        low = before ? middle + 1u : low;
        high = before ? high : middle;
    }
    return low - run.first;
}

void main() {
    uint stride = gl_NumWorkGroups.x * uint(GROUP_SIZE);
    for (uint rank = gl_GlobalInvocationID.x; rank < slice.count; rank += stride) {
        uint site = from[rank];
        Ranks bin = binOf(site);
        uint index = (rank - bin.first) / slice.first;
        bool second = index % 2u == 1u;
        Ranks own = runOf(bin, index, slice.first);
        Ranks other = runOf(bin, second ? index - 1u : index + 1u, slice.first);
        uint begin = second ? other.first : own.first;
        to[begin + (rank - own.first) + countBefore(other, site)] = site;
    }
}
