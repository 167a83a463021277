// Sums of blocks of COUNTS_AT_ONCE counts, behind what the counts amount to: the arguments of an
// indirect draw of as many triangles.
layout(std430, set = 0, binding = BINDING_SUMS) buffer Sums {
    uint index_count;
    uint instance_count;
    uint first_index;
    uint vertex_offset;
    uint first_instance;
    uint sums[];
};
