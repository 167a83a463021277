/// How wide the vectors of this machine are.
#pragma once

namespace vorpipe {

/// The number of floats side by side that the processor supports: 16 with AVX-512 as in x86-64-v4, 8 with
/// AVX2, else
/// 4. The environment variable VORPIPE_LANES limits it: tests compare the results of different widths on one
/// machine.
int laneWidth();

}  // namespace vorpipe
