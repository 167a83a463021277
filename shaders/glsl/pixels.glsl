// The pixels that a cell covers. The file that includes this one has included cell.glsl and view.glsl.

#define SEVERAL 2

// How many pixel centers lie in a cell.
struct Covered {
    int pixels;   // 0, 1 or, for more than one, SEVERAL
    vec2 center;  // of the one pixel, in normalized device coordinates
};

// In a picture of a million cells most cells cover one pixel center or none. One center is drawn as a small
// triangle, without the cell's vertices. It is covered if it lies inside all lines, widened as they are.
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

// The status of a cell for a picture, from that of its clipping. A picture needs the shape alone: an open cell
// whose shape is closed is certified. The fast pipelines leave the few of these to the roomy ones. A cell that
// is shrunk to nothing covers no pixel and is certified. One that floats are too coarse for is unsecured, and
// found in double.
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
