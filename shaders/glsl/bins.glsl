// The bins of a uniform grid over sites, and the order in which a search visits them. Its includer defines
// before it
//   cell_int firstOfBin(cell_int bin)  the first site of a bin, row by row; at columns * rows, the number of sites
// and with WEIGHTED
//   real weightExcess(cell_int number)  a number of Grid::heaviest minus the weight of the cell's site, rounded up
//   int heavyAt(int k)            site k of SiteSet::heavy
//
// The sites stand bin by bin, so that bins side by side in a row are one run of sites.

// The grid, seen from the origin of a cell.
struct Bins {
    int columns;
    int rows;
    real size;      // side of a bin
    vec2 low;       // the lower left corner of the grid
    real slack;     // by how much a site may lie outside of its bin, as seen from here
    vec4 coverage;  // west, south, east, north: the sites beyond this box are not in the grid
    int most;       // sites to try before the search gives up
#ifdef WEIGHTED
    int heavy;  // sites in SiteSet::heavy
#endif
};

// A rectangle of bins; its bounds are inclusive.
struct BinRange {
    cell_int west;
    cell_int south;
    cell_int east;
    cell_int north;
};

#define MOST_RUNS 8
#define BLOCK_RUNS 3

// Runs of sites, one after the other: the i-th site of all has the index i + shift[r], with r the first
// run for which i < end[r].
struct Runs {
    cell_int shift[MOST_RUNS];
    cell_int end[MOST_RUNS];
    cell_int count;  // of sites
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
    cell_int row;
    cell_int from;
    cell_int to;
};

// The half-open range of sites [first, behind).
struct Span {
    cell_int first;
    cell_int behind;
};

Span sitesOf(IN(Bins) bins, IN(BinRow) part) {
    cell_bool some = part.row >= 0 && part.row < bins.rows && part.from <= part.to;
    cell_int bin = part.row * bins.columns + part.from;
    Span span;
    span.first = firstOfBin(some ? bin : cell_int(0));
    span.behind = firstOfBin(some ? bin + part.to - part.from + 1 : cell_int(0));
    return span;
}

// The index of the i-th site of the runs.
cell_int siteInRuns(IN(Runs) runs, cell_int i) {
    cell_int shift = runs.shift[0];
    UNROLL for (int r = 1; r < MOST_RUNS; r++) {
        shift = i >= runs.end[r - 1] ? runs.shift[r] : shift;
    }
    return i + shift;
}

// The index of the i-th site of a block's runs.
cell_int siteInBlock(IN(Runs) runs, cell_int i) {
    return (i < runs.end[0] ? runs.shift[0] : (i < runs.end[1] ? runs.shift[1] : runs.shift[2])) + i;
}

// The position among the block's sites of the site with that index; runs.count if it is not in the block.
cell_int positionInBlock(IN(Runs) runs, cell_int index) {
    cell_int position = runs.count;
    cell_int begin = cell_int(0);
    UNROLL for (int r = 0; r < BLOCK_RUNS; r++) {
        cell_int i = index - runs.shift[r];
        position = i >= begin && i < runs.end[r] ? i : position;
        begin = runs.end[r];
    }
    return position;
}

// Part r of the 3 x 3 bins around the origin.
BinRow partOfBlock(IN(Bins) bins, int r, cell_int column, cell_int row) {
    BinRow part;
    part.row = r == 0 ? row : (r == 1 ? row - 1 : row + 1);
    part.from = max(column - 1, cell_int(0));
    part.to = min(column + 1, cell_int(bins.columns - 1));
    return part;
}

// Part r of what a step of the search tries of the bins in `range`. Step 0: the ring around the block.
// Step s: the four rows that are 2 s - 2 and 2 s - 1 away from the origin, without what the ring had.
BinRow partOfStep(IN(BinRange) range, int step, int r, cell_int column, cell_int row) {
    bool ring = step == 0;
    bool right = r % 2 == 1;
    int pair = r / 2;
    cell_int west = ring ? max(range.west, column - 2) : range.west;
    cell_int east = ring ? min(range.east, column + 2) : range.east;
    int done = ring ? 1 : 2;  // columns and rows on either side of the origin's
    int away = ring ? (pair + 1) / 2 : 2 * step - 2 + pair / 2;
    bool whole = away > done;
    bool upward = ring && pair == 3 ? right : pair % 2 == 1;
    bool again = !ring && (whole ? right : away == 0 && upward);
    BinRow part;
    part.row = upward ? row + away : row - away;
    cell_bool used = part.row >= range.south && part.row <= range.north && !again;
    part.from = !whole && right ? column + done + 1 : west;
    part.to = whole || right ? east : column - done - 1;
    part.to = used ? part.to : part.from - 1;
    return part;
}

// Of the block, no more than the first BLOCK_RUNS runs are there.
Runs runsOfBlock(IN(Bins) bins, cell_int column, cell_int row) {
    Runs runs;
    runs.count = cell_int(0);
    UNROLL for (int r = 0; r < BLOCK_RUNS; r++) {
        BinRow part = partOfBlock(bins, r, column, row);
        Span span = sitesOf(bins, part);
        runs.shift[r] = span.first - runs.count;
        runs.count += span.behind - span.first;
        runs.end[r] = runs.count;
    }
    return runs;
}

#ifdef WEIGHTED
// The heavy sites come before step 0, MOST_RUNS in each step.
int firstStep(IN(Bins) bins) { return -((bins.heavy + MOST_RUNS - 1) / MOST_RUNS); }

Runs runsOfHeavy(IN(Bins) bins, int step) {
    Runs runs;
    runs.count = cell_int(0);
    UNROLL for (int r = 0; r < MOST_RUNS; r++) {
        int k = (-1 - step) * MOST_RUNS + r;
        bool some = k < bins.heavy;
        runs.shift[r] = cell_int(heavyAt(some ? k : 0)) - runs.count;
        runs.count += cell_int(some ? 1 : 0);
        runs.end[r] = runs.count;
    }
    return runs;
}
#endif

Runs runsOfStep(IN(Bins) bins, IN(BinRange) range, int step, cell_int column, cell_int row) {
#ifdef WEIGHTED
    if (step < 0) {
        return runsOfHeavy(bins, step);
    }
#endif
    Runs runs;
    runs.count = cell_int(0);
    UNROLL for (int r = 0; r < MOST_RUNS; r++) {
        BinRow part = partOfStep(range, step, r, column, row);
        Span span = sitesOf(bins, part);
        runs.shift[r] = span.first - runs.count;
        runs.count += span.behind - span.first;
        runs.end[r] = runs.count;
    }
    return runs;
}

cell_bool isBeyondBlock(IN(BinRange) range, cell_int column, cell_int row) {
    return range.west < column - 1 || range.east > column + 1 || range.south < row - 1 || range.north > row + 1;
}

// Whether step `step` or a later one has bins of `range` to try; asked after step 0.
cell_bool isLeft(IN(BinRange) range, int step, cell_int column, cell_int row) {
#ifdef WEIGHTED
    if (step <= 0) {
        return cell_bool(true);
    }
#endif
    cell_bool wide = range.west < column - 2 || range.east > column + 2;
    int next_of_wide = 2 * step - 2;
    cell_int next = wide ? cell_int(next_of_wide) : cell_int(max(next_of_wide, 3));
    return range.south <= row - next || range.north >= row + next;
}


#ifdef WEIGHTED
// By how much the sites of the bins in `range`, but for the heavy ones, are heavier than the cell's own: a
// bound from above. It comes from the finest level of Grid::heaviest where the range has few numbers.
real weightExcessIn(IN(Bins) bins, IN(BinRange) range) {
    cell_int first = cell_int(0);
    cell_int columns = cell_int(bins.columns);
    cell_int rows = cell_int(bins.rows);
    BinRange seen = range;
    cell_bool many = seen.east - seen.west > 2 || seen.north - seen.south > 2;
    while (ANY(many)) {
        first += many ? columns * rows : cell_int(0);
        columns = many ? (columns + 1) / 2 : columns;
        rows = many ? (rows + 1) / 2 : rows;
        seen.west = many ? seen.west / 2 : seen.west;
        seen.south = many ? seen.south / 2 : seen.south;
        seen.east = many ? seen.east / 2 : seen.east;
        seen.north = many ? seen.north / 2 : seen.north;
        many = seen.east - seen.west > 2 || seen.north - seen.south > 2;
    }
    real weight_excess = -FAR;
    UNROLL for (int k = 0; k < 9; k++) {
        cell_int column = min(seen.west + k % 3, seen.east);
        cell_int row = min(seen.south + k / 3, seen.north);
        real here = weightExcess(first + row * columns + column);
        weight_excess = here > weight_excess ? here : weight_excess;
    }
    return weight_excess;
}

// The same of all sites.
real weightExcessOfAll(IN(Bins) bins) {
    int top = 0;
    int columns = bins.columns;
    int rows = bins.rows;
    while (columns > 1 || rows > 1) {
        top += columns * rows;
        columns = (columns + 1) / 2;
        rows = (rows + 1) / 2;
    }
    return weightExcess(cell_int(top));
}
#endif
