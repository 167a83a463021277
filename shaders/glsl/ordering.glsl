// What the steps share that put sites in order inside their bins: each takes the sites, at their places, from
// one list into another.
layout(set = 0, binding = BINDING_BINS) uniform usamplerBuffer bin_starts;
layout(set = 0, binding = BINDING_BIN_OF_SITE) uniform usamplerBuffer bin_of_site;
layout(std430, set = 0, binding = BINDING_FROM) readonly buffer From { uint from[]; };
layout(std430, set = 0, binding = BINDING_SITE_AT_PLACE) writeonly buffer To { uint to[]; };

// The places first .. behind - 1.
struct Places {
    uint first;
    uint behind;
};

Places binOf(uint site) {
    int bin = int(texelFetch(bin_of_site, int(site)).x);
    Places places;
    places.first = texelFetch(bin_starts, bin).x;
    places.behind = texelFetch(bin_starts, bin + 1).x;
    return places;
}

// Run `index` of those of `size` places that a bin falls into.
Places runOf(Places bin, uint index, uint size) {
    Places run;
    run.first = min(bin.first + index * size, bin.behind);
    run.behind = min(run.first + size, bin.behind);
    return run;
}
