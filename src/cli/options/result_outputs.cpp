#include "cli/options/result_outputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>

#include "base/try.h"
#include "cli/options/options.h"
#include "io/base/error.h"
#include "io/base/quoted.h"
#include "io/pictures/picture_file.h"

namespace vorpipe::cli {
namespace {

/// Parses a file of sites; for a file of cells or a picture, the error names the right option.
Parsed<PointsTarget> parsePoints(std::string_view text) {
  if (text == "-" || text == standard_output) return PointsTarget{std::string(standard_output), nullptr};
  VORPIPE_VAR(path, parseFile(text, ""));
  if (const auto format = pointsFormatOf(path)) return PointsTarget{std::move(path), *format};
  const auto isFor = [&](std::string_view option) {
    return tl::unexpected(fmt::format("{0} is no file of sites ({1}); {2} {0} writes one of such a kind",
                                      path, fmt::join(pointsExtensions(), ", "), option));
  };
  if (pictureFormatOf(path)) return isFor("--picture");
  if (cellsFormatOf(path)) return isFor("--cells");
  return tl::unexpected(pointsFormatOf(path).error().message);
}

std::string numbered(const std::string& path, std::uint64_t number) {
  const std::filesystem::path whole(path);
  const std::string name =
      fmt::format("{}-{:04}{}", whole.stem().string(), number, whole.extension().string());
  return (whole.parent_path() / name).string();
}

}  // namespace

std::vector<std::string> ResultTargets::paths() const {
  std::vector<std::string> paths;
  for (const PointsTarget& target : points) paths.push_back(target.path);
  for (const CellsTarget& target : cells) paths.push_back(target.path);
  for (const PictureFile& file : pictures) paths.push_back(file.path);
  return paths;
}

std::vector<std::string> ResultTargets::pathsWith(std::initializer_list<std::string> others) const {
  std::vector<std::string> all = paths();
  std::ranges::copy_if(others, std::back_inserter(all),
                       [](const std::string& path) { return !path.empty(); });
  return all;
}

std::vector<std::string> ResultTargets::numberedPaths(std::uint64_t diagram) const {
  std::vector<std::string> all = paths();
  for (std::string& path : all) path = numbered(path, diagram);
  return all;
}

Detail ResultTargets::detail() const {
  Detail detail = Detail::measures;
  for (const CellsTarget& target : cells) detail = std::max(detail, target.format->detail);
  return detail;
}

bool ResultTargets::carryAttributes() const {
  return std::ranges::any_of(points,
                             [](const auto& to) { return to.format == nullptr || to.format->attributes; }) ||
         std::ranges::any_of(cells, [](const auto& to) { return to.format->attributes; });
}

bool ResultTargets::useStandardOutput() const {
  return std::ranges::any_of(points, [](const auto& to) { return to.path == standard_output; });
}

void addResultTargets(Options& options, ResultTargets& targets, std::string_view sites) {
  const auto points = pointsExtensions(), cells = cellsExtensions(), pictures = pictureExtensions();
  addRepeatable(
      options, "-o", "FILE",
      fmt::format(
          "{}, in the order of the input and with its attributes, by the extension: {}; or - for standard "
          "output, as --format says [csv]; repeatable",
          sites, fmt::join(points, ", ")),
      parsePoints, [&targets](PointsTarget target) { targets.points.push_back(std::move(target)); },
      {{}, {points.begin(), points.end()}});
  addRepeatable(
      options, "--cells", "FILE",
      fmt::format("their cells, as `vorpipe cells` writes them: {}; repeatable", fmt::join(cells, ", ")),
      [](std::string_view text) { return parseNamed<CellsTarget>(text, cellsFormatOf); },
      [&targets](CellsTarget target) { targets.cells.push_back(std::move(target)); },
      {{}, {cells.begin(), cells.end()}});
  addRepeatable(
      options, "--picture", "FILE",
      fmt::format("a picture of them, as `vorpipe render` draws it: {}; repeatable",
                  fmt::join(pictures, ", ")),
      [](std::string_view text) { return parseNamed<PictureFile>(text, pictureFormatOf); },
      [&targets](PictureFile file) { targets.pictures.push_back(std::move(file)); },
      {{}, {pictures.begin(), pictures.end()}});
}

void addRelaxTargets(Options& options, ResultTargets& targets) {
  addResultTargets(options, targets, "the moved sites");
  addFile(
      options, "--trace", targets.trace, ".csv",
      "a row for each diagram: its number, the energy, that as a part of the hexagonal lattice's, the "
      "longest "
      "way of a site to its centroid in spacings, the seconds since the first, and whether it was kept: 0 "
      "where its energy was too high, and the sites went back");
  addParsed(
      options, "--save-every", targets.every, "N",
      "also writes what -o, --cells and --picture name after each N diagrams, with the number of the diagram "
      "in the name: sites-0010.csv",
      [](std::string_view text) { return parseWhole(text, 1, UINT32_MAX); });
  addFolder(options, "--frames", targets.frames, StepsTo::folder_or_film,
            "an .mp4, made by ffmpeg, or an empty folder for numbered .png files: a picture of each diagram");
}

Result<void> takeFormat(ResultTargets& targets, const InputOptions& input) {
  const std::string& kind = input.format.output;
  if (!kind.empty() && input.sites != "-" && !targets.useStandardOutput()) {
    return inputError("--format: neither --sites - nor -o - is there to take it");
  }
  bool taken = false;
  for (PointsTarget& target : targets.points) {
    if (target.format != nullptr) continue;
    if (std::exchange(taken, true))
      return inputError("-o: standard output takes one file, and is named twice");
    const auto format = pointsFormatOf("-." + (kind.empty() ? "csv" : kind));
    if (!format) {
      return inputError(fmt::format("--format: {} is no kind of file for sites; known are {}",
                                    vorpipe::inQuotes(kind), fmt::join(pointsExtensions(), ", ")));
    }
    target.format = *format;
  }
  if (targets.every == 0) return {};
  if (targets.paths().empty())
    return inputError("--save-every: there is no -o, --cells or --picture to number");
  if (taken) return inputError("--save-every: standard output has no name to put a number into");
  return {};
}

}  // namespace vorpipe::cli
