/// Those of mended_inputs.h in outlines.
#pragma once

#include <vector>

#include "support/hard/hard_inputs.h"

namespace vorpipe::test::mended {

void addOutlined(std::vector<HardInput>& all);

}  // namespace vorpipe::test::mended
