// The search over a uniform grid, fused with the clipping. Whoever includes this file has included
// cell.glsl and defines before it
//   int firstOfBin(int bin)   the first site of a bin, row by row; at columns * rows, the number of sites
//   vec2 offsetTo(cell_int place)  the site at `place` minus the site of the cell, exact or nearly so
//
// The cell is cut by every site of the 3 x 3 bins around its origin. After that few sites cut, so the
// rest of those that might is only tried, vertex by vertex, and the cell is cut by those that do: first
// what is in the next ring of bins, which ends the search for nearly all cells of evenly spread sites,
// then in all other rows, outward.
//
// Loops are of the form do { } while, with a first pass that always has something to do. Lanes of a
// software driver pass through a loop together, and once more than the longest of them where the test
// comes first.

#include "bins.glsl"

// A site as the clipping sees it.
struct Viewpoint {
    cell_int self;  // its place
    vec2 shift;     // the way from the origin of its cell to it
    vec2 outset;    // that of clipSite
};

#define MOST_FOUND 4

// The coordinates of the vertices, or zeros for a free slot.
struct Vertices {
    EDGES(real, x);
    EDGES(real, y);
};

// A bisector of the cell's site, ready to cut: p . n <= h.
struct Bisector {
    vec2 n;
    real h;
    cell_int place;   // of the other site
    cell_bool apart;  // false: the other is too near for a bisector, or the cell's own; this one cuts nothing
};

Bisector bisectorWith(IN(Viewpoint) view, cell_int place) {
    vec2 d = offsetTo(place);
    real squared = d.x * d.x + d.y * d.y;
    Bisector b;
    b.place = place;
    b.apart = squared > real(0.0);
    real distance = sqrt(b.apart ? squared : real(1.0));
    real inverse = real(1.0) / distance;
    b.n = vec2(b.apart ? d.x * inverse : real(1.0), d.y * inverse);
    real h = real(0.5) * distance + (view.shift.x * b.n.x + view.shift.y * b.n.y);
    real wider = abs(b.n.x) * view.outset.x + abs(b.n.y) * view.outset.y;
    b.h = b.apart ? h + wider : FAR;
    return b;
}

// Cuts by the bisector with the site at `place`, unless that is the cell's own. False if the two are too
// near to each other for that.
bool cutBySite(INOUT(Cell) c, IN(Viewpoint) view, int place) {
    Bisector b = bisectorWith(view, place);
    cutCell(c, b.n, b.h, place);
    bool own = place == view.self;
    return b.apart || own;
}

Vertices verticesOf(IN(Cell) c) {
    Vertices v;
    for (int k = 0; k < EDGE_END; k++) {
        vec2 start = edgeStart(c, k);
        v.x[k] = isEdge(c, k) ? start.x : real(0.0);
        v.y[k] = isEdge(c, k) ? start.y : real(0.0);
    }
    return v;
}

// Whether the bisector with the site at `place` cuts a vertex off, or nearly so.
cell_bool mayCut(IN(Vertices) v, IN(Viewpoint) view, cell_int place) {
    vec2 d = offsetTo(place);
    real farthest = real(0.0);
    for (int k = 0; k < EDGE_END; k++) {
        real along = v.x[k] * d.x + v.y[k] * d.y;
        farthest = along > farthest ? along : farthest;
    }
    real halfway = real(0.49999) * (d.x * d.x + d.y * d.y) + (view.shift.x * d.x + view.shift.y * d.y);
    cell_bool other = place != view.self;
    return farthest > halfway && other;
}

// The box of all sites that can cut the cell: a site cuts a vertex off if it is nearer to the vertex than
// the cell's own site is, so it lies in a disk around the vertex. Together the disks are the flower.
vec4 flowerBox(IN(Cell) c, vec2 site) {
    vec4 box = vec4(site.x, site.y, site.x, site.y);
    for (int k = 0; k < EDGE_END; k++) {
        vec2 v = edgeStart(c, k);
        vec2 d = vec2(v.x - site.x, v.y - site.y);
        real radius = sqrt(d.x * d.x + d.y * d.y) * (real(1.0) + real(32.0) * ROUNDING);
        cell_bool edge = isEdge(c, k);
        real west = edge ? v.x - radius : site.x;
        real south = edge ? v.y - radius : site.y;
        real east = edge ? v.x + radius : site.x;
        real north = edge ? v.y + radius : site.y;
        box = vec4(west < box.x ? west : box.x, south < box.y ? south : box.y, east > box.z ? east : box.z,
                   north > box.w ? north : box.w);
    }
    return box;
}

// Cuts by those sites of the runs that cut. False if one of them is too near for that.
bool cutByRuns(INOUT(Cell) c, IN(Viewpoint) view, IN(Runs) runs) {
    bool certain = true;
    int i = 0;
    do {
        Vertices vertices = verticesOf(c);
        int found0 = view.self;
        int found1 = view.self;
        int found2 = view.self;
        int found3 = view.self;
        int found = 0;
        do {
            int place = i < runs.count ? placeInRuns(runs, i) : view.self;
            bool hit = mayCut(vertices, view, place);
            found0 = hit && found == 0 ? place : found0;
            found1 = hit && found == 1 ? place : found1;
            found2 = hit && found == 2 ? place : found2;
            found3 = hit && found == 3 ? place : found3;
            found += hit ? 1 : 0;
            i++;
        } while (i < runs.count && found < MOST_FOUND);
        int f = 0;
        do {
            bool apart = cutBySite(c, view, f == 0 ? found0 : (f == 1 ? found1 : (f == 2 ? found2 : found3)));
            certain = certain && apart;
            f++;
        } while (f < found);
    } while (i < runs.count && !c.overflow && !c.empty);
    return certain;
}

// Cuts by all sites of the block. False if one of them is too near for that.
bool cutByBlock(INOUT(Cell) c, IN(Viewpoint) view, IN(Runs) runs, bool worthwhile) {
    bool certain = true;
    int i = 0;
    bool going = worthwhile;
    Bisector next = bisectorWith(view, runs.count > 0 ? placeInBlock(runs, 0) : view.self);
    do {
        // The next one is made before this one cuts, so that its loads and roots are done meanwhile.
        Bisector b = next;
        i++;
        going = going && i < runs.count;
        next = bisectorWith(view, going ? placeInBlock(runs, i) : view.self);
        cutCell(c, b.n, b.h, b.place);
        bool own = b.place == view.self;
        certain = certain && (b.apart || own);
    } while (going);
    return certain;
}

// Clips the cell of the site at place `self`, which lies at `shift` from the origin of the cell, by
// every site that can cut it. outset moves every line outward, by up to its two components along x and
// y: nothing, to measure; half a step of the vertex grid, to draw.
int clipSite(INOUT(Cell) c, IN(Bins) bins, vec4 walls, vec2 outset, int self, vec2 shift) {
    beginCell(c, vec4(walls.x - outset.x, walls.y - outset.y, walls.z + outset.x, walls.w + outset.y));
    Viewpoint view;
    view.self = self;
    view.shift = shift;
    view.outset = outset;
    int column = binAlong(-bins.low.x / bins.size, bins.columns);
    int row = binAlong(-bins.low.y / bins.size, bins.rows);
    Runs runs = runsOfBlock(bins, column, row);
    int tried = runs.count;
    bool left = tried <= bins.most;
    bool certain = cutByBlock(c, view, runs, left);
    int step = 0;
    vec4 box = flowerBox(c, shift);
    do {
        runs = runsOfStep(bins, binsOf(bins, box), step, column, row);
        tried += runs.count + MOST_RUNS;
        left = left && tried <= bins.most && !c.overflow && !c.empty;
        runs.count = left ? runs.count : 0;
        bool apart = cutByRuns(c, view, runs);
        certain = certain && apart;
        box = flowerBox(c, shift);
        step++;
        left = left && isLeft(binsOf(bins, box), step, column, row);
    } while (left);
    bool unknown = box.x < bins.known.x || box.y < bins.known.y || box.z > bins.known.z || box.w > bins.known.w;
    return outcome(c, unknown || !certain || tried > bins.most);
}
