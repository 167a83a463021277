#include "io/sites/space_source.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <new>
#include <system_error>
#include <utility>

#include "base/try.h"
#include "base/words.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/line_reader.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/base/read_log.h"
#include "io/sites/simulation_cell.h"

namespace vorpipe {
namespace {

/// The first three have namesakes in the plane.
constexpr std::array<std::pair<std::string_view, Pattern3>, 10> space_patterns = {{
    {"random", Pattern3::random},
    {"jitter", Pattern3::jitter},
    {"clusters", Pattern3::clusters},
    {"sphere", Pattern3::sphere},
    {"cubic", Pattern3::cubic},
    {"bcc", Pattern3::bcc},
    {"fcc", Pattern3::fcc},
    {"hcp", Pattern3::hcp},
    {"diamond", Pattern3::diamond},
    {"a15", Pattern3::a15},
}};
constexpr std::size_t in_plane_too = 3;
constexpr std::array<std::string_view, 5> table_extensions = {".csv", ".tsv", ".npy", ".xyz", ".txt"};

/// The extensions of all files that sites in space are read from.
std::vector<std::string_view> spaceInputs() {
  std::vector<std::string_view> all(table_extensions.begin(), table_extensions.end());
  const auto more = extensionsOfSpace();
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// Whether a file is an .xyz whose second line is that of an extended one.
bool beginsExtended(const std::string& path) {
  std::error_code failed;
  if (lowerExtension(path) != ".xyz" || !std::filesystem::is_regular_file(path, failed)) return false;
  const ReadLog::Pause unnoted;
  auto file = InputFile::open(path);
  if (!file) return false;  // reading it says what is wrong
  LineReader lines(std::move(*file));
  const auto first = lines.next();
  if (!first || !*first || !wholeNumber<std::uint64_t>(trimmed(**first))) return false;
  const auto second = lines.next();
  return second && *second && isExtendedComment(**second);
}

std::vector<std::string_view> namesFrom(std::size_t first) {
  std::vector<std::string_view> names;
  for (std::size_t k = first; k < space_patterns.size(); ++k) names.push_back(space_patterns[k].first);
  return names;
}

/// The pattern of PATTERN:N.
std::optional<Pattern3> patternIn(std::string_view spec) {
  const std::size_t colon = spec.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto* const found =
      std::ranges::find(space_patterns, spec.substr(0, colon), &std::pair<std::string_view, Pattern3>::first);
  return found == space_patterns.end() ? std::nullopt : std::optional(found->second);
}

/// Takes the box of a file's cell, or notes why not.
void takeCell(const SimulationCell& cell, const std::string& name, SpaceTable& table) {
  table.box = boxOf(cell);
  if (!table.box) {
    table.notes.push_back(name + ": its cell is tilted, and is not used: --lattice names it");
  } else if (const std::string axes = periodsOf(cell); !axes.empty()) {
    table.notes.push_back(
        fmt::format("{}: repeats itself along {}; its cells do so with --domain and --periodic", name, axes));
  }
}

Result<SpaceTable> generated(Pattern3 pattern, const std::string& spec, std::uint64_t seed,
                             const std::optional<Box3>& box) {
  const auto n = generatedInSpace(spec);
  if (!n) {
    return inputError(fmt::format("{}: {} is not a number of sites; it must be a whole number from 1 to {}",
                                  spec, inQuotes(std::string_view(spec).substr(spec.find(':') + 1)),
                                  max_sites));
  }
  SpaceTable table;
  table.generated = true;
  try {
    table.sites = box ? generate(pattern, *n, seed, *box) : generate(pattern, *n, seed);
  } catch (const std::bad_alloc&) {
    return deviceError(fmt::format("{}: there is not enough memory for so many sites", spec));
  }
  return table;
}

}  // namespace

std::vector<std::string_view> spacePatternNames() { return namesFrom(in_plane_too); }

bool isOfSpace(std::string_view spec) {
  const auto names = spacePatternNames();
  const std::size_t colon = spec.find(':');
  if (colon != std::string_view::npos && std::ranges::find(names, spec.substr(0, colon)) != names.end())
    return true;
  const std::string path(spec);
  const auto files = extensionsOfSpace();
  return std::ranges::find(files, inputExtension(path)) != files.end() || beginsExtended(path);
}

std::optional<std::uint64_t> generatedInSpace(std::string_view spec) {
  if (!patternIn(spec)) return std::nullopt;
  const auto n = wholeNumber<std::uint64_t>(spec.substr(spec.find(':') + 1));
  return n && *n >= 1 && *n <= max_sites ? n : std::nullopt;
}

Result<SpaceTable> readSpaceSites(const std::string& path, const ReadOptions& options) {
  const std::string extension = !options.format.empty() ? "." + options.format
                                : path == "-"           ? ".csv"
                                                        : inputExtension(path);
  const auto known = sitesExtensions();
  const auto inputs = spaceInputs();
  if (std::ranges::find(inputs, extension) == inputs.end() &&
      std::ranges::find(known, extension) != known.end()) {
    return inputError(fmt::format("{}: a {} has sites in the plane; sites in space are read from {}",
                                  path == "-" ? "<stdin>" : path, extension, fmt::join(inputs, ", ")));
  }
  ReadOptions in_space = options;
  in_space.third = Third::z;
  VORPIPE_VAR(read, readSites(path, in_space));
  SpaceTable table;
  table.attributes = std::move(read.attributes);
  table.notes = std::move(read.notes);
  table.weights = std::move(read.sites.weight);
  if (read.cell) takeCell(*read.cell, path == "-" ? "<stdin>" : path, table);
  try {
    table.sites.reserve(read.sites.size());
    for (std::size_t i = 0; i < read.sites.size(); ++i)
      table.sites.push_back({read.sites.x[i], read.sites.y[i], read.z[i]});
  } catch (const std::bad_alloc&) {
    return deviceError(path + ": there is not enough memory for its sites");
  }
  return table;
}

Result<SpaceTable> loadSpaceSites(const std::string& spec, std::uint64_t seed, const ReadOptions& options,
                                  const std::optional<Box3>& box) {
  if (const auto pattern = patternIn(spec)) return generated(*pattern, spec, seed, box);
  auto table = readSpaceSites(spec, options);
  if (table) return table;
  const std::string_view text = spec;
  const auto names = namesFrom(0);
  if (std::ranges::find(names, text) != names.end())
    return inputError(fmt::format("{0}: a generator needs a number of sites, as in {0}:1000", spec));
  if (text.find(':') != std::string_view::npos && !std::filesystem::exists(spec)) {
    return inputError(
        fmt::format("{}: is neither a file nor a generator in space ({})", spec, fmt::join(names, ", ")));
  }
  return table;
}

}  // namespace vorpipe
