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

#include "base/words.h"
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

std::optional<Pattern> patternNamed(std::string_view name) {
  const auto* const named = std::ranges::find(patterns, name, &std::pair<std::string_view, Pattern>::first);
  return named == patterns.end() ? std::nullopt : std::optional(named->second);
}

/// A whole number from 1 to max_sites.
std::optional<std::uint64_t> countOf(std::string_view text) {
  const auto n = wholeNumber<std::uint64_t>(text);
  return n && *n >= 1 && *n <= max_sites ? n : std::nullopt;
}

Result<SiteSource> generateSites(Pattern pattern, std::string_view spec, std::string_view count,
                                 std::uint64_t seed, const std::optional<Box>& box) {
  const auto n = countOf(count);
  if (!n) {
    return inputError(fmt::format("{}: {} is not a number of sites; it must be a whole number from 1 to {}",
                                  spec, inQuotes(count), max_sites));
  }
  try {
    const Generator generator{pattern, *n, seed};
    return SiteSource{SiteTable{sitesOf(generator, box)}, generator};
  } catch (const std::bad_alloc&) {
    return deviceError(fmt::format("{}: there is not enough memory for so many sites", spec));
  }
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

std::optional<std::uint64_t> generatedCount(std::string_view spec) {
  const std::size_t colon = spec.find(':');
  if (colon == std::string_view::npos || !patternNamed(spec.substr(0, colon))) return std::nullopt;
  return countOf(spec.substr(colon + 1));
}

Result<SiteSource> loadSites(const std::string& spec, std::uint64_t seed, const ReadOptions& options,
                             const std::optional<Box>& box) {
  const std::string_view text = spec;
  const std::size_t colon = text.find(':');
  const auto pattern = patternNamed(text.substr(0, colon));
  if (pattern && colon != std::string_view::npos) {
    return generateSites(*pattern, text, text.substr(colon + 1), seed, box);
  }
  auto table = readSites(spec, options);
  if (!table && pattern) {
    return inputError(fmt::format("{0}: a generator needs a number of sites, as in {0}:1000", spec));
  }
  if (!table) {
    if (colon != std::string_view::npos && !std::filesystem::exists(spec)) {
      return inputError(
          fmt::format("{}: is neither a file nor a generator ({}{})", spec, fmt::join(patternNames(), ", "),
                      text.starts_with("density:") ? "; density:N is for relax and transport" : ""));
    }
    return tl::unexpected(std::move(table.error()));
  }
  return SiteSource{std::move(*table), std::nullopt};
}

}  // namespace vorpipe
