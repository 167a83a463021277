/// Sites out of a file of any known kind.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "io/sites/site_table.h"
#include "vorpipe.h"

namespace vorpipe {

/// Most sites of one run: a neighbor is an index of 32 bits with a sign.
inline constexpr std::uint64_t max_sites = std::numeric_limits<std::int32_t>::max();

/// The extensions of all kinds, in the order in which messages name them.
std::vector<std::string_view> sitesExtensions();

/// Reads at least one site. The path's extension tells the kind of file, and that before .gz; "-" is standard
/// input. Sites::weight is empty where the file has none. docs/formats.md has the kinds. Errors: a path, data
/// or an option that is wrong for them, with file, line and column (input); reading failed or memory ran out
/// (device).
Result<SiteTable> readSites(const std::string& path, const ReadOptions& options = {});

}  // namespace vorpipe
