// Numbers that GLSL and C++ share. Plain #defines, so that both languages read them.
#ifndef VORPIPE_LAYOUT
#define VORPIPE_LAYOUT

// Room for the edges of one cell while it is clipped, a multiple of 4: the fast pipeline, which
// overflows for 4.5 % of the cells of white noise, and the roomy one for those (some 40 of a million
// cells go on to the host). Time grows with the room, and the time that software
// drivers compile grows with its square: 16 would take them three times as long as 12.
#define EDGES_FAST 8
#define EDGES_MOST 12

// What became of a cell; see CellStatus in backend.h.
#define CELL_MISSING 0
#define CELL_CERTIFIED 1
#define CELL_EMPTY 2
#define CELL_OVERFLOW 3
#define CELL_UNSECURED 4
#define CELL_OPEN 5

// Walls in place of a neighbor.
#define WALL_XMIN -1
#define WALL_XMAX -2
#define WALL_YMIN -3
#define WALL_YMAX -4

// Descriptor bindings (Vulkan) in the order of use; OpenGL binds by name.
#define BINDING_VIEW 0
#define BINDING_LINES 1
#define BINDING_PALETTE 2
#define BINDING_STATUS 3

#endif
