/// Sites out of a file of any known kind.
#pragma once

#include <cstdint>
#include <string>

#include "vorpipe.h"

namespace vorpipe {

/// Most sites of one run: indices are 32 bits wide, and no_site is none of them.
inline constexpr std::uint64_t max_sites = no_site - 1;

/// Reads at least one site by the path's extension: .csv, .xyz, .txt or .npy; "-" is CSV on standard
/// input. Sites::weight is empty where the file has none. Errors: a path or data that is wrong, with
/// file, line and column (input); reading failed or memory ran out (device).
Result<Sites> readSites(const std::string& path);

}  // namespace vorpipe
