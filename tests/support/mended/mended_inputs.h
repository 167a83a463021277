/// Inputs that were found wrong once, made as small as they go.
#pragma once

#include <vector>

#include "support/hard/hard_inputs.h"

namespace vorpipe::test {

/// Each is named after what is hard about it.
std::vector<HardInput> mendedInputs();

}  // namespace vorpipe::test
