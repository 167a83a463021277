// One entry of a batch, as cell.vert hands it on or a compute shader loads it: its cell comes from a list
// of lines. The twin of site_entry.glsl.
#ifdef ENTRIES_IN_BUFFER
layout(std430, set = 0, binding = BINDING_ENTRIES) readonly buffer Entries { uvec4 words_of_entries[]; };
layout(set = 0, binding = BINDING_MARKS) uniform usamplerBuffer marks;
uint index_of_entry;
uint entry_index[1];
vec4 entry_walls[1];
vec2 entry_bounds[1];
uvec2 entry_lines[1];

// The entry at `index` of a slice that begins at `first`.
void loadEntry(uint first, uint index) {
    index_of_entry = first + index;
    entry_index[0] = index;
    uvec4 begin = words_of_entries[2u * index_of_entry];
    uvec4 end = words_of_entries[2u * index_of_entry + 1u];
    entry_lines[0] = begin.xy;
    entry_walls[0] = uintBitsToFloat(uvec4(begin.zw, end.xy));
    entry_bounds[0] = uintBitsToFloat(end.zw);
}

// In normalized device coordinates.
vec2 entryOrigin() { return uintBitsToFloat(texelFetch(marks, int(index_of_entry)).xy); }

uvec2 entryMark() { return texelFetch(marks, int(index_of_entry)).zw; }
#else
layout(location = 0) flat in vec4 entry_walls[];
layout(location = 1) flat in vec2 entry_bounds[];
layout(location = 2) flat in uvec2 entry_lines[];
layout(location = 3) flat in vec2 entry_origin[];
layout(location = 4) flat in uvec2 entry_mark[];
layout(location = 5) flat in uint entry_index[];

// In normalized device coordinates.
vec2 entryOrigin() { return entry_origin[0]; }

uvec2 entryMark() { return entry_mark[0]; }
#endif

layout(set = 0, binding = BINDING_LINES) uniform samplerBuffer lines;

vec4 lineAt(int index) { return texelFetch(lines, index); }

#include "cell.glsl"
#include "list.glsl"

int clipEntry(inout Cell cell, vec2 outset) {
    return clipCell(cell, entry_walls[0], outset, int(entry_lines[0].x), int(entry_lines[0].y),
                    entry_bounds[0].x, entry_bounds[0].y);
}

// Never for lists: the host, which packs the lines of an entry, moves them inward by what floats may lose.
bool isTooCoarse(in Cell cell) { return false; }

uint entryIndex() { return entry_index[0]; }

// A line as the caller counts them: from the entry's first, or a wall.
int neighborOf(int line) { return line < 0 ? line : line - int(entry_lines[0].x); }
