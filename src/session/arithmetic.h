/// How a device rounds.
#pragma once

#include "backend/backend.h"

namespace vorpipe::core {

/// Implements Session::arithmetic on an open backend.
Result<Arithmetic> measureArithmetic(Backend& backend);

}  // namespace vorpipe::core
