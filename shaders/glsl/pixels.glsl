// What a picture needs of a cell. Its includer has included cell.glsl and view.glsl.

#define SEVERAL 2

// The centers of pixels in a cell.
struct Covered {
    int pixels;   // 0, 1 or, for more than one, SEVERAL
    vec2 center;  // of the one pixel, in normalized device coordinates
};

// Most cells that are smaller than a pixel cover no center, and most others of a million cover one: to draw that
// takes a triangle and no vertex of the cell. A center is covered if all lines, widened as they are, say so.
Covered coveredPixels(in Cell cell, vec2 origin) {
    vec2 low = vec2(FAR);
    vec2 high = vec2(-FAR);
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        vec2 start = edgeStart(cell, k);
        low = isEdge(cell, k) ? min(low, start) : low;
        high = isEdge(cell, k) ? max(high, start) : high;
    }
    vec2 first = ceil((origin + low * view.scale + 1.0) * view.half_size - 0.5 - view.margin);
    vec2 last = floor((origin + high * view.scale + 1.0) * view.half_size - 0.5 + view.margin);
    Covered covered = Covered(0, vec2(0.0));
    UNROLL for (int k = 0; k < 4; k++) {
        vec2 pixel = first + vec2(float(k % 2), float(k / 2));
        vec2 center = (pixel + 0.5) / view.half_size - 1.0;
        vec2 p = (center - origin) / view.scale;
        bool inside = pixel.x <= last.x && pixel.y <= last.y;
        UNROLL for (int j = 0; j < EDGE_END; j++) {
            bool before = p.x * cell.nx[j] + p.y * cell.ny[j] <= cell.h[j];
            inside = inside && before;
        }
        covered.center = inside ? center : covered.center;
        covered.pixels += inside ? 1 : 0;
    }
    bool wide = first.x <= last.x && first.y <= last.y && (last.x - first.x > 1.0 || last.y - first.y > 1.0);
    covered.pixels = wide ? SEVERAL : min(covered.pixels, SEVERAL);
    return covered;
}

// Corner 0, 1 or 2 of a triangle around the center of a pixel that holds no other center.
vec2 cornerAround(vec2 center, int corner) {
    vec2 way = corner == 2 ? vec2(0.0, 0.25) : vec2(corner == 0 ? -0.25 : 0.25, -0.25);
    return center + way / view.half_size;
}

// What the clipping said, but that a picture needs the shape alone: the fast pipelines leave the few open cells to
// the roomy ones. A cell that is shrunk to nothing needs no pixel, and what floats are too coarse for is left to
// somebody more precise.
int statusOfShape(in Cell cell, int status) {
    int shape = status;
#if MAX_EDGES > EDGES_FAST
    shape = status == CELL_OPEN && hasClosedShape(cell) ? CELL_CERTIFIED : shape;
#endif
    bool shrunk = view.outset.x < 0.0 || view.outset.y < 0.0;
    shape = status == CELL_EMPTY && shrunk ? CELL_CERTIFIED : shape;
    bool coarse = shape == CELL_CERTIFIED && !cell.empty && isTooCoarse(cell);
    return coarse ? CELL_UNSECURED : shape;
}
