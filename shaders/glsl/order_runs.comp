#version 450
#extension GL_GOOGLE_include_directive : require
// After scatter_sites.comp: sorts the sites of each run of RUN_SIZE ranks of a bin by their indices.
#include "layout.glsl"
#include "slice.glsl"
#include "ordering.glsl"

layout(local_size_x = GROUP_SIZE) in;

void main() {
    uint stride = gl_NumWorkGroups.x * uint(GROUP_SIZE);
    for (uint rank = gl_GlobalInvocationID.x; rank < slice.count; rank += stride) {
        uint site = from[rank];
        Ranks bin = binOf(site);
        Ranks run = runOf(bin, (rank - bin.first) / uint(RUN_SIZE), uint(RUN_SIZE));
        uint before = 0u;
        for (uint other = run.first; other < run.behind; other++) {
            before += from[other] < site ? 1u : 0u;
        }
        to[run.first + before] = site;
    }
}
