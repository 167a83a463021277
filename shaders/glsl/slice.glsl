// The part of a call's entries that one dispatch of a compute shader takes on.
layout(push_constant) uniform Slice {
    uint first;
    uint count;
} slice;
