#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// Clips one entry and writes its neighbors down, counter-clockwise. The build gives MAX_EDGES,
// SEARCH_GRID where an entry is a site of an upload instead of a list of lines, and WEIGHTED where sites have
// weights: then an empty entry has the lines that leave nothing of it.
#include "layout.glsl"
#include "vocabulary.glsl"
#include "view.glsl"

layout(points) in;
layout(points, max_vertices = 1) out;

#ifdef WEIGHTED
#define ROW_PARTS (MAX_EDGES / 4 + 1)
#else
#define ROW_PARTS (MAX_EDGES / 4)
#endif

// Captured by transform feedback: one point per entry.
layout(location = 0) flat out int cell_answer;  // status, and above its eight bits the number of edges
layout(location = 1) flat out ivec4 cell_neighbors[ROW_PARTS];

// Vulkan stores in buffers; OpenGL 4.1, which has none, specializes this to false.
layout(constant_id = 0) const bool STATUS_IN_BUFFER = true;
layout(std430, set = 0, binding = BINDING_STATUS) writeonly buffer Status { uint status_of[]; };

// The neighbors of an entry from entry * ROW_PARTS on.
layout(std430, set = 0, binding = BINDING_EDGES) writeonly buffer Edges { ivec4 neighbors[]; };

#ifdef SEARCH_GRID
#include "site_entry.glsl"
#else
#include "list_entry.glsl"
#endif

#ifdef WEIGHTED
// Puts the lines of an empty cell in any order, the last one behind those of the slots.
void allSlots(inout Order order) {
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        order.rank[k] = k;
    }
    order.count = MAX_EDGES + 1;
}
#endif

int neighborOfRank(in Cell cell, in Order order, int rank) {
#ifdef WEIGHTED
    int line = neighborOf(cell.last);
#else
    int line = 0;
#endif
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        line = order.rank[k] == rank ? neighborOf(cell.line[k]) : line;
    }
    return line;
}

void main() {
    Cell cell;
    int status = clipEntry(cell, vec2(0.0));
    Order order;
    order.count = 0;
    if (status == CELL_CERTIFIED) {
        orderEdges(cell, order);
    }
#ifdef WEIGHTED
    if (status == CELL_EMPTY) {
        allSlots(order);
    }
#endif
    int answer = status + order.count * 256;
    if (STATUS_IN_BUFFER) {
        status_of[entryIndex()] = uint(answer);
    }
    UNROLL for (int part = 0; part < ROW_PARTS; part++) {
        ivec4 row = ivec4(0);
        if (part * 4 < order.count) {
            row = ivec4(neighborOfRank(cell, order, part * 4), neighborOfRank(cell, order, part * 4 + 1),
                        neighborOfRank(cell, order, part * 4 + 2), neighborOfRank(cell, order, part * 4 + 3));
        }
        if (STATUS_IN_BUFFER) {
            neighbors[entryIndex() * uint(ROW_PARTS) + uint(part)] = row;
        } else {
            cell_neighbors[part] = row;
        }
    }
    if (!STATUS_IN_BUFFER) {
        cell_answer = answer;
        EmitVertex();
    }
}
