/// A batch in float, as devices take it.
#pragma once

#include "backend/backend.h"

namespace vorpipe {

/// Returns a batch with every number rounded to float.
CellBatch<float> toFloat(const CellBatch<double>& batch);

}  // namespace vorpipe
