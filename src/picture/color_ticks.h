/// The values that a scale of colors names.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

/// The ticks of a key whose other members are set. `ranked`: the values, ascending, by quantile alone.
/// By quantile the values at 0, 25, 50, 75 and 100 %, each once; else both ends, and round numbers between
/// them that are not too near to an end. Where all values are equal there is one, in the middle. Numbers of
/// neighbors are whole.
std::vector<std::pair<double, double>> ticksOf(const ColorKey& key, std::span<const double> ranked);

}  // namespace vorpipe::core
