/// The part of mendedInputs() that has weights, and how any of them is made.
#pragma once

#include <string>
#include <vector>

#include "support/hard/hard_inputs.h"

namespace vorpipe::test::mended {

/// Named after what is hard about it.
HardInput inputOf(std::string name, Sites sites, const Box& domain, Periodic periodic = Periodic::none,
                  int width = 40, int height = 30);

void addWeighted(std::vector<HardInput>& all);

}  // namespace vorpipe::test::mended
