#include "io/sites/site_source.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <new>
#include <string_view>
#include <utility>

#include "base/try.h"
#include "base/words.h"
#include "io/base/coordinate_system.h"
#include "io/base/error.h"
#include "io/base/quoted.h"
#include "io/sites/sites_file.h"
#include "vorpipe/patterns.h"

namespace vorpipe {
namespace {

constexpr std::array<std::pair<std::string_view, Pattern>, 6> patterns = {{
    {"random", Pattern::random},
    {"square", Pattern::square},
    {"hex", Pattern::hex},
    {"jitter", Pattern::jitter},
    {"clusters", Pattern::clusters},
    {"circle", Pattern::circle},
}};

constexpr std::array<std::pair<std::string_view, GlobePattern>, 2> globe_patterns = {{
    {"icosahedral", GlobePattern::icosahedral},
    {"fibonacci", GlobePattern::fibonacci},
}};

std::optional<GlobePattern> globePatternNamed(std::string_view name) {
  const auto* const named =
      std::ranges::find(globe_patterns, name, &std::pair<std::string_view, GlobePattern>::first);
  return named == globe_patterns.end() ? std::nullopt : std::optional(named->second);
}

std::optional<Pattern> patternNamed(std::string_view name) {
  const auto* const named = std::ranges::find(patterns, name, &std::pair<std::string_view, Pattern>::first);
  return named == patterns.end() ? std::nullopt : std::optional(named->second);
}

/// A whole number from 1 to max_sites.
std::optional<std::uint64_t> countOf(std::string_view text) {
  const auto n = wholeNumber<std::uint64_t>(text);
  return n && *n >= 1 && *n <= max_sites ? n : std::nullopt;
}

/// Returns the N of PATTERN:N.
Result<std::uint64_t> readCount(std::string_view spec, std::string_view count) {
  if (const auto n = countOf(count)) return *n;
  return inputError(fmt::format("{}: {} is not a number of sites; it must be a whole number from 1 to {}",
                                spec, inQuotes(count), max_sites));
}

Result<SiteSource> generateSites(Pattern pattern, std::uint64_t n, std::uint64_t seed,
                                 const std::optional<Box>& box) {
  const Generator generator{pattern, n, seed};
  return SiteSource{SiteTable{sitesOf(generator, box)}, generator};
}

Result<SiteSource> generateDegrees(GlobePattern pattern, std::string_view spec, std::uint64_t n) {
  auto sites = generateOnGlobe(pattern, n);
  if (!sites) return inputError(fmt::format("{}: {}", spec, sites.error().message));
  SiteSource source{SiteTable{std::move(*sites)}, std::nullopt};
  source.table.system = wgs84();
  return source;
}

}  // namespace

Sites sitesOf(const Generator& generator, const std::optional<Box>& box) {
  const auto isSide = [](double length) { return length > 0 && std::isfinite(length); };
  const bool fills = box && isSide(box->xmax - box->xmin) && isSide(box->ymax - box->ymin);
  return generate(generator.pattern, generator.count, generator.seed, fills ? *box : Box{0, 0, 1, 1});
}

std::vector<std::string_view> patternNames() {
  std::vector<std::string_view> names;
  for (const auto& [name, pattern] : patterns) names.push_back(name);
  return names;
}

std::vector<std::string_view> globePatternNames() {
  std::vector<std::string_view> names;
  for (const auto& [name, pattern] : globe_patterns) names.push_back(name);
  return names;
}

bool isOfGlobe(std::string_view spec) {
  const std::size_t colon = spec.find(':');
  return colon != std::string_view::npos && globePatternNamed(spec.substr(0, colon));
}

std::optional<std::uint64_t> generatedCount(std::string_view spec) {
  const std::size_t colon = spec.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  if (!patternNamed(spec.substr(0, colon)) && !isOfGlobe(spec)) return std::nullopt;
  return countOf(spec.substr(colon + 1));
}

Result<SiteSource> loadSites(const std::string& spec, std::uint64_t seed, const ReadOptions& options,
                             const std::optional<Box>& box) {
  const std::string_view text = spec;
  const std::size_t colon = text.find(':');
  const auto pattern = patternNamed(text.substr(0, colon));
  const auto of_globe = globePatternNamed(text.substr(0, colon));
  if ((pattern || of_globe) && colon != std::string_view::npos) {
    VORPIPE_LET(count, readCount(text, text.substr(colon + 1)));
    try {
      return pattern ? generateSites(*pattern, count, seed, box) : generateDegrees(*of_globe, text, count);
    } catch (const std::bad_alloc&) {
      return deviceError(fmt::format("{}: there is not enough memory for so many sites", spec));
    }
  }
  auto table = readSites(spec, options);
  if (!table && (pattern || of_globe)) {
    return inputError(
        fmt::format("{0}: a generator needs a number of sites, as in {0}:{1}", spec, of_globe ? 642 : 1000));
  }
  if (!table) {
    if (colon != std::string_view::npos && !std::filesystem::exists(spec)) {
      return inputError(
          fmt::format("{}: is neither a file nor a generator ({}; {} with --globe){}", spec,
                      fmt::join(patternNames(), ", "), fmt::join(globePatternNames(), ", "),
                      text.starts_with("density:") ? "; density:N is for relax and transport" : ""));
    }
    return tl::unexpected(std::move(table.error()));
  }
  return SiteSource{std::move(*table), std::nullopt};
}

}  // namespace vorpipe
