/// Reads sites from a file of any known kind.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "io/sites/site_table.h"
#include "vorpipe.h"

namespace vorpipe {

/// Most sites of one run: a neighbor is a signed 32-bit index.
inline constexpr std::uint64_t max_sites = std::numeric_limits<std::int32_t>::max();

/// The extensions of all kinds, in the order in which messages name them.
std::vector<std::string_view> sitesExtensions();

/// Reads at least one site. The path's extension, or the one before .gz, determines the kind of file; "-" is
/// standard input. Sites::weight is empty if the file has none. docs/formats.md lists the kinds. Errors: a
/// path, data or an option that is wrong for them, with file, line and column (input); reading failed or
/// memory ran out (device).
Result<SiteTable> readSites(const std::string& path, const ReadOptions& options = {});

}  // namespace vorpipe
