#version 450
#extension GL_GOOGLE_include_directive : require
// Clips one entry and writes its edges down, counter-clockwise. MAX_EDGES is given by the build.
#include "layout.glsl"
#include "vocabulary.glsl"
#include "view.glsl"

#define BINDING_EDGES (BINDING_STATUS + 1)

layout(points) in;
layout(points, max_vertices = MAX_EDGES) out;

layout(location = 0) flat in vec4 entry_walls[];
layout(location = 1) flat in vec2 entry_bounds[];
layout(location = 2) flat in uvec2 entry_lines[];
layout(location = 5) flat in uint entry_index[];

// Captured by transform feedback: one point per edge, and one for an entry without any.
layout(location = 0) flat out vec2 edge_start;  // from the origin
layout(location = 1) flat out ivec4 edge_of;    // entry, status, line, rank

layout(set = 0, binding = BINDING_LINES) uniform samplerBuffer lines;

// Vulkan stores in buffers; OpenGL 4.1, which has none, specializes this to false.
layout(constant_id = 0) const bool STATUS_IN_BUFFER = true;
layout(std430, set = 0, binding = BINDING_STATUS) writeonly buffer Status { uint status_of[]; };

// Edge `rank` of an entry, at entry * MAX_EDGES + rank: the bits of its start, its line, and how many
// edges the entry has.
layout(std430, set = 0, binding = BINDING_EDGES) writeonly buffer Edges { uvec4 edges[]; };

vec4 lineAt(int index) { return texelFetch(lines, index); }

#include "cell.glsl"

// The line of the edge of a given rank as the caller counts them: from the entry's first, or a wall.
int lineOfRank(in Cell cell, in Order order, int rank) {
    int line = 0;
    for (int k = 0; k < EDGE_END; k++) {
        if (order.rank[k] == rank) {
            line = cell.line[k];
        }
    }
    return line < 0 ? line : line - int(entry_lines[0].x);
}

void emit(vec2 start, int status, int line, int rank) {
    edge_start = start;
    edge_of = ivec4(int(entry_index[0]), status, line, rank);
    EmitVertex();
    EndPrimitive();
}

void main() {
    Cell cell;
    int status = clipCell(cell, entry_walls[0], vec2(0.0), int(entry_lines[0].x), int(entry_lines[0].y),
                          entry_bounds[0].x, entry_bounds[0].y);
    if (STATUS_IN_BUFFER) {
        status_of[entry_index[0]] = uint(status);
    }
    if (status != CELL_EMPTY && status != CELL_OVERFLOW) {
        Order order;
        orderEdges(cell, order);
        for (int rank = 0; rank < order.count; rank++) {
            vec2 start = startOfRank(cell, order, rank);
            int line = lineOfRank(cell, order, rank);
            if (STATUS_IN_BUFFER) {
                edges[entry_index[0] * uint(MAX_EDGES) + uint(rank)] =
                    uvec4(floatBitsToUint(start), uint(line), uint(order.count));
            } else {
                emit(start, status, line, rank);
            }
        }
    } else if (!STATUS_IN_BUFFER) {
        emit(vec2(0.0), status, 0, -1);
    }
}
