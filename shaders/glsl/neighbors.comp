#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
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
#define ROW_WORDS (MAX_EDGES + 1)
#else
#define ROW_WORDS MAX_EDGES
#endif

// The status of each entry, with the number of edges above the eight bits of that; then a row for each
// with the neighbors.
layout(std430, set = 0, binding = BINDING_STATUS) writeonly buffer Answers { int answers[]; };

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
    uint row = slice.count + gl_GlobalInvocationID.x * uint(ROW_WORDS);
    bool certified = status == CELL_CERTIFIED;
    answers[gl_GlobalInvocationID.x] = status + (certified ? order.count * 256 : 0);
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        if (certified && order.rank[k] >= 0) {
            answers[row + uint(order.rank[k])] = neighborOf(cell.line[k]);
        }
    }
#ifdef WEIGHTED
    if (status == CELL_EMPTY) {
        answers[gl_GlobalInvocationID.x] = status + (MAX_EDGES + 1) * 256;
        UNROLL for (int k = 0; k < EDGE_END; k++) {
            answers[row + uint(k)] = neighborOf(cell.line[k]);
        }
        answers[row + uint(MAX_EDGES)] = neighborOf(cell.last);
    }
#endif
}
