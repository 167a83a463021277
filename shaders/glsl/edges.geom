#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// Clips one entry and writes its neighbors down, as answer.glsl has them. The build gives MAX_EDGES, SEARCH_GRID
// where an entry is a site of an upload instead of a list of lines, and WEIGHTED where sites have weights.
#include "layout.glsl"
#include "vocabulary.glsl"
#include "view.glsl"

layout(points) in;
layout(points, max_vertices = 1) out;

#ifdef SEARCH_GRID
#include "site_entry.glsl"
#else
#include "list_entry.glsl"
#endif

#include "answer.glsl"

// Captured by transform feedback: one point per entry.
layout(location = 0) flat out int cell_answer;  // status, and above its eight bits the number of edges
layout(location = 1) flat out ivec4 cell_neighbors[ROW_PARTS];

// Vulkan stores in buffers; OpenGL 4.1, which has none, specializes this to false.
layout(constant_id = 0) const bool STATUS_IN_BUFFER = true;
layout(std430, set = 0, binding = BINDING_STATUS) writeonly buffer Status { uint status_of[]; };

// The neighbors of an entry from entry * ROW_PARTS on.
layout(std430, set = 0, binding = BINDING_EDGES) writeonly buffer Edges { ivec4 neighbors[]; };

void main() {
    Answer answer = answerEntry();
    if (STATUS_IN_BUFFER) {
        status_of[entryIndex()] = uint(answer.word);
    }
    UNROLL for (int part = 0; part < ROW_PARTS; part++) {
        if (STATUS_IN_BUFFER) {
            neighbors[entryIndex() * uint(ROW_PARTS) + uint(part)] = answer.row[part];
        } else {
            cell_neighbors[part] = answer.row[part];
        }
    }
    if (!STATUS_IN_BUFFER) {
        cell_answer = answer.word;
        EmitVertex();
    }
}
