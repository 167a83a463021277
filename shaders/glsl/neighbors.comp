#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// Clips one entry and writes its neighbors down, as answer.glsl has them. The build gives MAX_EDGES, SEARCH_GRID
// where an entry is a site of an upload instead of a list of lines, and WEIGHTED where sites have weights.
#define ENTRIES_IN_BUFFER
#include "layout.glsl"
#include "vocabulary.glsl"
#include "view.glsl"
#include "slice.glsl"

layout(local_size_x = GROUP_SIZE) in;

// The word of each entry, one after the other; then a row for each.
layout(std430, set = 0, binding = BINDING_STATUS) writeonly buffer Answers { ivec4 answers[]; };

#ifdef SEARCH_GRID
#include "site_entry.glsl"
#else
#include "list_entry.glsl"
#endif

#include "answer.glsl"

void main() {
    uint entry = gl_GlobalInvocationID.x;
    if (entry >= slice.count) {
        return;
    }
    loadEntry(slice.first, entry);
    Answer answer = answerEntry();
    answers[entry / 4u][entry % 4u] = answer.word;
    uint row = (slice.count + 3u) / 4u + entry * uint(ROW_PARTS);
    UNROLL for (int part = 0; part < ROW_PARTS; part++) {
        answers[row + uint(part)] = answer.row[part];
    }
}
