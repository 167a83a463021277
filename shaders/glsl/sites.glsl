// The cell of one site of an upload, found by the search over its grid. Its includer has
// included cell.glsl and defines before it
//   vec4 siteAt(int index)   site `index`: x_high, y_high, x_low, y_low from the center of the domain
//   int firstOfBin(int bin)  as for grid.glsl
// and with WEIGHTED
//   vec2 weightAt(int index)      its weight: high, low
//   float heaviestAt(int number)  of Grid::heaviest, rounded up
// src/backend/site_texels.h writes all of them.

#include "site_grid.glsl"

vec4 here;  // the site of the cell

// From `here` to another site. Where two sites are near each other, both differences are exact; the sum
// is rounded relative to its own size. No compiler may rearrange that.
vec2 offsetFromHere(vec4 other) {
    precise vec2 offset = (other.xy - here.xy) + (other.zw - here.zw);
    return offset;
}

vec4 boxFromHere(vec4 high, vec4 low) {
    precise vec4 box = (high - here.xyxy) + (low - here.zwzw);
    return box;
}

vec2 offsetTo(int index) { return offsetFromHere(siteAt(index)); }

#ifdef WEIGHTED
vec2 weight_here;

real weightDifference(int index) {
    vec2 other = weightAt(index);
    precise float difference = (weight_here.x - other.x) + (weight_here.y - other.y);
    return difference;
}

real weightExcess(int number) {
    precise float weight_excess = (heaviestAt(number) - weight_here.x) - weight_here.y;
    return weight_excess + abs(weight_excess) * (2.0 * ROUNDING);
}

int heavyAt(int k) { return site_grid.heavy[k / 4][k % 4]; }
#endif

#include "grid.glsl"

// From `here` to the origin of its cell: nothing, or the way to the nearest point of the domain.
vec2 offsetToOrigin() {
    vec4 walls = boxFromHere(site_grid.domain_high, site_grid.domain_low);
    return max(walls.xy, min(walls.zw, vec2(0.0)));
}

// Clips the cell of the site at `index`, which becomes `here`. outset is that of searchBlock.
int clipSiteAt(inout Cell cell, int index, vec2 outset) {
    here = siteAt(index);
#ifdef WEIGHTED
    weight_here = weightAt(index);
#endif
    vec2 origin = offsetToOrigin();
    Bins bins;
    bins.columns = site_grid.columns;
    bins.rows = site_grid.rows;
    bins.size = site_grid.size;
    bins.low = offsetFromHere(site_grid.corner) - origin;
    vec2 high = bins.low + vec2(float(bins.columns), float(bins.rows)) * bins.size;
    vec2 longest = max(abs(bins.low), abs(high));
    bins.slack = site_grid.slack * max(longest.x, longest.y);
    bins.coverage = boxFromHere(site_grid.coverage_high, site_grid.coverage_low) - origin.xyxy;
    bins.most = site_grid.most;
#ifdef WEIGHTED
    bins.heavy = site_grid.heavy_count;
#endif
    vec4 walls = boxFromHere(site_grid.domain_high, site_grid.domain_low) - origin.xyxy;
    return clipSite(cell, bins, walls, outset, index, -origin);
}
