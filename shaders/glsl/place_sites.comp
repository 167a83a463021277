#version 450
#extension GL_GOOGLE_include_directive : require
// Last of the steps that put the sites of an upload into the bins of their grid: writes the sites at their
// places, and the places down.
#include "layout.glsl"
#include "slice.glsl"

layout(local_size_x = GROUP_SIZE) in;

layout(set = 0, binding = BINDING_SITES) uniform samplerBuffer sites;
layout(std430, set = 0, binding = BINDING_FROM) readonly buffer From { uint site_at_place[]; };
layout(std430, set = 0, binding = BINDING_PLACE_OF_SITE) writeonly buffer PlaceOfSite { uint place_of_site[]; };
layout(std430, set = 0, binding = BINDING_PLACED_SITES) writeonly buffer PlacedSites { vec4 placed_sites[]; };

void main() {
    uint stride = gl_NumWorkGroups.x * uint(GROUP_SIZE);
    for (uint place = gl_GlobalInvocationID.x; place < slice.count; place += stride) {
        uint site = site_at_place[place];
        placed_sites[place] = texelFetch(sites, int(site));
        place_of_site[site] = place;
    }
}
