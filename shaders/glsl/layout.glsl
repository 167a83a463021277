// Numbers that GLSL and C++ share. Plain #defines, so that both languages read them.
#ifndef VORPIPE_LAYOUT
#define VORPIPE_LAYOUT

// Room for the edges of one cell, a multiple of 4: the fast pipeline, and the roomy one for what overflows it.
// 12 holds all but a few in a thousand cells of white noise while they are clipped; 32 vertices of
// 8 components stay within the 1024 components that a geometry shader may write.
#define EDGES_FAST 12
#define EDGES_MOST 32

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
