#version 450
#extension GL_GOOGLE_include_directive : require
// First of the steps that put the sites of an upload into the bins of their grid: finds the bin of each, and
// counts. Then sum_counts.comp and scan_sums.comp, and bin_starts.comp.
#include "layout.glsl"
#include "vocabulary.glsl"
#include "slice.glsl"
#include "site_grid.glsl"
#include "bin_along.glsl"

layout(local_size_x = GROUP_SIZE) in;

layout(set = 0, binding = BINDING_SITES) uniform samplerBuffer sites;
layout(std430, set = 0, binding = BINDING_COUNTS) buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = BINDING_BIN_OF_SITE) writeonly buffer BinOfSite { uint bin_of_site[]; };

// How many sites the bin had before, which differs from run to run.
layout(std430, set = 0, binding = BINDING_RANK_OF_SITE) writeonly buffer Arrivals { uint arrival_of_site[]; };

void main() {
    uint stride = gl_NumWorkGroups.x * uint(GROUP_SIZE);
    for (uint site = gl_GlobalInvocationID.x; site < slice.count; site += stride) {
        vec4 at = texelFetch(sites, int(site));
        precise vec2 offset = (at.xy - site_grid.corner.xy) + (at.zw - site_grid.corner.zw);
        int column = binAlong(offset.x / site_grid.size, site_grid.columns);
        int row = binAlong(offset.y / site_grid.size, site_grid.rows);
        uint bin = uint(row * site_grid.columns + column);
        bin_of_site[site] = bin;
        arrival_of_site[site] = atomicAdd(counts[bin], 1u);
    }
}
