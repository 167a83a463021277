/// Sites that `--sites` names: a generator or a file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/sites/sites_file.h"
#include "vorpipe.h"

namespace vorpipe {

/// A pattern with its parameters.
struct Generator {
  Pattern pattern;
  std::uint64_t count, seed;
};

/// Returns the generator's sites, all over the box. Uses the unit square without a box, or if its sides are
/// not finite and above 0, which the user of the box refuses.
Sites sitesOf(const Generator& generator, const std::optional<Box>& box);

struct SiteSource {
  SiteTable table;
  std::optional<Generator>
      generator;  ///< none when the sites come from a file, or are those of a GlobePattern
};

/// The patterns that loadSites takes, in the order in which messages name them; and those that are of the
/// globe.
std::vector<std::string_view> patternNames();
std::vector<std::string_view> globePatternNames();

/// Whether `spec` asks for a pattern of the globe, whose sites are degrees.
bool isOfGlobe(std::string_view spec);

/// Returns the N that `spec` asks a generator for; none if it names a file or is wrong.
std::optional<std::uint64_t> generatedCount(std::string_view spec);

/// Reads or generates the sites of `spec`: PATTERN:N (random, square, hex, jitter, clusters, circle; N sites)
/// in the box; icosahedral:N or fibonacci:N, in degrees on the globe; or what readSites takes, with its
/// options. For a file of such a name write ./PATTERN:N. Errors: those of readSites and generateOnGlobe, N is
/// not a number from 1 to max_sites (input), memory ran out (device).
Result<SiteSource> loadSites(const std::string& spec, std::uint64_t seed, const ReadOptions& options = {},
                             const std::optional<Box>& box = {});

}  // namespace vorpipe
