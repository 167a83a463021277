#include "io/sites/simulation_cell.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <utility>

#include "base/try.h"
#include "base/words.h"
#include "io/base/number.h"
#include "io/base/quoted.h"

namespace vorpipe {
namespace {

/// The value of KEY=VALUE or KEY="VALUE" in a line, and its column.
struct Entry {
  std::string_view value;
  std::size_t column;
};

/// Returns the first value of a key, in any case.
std::optional<Entry> entryOf(std::string_view line, std::string_view key) {
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t", at)) != std::string_view::npos) {
    const std::size_t equal = line.find_first_of("= \t", at);
    if (equal == std::string_view::npos) return std::nullopt;
    const std::string_view name = line.substr(at, equal - at);
    at = equal;
    if (line[equal] != '=') continue;
    std::size_t begin = equal + 1;
    const bool quoted = begin < line.size() && (line[begin] == '"' || line[begin] == '\'');
    const std::size_t end = quoted ? line.find(line[begin], begin + 1) : line.find_first_of(" \t", begin);
    begin += quoted ? 1 : 0;
    const std::string_view value = line.substr(begin, end == std::string_view::npos ? end : end - begin);
    if (lowerCase(name) == key) return Entry{value, begin + 1};
    if (end == std::string_view::npos) return std::nullopt;
    at = end + (quoted ? 1 : 0);
  }
  return std::nullopt;
}

std::vector<std::string_view> wordsOf(std::string_view text) {
  std::vector<std::string_view> words;
  while (!(text = trimmed(text)).empty()) {
    const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return words;
}

/// Reads as many numbers as there are in `numbers`.
Result<void> takeNumbers(const LineReader& lines, const Entry& entry, std::string_view key,
                         std::span<double> numbers) {
  const auto words = wordsOf(entry.value);
  if (words.size() != numbers.size()) {
    return lines.errorAt(entry.column,
                         fmt::format("{} has {} numbers, and not {}", key, words.size(), numbers.size()));
  }
  for (std::size_t k = 0; k < words.size(); ++k) {
    const auto number = parseNumber(words[k]);
    const auto column = entry.column + static_cast<std::size_t>(words[k].data() - entry.value.data());
    if (!number) return lines.errorAt(column, number.error());
    numbers[k] = *number;
  }
  return {};
}

/// Names the columns that NAME:TYPE:COUNT... lists.
Result<void> takeProperties(const LineReader& lines, const Entry& entry, FrameComment& frame) {
  const auto wrong = [&](std::string_view what) {
    return lines.errorAt(entry.column, fmt::format("Properties: {}", what));
  };
  std::vector<std::string_view> parts;
  for (std::string_view rest = entry.value; true;) {
    const std::size_t colon = rest.find(':');
    parts.push_back(rest.substr(0, colon));
    if (colon == std::string_view::npos) break;
    rest.remove_prefix(colon + 1);
  }
  if (parts.size() % 3 != 0) return wrong("are no list of NAME:TYPE:COUNT");
  constexpr std::size_t most = 1000;
  for (std::size_t k = 0; k < parts.size(); k += 3) {
    const auto count = wholeNumber<std::size_t>(parts[k + 2]);
    if (!count || *count < 1 || *count > most)
      return wrong(
          fmt::format("{} has no number of columns, but {}", inQuotes(parts[k]), inQuotes(parts[k + 2])));
    const bool places = lowerCase(parts[k]) == "pos" || lowerCase(parts[k]) == "position";
    if (places && *count != 3) return wrong(fmt::format("{} has {} columns, and not 3", parts[k], *count));
    constexpr std::array<std::string_view, 3> axes = {"x", "y", "z"};
    for (std::size_t i = 0; i < *count; ++i) {
      frame.names.push_back(places        ? std::string(axes[i])
                            : *count == 1 ? std::string(parts[k])
                                          : fmt::format("{}_{}", parts[k], i + 1));
    }
  }
  frame.names_at = entry.column;
  return {};
}

Result<void> takePeriods(const LineReader& lines, const Entry& entry, SimulationCell& cell) {
  const auto words = wordsOf(entry.value);
  if (words.size() != 3) return lines.errorAt(entry.column, "pbc has three of T and F");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string word = lowerCase(words[axis]);
    const bool yes = word == "t" || word == "true" || word == "1";
    if (!yes && word != "f" && word != "false" && word != "0")
      return lines.errorAt(entry.column + static_cast<std::size_t>(words[axis].data() - entry.value.data()),
                           fmt::format("pbc: {} is neither T nor F", inQuotes(words[axis])));
    cell.periodic[axis] = yes;
  }
  return {};
}

}  // namespace

Result<FrameComment> readFrameComment(const LineReader& lines, std::string_view comment) {
  FrameComment frame;
  if (const auto properties = entryOf(comment, "properties")) {
    VORPIPE_TRY(takeProperties(lines, *properties, frame));
  }
  const auto lattice = entryOf(comment, "lattice");
  if (!lattice) return frame;
  std::array<double, 9> numbers{};
  VORPIPE_TRY(takeNumbers(lines, *lattice, "Lattice", numbers));
  SimulationCell cell;
  for (std::size_t k = 0; k < 3; ++k)
    cell.vectors[k] = {numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]};
  // A lattice without another word is a period.
  cell.periodic = {true, true, true};
  if (const auto periods = entryOf(comment, "pbc")) {
    VORPIPE_TRY(takePeriods(lines, *periods, cell));
  }
  if (const auto origin = entryOf(comment, "origin")) {
    std::array<double, 3> at{};
    VORPIPE_TRY(takeNumbers(lines, *origin, "Origin", at));
    cell.origin = {at[0], at[1], at[2]};
  }
  frame.cell = cell;
  return frame;
}

bool isExtendedComment(std::string_view line) {
  return entryOf(line, "lattice").has_value() || entryOf(line, "properties").has_value();
}

SimulationCell tiltedCell(const std::array<double, 3>& low, const std::array<double, 3>& high,
                          const std::array<double, 3>& tilt) {
  return {
      .origin = {low[0], low[1], low[2]},
      .vectors = {
          {{high[0] - low[0], 0, 0}, {tilt[0], high[1] - low[1], 0}, {tilt[1], tilt[2], high[2] - low[2]}}}};
}

Point3 placeIn(const SimulationCell& cell, const std::array<double, 3>& fractions) {
  Point3 place = cell.origin;
  for (std::size_t k = 0; k < 3; ++k) {
    place.x += fractions[k] * cell.vectors[k].x;
    place.y += fractions[k] * cell.vectors[k].y;
    place.z += fractions[k] * cell.vectors[k].z;
  }
  return place;
}

std::optional<Box3> boxOf(const SimulationCell& cell) {
  const auto& [a, b, c] = cell.vectors;
  const bool upright = a.y == 0 && a.z == 0 && b.x == 0 && b.z == 0 && c.x == 0 && c.y == 0;
  if (!upright || a.x == 0 || b.y == 0 || c.z == 0) return std::nullopt;
  const Point3& o = cell.origin;
  const auto [xmin, xmax] = std::minmax({o.x, o.x + a.x});
  const auto [ymin, ymax] = std::minmax({o.y, o.y + b.y});
  const auto [zmin, zmax] = std::minmax({o.z, o.z + c.z});
  return Box3{xmin, ymin, zmin, xmax, ymax, zmax};
}

std::string periodsOf(const SimulationCell& cell) {
  std::vector<std::string_view> axes;
  constexpr std::array<std::string_view, 3> names = {"x", "y", "z"};
  for (std::size_t k = 0; k < 3; ++k) {
    if (cell.periodic[k]) axes.push_back(names[k]);
  }
  return fmt::format("{}", fmt::join(axes, ", "));
}

}  // namespace vorpipe
