/// Weights and masses of sites: a number for each, mostly in a separate file.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/attribute.h"
#include "io/base/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe {

/// Reads the weights of `count` sites, one finite number for each in their order: from .txt or .csv, a number
/// to a line, where # begins a comment; or from .npy, numbers that areNumbers() takes, of shape (N,) or
/// (N, 1). A first line `weight` or `radius` (weights are then the squares) may name the numbers. Errors: a
/// path or data that is wrong, or not as many numbers as sites, with file, line and column (input); reading
/// failed or memory ran out (device).
Result<std::vector<double>> readWeights(const std::string& path, std::uint64_t count);

/// Whether weights can be written to such a path. Error (input): readWeights does not accept its extension.
Result<void> checkWeightsPath(const std::string& path);

/// Writes weights in the format of the path's extension, so that readWeights reads back the same numbers.
/// Error (device): writing failed.
Result<void> writeWeights(ByteSink& sink, const std::vector<double>& weights, const std::string& path);

/// `count` weights, evenly distributed between `low` and `high`; the same seed gives the same weights on
/// every platform, whatever else it was used for.
std::vector<double> randomWeights(double low, double high, std::uint64_t count, std::uint64_t seed);

/// Whether a mass may be 0; no cell has mass 0.
enum class ZeroMass : std::uint8_t { refused, taken };

/// Checks that a text is a mass. The error states what is wrong with it.
tl::expected<void, std::string> checkMass(std::string_view text, ZeroMass zero = ZeroMass::refused);

/// Reads the masses of `count` sites as readWeights does: each more than 0, or 0 if allowed. Skips a
/// first line that begins with a letter, as a column's name does.
Result<std::vector<double>> readMasses(const std::string& path, std::uint64_t count,
                                       ZeroMass zero = ZeroMass::refused);

/// The same from the attribute with this name. Errors (input): there is none, or several; a value is missing,
/// or no mass.
Result<std::vector<double>> massesIn(std::span<const Attribute> attributes, std::string_view name,
                                     ZeroMass zero = ZeroMass::refused);

}  // namespace vorpipe
