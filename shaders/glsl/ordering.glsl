// Shared by the steps that sort the sites inside their bins. A site's rank is its index when all are sorted,
// bin by bin. Each step moves the sites from one list, by rank, into another.
layout(set = 0, binding = BINDING_BINS) uniform usamplerBuffer bin_starts;
layout(set = 0, binding = BINDING_BIN_OF_SITE) uniform usamplerBuffer bin_of_site;
layout(std430, set = 0, binding = BINDING_FROM) readonly buffer From { uint from[]; };
layout(std430, set = 0, binding = BINDING_SITE_OF_RANK) writeonly buffer To { uint to[]; };

// The half-open range of ranks [first, behind).
struct Ranks {
    uint first;
    uint behind;
};

// The ranks of the sites in the bin of `site`.
Ranks binOf(uint site) {
    int bin = int(texelFetch(bin_of_site, int(site)).x);
    Ranks ranks;
    ranks.first = texelFetch(bin_starts, bin).x;
    ranks.behind = texelFetch(bin_starts, bin + 1).x;
    return ranks;
}

// Run `index` of a bin that is divided into runs of `size` ranks.
Ranks runOf(Ranks bin, uint index, uint size) {
    Ranks run;
    run.first = min(bin.first + index * size, bin.behind);
    run.behind = min(run.first + size, bin.behind);
    return run;
}
