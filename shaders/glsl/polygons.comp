#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// Clips one entry and writes its polygon down, to be drawn. The build gives MAX_EDGES, and SEARCH_GRID
// where an entry is a site of an upload instead of a list of lines.
#define ENTRIES_IN_BUFFER
#include "layout.glsl"
#define DRAWN
#include "vocabulary.glsl"
#include "view.glsl"
#include "slice.glsl"

layout(local_size_x = GROUP_SIZE) in;

layout(std430, set = 0, binding = BINDING_STATUS) writeonly buffer Status { uint status_of[]; };

// MAX_EDGES vertices for each entry, of which it uses the first, counter-clockwise: two floats, in
// normalized device coordinates, id and palette index.
layout(std430, set = 0, binding = BINDING_VERTICES) writeonly buffer VertexRows { uvec4 vertices[]; };

// Triangles for each entry; none if it may be left out of the picture.
layout(std430, set = 0, binding = BINDING_COUNTS) writeonly buffer Counts { uint triangles_of[]; };

#ifdef SEARCH_GRID
#include "site_entry.glsl"
#else
#include "list_entry.glsl"
#endif
#include "pixels.glsl"

void putVertex(uint entry, int rank, vec2 at, uvec2 mark) {
    vertices[entry * uint(MAX_EDGES) + uint(rank)] = uvec4(floatBitsToUint(at), mark);
}

void main() {
    uint entry = gl_GlobalInvocationID.x;
    if (entry >= slice.count) {
        return;
    }
    loadEntry(slice.first, entry);
    Cell cell;
    int status = statusOfShape(cell, clipEntry(cell, view.outset));
    status_of[entry] = uint(status);
    vec2 origin = entryOrigin();
    Covered covered = coveredPixels(cell, origin);
    int pixels = status == CELL_CERTIFIED ? covered.pixels : 0;
    Order order;
    orderEdges(cell, order);
    triangles_of[entry] = uint(pixels == SEVERAL ? max(order.count - 2, 0) : pixels);
    uvec2 mark = entryMark();
    if (pixels == 1) {
        UNROLL for (int corner = 0; corner < 3; corner++) {
            putVertex(entry, corner, cornerAround(covered.center, corner), mark);
        }
    }
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        if (pixels == SEVERAL && order.rank[k] >= 0) {
            putVertex(entry, order.rank[k], origin + edgeStart(cell, k) * view.scale, mark);
        }
    }
}
