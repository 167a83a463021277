// The grid of an upload; src/backend/site_texels.h writes the block.
layout(std140, set = 0, binding = BINDING_GRID) uniform SiteGrid {
    vec4 domain_high;  // west, south, east, north from the center of the domain, like a site
    vec4 domain_low;
    vec4 coverage_high;
    vec4 coverage_low;
    vec4 corner;  // of the grid, like a site
    float size;   // of a bin
    float slack;  // of the longest way from an origin to a corner of the grid
    int columns;
    int rows;
    int most;
    int heavy_count;
    ivec4 heavy[MOST_HEAVY / 4];  // heavy_count of them count
} site_grid;
