// The cell in space and its clipping: the one place where vorpipe proposes a polyhedron.
//
// One cell at a time, its vertices side by side: in the lanes of a subgroup on a device, in those of a vector in C++.
// Its includer defines before it
//   SLOTS, LANES             64 slots for vertices, and how many of them stand side by side
//   REAL, lane_real          a number: float on a device, float or double in C++; and LANES of them, a vector in C++
//   MASK                     64 truths, one for each slot, as bits; with & | ~
//   NO_SLOT, SLOT(k)         the mask without any bit, and the one with the bit of slot k alone
//   ANY_OF(m), COUNT(m), LOWEST(m)
//                            whether any bit of a mask is set, how many are, and the index of the lowest that is
//   LESS(a, b, block)        the mask of those of the slots block * LANES .. in which a lane_real is less than another
//   BLOCKS(m)                how many blocks of LANES slots it takes from slot 0 to the highest of a mask
//   LOAD(array, block), STORE(array, block, value)
//                            LANES elements of an array of SLOTS numbers
//   NO_REAL, GREATER(a, b)   a lane_real of zeros, and the greater one in each lane
//   GREATEST(value)          the greatest of all lanes
//   INOUT(T)                 parameter mode
//
// A vertex stands in a slot: its place relative to the site, and its three faces, counter-clockwise seen from outside.
// Free slots are at the site, and so never the farthest.
// A face stands in a slot as well: its name, and `on`, the mask of the vertices on it. No order and no adjacency: the
// other end of the edge between faces a and b, seen from vertex u, is the only bit of on[a] & on[b] besides u.

struct Polyhedron {
    REAL x[SLOTS];
    REAL y[SLOTS];
    REAL z[SLOTS];
    REAL beyond[SLOTS];  // how far each vertex lies beyond the last plane that was tried
    MASK on[SLOTS];       // by face
    int name[SLOTS];      // by face
    int first[SLOTS];     // by vertex: its faces
    int second[SLOTS];
    int third[SLOTS];
    MASK live;      // vertices
    MASK used;      // faces
    bool empty;     // nothing is left
    bool overflow;  // a vertex or a face found no free slot
};

void addVertex(INOUT(Polyhedron) c, int slot, int a, int b, int d, REAL px, REAL py, REAL pz) {
    c.x[slot] = px;
    c.y[slot] = py;
    c.z[slot] = pz;
    c.first[slot] = a;
    c.second[slot] = b;
    c.third[slot] = d;
    c.on[a] = c.on[a] | SLOT(slot);
    c.on[b] = c.on[b] | SLOT(slot);
    c.on[d] = c.on[d] | SLOT(slot);
}

// The cell before any cut: the box, relative to the site. Faces 0 to 5 are its walls, with the names -1 to -6.
void beginPolyhedron(INOUT(Polyhedron) c, REAL xmin, REAL ymin, REAL zmin, REAL xmax, REAL ymax, REAL zmax) {
    for (int k = 0; k < SLOTS; k++) {
        c.x[k] = REAL(0);
        c.y[k] = REAL(0);
        c.z[k] = REAL(0);
        c.beyond[k] = REAL(0);
    }
    for (int w = 0; w < 6; w++) {
        c.on[w] = NO_SLOT;
        c.name[w] = -1 - w;
    }
    for (int k = 0; k < 8; k++) {
        bool right = k % 2 != 0;
        bool back = (k / 2) % 2 != 0;
        bool top = k / 4 != 0;
        int a = right ? 1 : 0;
        int b = back ? 3 : 2;
        // Counter-clockwise seen from outside: the normals of three walls at corner 7 are those of the axes.
        bool swapped = (right != back) == top;
        addVertex(c, k, swapped ? b : a, swapped ? a : b, top ? 5 : 4, right ? xmax : xmin, back ? ymax : ymin,
                  top ? zmax : zmin);
    }
    c.live = SLOT(8) - SLOT(0);
    c.used = SLOT(6) - SLOT(0);
    c.empty = false;
    c.overflow = false;
}

// The vertices beyond the plane p . (dx, dy, dz) = h.
MASK verticesBeyond(INOUT(Polyhedron) c, REAL dx, REAL dy, REAL dz, REAL h) {
    MASK removed = NO_SLOT;
    int blocks = BLOCKS(c.live);
    for (int k = 0; k < blocks; k++) {
        lane_real far = LOAD(c.x, k) * dx + (LOAD(c.y, k) * dy + (LOAD(c.z, k) * dz - h));
        STORE(c.beyond, k, far);
        removed = removed | LESS(NO_REAL, far, k);
    }
    return removed & c.live;
}

// The square of the distance of the farthest vertex.
REAL squaredRadius(INOUT(Polyhedron) c) {
    lane_real most = NO_REAL;
    int blocks = BLOCKS(c.live);
    for (int k = 0; k < blocks; k++) {
        lane_real x = LOAD(c.x, k);
        lane_real y = LOAD(c.y, k);
        lane_real z = LOAD(c.z, k);
        most = GREATER(most, x * x + (y * y + z * z));
    }
    return GREATEST(most);
}

// Cuts off the vertices that the last verticesBeyond() found, some, and adds the face `name`.
void cutOff(INOUT(Polyhedron) c, MASK removed, int name) {
    if (!ANY_OF(c.live & ~removed)) {
        c.empty = true;
        return;
    }
    if (!ANY_OF(~c.used)) {
        c.overflow = true;
        return;
    }
    int face = LOWEST(~c.used);
    // The edges between a vertex that goes and one that stays, where each new vertex lies. Every candidate is written,
    // and only those that count are kept: a branch here could not be foreseen. Of what rounding has torn an edge may have
    // no other end; then any slot is.
    MASK any_slot = SLOT(SLOTS - 1);
    int a_of[3 * SLOTS];
    int b_of[3 * SLOTS];
    int gone[3 * SLOTS];
    int kept[3 * SLOTS];
    int count = 0;
    for (MASK left = removed; ANY_OF(left); left = left & (left - SLOT(0))) {
        int u = LOWEST(left);
        int a = c.first[u];
        int b = c.second[u];
        int d = c.third[u];
        MASK on_a = c.on[a] & ~SLOT(u);
        MASK on_b = c.on[b] & ~SLOT(u);
        MASK on_d = c.on[d] & ~SLOT(u);
        MASK other = on_a & on_b;
        a_of[count] = a;
        b_of[count] = b;
        gone[count] = u;
        kept[count] = LOWEST(other | any_slot);
        count += ANY_OF(other & removed) ? 0 : 1;
        other = on_b & on_d;
        a_of[count] = b;
        b_of[count] = d;
        gone[count] = u;
        kept[count] = LOWEST(other | any_slot);
        count += ANY_OF(other & removed) ? 0 : 1;
        other = on_d & on_a;
        a_of[count] = d;
        b_of[count] = a;
        gone[count] = u;
        kept[count] = LOWEST(other | any_slot);
        count += ANY_OF(other & removed) ? 0 : 1;
    }
    MASK room = ~c.live;
    if (COUNT(room) < count) {
        c.overflow = true;
        return;
    }
    for (int k = 0; k < SLOTS; k++) {
        c.on[k] = c.on[k] & ~removed;
    }
    MASK added = NO_SLOT;
    c.name[face] = name;
    c.on[face] = NO_SLOT;
    for (int k = 0; k < count; k++) {
        int slot = LOWEST(room);
        room = room & (room - SLOT(0));
        added = added | SLOT(slot);
        int u = gone[k];
        int v = kept[k];
        REAL t = c.beyond[v] / (c.beyond[v] - c.beyond[u]);
        addVertex(c, slot, a_of[k], b_of[k], face, c.x[v] + t * (c.x[u] - c.x[v]), c.y[v] + t * (c.y[u] - c.y[v]),
                  c.z[v] + t * (c.z[u] - c.z[v]));
    }
    c.used = c.used | SLOT(face);
    for (MASK left = removed; ANY_OF(left); left = left & (left - SLOT(0))) {
        int u = LOWEST(left);
        c.used = ANY_OF(c.on[c.first[u]]) ? c.used : c.used & ~SLOT(c.first[u]);
        c.used = ANY_OF(c.on[c.second[u]]) ? c.used : c.used & ~SLOT(c.second[u]);
        c.used = ANY_OF(c.on[c.third[u]]) ? c.used : c.used & ~SLOT(c.third[u]);
        c.x[u] = REAL(0);
        c.y[u] = REAL(0);
        c.z[u] = REAL(0);
    }
    c.live = (c.live & ~removed) | added;
}
