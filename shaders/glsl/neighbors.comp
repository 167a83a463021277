#version 450
#extension GL_GOOGLE_include_directive : require
// Clips one entry and writes its neighbors down, counter-clockwise. The build gives MAX_EDGES,
// SEARCH_GRID where an entry is a site of an upload instead of a list of lines, and WEIGHTED where sites have
// weights: then an empty entry has the lines that leave nothing of it.
#define ENTRIES_IN_BUFFER
#include "layout.glsl"
#include "vocabulary.glsl"
#include "view.glsl"
#include "slice.glsl"

layout(local_size_x = GROUP_SIZE) in;

#ifdef WEIGHTED
#define ROW_WORDS (MAX_EDGES + 2)
#else
#define ROW_WORDS (MAX_EDGES + 1)
#endif

// For each entry a row: its status, with the number of edges above the eight bits of that; then the
// neighbors.
layout(std430, set = 0, binding = BINDING_STATUS) writeonly buffer Rows { int rows[]; };

#ifdef SEARCH_GRID
#include "site_entry.glsl"
#else
#include "list_entry.glsl"
#endif

void main() {
    if (gl_GlobalInvocationID.x >= slice.count) {
        return;
    }
    loadEntry(slice.first, gl_GlobalInvocationID.x);
    Cell cell;
    int status = clipEntry(cell, vec2(0.0));
    Order order;
    orderEdges(cell, order);
    uint row = gl_GlobalInvocationID.x * uint(ROW_WORDS);
    bool certified = status == CELL_CERTIFIED;
    rows[row] = status + (certified ? order.count * 256 : 0);
    for (int k = 0; k < EDGE_END; k++) {
        if (certified && order.rank[k] >= 0) {
            rows[row + 1u + uint(order.rank[k])] = neighborOf(cell.line[k]);
        }
    }
#ifdef WEIGHTED
    if (status == CELL_EMPTY) {
        rows[row] = status + (MAX_EDGES + 1) * 256;
        for (int k = 0; k < EDGE_END; k++) {
            rows[row + 1u + uint(k)] = neighborOf(cell.line[k]);
        }
        rows[row + uint(MAX_EDGES + 1)] = neighborOf(cell.last);
    }
#endif
}
