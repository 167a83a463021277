// One site of an upload, as site.vert hands it on or a compute shader loads it: its cell comes from the
// search over the grid. The twin of list_entry.glsl.
#ifdef ENTRIES_IN_BUFFER
layout(std430, set = 0, binding = BINDING_ENTRIES) readonly buffer Entries { uint sites_of_entries[]; };
uint entry_index[1];
uint entry_site[1];

// Whether the device has put the sites into their bins, and so in another order than that of the upload.
layout(constant_id = 0) const bool PLACED_HERE = false;
layout(set = 0, binding = BINDING_PLACE_OF_SITE) uniform usamplerBuffer place_of_site;
layout(set = 0, binding = BINDING_SITE_AT_PLACE) uniform usamplerBuffer site_at_place;

// The entry at `index` of a slice that begins at `first`.
void loadEntry(uint first, uint index) {
    entry_index[0] = index;
    entry_site[0] = sites_of_entries[first + index];
}

int placeOf(uint site) { return int(PLACED_HERE ? texelFetch(place_of_site, int(site)).x : site); }

int neighborOf(int line) {
    return PLACED_HERE && line >= 0 ? int(texelFetch(site_at_place, line).x) : line;
}
#else
layout(location = 0) flat in uint entry_index[];
layout(location = 1) flat in uint entry_site[];

int placeOf(uint site) { return int(site); }

int neighborOf(int line) { return line; }
#endif

layout(set = 0, binding = BINDING_SITES) uniform samplerBuffer sites;
layout(set = 0, binding = BINDING_BINS) uniform usamplerBuffer bin_starts;
layout(set = 0, binding = BINDING_MARKS) uniform usamplerBuffer marks;

#ifdef WEIGHTED
layout(set = 0, binding = BINDING_WEIGHTS) uniform samplerBuffer weights;
layout(set = 0, binding = BINDING_HEAVIEST) uniform samplerBuffer heaviest;

vec2 weightAt(int place) { return texelFetch(weights, place).xy; }

// Four numbers to a texel: there are up to twice as many as bins.
float heaviestAt(int number) { return texelFetch(heaviest, number / 4)[number % 4]; }
#endif

vec4 siteAt(int place) { return texelFetch(sites, place); }
int firstOfBin(int bin) { return int(texelFetch(bin_starts, bin).x); }

#include "cell.glsl"
#include "sites.glsl"

int clipEntry(inout Cell cell, vec2 outset) {
#ifdef DRAWN
    beginLines(view.allowed);
#endif
    return clipSiteAt(cell, placeOf(entry_site[0]), outset);
}

#ifdef DRAWN
bool isTooCoarse(in Cell cell) { return losesTooMuch(cell, -offsetToOrigin()); }
#endif

uint entryIndex() { return entry_index[0]; }

// In normalized device coordinates; the clipping has set `here`.
vec2 entryOrigin() { return (offsetToOrigin() - offsetFromHere(view.center)) * view.scale; }

uvec2 entryMark() { return texelFetch(marks, int(entry_site[0])).xy; }
