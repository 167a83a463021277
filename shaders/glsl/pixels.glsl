// Which cells a picture needs. Whoever includes this file has included cell.glsl and view.glsl.

// Whether the center of a pixel lies in the cell's bounding box: most cells that are smaller than a
// pixel hold none and need not be drawn.
bool mayCoverPixel(in Cell cell, vec2 origin) {
    vec2 low = vec2(FAR);
    vec2 high = vec2(-FAR);
    for (int k = 0; k < EDGE_END; k++) {
        vec2 start = edgeStart(cell, k);
        low = isEdge(cell, k) ? min(low, start) : low;
        high = isEdge(cell, k) ? max(high, start) : high;
    }
    vec2 first = ceil((origin + low * view.scale + 1.0) * view.half_size - 0.5 - view.margin);
    vec2 last = floor((origin + high * view.scale + 1.0) * view.half_size - 0.5 + view.margin);
    return first.x <= last.x && first.y <= last.y;
}

// What the clipping said, but that a picture needs the shape alone. The fast pipelines leave the few
// open cells to the roomy ones.
int statusOfShape(in Cell cell, int status) {
#if MAX_EDGES > EDGES_FAST
    return status == CELL_OPEN && hasClosedShape(cell) ? CELL_CERTIFIED : status;
#else
    return status;
#endif
}
