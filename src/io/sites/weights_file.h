/// Weights of sites, apart from the sites.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// Reads one finite weight for each of `count` sites, in their order: from .txt or .csv, a number to a line,
/// where # begins a comment and a first line `weight` or `radius` (weights are then its squares) may say what
/// they are; or from .npy, float32 or float64 of shape (N,) or (N, 1). Errors: a path or data that is wrong,
/// or not as many weights as sites, with file, line and column (input); reading failed or memory ran out
/// (device).
Result<std::vector<double>> readWeights(const std::string& path, std::uint64_t count);

/// `count` weights, evenly distributed between `low` and `high`; the same seed gives the same on every
/// platform, whatever else was made of it.
std::vector<double> randomWeights(double low, double high, std::uint64_t count, std::uint64_t seed);

}  // namespace vorpipe
