#version 450
#extension GL_GOOGLE_include_directive : require
// Clips one entry and draws it as one triangle strip. MAX_EDGES is given by the build.
#include "layout.glsl"
#include "vocabulary.glsl"
#include "view.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = MAX_EDGES) out;

layout(location = 0) flat in vec4 entry_walls[];
layout(location = 1) flat in vec2 entry_bounds[];
layout(location = 2) flat in uvec2 entry_lines[];
layout(location = 3) flat in vec2 entry_origin[];
layout(location = 4) flat in uvec2 entry_mark[];
layout(location = 5) flat in uint entry_index[];

in gl_PerVertex { vec4 gl_Position; } gl_in[];
out gl_PerVertex { vec4 gl_Position; };
layout(location = 0) flat out uvec2 cell_mark;    // id, shade
layout(location = 1) flat out uvec2 cell_status;  // entry, status

layout(set = 0, binding = BINDING_LINES) uniform samplerBuffer lines;

// Vulkan stores the status in a buffer; OpenGL 4.1, which has none, specializes this to false and
// captures cell_status by transform feedback.
layout(constant_id = 0) const bool STATUS_IN_BUFFER = true;
layout(std430, set = 0, binding = BINDING_STATUS) writeonly buffer Status { uint status_of[]; };

vec4 lineAt(int index) { return texelFetch(lines, index); }

#include "cell.glsl"

void emit(vec2 p, int status) {
    gl_Position = vec4(entry_origin[0] + p * view.scale, 0.0, 1.0);
    cell_mark = entry_mark[0];
    cell_status = uvec2(entry_index[0], uint(status));
    EmitVertex();
}

// Whether the center of a pixel lies in the cell's bounding box: most cells that are smaller than a
// pixel hold none and need not be drawn.
bool mayCoverPixel(in Cell cell) {
    vec2 low = vec2(FAR);
    vec2 high = vec2(-FAR);
    for (int k = 0; k < EDGE_END; k++) {
        vec2 start = edgeStart(cell, k);
        low = isEdge(cell, k) ? min(low, start) : low;
        high = isEdge(cell, k) ? max(high, start) : high;
    }
    vec2 first = ceil((entry_origin[0] + low * view.scale + 1.0) * view.half_size - 0.5 - view.margin);
    vec2 last = floor((entry_origin[0] + high * view.scale + 1.0) * view.half_size - 0.5 + view.margin);
    return first.x <= last.x && first.y <= last.y;
}

void main() {
    Cell cell;
    int status = clipCell(cell, entry_walls[0], view.outset, int(entry_lines[0].x),
                          int(entry_lines[0].y), entry_bounds[0].x, entry_bounds[0].y);
#if MAX_EDGES > EDGES_FAST
    // A picture needs the shape alone. The fast pipeline leaves the few open cells to this one.
    if (status == CELL_OPEN && hasClosedShape(cell)) {
        status = CELL_CERTIFIED;
    }
#endif
    if (STATUS_IN_BUFFER) {
        status_of[entry_index[0]] = uint(status);
    }
    if (status == CELL_CERTIFIED && mayCoverPixel(cell)) {
        Order order;
        orderEdges(cell, order);
        for (int place = 0; place < order.count; place++) {
            emit(startOfRank(cell, order, rankInStrip(place, order.count)), status);
        }
    } else if (!STATUS_IN_BUFFER) {
        for (int corner = 0; corner < 3; corner++) {
            emit(vec2(0.0), status);
        }
    }
    EndPrimitive();
}
