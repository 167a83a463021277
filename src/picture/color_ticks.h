/// The tick values of a color scale.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

/// Returns the ticks of a key whose other members are set. `ranked`: the values, ascending, by quantile only.
/// By quantile, ticks are the values at 0, 25, 50, 75 and 100 %, each once. Otherwise they are both ends, and
/// round numbers between them that are not too near to an end. If all values are equal there is one tick, in
/// the middle. Ticks for numbers of neighbors are integers.
std::vector<std::pair<double, double>> ticksOf(const ColorKey& key, std::span<const double> ranked);

}  // namespace vorpipe::core
