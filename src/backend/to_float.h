/// A batch as devices take it.
#pragma once

#include "backend/backend.h"

namespace vorpipe {

/// Rounds every number of a batch.
CellBatch<float> toFloat(const CellBatch<double>& batch);

}  // namespace vorpipe
