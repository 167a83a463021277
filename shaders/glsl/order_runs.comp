#version 450
#extension GL_GOOGLE_include_directive : require
// After scatter_sites.comp: puts the sites of each run of RUN_SIZE places of a bin in order.
#include "layout.glsl"
#include "slice.glsl"
#include "ordering.glsl"

layout(local_size_x = GROUP_SIZE) in;

void main() {
    uint stride = gl_NumWorkGroups.x * uint(GROUP_SIZE);
    for (uint place = gl_GlobalInvocationID.x; place < slice.count; place += stride) {
        uint site = from[place];
        Places bin = binOf(site);
        Places run = runOf(bin, (place - bin.first) / uint(RUN_SIZE), uint(RUN_SIZE));
        uint before = 0u;
        for (uint other = run.first; other < run.behind; other++) {
            before += from[other] < site ? 1u : 0u;
        }
        to[run.first + before] = site;
    }
}
