/// Weights of sites, apart from the sites.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/base/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe {

/// Reads the weights of `count` sites as readSiteNumbers does; a first line `weight` or `radius` (weights are
/// then its squares) may say what they are.
Result<std::vector<double>> readWeights(const std::string& path, std::uint64_t count);

/// Whether weights can be written to such a path. Error (input): its extension is none of readWeights.
Result<void> checkWeightsPath(const std::string& path);

/// Writes weights as the path's extension says, so that readWeights reads back the same numbers. Error
/// (device): writing failed.
Result<void> writeWeights(ByteSink& sink, const std::vector<double>& weights, const std::string& path);

/// `count` weights, evenly distributed between `low` and `high`; the same seed gives the same on every
/// platform, whatever else was made of it.
std::vector<double> randomWeights(double low, double high, std::uint64_t count, std::uint64_t seed);

}  // namespace vorpipe
