/// What `--sites` names: a generator or a file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/sites/site_table.h"
#include "vorpipe.h"

namespace vorpipe {

/// A pattern as its name asks for it.
struct Generator {
  Pattern pattern;
  std::uint64_t count, seed;
};

/// Its sites, all over the box; over the unit square where there is none, or one whose sides are not finite
/// and above 0, which its user refuses.
Sites sitesOf(const Generator& generator, const std::optional<Box>& box);

struct SiteSource {
  SiteTable table;
  std::optional<Generator> generator;  ///< none when the sites come from a file
};

/// The patterns that loadSites takes, in the order in which messages name them.
std::vector<std::string_view> patternNames();

/// The N that `spec` asks a generator for; none where it names a file or is wrong.
std::optional<std::uint64_t> generatedCount(std::string_view spec);

/// Reads or generates the sites of `spec`: PATTERN:N (random, square, hex, jitter, clusters, circle; N
/// sites) in the box, or what readSites takes, with its options. A file of such a name is meant by
/// ./PATTERN:N. Errors: those of readSites, N is not a number from 1 to max_sites (input), memory ran out
/// (device).
Result<SiteSource> loadSites(const std::string& spec, std::uint64_t seed, const ReadOptions& options = {},
                             const std::optional<Box>& box = {});

}  // namespace vorpipe
