#version 450
#extension GL_GOOGLE_include_directive : require
// After bin_starts.comp: puts each site into its bin, in the order of arrival. Then order_runs.comp,
// merge_runs.comp and gather_sites.comp.
#include "layout.glsl"
#include "slice.glsl"
#include "ordering.glsl"

layout(local_size_x = GROUP_SIZE) in;

layout(std430, set = 0, binding = BINDING_RANK_OF_SITE) readonly buffer Arrivals { uint arrival_of_site[]; };

void main() {
    uint stride = gl_NumWorkGroups.x * uint(GROUP_SIZE);
    for (uint site = gl_GlobalInvocationID.x; site < slice.count; site += stride) {
        to[binOf(site).first + arrival_of_site[site]] = site;
    }
}
