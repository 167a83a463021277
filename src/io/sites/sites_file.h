/// Sites out of a file of any known kind.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// Most sites of one run: a neighbor is an index of 32 bits with a sign.
inline constexpr std::uint64_t max_sites = std::numeric_limits<std::int32_t>::max();

/// The extensions of all kinds, in the order in which messages name them.
std::vector<std::string_view> sitesExtensions();

/// Reads at least one site by the path's extension: .csv, .xyz, .txt or .npy; "-" is CSV on standard
/// input. Sites::weight is empty where the file has none. Errors: a path or data that is wrong, with
/// file, line and column (input); reading failed or memory ran out (device).
Result<Sites> readSites(const std::string& path);

}  // namespace vorpipe
