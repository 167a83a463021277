// The words of the shared files as GLSL understands them; src/backend/cpu/glsl.h is the C++ twin.
#define real float
#define EDGES(T, name) T name[MAX_EDGES]
#define IN(T) in T
#define INOUT(T) inout T
#define ROUNDING 5.9604645e-8

#define EDGE_END MAX_EDGES
