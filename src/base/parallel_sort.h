/// Sorts on several threads.
#pragma once

#include <span>

namespace vorpipe {

/// Sorts numbers in place, ascending, on up to `threads` threads; 0: all of the machine's. None is NaN.
void parallelSort(std::span<double> numbers, int threads);

}  // namespace vorpipe
