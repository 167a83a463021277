// The search over a uniform grid, fused with the clipping. Its includer has included
// cell.glsl and defines before it
//   ANY(condition)            whether a cell_bool holds for any cell of those side by side
//   cell_int firstOfBin(cell_int bin)  the first site of a bin, row by row; at columns * rows, the number of sites
//   vec2 offsetTo(cell_int index)  the site at `index` minus the site of the cell, exact or nearly so
// and with WEIGHTED, besides what bins.glsl needs,
//   real weightDifference(cell_int index)  the weight of the cell's site minus that of the site at `index`
// and defines or not
//   DRAWN  whether cells are drawn, never with WEIGHTED: then what a device's roots and quotients lose is bounded
//          and, with a negative outset, cells are shrunk
//
// The cell is cut by every site of the 3 x 3 bins around its origin. After that few sites cut, so the
// rest of those that might is only tried, vertex by vertex, and the cell is cut by those that do: first
// what is in the next ring of bins, which ends the search for nearly all cells of evenly spread sites,
// then in all other rows, outward.
//
// With weights w, the site j has the points p for which |p - j|^2 - w_j is less than |p - i|^2 - w_i. That
// moves the bisector, along the same normal; the disk around a vertex in which a site must lie to cut it off
// grows with the weight of that site; and the cell may lie anywhere, or be empty.
//
// Loops are of the form do { } while, with a first pass that always has something to do. Lanes of a
// software driver pass through a loop together, and once more than the longest of them where the test
// comes first. Cells side by side do so as well: a loop continues while ANY of them does, and finished cells
// process their own site, which cuts nothing.

#include "bins.glsl"

// The site whose cell is clipped, relative to the origin of the cell.
struct Viewpoint {
    cell_int self;       // its index
    vec2 origin_offset;  // the way from the origin of its cell to it
    vec2 outset;         // that of searchBlock
#ifdef WEIGHTED
    real weight_excess;  // bounds by how much a site that is left to try is heavier than the cell's own
#endif
};

#ifdef DRAWN
// What floats may lose of the lines that were tried against the cell, whether they cut it or not: one that they lose
// too much of may pass by a cell that it cuts.
struct LinesTried {
    real allowed;   // what may be lost of the cell, a length
    real nearest;   // the square of the least distance of their sites
};

LinesTried lines_tried;

void beginLines(real allowed) {
    lines_tried.allowed = allowed;
    lines_tried.nearest = FAR;
}
#endif

#define MOST_FOUND 4

// The coordinates of the vertices, or of a point of the cell for a free slot: without weights, its origin.
struct Vertices {
    EDGES(real, x);
    EDGES(real, y);
};

// A bisector of the cell's site, ready to cut: p . n <= h.
struct Bisector {
    vec2 n;
    real h;
    cell_int index;   // that of the other site
    cell_bool apart;  // false: the other is too near for a bisector, or the cell's own; this one cuts nothing
};

Bisector bisectorWith(IN(Viewpoint) view, cell_int index) {
    vec2 d = offsetTo(index);
    real squared = d.x * d.x + d.y * d.y;
    Bisector b;
    b.index = index;
    b.apart = squared > real(0.0);
    real distance = sqrt(b.apart ? squared : real(1.0));
    real inverse = real(1.0) / distance;
#ifdef DRAWN
    // One step of Newton's, so that n is a unit vector as nearly as its products are, whatever a root and a quotient
    // of the device are.
    real once = b.apart ? squared : real(1.0);
    inverse += inverse * (real(0.5) - real(0.5) * (once * inverse * inverse));
    distance = once * inverse;
#endif
    b.n = vec2(b.apart ? d.x * inverse : real(1.0), d.y * inverse);
    real h = real(0.5) * distance + (view.origin_offset.x * b.n.x + view.origin_offset.y * b.n.y);
#ifdef WEIGHTED
    h += real(0.5) * weightDifference(index) * inverse;
#endif
    real wider = abs(b.n.x) * view.outset.x + abs(b.n.y) * view.outset.y;
    b.h = b.apart ? h + wider : FAR;
#ifdef DRAWN
    lines_tried.nearest = b.apart ? min(lines_tried.nearest, squared) : lines_tried.nearest;
#endif
    return b;
}

// Cuts by the bisector with the site at `index`, unless that is the cell's own. False if the two are too
// near to each other for that.
cell_bool cutBySite(INOUT(Cell) c, IN(Viewpoint) view, cell_int index) {
    Bisector b = bisectorWith(view, index);
#ifdef WEIGHTED
    b.h = hasEdge(c, index) ? FAR : b.h;  // heavy sites are tried first, then in their bins again
#endif
    cutCell(c, b.n, b.h, index);
    cell_bool own = index == view.self;
    return b.apart || own;
}

Vertices verticesOf(IN(Cell) c) {
    vec2 inside = vec2(real(0.0), real(0.0));
#ifdef WEIGHTED
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        vec2 start = edgeStart(c, k);
        inside.x = isEdge(c, k) ? start.x : inside.x;
        inside.y = isEdge(c, k) ? start.y : inside.y;
    }
#endif
    Vertices v;
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        vec2 start = edgeStart(c, k);
        v.x[k] = isEdge(c, k) ? start.x : inside.x;
        v.y[k] = isEdge(c, k) ? start.y : inside.y;
    }
    return v;
}

// Whether the bisector with the site at `index` cuts a vertex off, or nearly so.
cell_bool mayCut(IN(Vertices) v, IN(Viewpoint) view, cell_int index) {
    vec2 d = offsetTo(index);
    real farthest = -FAR;
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        real along = v.x[k] * d.x + v.y[k] * d.y;
        farthest = along > farthest ? along : farthest;
    }
    real halfway = real(0.49999) * (d.x * d.x + d.y * d.y) + (view.origin_offset.x * d.x + view.origin_offset.y * d.y);
#ifdef WEIGHTED
    real against = real(0.5) * weightDifference(index);
    halfway += against - real(0.00001) * abs(against);
#endif
#ifdef DRAWN
    // A site that leaves a cell alone may cut the shrunk one.
    halfway += min(abs(d.x) * view.outset.x + abs(d.y) * view.outset.y, real(0.0));
#endif
    cell_bool other = index != view.self;
    return farthest > halfway && other;
}

// The box of all sites that can cut the cell: a site cuts a vertex off if it is nearer to the vertex than
// the cell's own site is, so it lies in a disk around the vertex. Together the disks are the flower.
// With weights the square of the disk's radius is larger by how much heavier the site may be; if that is
// less than nothing, there is no disk.
// Where lines are moved inward, by up to s, a site cuts a vertex v off if it cuts v + b off for some b no longer
// than s: so the disk around v has the radius |v| + 2 s, and with weights that of |v| + s, and s more.
vec4 flowerBox(IN(Cell) c, IN(Viewpoint) view) {
    vec2 site = view.origin_offset;
    real inward = max(-(view.outset.x + view.outset.y), real(0.0));
    vec4 box = vec4(site.x, site.y, site.x, site.y);
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        vec2 v = edgeStart(c, k);
        vec2 d = vec2(v.x - site.x, v.y - site.y);
        cell_bool edge = isEdge(c, k);
#ifdef WEIGHTED
        real away = sqrt(d.x * d.x + d.y * d.y) + inward;
        real squared = away * away * (real(1.0) + real(64.0) * ROUNDING) + view.weight_excess;
        cell_bool some = squared > real(0.0);
        edge = edge && some;
        real radius = sqrt(some ? squared : real(0.0)) + real(32.0) * ROUNDING * (away + sqrt(abs(view.weight_excess)));
        radius += inward;
#else
        real radius = sqrt(d.x * d.x + d.y * d.y) * (real(1.0) + real(32.0) * ROUNDING) + real(2.0) * inward;
#endif
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
cell_bool cutByRuns(INOUT(Cell) c, IN(Viewpoint) view, IN(Runs) runs) {
    cell_bool certain = cell_bool(true);
    cell_bool more = cell_bool(false);
    cell_int i = cell_int(0);
    do {
        Vertices vertices = verticesOf(c);
        cell_int found0 = view.self;
        cell_int found1 = view.self;
        cell_int found2 = view.self;
        cell_int found3 = view.self;
        cell_int found = cell_int(0);
        cell_bool some = i < runs.count;
        do {
            cell_int index = some ? siteInRuns(runs, i) : view.self;
            cell_bool hit = mayCut(vertices, view, index);
            found0 = hit && found == 0 ? index : found0;
            found1 = hit && found == 1 ? index : found1;
            found2 = hit && found == 2 ? index : found2;
            found3 = hit && found == 3 ? index : found3;
            found += hit ? cell_int(1) : cell_int(0);
            i += some ? cell_int(1) : cell_int(0);
            some = i < runs.count && found < MOST_FOUND;
        } while (ANY(some));
        int f = 0;
        cell_bool waiting;
        do {
            cell_bool apart = cutBySite(c, view, f == 0 ? found0 : (f == 1 ? found1 : (f == 2 ? found2 : found3)));
            certain = certain && apart;
            f++;
            waiting = found > f;
        } while (ANY(waiting));
        more = i < runs.count && !c.overflow && !c.empty;
    } while (ANY(more));
    return certain;
}

// Cuts by all sites of the block but the cell's own. False if one of them is too near for that.
cell_bool cutByBlock(INOUT(Cell) c, IN(Viewpoint) view, IN(Runs) runs, cell_bool worthwhile) {
    cell_bool certain = cell_bool(true);
    cell_int own = positionInBlock(runs, view.self);
    cell_int others = own < runs.count ? runs.count - 1 : runs.count;
    int i = 0;
    cell_bool going = worthwhile && others > 0;
    Bisector next = bisectorWith(view, going ? siteInBlock(runs, own > 0 ? cell_int(0) : cell_int(1)) : view.self);
    do {
        // The next one is made before this one cuts, so that its loads and roots are done meanwhile.
        Bisector b = next;
        i++;
        going = going && i < others;
#ifdef WEIGHTED
        going = going && !c.empty;
#endif
        next = bisectorWith(view, going ? siteInBlock(runs, own > i ? cell_int(i) : cell_int(i + 1)) : view.self);
        cutCell(c, b.n, b.h, b.index);
        cell_bool idle = b.index == view.self;
        certain = certain && (b.apart || idle);
    } while (ANY(going));
    return certain;
}

#ifdef WEIGHTED
// The box of all sites that can cut the cell, but for those in `heavy`; where sites are left to try, lowers
// view.weight_excess to what the bins in it say: a site that can cut is no heavier, so it lies in the box, whose
// bins bound its weight.
vec4 boxLeft(IN(Cell) c, IN(Bins) bins, INOUT(Viewpoint) view, cell_bool left, int rounds) {
    vec4 box = flowerBox(c, view);
    UNROLL for (int round = 0; round < rounds; round++) {
        real weight_excess = min(view.weight_excess, weightExcessIn(bins, binsOf(bins, box)));
        view.weight_excess = left ? weight_excess : view.weight_excess;
        box = flowerBox(c, view);
    }
    return box;
}
#endif

// How far the search for a cell is.
struct Search {
    Viewpoint view;
    cell_int column;  // of the bin around the origin
    cell_int row;
    cell_int tried;
    cell_bool certain;
    vec4 box;        // of the sites that can cut the cell
    cell_bool left;  // whether some of them may not have been tried
};

Search searchFrom(IN(Bins) bins, vec2 outset, cell_int self, vec2 origin_offset) {
    Search s;
    s.view.self = self;
    s.view.origin_offset = origin_offset;
    s.view.outset = outset;
    s.column = binAlong(-bins.low.x / bins.size, bins.columns);
    s.row = binAlong(-bins.low.y / bins.size, bins.rows);
    return s;
}

// Begins the cell of the site with the index `self`, which lies at `origin_offset` from the origin of the cell,
// and cuts it by every site of the block. outset moves every line outward, by up to its two components along x
// and y: 0 to measure; what view_uniform.h says to draw. Where it is negative, lines move inward.
Search searchBlock(INOUT(Cell) c, IN(Bins) bins, vec4 walls, vec2 outset, cell_int self, vec2 origin_offset) {
    beginCell(c, vec4(walls.x - outset.x, walls.y - outset.y, walls.z + outset.x, walls.w + outset.y));
    Search s = searchFrom(bins, outset, self, origin_offset);
    Runs runs = runsOfBlock(bins, s.column, s.row);
    s.tried = runs.count;
    s.left = s.tried <= bins.most;
    s.certain = cutByBlock(c, s.view, runs, s.left);
#ifdef WEIGHTED
    s.view.weight_excess = weightExcessOfAll(bins);
    s.box = boxLeft(c, bins, s.view, s.left, 2);
#else
    s.box = flowerBox(c, s.view);
    cell_bool beyond = isBeyondBlock(binsOf(bins, s.box), s.column, s.row);
    s.left = s.left && beyond;
#endif
    s.left = s.left && !c.overflow && !c.empty;
    return s;
}

// Cuts a cell by every site beyond the block that can cut it.
void searchBeyond(INOUT(Cell) c, IN(Bins) bins, INOUT(Search) s) {
#ifdef WEIGHTED
    int step = firstStep(bins);
#else
    int step = 0;
#endif
    do {
        Runs runs = runsOfStep(bins, binsOf(bins, s.box), step, s.column, s.row);
        s.tried += s.left ? runs.count + MOST_RUNS : cell_int(0);
        s.left = s.left && s.tried <= bins.most && !c.overflow && !c.empty;
        runs.count = s.left ? runs.count : cell_int(0);
        cell_bool apart = cutByRuns(c, s.view, runs);
        s.certain = s.certain && apart;
#ifdef WEIGHTED
        s.box = boxLeft(c, bins, s.view, s.left, 1);
#else
        s.box = flowerBox(c, s.view);
#endif
        step++;
        cell_bool beyond = isLeft(binsOf(bins, s.box), step, s.column, s.row);
        s.left = s.left && beyond;
    } while (ANY(s.left));
}

// What became of a cell when the search is over.
cell_int outcomeOf(IN(Cell) c, IN(Bins) bins, IN(Search) s) {
    cell_bool unknown = s.box.x < bins.coverage.x || s.box.y < bins.coverage.y || s.box.z > bins.coverage.z ||
        s.box.w > bins.coverage.w;
    cell_bool given_up = s.tried > bins.most;
    return outcome(c, unknown || given_up || !s.certain);
}

// Clips the cell of a site by every site that can cut it; see searchBlock.
cell_int clipSite(INOUT(Cell) c, IN(Bins) bins, vec4 walls, vec2 outset, cell_int self, vec2 origin_offset) {
    Search s = searchBlock(c, bins, walls, outset, self, origin_offset);
    searchBeyond(c, bins, s);
    return outcomeOf(c, bins, s);
}

#ifdef DRAWN
// Whether floats may lose more of a cell than is allowed; docs/algorithm.md, "What floats lose". What is lost of the
// place of another site turns the line between the two by that part of their distance.
cell_bool losesTooMuch(IN(Cell) c, vec2 origin_offset) {
    real farthest = sqrt(max(squaredRadius(c), real(0.0)));
    real reach = farthest + abs(origin_offset.x) + abs(origin_offset.y);
    real away = sqrt(lines_tried.nearest);
    return reach * (real(REACH_ROUNDING) * away + real(PLACE_ROUNDING)) > lines_tried.allowed * away;
}
#endif
