// Numbers that GLSL and C++ share. Plain #defines, so that both languages read them.
#ifndef VORPIPE_LAYOUT
#define VORPIPE_LAYOUT

// What floats lose of a cell at most, in pictures. Of its lines and corners, for each unit of the way to its farthest
// corner; and of the place of a site, seen from another: 49 bits of two floats from the center of the domain.
#define REACH_ROUNDING 2.384185791015625e-6
#define PLACE_ROUNDING 7.105427357601002e-15

// Room for the edges of one cell while it is clipped, a multiple of 4: the fast pipeline, which
// overflows for 5.2 % of the cells of white noise, and the roomy one for those (about 40 of a million
// cells remain for the host). Time grows with the room, and the time that software
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
#define BINDING_EDGES 4
#define BINDING_GRID 5
#define BINDING_SITES 6
#define BINDING_BINS 7
#define BINDING_MARKS 8
#define BINDING_ENTRIES 9
#define BINDING_VERTICES 10
#define BINDING_COUNTS 11
#define BINDING_SUMS 12
#define BINDING_INDICES 13
#define BINDING_BIN_OF_SITE 14
#define BINDING_RANK_OF_SITE 15
#define BINDING_SITE_OF_RANK 16
#define BINDING_SORTED_SITES 17
#define BINDING_FROM 18
#define BINDING_MERGES 19
#define BINDING_WEIGHTS 20
#define BINDING_HEAVIEST 21

// The most heavy sites; a multiple of 4.
#define MOST_HEAVY 32

// Invocations in a group of a compute shader, and counts that one of them adds up.
#define GROUP_SIZE 64
#define COUNTS_AT_ONCE 32

// Sites of a bin that are put in order without merging.
#define RUN_SIZE 32

#endif
