/// Weights of sites in a separate file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/base/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe {

/// Reads the weights of `count` sites as readSiteNumbers does; a first line `weight` or `radius` (weights are
/// then the squares) may name the numbers.
Result<std::vector<double>> readWeights(const std::string& path, std::uint64_t count);

/// Whether weights can be written to such a path. Error (input): readWeights does not accept its extension.
Result<void> checkWeightsPath(const std::string& path);

/// Writes weights in the format of the path's extension, so that readWeights reads back the same numbers.
/// Error (device): writing failed.
Result<void> writeWeights(ByteSink& sink, const std::vector<double>& weights, const std::string& path);

/// `count` weights, evenly distributed between `low` and `high`; the same seed gives the same weights on
/// every platform, whatever else it was used for.
std::vector<double> randomWeights(double low, double high, std::uint64_t count, std::uint64_t seed);

}  // namespace vorpipe
