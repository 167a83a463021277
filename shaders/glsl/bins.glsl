// The bins of a uniform grid over sites, and which of them a search turns to when. Whoever includes this
// file defines before it
//   int firstOfBin(int bin)  the first site of a bin, row by row; at columns * rows, the number of sites
// and with WEIGHTED
//   real leadOf(int number)  a number of Grid::heaviest minus the weight of the cell's site, rounded up
//   int heavyAt(int k)       site k of SiteSet::heavy
//
// The sites stand bin by bin, so that bins side by side in a row are one run of sites.

// The grid, seen from the origin of a cell.
struct Bins {
    int columns;
    int rows;
    real size;   // side of a bin
    vec2 low;    // the grid's lower left corner
    real slack;  // by how much a site may lie outside of its bin, as seen from here
    vec4 known;  // west, south, east, north: the sites beyond this box are not in the grid
    int most;    // sites to try before the search gives up
#ifdef WEIGHTED
    int heavy;  // sites in SiteSet::heavy
#endif
};

// Bins by column and row, all inclusive.
struct BinRange {
    int west;
    int south;
    int east;
    int north;
};

#define MOST_RUNS 8
#define BLOCK_RUNS 3

// Runs of sites, one after the other: the i-th site of all is at place i + shift[r], with r the first
// run for which i < end[r].
struct Runs {
    int shift[MOST_RUNS];
    int end[MOST_RUNS];
    int count;  // of sites
};

#include "bin_along.glsl"

BinRange binsOf(IN(Bins) bins, vec4 box) {
    real scale = real(1.0) / bins.size;
    BinRange range;
    range.west = binAlong((box.x - bins.slack - bins.low.x) * scale, bins.columns);
    range.south = binAlong((box.y - bins.slack - bins.low.y) * scale, bins.rows);
    range.east = binAlong((box.z + bins.slack - bins.low.x) * scale, bins.columns);
    range.north = binAlong((box.w + bins.slack - bins.low.y) * scale, bins.rows);
    return range;
}

// A part of a row of bins, empty where from > to or where the grid has no such row.
struct BinRow {
    int row;
    int from;
    int to;
};

// The sites first .. behind - 1.
struct Span {
    int first;
    int behind;
};

Span sitesOf(IN(Bins) bins, IN(BinRow) part) {
    int rows = bins.rows;
    bool some = part.row >= 0 && part.row < rows && part.from <= part.to;
    int bin = part.row * bins.columns + part.from;
    Span span;
    span.first = firstOfBin(some ? bin : 0);
    span.behind = firstOfBin(some ? bin + part.to - part.from + 1 : 0);
    return span;
}

int placeInRuns(IN(Runs) runs, int i) {
    int shift = runs.shift[0];
    for (int r = 1; r < MOST_RUNS; r++) {
        shift = i >= runs.end[r - 1] ? runs.shift[r] : shift;
    }
    return i + shift;
}

int placeInBlock(IN(Runs) runs, int i) {
    return i + (i < runs.end[0] ? runs.shift[0] : (i < runs.end[1] ? runs.shift[1] : runs.shift[2]));
}

// Part r of the 3 x 3 bins around the origin.
BinRow partOfBlock(IN(Bins) bins, int r, int column, int row) {
    BinRow part;
    part.row = r == 0 ? row : (r == 1 ? row - 1 : row + 1);
    part.from = max(column - 1, 0);
    part.to = r < BLOCK_RUNS ? min(column + 1, bins.columns - 1) : -1;
    return part;
}

// Part r of what a step of the search tries of the bins in `range`. Step 0: the ring around the block.
// Step s: the four rows that are 2 s - 2 and 2 s - 1 away from the origin, without what the ring had.
BinRow partOfStep(IN(BinRange) range, int step, int r, int column, int row) {
    bool ring = step == 0;
    bool right = r % 2 == 1;
    int pair = r / 2;
    int west = ring ? max(range.west, column - 2) : range.west;
    int east = ring ? min(range.east, column + 2) : range.east;
    int done = ring ? 1 : 2;  // columns and rows on either side of the origin's
    int away = ring ? (pair + 1) / 2 : 2 * step - 2 + pair / 2;
    bool whole = away > done;
    bool upward = ring && pair == 3 ? right : pair % 2 == 1;
    bool again = !ring && (whole ? right : away == 0 && upward);
    BinRow part;
    part.row = upward ? row + away : row - away;
    bool used = part.row >= range.south && part.row <= range.north && !again;
    part.from = !whole && right ? column + done + 1 : west;
    part.to = whole || right ? east : column - done - 1;
    part.to = used ? part.to : part.from - 1;
    return part;
}

Runs runsOfBlock(IN(Bins) bins, int column, int row) {
    Runs runs;
    runs.count = 0;
    for (int r = 0; r < MOST_RUNS; r++) {
        BinRow part = partOfBlock(bins, r, column, row);
        Span span = sitesOf(bins, part);
        runs.shift[r] = span.first - runs.count;
        runs.count += span.behind - span.first;
        runs.end[r] = runs.count;
    }
    return runs;
}

#ifdef WEIGHTED
// The heavy sites come before step 0, some in each step.
int firstStep(IN(Bins) bins) { return -((bins.heavy + MOST_RUNS - 1) / MOST_RUNS); }

Runs runsOfHeavy(IN(Bins) bins, int step) {
    Runs runs;
    runs.count = 0;
    for (int r = 0; r < MOST_RUNS; r++) {
        int k = (-1 - step) * MOST_RUNS + r;
        bool some = k < bins.heavy;
        runs.shift[r] = heavyAt(some ? k : 0) - runs.count;
        runs.count += some ? 1 : 0;
        runs.end[r] = runs.count;
    }
    return runs;
}
#endif

Runs runsOfStep(IN(Bins) bins, IN(BinRange) range, int step, int column, int row) {
#ifdef WEIGHTED
    if (step < 0) {
        return runsOfHeavy(bins, step);
    }
#endif
    Runs runs;
    runs.count = 0;
    for (int r = 0; r < MOST_RUNS; r++) {
        BinRow part = partOfStep(range, step, r, column, row);
        Span span = sitesOf(bins, part);
        runs.shift[r] = span.first - runs.count;
        runs.count += span.behind - span.first;
        runs.end[r] = runs.count;
    }
    return runs;
}

// Whether step `step` or a later one has bins of `range` to try; asked after step 0.
bool isLeft(IN(BinRange) range, int step, int column, int row) {
#ifdef WEIGHTED
    if (step <= 0) {
        return true;
    }
#endif
    bool wide = range.west < column - 2 || range.east > column + 2;
    int next = wide ? 2 * step - 2 : max(2 * step - 2, 3);
    return range.south <= row - next || range.north >= row + next;
}


#ifdef WEIGHTED
// By how much the sites of the bins in `range`, but for the heavy ones, are heavier than the cell's own: a
// bound from above. It comes from the finest level of Grid::heaviest where the range has few numbers.
real leadIn(IN(Bins) bins, IN(BinRange) range) {
    int first = 0;
    int columns = bins.columns;
    int rows = bins.rows;
    BinRange seen = range;
    while (seen.east - seen.west > 2 || seen.north - seen.south > 2) {
        first += columns * rows;
        columns = (columns + 1) / 2;
        rows = (rows + 1) / 2;
        seen.west = seen.west / 2;
        seen.south = seen.south / 2;
        seen.east = seen.east / 2;
        seen.north = seen.north / 2;
    }
    real lead = -FAR;
    for (int k = 0; k < 9; k++) {
        int column = min(seen.west + k % 3, seen.east);
        int row = min(seen.south + k / 3, seen.north);
        real here = leadOf(first + row * columns + column);
        lead = here > lead ? here : lead;
    }
    return lead;
}

// The same of all sites.
real leadOfAll(IN(Bins) bins) {
    int top = 0;
    int columns = bins.columns;
    int rows = bins.rows;
    while (columns > 1 || rows > 1) {
        top += columns * rows;
        columns = (columns + 1) / 2;
        rows = (rows + 1) / 2;
    }
    return leadOf(top);
}
#endif
