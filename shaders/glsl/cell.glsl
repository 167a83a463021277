// The cell and its clipping: the one place where vorpipe cuts a cell.
//
// Pure functions over a struct Cell. Whoever includes this file defines before it
//   real                     float, or double in C++
//   MAX_EDGES                room for edges
//   EDGE_END                 MAX_EDGES, as loops run to it
//   EDGES(T, name)           declares an array of MAX_EDGES elements of T
//   IN(T), INOUT(T)          parameter modes
//   ROUNDING                 the relative rounding error of real
//   vec4 lineAt(int index)   line `index` of the list: normal.xy, h, bound
// docs/shaders.md has the dialect: what GLSL 4.10, GLSL 4.50 and C++ with GLM all accept.
//
// A cell is an unordered set of edges in slots. Slot k holds the line {p : p . n = h} with the unit
// outward normal n, and the interval [lo, hi] of the edge on it, measured from the line's foot n h
// along t = (-n.y, n.x), which runs counter-clockwise. All coordinates are relative to the origin of
// the cell, which is the site itself if that lies inside the domain. A slot is free when its
// interval is empty. No order, no shifting, no index that depends on data: on a GPU, and in SIMD
// lanes, the slots stay in registers.

#define FAR real(1.0e30)

struct Cell {
    EDGES(real, nx);
    EDGES(real, ny);
    EDGES(real, h);
    EDGES(real, lo);
    EDGES(real, hi);
    EDGES(int, line);     // index of the line in the list, or a WALL
    real squared_radius;  // of the farthest vertex from the origin; negative when no edge is left
    bool overflow;        // an edge found no free slot
};

bool isEdge(IN(Cell) c, int k) { return c.lo[k] < c.hi[k]; }

void setEdge(INOUT(Cell) c, int k, vec2 n, real h, real lo, real hi, int line) {
    c.nx[k] = n.x;
    c.ny[k] = n.y;
    c.h[k] = h;
    c.lo[k] = lo;
    c.hi[k] = hi;
    c.line[k] = line;
}

// The cell before any cut: the domain, whose walls lie at walls = (west, south, east, north).
// Free slots repeat the walls, with an empty interval.
void beginCell(INOUT(Cell) c, vec4 walls) {
    for (int k = 0; k < EDGE_END; k += 4) {
        real used = k == 0 ? real(1.0) : real(0.0);
        setEdge(c, k, vec2(real(-1.0), real(0.0)), -walls.x, -walls.w * used, -walls.y * used, WALL_XMIN);
        setEdge(c, k + 1, vec2(real(1.0), real(0.0)), walls.z, walls.y * used, walls.w * used, WALL_XMAX);
        setEdge(c, k + 2, vec2(real(0.0), real(-1.0)), -walls.y, walls.x * used, walls.z * used, WALL_YMIN);
        setEdge(c, k + 3, vec2(real(0.0), real(1.0)), walls.w, -walls.z * used, -walls.x * used, WALL_YMAX);
    }
    vec2 corner = vec2(max(abs(walls.x), abs(walls.z)), max(abs(walls.y), abs(walls.w)));
    c.squared_radius = corner.x * corner.x + corner.y * corner.y;
    c.overflow = false;
}

// Keeps the part of the cell where p . n <= h.
//
// A point of line k is p = n_k h_k + t_k s, and p . n <= h says
//     s sine <= h - h_k cosine,   sine = cross(n_k, n), cosine = n_k . n,
// which shortens the edge at its end (sine > 0) or at its beginning (sine < 0), at the point where
// the lines meet. There the new edge begins or ends. Its place on the new line is the projection of
// that very point, not a second quotient: so the two ends agree even where the lines are nearly
// parallel and the quotient is mostly rounding error; the point is then off along both lines alike,
// and the shape is right. Of two parallel lines the outer one is dropped.
// The line of an edge that is gone is still a true bound of the cell, so free slots need no test.
// The new edge ends where two others do: the radius follows from those alone.
void cutCell(INOUT(Cell) c, vec2 n, real h, int line) {
    real lo = -FAR;
    real hi = FAR;
    real farthest = real(-1.0);
    for (int k = 0; k < EDGE_END; k++) {
        real sine = c.nx[k] * n.y - c.ny[k] * n.x;
        real cosine = c.nx[k] * n.x + c.ny[k] * n.y;
        real beyond = h - c.h[k] * cosine;
        bool parallel = abs(sine) < real(1.0e-30);
        bool forward = parallel || sine > real(0.0);
        real at_k = beyond / (parallel ? real(1.0) : sine);
        real at = at_k * cosine - c.h[k] * sine;
        if (parallel) {
            bool outside = beyond < real(0.0);
            at_k = outside ? -FAR : FAR;
            at = outside != (cosine > real(0.0)) ? FAR : -FAR;
        }
        c.hi[k] = forward ? min(c.hi[k], at_k) : c.hi[k];
        c.lo[k] = forward ? c.lo[k] : max(c.lo[k], at_k);
        lo = forward ? max(lo, at) : lo;
        hi = forward ? hi : min(hi, at);
        real end = max(c.lo[k] * c.lo[k], c.hi[k] * c.hi[k]) + c.h[k] * c.h[k];
        farthest = isEdge(c, k) ? max(farthest, end) : farthest;
    }
    c.squared_radius = farthest;
    bool waiting = lo < hi;
    for (int k = 0; k < EDGE_END; k++) {
        if (waiting && !isEdge(c, k)) {
            setEdge(c, k, n, h, lo, hi, line);
            waiting = false;
        }
    }
    c.overflow = c.overflow || waiting;
}

// The radius of security (Levy and Bonneel 2012): a site at least this far from the site of the
// cell cuts nothing off it, because its bisector passes beyond the farthest vertex.
// shift is the distance from the origin to the site.
real securityRadius(real squared_radius, real shift) {
    return real(2.0) * (sqrt(squared_radius) + shift) * (real(1.0) + real(16.0) * ROUNDING);
}

// Where edge k begins.
vec2 edgeStart(IN(Cell) c, int k) {
    return vec2(c.nx[k] * c.h[k] - c.ny[k] * c.lo[k], c.ny[k] * c.h[k] + c.nx[k] * c.lo[k]);
}

// Whether there are edges that, end to end, come back to where they began, up to rounding.
bool isClosed(IN(Cell) c) {
    real x = real(0.0);
    real y = real(0.0);
    int count = 0;
    for (int k = 0; k < EDGE_END; k++) {
        real length = isEdge(c, k) ? c.hi[k] - c.lo[k] : real(0.0);
        x -= length * c.ny[k];
        y += length * c.nx[k];
        count += isEdge(c, k) ? 1 : 0;
    }
    real slack = real(256.0) * ROUNDING;
    return count >= 3 && x * x + y * y <= slack * slack * c.squared_radius;
}

// Whether every edge ends where another begins, but for a gap along both their lines. Where three lines
// are nearly parallel, rounding may leave such a gap, or let two edges overlap: that loses track of
// which line carries the edge there, and nothing of the shape.
bool hasClosedShape(IN(Cell) c) {
    int count = 0;
    bool closed = true;
    for (int k = 0; k < EDGE_END; k++) {
        bool followed = false;
        vec2 end = vec2(c.nx[k] * c.h[k] - c.ny[k] * c.hi[k], c.ny[k] * c.h[k] + c.nx[k] * c.hi[k]);
        for (int j = 0; j < EDGE_END; j++) {
            real ahead = c.nx[k] * c.nx[j] + c.ny[k] * c.ny[j];
            real along = end.x * c.nx[j] + end.y * c.ny[j] - c.h[j];
            vec2 gap = edgeStart(c, j) - end;
            real across = gap.x * c.nx[k] + gap.y * c.ny[k];
            real slack = real(64.0) * ROUNDING;
            bool meets = along * along + across * across <= slack * slack * c.squared_radius;
            bool near = ahead > real(0.99) || gap.x * gap.x + gap.y * gap.y <= slack * slack * c.squared_radius;
            followed = followed || (j != k && isEdge(c, j) && meets && near);
        }
        closed = closed && (followed || !isEdge(c, k));
        count += isEdge(c, k) ? 1 : 0;
    }
    return closed && count >= 3;
}

// Clips the cell by the lines first .. first + count - 1, which come in ascending order of bound,
// until the rest is proved unable to cut. outset moves every line outward, by up to its two
// components along x and y: nothing, to measure; half a step of the vertex grid, to draw.
// reach bounds from below the distance of every site that is not in the list.
int clipCell(INOUT(Cell) c, vec4 walls, vec2 outset, int first, int count, real reach, real shift) {
    beginCell(c, vec4(walls.x - outset.x, walls.y - outset.y, walls.z + outset.x, walls.w + outset.y));
    real security = securityRadius(c.squared_radius, shift);
    real unseen = reach;
    for (int i = 0; i < count; i++) {
        vec4 line = lineAt(first + i);
        if (line.w >= security) {
            unseen = line.w;
            break;
        }
        real wider = abs(line.x) * outset.x + abs(line.y) * outset.y;
        cutCell(c, vec2(line.x, line.y), line.z + wider, first + i);
        if (c.overflow || c.squared_radius < real(0.0)) {
            break;
        }
        security = securityRadius(c.squared_radius, shift);
    }
    if (c.overflow) {
        return CELL_OVERFLOW;
    }
    if (c.squared_radius < real(0.0)) {
        return CELL_EMPTY;
    }
    if (unseen < security) {
        return CELL_UNSECURED;
    }
    return isClosed(c) ? CELL_CERTIFIED : CELL_OPEN;
}

// A number that grows with the angle of (x, y) from -pi to pi, without trigonometry.
real pseudoAngle(real x, real y) {
    real slope = x / max(abs(x) + abs(y), real(1.0e-30));
    return y < real(0.0) ? slope - real(1.0) : real(1.0) - slope;
}

struct Order {
    EDGES(int, rank);  // 0 .. count - 1, counter-clockwise; -1 for a free slot
    int count;
};

// Ranks the edges counter-clockwise, by the angle of their midpoints seen from inside. Midpoints,
// unlike normals, tell edges apart that lie on nearly the same line.
void orderEdges(IN(Cell) c, INOUT(Order) order) {
    vec2 sum = vec2(real(0.0), real(0.0));
    order.count = 0;
    for (int k = 0; k < EDGE_END; k++) {
        if (isEdge(c, k)) {
            real middle = (c.lo[k] + c.hi[k]) * real(0.5);
            sum += vec2(c.nx[k] * c.h[k] - c.ny[k] * middle, c.ny[k] * c.h[k] + c.nx[k] * middle);
            order.count++;
        }
    }
    vec2 center = sum / real(max(order.count, 1));
    EDGES(real, angle);
    for (int k = 0; k < EDGE_END; k++) {
        real middle = (c.lo[k] + c.hi[k]) * real(0.5);
        angle[k] = pseudoAngle(c.nx[k] * c.h[k] - c.ny[k] * middle - center.x,
                               c.ny[k] * c.h[k] + c.nx[k] * middle - center.y);
        order.rank[k] = isEdge(c, k) ? 0 : -1;
    }
    for (int k = 1; k < EDGE_END; k++) {
        for (int j = 0; j < k; j++) {
            bool both = order.rank[j] >= 0 && order.rank[k] >= 0;
            bool later = angle[j] <= angle[k];
            order.rank[k] += both && later ? 1 : 0;
            order.rank[j] += both && !later ? 1 : 0;
        }
    }
}

// The beginning of the edge of a given rank.
vec2 startOfRank(IN(Cell) c, IN(Order) order, int rank) {
    vec2 p = vec2(real(0.0), real(0.0));
    for (int k = 0; k < EDGE_END; k++) {
        if (order.rank[k] == rank) {
            p = edgeStart(c, k);
        }
    }
    return p;
}

// The rank of the vertex at a place of the triangle strip that fills a convex polygon of n
// vertices: 0, 1, n - 1, 2, n - 2, ...
int rankInStrip(int place, int n) {
    int half_way = (place + 1) / 2;
    return place == 0 ? 0 : (place % 2 == 1 ? half_way : n - half_way);
}
