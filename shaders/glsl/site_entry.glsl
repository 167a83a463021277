// One site of an upload, as site.vert hands it on or a compute shader loads it: its cell comes from the
// search over the grid. The twin of list_entry.glsl.
#ifdef ENTRIES_IN_BUFFER
layout(std430, set = 0, binding = BINDING_ENTRIES) readonly buffer Entries { uint sites_of_entries[]; };
uint entry_index[1];
uint entry_site[1];

// Whether the device has sorted the sites into bins. Then a site's rank, its index in the sorted order,
// differs from its index in the upload.
layout(constant_id = 0) const bool SORTED_HERE = false;
layout(set = 0, binding = BINDING_RANK_OF_SITE) uniform usamplerBuffer rank_of_site;
layout(set = 0, binding = BINDING_SITE_OF_RANK) uniform usamplerBuffer site_of_rank;

// The entry at `index` of a slice that begins at `first`.
void loadEntry(uint first, uint index) {
    entry_index[0] = index;
    entry_site[0] = sites_of_entries[first + index];
}

// The index in `sites` of a site of the upload.
int rankOf(uint site) { return int(SORTED_HERE ? texelFetch(rank_of_site, int(site)).x : site); }

// The neighbor beyond a line: the index of a site in the upload, or a wall.
int neighborOf(int line) {
    return SORTED_HERE && line >= 0 ? int(texelFetch(site_of_rank, line).x) : line;
}
#else
layout(location = 0) flat in uint entry_index[];
layout(location = 1) flat in uint entry_site[];

int rankOf(uint site) { return int(site); }

int neighborOf(int line) { return line; }
#endif

layout(set = 0, binding = BINDING_SITES) uniform samplerBuffer sites;
layout(set = 0, binding = BINDING_BINS) uniform usamplerBuffer bin_starts;
layout(set = 0, binding = BINDING_MARKS) uniform usamplerBuffer marks;

#ifdef WEIGHTED
layout(set = 0, binding = BINDING_WEIGHTS) uniform samplerBuffer weights;
layout(set = 0, binding = BINDING_HEAVIEST) uniform samplerBuffer heaviest;

vec2 weightAt(int index) { return texelFetch(weights, index).xy; }

// Four numbers to a texel: there are up to twice as many as bins.
float heaviestAt(int number) { return texelFetch(heaviest, number / 4)[number % 4]; }
#endif

vec4 siteAt(int index) { return texelFetch(sites, index); }
int firstOfBin(int bin) { return int(texelFetch(bin_starts, bin).x); }

#include "cell.glsl"
#include "sites.glsl"

int clipEntry(inout Cell cell, vec2 outset) {
#ifdef DRAWN
    beginLines(view.allowed);
#endif
    return clipSiteAt(cell, rankOf(entry_site[0]), outset);
}

#ifdef DRAWN
bool isTooCoarse(in Cell cell) { return losesTooMuch(cell, -offsetToOrigin()); }
#endif

uint entryIndex() { return entry_index[0]; }

// In normalized device coordinates; the clipping has set `here`.
vec2 entryOrigin() { return (offsetToOrigin() - offsetFromHere(view.center)) * view.scale; }

uvec2 entryMark() { return texelFetch(marks, int(entry_site[0])).xy; }
