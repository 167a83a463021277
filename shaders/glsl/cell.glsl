// The cell and its clipping: the one place where vorpipe cuts a cell.
//
// Pure functions over a struct Cell. Its includer defines before it
//   real                     float, or double in C++
//   cell_int, cell_bool      int and bool where cells differ. In C++ these two and real may be vectors that
//                            hold one number for each of several cells: so such a bool is selected by, not
//                            branched on, and a constant becomes real(0.5), cell_int(1), cell_bool(true)
//   MAX_EDGES                room for edges
//   EDGE_END                 MAX_EDGES, as loops run to it
//   EDGES(T, name)           declares an array of MAX_EDGES elements of T
//   IN(T), INOUT(T)          parameter modes
//   ROUNDING                 the relative rounding error of real
//   FAR                      farther than anything
//   WEIGHTED                 defined or not: whether sites have weights
//   CUTTING                  what the compiler is to know of the function that cuts
//   real lesserWhere(real sign, real a, real b), greaterWhere
//                            a where sign is positive and a is less, or greater, than b; b elsewhere
//   UNROLL                   what it is to know of a loop over slots: done by the build, this spares drivers most
//                            of the time that they take to make a pipeline
//   NOWHERE, SAME            parallel lines get this sine, and lines that are the same this much of a
//                            distance, by adding what rounding swallows for any others: so the former
//                            meet far away, and the latter do too
// docs/shaders.md has the dialect: what GLSL 4.10, GLSL 4.50 and C++ with GLM all accept.
//
// A cell is an unordered set of edges in slots. Slot k holds the line {p : p . n = h} with the unit
// outward normal n, and the interval [lo, hi] of the edge on it, measured from the line's foot n h
// along t = (-n.y, n.x), which runs counter-clockwise. All coordinates are relative to the origin of
// the cell, which is the site itself if that lies inside the domain. A slot is free when its
// interval is empty. No order, no shifting, no index that depends on data: on a GPU, and in SIMD
// lanes, the slots stay in registers.

struct Cell {
    EDGES(real, nx);
    EDGES(real, ny);
    EDGES(real, h);
    EDGES(real, lo);
    EDGES(real, hi);
    EDGES(cell_int, line);  // index of the line in the list, or a WALL
    cell_bool empty;        // no edge is left, and none comes back
    cell_bool overflow;     // an edge found no free slot
#ifdef WEIGHTED
    cell_int last;  // where nothing is left: the line that cut off the rest. It and the slots leave nothing
#endif
};

cell_bool isEdge(IN(Cell) c, int k) { return c.lo[k] < c.hi[k]; }

// The cell before any cut: the domain, whose walls lie at walls = (west, south, east, north).
// Free slots repeat the walls, with an empty interval.
// Here and below no function that changes a cell is called in a loop over its slots: the copies that this
// makes in GLSL keep drivers from unrolling the loop, and the slots from becoming registers.
void beginCell(INOUT(Cell) c, vec4 walls) {
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        int wall = k % 4;
        real outward = wall % 2 == 0 ? real(-1.0) : real(1.0);
        real lo = wall == 0 ? -walls.w : (wall == 1 ? walls.y : (wall == 2 ? walls.x : -walls.z));
        real hi = wall == 0 ? -walls.y : (wall == 1 ? walls.w : (wall == 2 ? walls.z : -walls.x));
        c.nx[k] = wall < 2 ? outward : real(0.0);
        c.ny[k] = wall < 2 ? real(0.0) : outward;
        c.h[k] = wall == 0 ? -walls.x : (wall == 1 ? walls.z : (wall == 2 ? -walls.y : walls.w));
        c.lo[k] = k < 4 ? lo : real(0.0);
        c.hi[k] = k < 4 ? hi : real(0.0);
        c.line[k] = cell_int(WALL_XMIN - wall);
    }
    c.empty = cell_bool(false);
    c.overflow = cell_bool(false);
#ifdef WEIGHTED
    c.last = cell_int(WALL_XMIN);
#endif
}

// Keeps the part of the cell where p . n <= h.
//
// A point of line k is p = n_k h_k + t_k s, and p . n <= h says
//     s sine <= h - h_k cosine,   sine = cross(n_k, n), cosine = n_k . n,
// which shortens the edge at its end (sine > 0) or at its beginning (sine < 0), at the point where
// the lines meet. There the new edge begins or ends. Its place on the new line is the projection of
// that very point, not a second quotient: so the two ends agree even where the lines are nearly
// parallel and the quotient is mostly rounding error; the point is then off along both lines alike,
// and the shape is right.
// Parallel lines meet far away, on the side that leaves of an edge all or nothing: of two that face one
// way the outer is dropped, and the new one where they are the same.
// The line of an edge that is gone is still a true bound of the cell, so free slots need no test.
// || and && stand between variables and plain comparisons: anything more becomes a branch.
CUTTING void cutCell(INOUT(Cell) c, vec2 n, real h, cell_int line) {
    real lo = -FAR;
    real hi = FAR;
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        real sine = c.nx[k] * n.y - c.ny[k] * n.x + NOWHERE;
        real cosine = c.nx[k] * n.x + c.ny[k] * n.y;
        real at_k = (h - c.h[k] * cosine + SAME) / sine;
        real at = at_k * cosine - c.h[k] * sine;
        c.hi[k] = lesserWhere(sine, at_k, c.hi[k]);
        c.lo[k] = greaterWhere(-sine, at_k, c.lo[k]);
        lo = greaterWhere(sine, at, lo);
        hi = lesserWhere(-sine, at, hi);
    }
    cell_bool gone = c.empty;
    cell_bool waiting = lo < hi && !gone;
    cell_bool some = waiting;
#ifdef WEIGHTED
    c.last = gone ? c.last : line;
#endif
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        cell_bool edge = isEdge(c, k);
        cell_bool put = waiting && !edge;
        some = some || edge;
        c.nx[k] = put ? n.x : c.nx[k];
        c.ny[k] = put ? n.y : c.ny[k];
        c.h[k] = put ? h : c.h[k];
        c.lo[k] = put ? lo : c.lo[k];
        c.hi[k] = put ? hi : c.hi[k];
        c.line[k] = put ? line : c.line[k];
        waiting = waiting && edge;
    }
    c.empty = gone || !some;
    c.overflow = waiting || c.overflow;
}

#ifdef WEIGHTED
// Whether the line carries an edge. To cut by it again might give its edge to both, as rounding has it.
cell_bool hasEdge(IN(Cell) c, cell_int line) {
    cell_bool found = cell_bool(false);
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        cell_bool same = isEdge(c, k) && c.line[k] == line;
        found = found || same;
    }
    return found;
}
#endif

// Where edge k begins.
vec2 edgeStart(IN(Cell) c, int k) {
    return vec2(c.nx[k] * c.h[k] - c.ny[k] * c.lo[k], c.ny[k] * c.h[k] + c.nx[k] * c.lo[k]);
}

// Of the farthest vertex from the origin; negative when no edge is left.
real squaredRadius(IN(Cell) c) {
    real farthest = real(-1.0);
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        real end = max(c.lo[k] * c.lo[k], c.hi[k] * c.hi[k]) + c.h[k] * c.h[k];
        cell_bool edge = isEdge(c, k);
        farthest = edge && end > farthest ? end : farthest;
    }
    return farthest;
}

// The radius of security (Levy and Bonneel 2012): a site at least this far from the site of the
// cell cuts nothing off it, because its bisector passes beyond the farthest vertex.
// origin_offset is the distance from the origin to the site.
real securityRadius(real squared_radius, real origin_offset) {
    return real(2.0) * (sqrt(squared_radius) + origin_offset) * (real(1.0) + real(16.0) * ROUNDING);
}

// Whether there are edges that, end to end, come back to where they began, up to rounding.
cell_bool isClosed(IN(Cell) c) {
    real x = real(0.0);
    real y = real(0.0);
    cell_int count = cell_int(0);
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        real length = isEdge(c, k) ? c.hi[k] - c.lo[k] : real(0.0);
        x -= length * c.ny[k];
        y += length * c.nx[k];
        count += isEdge(c, k) ? cell_int(1) : cell_int(0);
    }
    real slack = real(256.0) * ROUNDING;
    cell_bool some = count >= 3;
    return some && x * x + y * y <= slack * slack * squaredRadius(c);
}

// Whether every edge ends where another begins, but for a gap along both their lines. Where three lines
// are nearly parallel, rounding may leave such a gap, or let two edges overlap: that loses track of
// which line carries the edge there, and nothing of the shape.
bool hasClosedShape(IN(Cell) c) {
    real slack = real(64.0) * ROUNDING;
    real allowed = slack * slack * squaredRadius(c);
    int count = 0;
    bool closed = true;
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        bool followed = false;
        vec2 end = vec2(c.nx[k] * c.h[k] - c.ny[k] * c.hi[k], c.ny[k] * c.h[k] + c.nx[k] * c.hi[k]);
        UNROLL for (int j = 0; j < EDGE_END; j++) {
            real ahead = c.nx[k] * c.nx[j] + c.ny[k] * c.ny[j];
            real along = end.x * c.nx[j] + end.y * c.ny[j] - c.h[j];
            vec2 gap = edgeStart(c, j) - end;
            real across = gap.x * c.nx[k] + gap.y * c.ny[k];
            bool meets = along * along + across * across <= allowed;
            bool near = ahead > real(0.99) || gap.x * gap.x + gap.y * gap.y <= allowed;
            followed = followed || (j != k && isEdge(c, j) && meets && near);
        }
        closed = closed && (followed || !isEdge(c, k));
        count += isEdge(c, k) ? 1 : 0;
    }
    return closed && count >= 3;
}

// What became of a cell that nothing more is cut off; unsecured: a site that was not tried may.
cell_int outcome(IN(Cell) c, cell_bool unsecured) {
    cell_int status = isClosed(c) ? cell_int(CELL_CERTIFIED) : cell_int(CELL_OPEN);
    status = unsecured ? cell_int(CELL_UNSECURED) : status;
    status = c.empty ? cell_int(CELL_EMPTY) : status;
    return c.overflow ? cell_int(CELL_OVERFLOW) : status;
}

// A number that grows with the angle of (x, y) from -pi to pi, without trigonometry.
real pseudoAngle(real x, real y) {
    real slope = x / max(abs(x) + abs(y), NOWHERE);
    return y < real(0.0) ? slope - real(1.0) : real(1.0) - slope;
}

struct Order {
    EDGES(cell_int, rank);  // 0 .. count - 1, counter-clockwise; -1 for a free slot
    cell_int count;
};

// Ranks the edges counter-clockwise, by the angle of their midpoints seen from inside. Midpoints,
// unlike normals, tell edges apart that lie on nearly the same line.
void orderEdges(IN(Cell) c, INOUT(Order) order) {
    real x = real(0.0);
    real y = real(0.0);
    cell_int count = cell_int(0);
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        real middle = (c.lo[k] + c.hi[k]) * real(0.5);
        cell_bool edge = isEdge(c, k);
        x += edge ? c.nx[k] * c.h[k] - c.ny[k] * middle : real(0.0);
        y += edge ? c.ny[k] * c.h[k] + c.nx[k] * middle : real(0.0);
        count += edge ? cell_int(1) : cell_int(0);
    }
    real share = real(1.0) / real(max(count, cell_int(1)));
    x *= share;
    y *= share;
    EDGES(real, angle);
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        real middle = (c.lo[k] + c.hi[k]) * real(0.5);
        real seen = pseudoAngle(c.nx[k] * c.h[k] - c.ny[k] * middle - x,
                                c.ny[k] * c.h[k] + c.nx[k] * middle - y);
        angle[k] = isEdge(c, k) ? seen : FAR;
    }
    // Two plain loops over all pairs: what compilers unroll, so that no index is left.
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        cell_int rank = cell_int(0);
        UNROLL for (int j = 0; j < EDGE_END; j++) {
            cell_bool before = j < k ? angle[j] <= angle[k] : angle[j] < angle[k];
            rank += before ? cell_int(1) : cell_int(0);
        }
        order.rank[k] = isEdge(c, k) ? rank : cell_int(-1);
    }
    order.count = count;
}

// Turns the ranks so that the edge on the line of the smallest number comes first.
void beginAtFirst(IN(Cell) c, INOUT(Order) order) {
    cell_int least = cell_int(2147483647);
    cell_int first = cell_int(0);
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        cell_bool before = order.rank[k] >= 0 && c.line[k] < least;
        least = before ? c.line[k] : least;
        first = before ? order.rank[k] : first;
    }
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        cell_int rank = order.rank[k] - first;
        rank = rank < 0 ? rank + order.count : rank;
        order.rank[k] = order.rank[k] < 0 ? order.rank[k] : rank;
    }
}

// The beginning of the edge of a given rank.
vec2 startOfRank(IN(Cell) c, IN(Order) order, int rank) {
    vec2 p = vec2(real(0.0), real(0.0));
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        if (order.rank[k] == rank) {
            p = edgeStart(c, k);
        }
    }
    return p;
}
