#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// Clips one entry and draws it as one triangle strip. The build gives MAX_EDGES, and
// SEARCH_GRID where an entry is a site of an upload instead of a list of lines.
#include "layout.glsl"
#define DRAWN
#include "vocabulary.glsl"
#include "view.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = MAX_EDGES) out;

out gl_PerVertex { vec4 gl_Position; };
layout(location = 0) flat out uvec2 cell_mark;    // id, palette index
layout(location = 1) flat out uvec2 cell_status;  // entry, status

// Vulkan stores the status in a buffer; OpenGL 4.1, which has none, specializes this to false and
// captures cell_status by transform feedback.
layout(constant_id = 0) const bool STATUS_IN_BUFFER = true;
layout(std430, set = 0, binding = BINDING_STATUS) writeonly buffer Status { uint status_of[]; };

#ifdef SEARCH_GRID
#include "site_entry.glsl"
#else
#include "list_entry.glsl"
#endif
#include "pixels.glsl"
#include "strip.glsl"

struct Pen {
    uvec2 mark;
    int status;
};

// `at` is in normalized device coordinates.
void emit(in Pen pen, vec2 at) {
    gl_Position = vec4(at, 0.0, 1.0);
    cell_mark = pen.mark;
    cell_status = uvec2(entryIndex(), uint(pen.status));
    EmitVertex();
}

void main() {
    Cell cell;
    int status = statusOfShape(cell, clipEntry(cell, view.outset));
    if (STATUS_IN_BUFFER) {
        status_of[entryIndex()] = uint(status);
    }
    vec2 origin = entryOrigin();
    Covered covered = coveredPixels(cell, origin);
    int pixels = status == CELL_CERTIFIED ? covered.pixels : 0;
    Pen pen = Pen(pixels > 0 ? entryMark() : uvec2(0u), status);
    if (pixels == SEVERAL) {
        Order order;
        orderEdges(cell, order);
        for (int index = 0; index < order.count; index++) {
            emit(pen, origin + startOfRank(cell, order, rankInStrip(index, order.count)) * view.scale);
        }
    } else if (pixels == 1 || !STATUS_IN_BUFFER) {
        UNROLL for (int corner = 0; corner < 3; corner++) {
            emit(pen, pixels == 1 ? cornerAround(covered.center, corner) : vec2(0.0));
        }
    }
    EndPrimitive();
}
