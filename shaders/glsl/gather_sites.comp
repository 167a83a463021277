#version 450
#extension GL_GOOGLE_include_directive : require
// Last of the steps that put the sites of an upload into the bins of their grid: gathers the sites in the
// order of their ranks, and writes the rank of each.
#include "layout.glsl"
#include "slice.glsl"

layout(local_size_x = GROUP_SIZE) in;

layout(set = 0, binding = BINDING_SITES) uniform samplerBuffer sites;
layout(std430, set = 0, binding = BINDING_FROM) readonly buffer From { uint site_of_rank[]; };
layout(std430, set = 0, binding = BINDING_RANK_OF_SITE) writeonly buffer RankOfSite { uint rank_of_site[]; };
layout(std430, set = 0, binding = BINDING_SORTED_SITES) writeonly buffer SortedSites { vec4 sorted_sites[]; };

void main() {
    uint stride = gl_NumWorkGroups.x * uint(GROUP_SIZE);
    for (uint rank = gl_GlobalInvocationID.x; rank < slice.count; rank += stride) {
        uint site = site_of_rank[rank];
        sorted_sites[rank] = texelFetch(sites, int(site));
        rank_of_site[site] = rank;
    }
}
