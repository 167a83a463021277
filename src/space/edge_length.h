/// Lengths of edges, also of those far below the rounding errors of their ends.
#pragma once

#include "space/label.h"

namespace vorpipe::space {

/// The length of the edge between faces j and k of the cell of i, from the vertex with l to that with m. It
/// is right to a millionth of itself, or of `fine`: in pairs of doubles where that suffices, and in 2,000
/// bits elsewhere, so that 0 is 0.
double edgeLength(const Places& places, Label i, Label j, Label k, Label l, Label m, double fine);

}  // namespace vorpipe::space
