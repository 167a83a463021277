/// Weights that are hard on arithmetic.
#pragma once

#include <span>
#include <string_view>

#include "support/hard/hard_random.h"

namespace vorpipe::test {

struct HardWeights {
  std::string_view name;
  /// The weights of sites that extend over about `extent`.
  std::vector<double> (*make)(const Sites& sites, double extent, Random& random);
};

std::span<const HardWeights> hardWeights();

}  // namespace vorpipe::test
