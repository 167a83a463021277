// The words of the shared files as GLSL understands them; src/backend/cpu/glsl.h is the C++ twin.
#define real float
#define cell_int int
#define cell_bool bool
#define ANY(condition) (condition)
#define CUTTING
#ifdef ROLLED
#define UNROLL
#else
#define UNROLL [[unroll]]
#endif
#define EDGES(T, name) T name[MAX_EDGES]
#define IN(T) in T
#define INOUT(T) inout T
#define ROUNDING 5.9604645e-8
#define FAR 1.0e30
#define NOWHERE 1.0e-36
#define SAME 1.0e-30

#define EDGE_END MAX_EDGES

// Not by min and max, which take three instructions where NaN must be heeded.
real lesserWhere(real sign, real a, real b) { return sign > 0.0 && a < b ? a : b; }
real greaterWhere(real sign, real a, real b) { return sign > 0.0 && a > b ? a : b; }
