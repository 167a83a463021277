#version 450
#extension GL_GOOGLE_include_directive : require
// After order_runs.comp, for crowded bins alone: merges ordered runs of slice.first places two by two. A site
// passes those before it in its own run, and those that it finds in the other by bisection.
#include "layout.glsl"
#include "slice.glsl"
#include "ordering.glsl"

layout(local_size_x = GROUP_SIZE) in;

// How many sites of an ordered run come before `site`.
uint countBefore(Places run, uint site) {
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
    for (uint place = gl_GlobalInvocationID.x; place < slice.count; place += stride) {
        uint site = from[place];
        Places bin = binOf(site);
        uint index = (place - bin.first) / slice.first;
        bool second = index % 2u == 1u;
        Places own = runOf(bin, index, slice.first);
        Places other = runOf(bin, second ? index - 1u : index + 1u, slice.first);
        uint begin = second ? other.first : own.first;
        to[begin + (place - own.first) + countBefore(other, site)] = site;
    }
}
