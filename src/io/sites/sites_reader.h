/// Sites out of one kind of file each, from an open file. Errors: what is wrong with the data, with
/// file, line and column (input); reading failed or memory ran out (device).
#pragma once

#include "io/files/input_file.h"
#include "vorpipe.h"

namespace vorpipe {

/// CSV with a header that names x, y and optionally weight or radius (the weight is its square), in any
/// order; other columns are ignored.
Result<Sites> readCsvSites(InputFile file);

/// Lines of x y or x y weight, separated by blanks or commas; # begins a comment.
Result<Sites> readTextSites(InputFile file);

/// NumPy array of shape (N, 2) or (N, 3), the third column being the weight, float32 or float64.
Result<Sites> readNpySites(InputFile file);

}  // namespace vorpipe
