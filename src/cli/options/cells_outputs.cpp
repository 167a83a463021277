#include "cli/options/cells_outputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "cli/options/options.h"
#include "io/base/error.h"
#include "io/base/quoted.h"
#include "io/cells/space_file.h"

namespace vorpipe::cli {
namespace {

Parsed<CellsTarget> parseCells(std::string_view text) {
  if (text == "-" || text == standard_output) return CellsTarget{std::string(standard_output), nullptr};
  auto target = parseNamed<CellsTarget>(text, cellsFormatOf);
  if (target) return target;
  VORPIPE_VAR(path, parseFile(text, ""));
  if (spaceFormatOf(path)) return CellsTarget{std::move(path), nullptr};
  return target;
}

Parsed<std::string> parseVoroFormat(std::string_view text) {
  VORPIPE_TRY(checkVoroFormat(text));
  return std::string(text);
}

/// The extensions of files that cells in space alone have.
std::vector<std::string_view> extensionsInSpace() {
  std::vector<std::string_view> extensions;
  for (const std::string_view extension : spaceExtensions()) {
    if (!cellsFormatOf("cells" + std::string(extension))) extensions.push_back(extension);
  }
  return extensions;
}

Parsed<EdgesTarget> parseEdges(std::string_view text) { return parseNamed<EdgesTarget>(text, edgesFormatOf); }

/// Parses --detail: whether only measures are wanted.
Parsed<bool> parseDetail(std::string_view text) {
  if (text == "measures" || text == "all") return text == "measures";
  return tl::unexpected(fmt::format("{} is no detail; it must be all or measures", inQuotes(text)));
}

/// Sets the format for --detail measures.
Result<void> takeMeasures(CellsTargets& targets) {
  const auto is_other = [](const CellsTarget& target) { return target.format->extension != ".npz"; };
  const bool lines = !targets.edges.empty() || !targets.triangulation.empty();
  if (lines || targets.cells.empty() || std::ranges::any_of(targets.cells, is_other)) {
    return inputError("--detail: measures alone go to a file of arrays: -o FILE.npz, and no other");
  }
  for (CellsTarget& target : targets.cells) target.format = &npz_measures;
  return {};
}

/// Returns the kinds as --format names them.
std::vector<std::string> cellsKinds() {
  std::vector<std::string> kinds;
  for (const std::string_view extension : cellsExtensions()) kinds.emplace_back(extension.substr(1));
  return kinds;
}

std::string extensionsOfFeatures() {
  std::vector<std::string_view> extensions;
  for (const std::string_view extension : cellsExtensions()) {
    if ((*cellsFormatOf("cells" + std::string(extension)))->features) extensions.push_back(extension);
  }
  return fmt::format("{}", fmt::join(extensions, ", "));
}

}  // namespace

std::vector<std::string> CellsTargets::paths() const {
  std::vector<std::string> paths;
  for (const CellsTarget& target : cells) paths.push_back(target.path);
  for (const EdgesTarget& target : edges) paths.push_back(target.path);
  for (const EdgesTarget& target : triangulation) paths.push_back(target.path);
  return paths;
}

Detail CellsTargets::detail() const {
  if (!triangulation.empty()) return Detail::everything;
  Detail detail = edges.empty() ? Detail::measures : Detail::polygons;
  for (const CellsTarget& target : cells) detail = std::max(detail, target.format->detail);
  return detail;
}

std::vector<const EdgesFormat*> formatsOf(const std::vector<EdgesTarget>& targets) {
  std::vector<const EdgesFormat*> formats;
  for (const EdgesTarget& target : targets) formats.push_back(target.format);
  return formats;
}

namespace {

/// Whether a file has the neighbors of a cell as one text.
bool haveLists(const CellsTargets& targets) {
  return std::ranges::any_of(targets.cells, [](const CellsTarget& target) {
    return target.format != nullptr &&
           (target.format->extension == ".csv" || target.format->extension == ".gpkg");
  });
}

}  // namespace

std::optional<NeededAttribute> neededFor(const CellsTargets& targets) {
  if (targets.id.empty()) return std::nullopt;
  const auto check = [in_lists =
                          haveLists(targets)](std::string_view name) -> tl::expected<void, std::string> {
    constexpr std::array walls = {Wall::xmin, Wall::xmax, Wall::ymin, Wall::ymax, Wall::outline};
    const auto is = [name](Wall wall) { return nameOf(wall) == name; };
    if (std::ranges::any_of(walls, is))
      return tl::unexpected(fmt::format("{} is the name of a wall among neighbors", inQuotes(name)));
    if (!in_lists || name.find(';') == std::string_view::npos) return {};
    return tl::unexpected(
        fmt::format("{} has a semicolon, which separates neighbors in .csv and .gpkg", inQuotes(name)));
  };
  return NeededAttribute{targets.id, check, /*unique=*/true};
}

Result<const Attribute*> namesOf(const CellsTargets& targets, std::span<const Attribute> attributes) {
  if (targets.id.empty()) return nullptr;
  const Attribute* const found = findNamed(attributes, targets.id);
  if (found != nullptr) return found;
  std::vector<std::string> names;
  for (const Attribute& attribute : attributes) names.push_back(inQuotes(attribute.name()));
  return inputError(fmt::format("--id: the sites have no attribute {}{}{}", inQuotes(targets.id),
                                names.empty() ? "" : "; they have ", fmt::join(names, ", ")));
}

std::string noteOnGeoJson(const CellsTargets& targets, const CoordinateSystem& system) {
  if (system.kind != CoordinateKind::plane) return {};
  // GeoJSON in lines (.geojsonl) has no member that could name a coordinate system.
  const std::string_view nameless = geoJsonSystem(system).empty() ? ".geojson" : ".geojsonl";
  std::string path;
  const auto take = [&](const auto& of_kind) {
    for (const auto& target : of_kind) {
      if (path.empty() && target.format->extension.starts_with(nameless)) path = target.path;
    }
  };
  take(targets.cells);
  take(targets.edges);
  take(targets.triangulation);
  if (path.empty()) return path;
  return path +
         ": readers take the coordinates of GeoJSON for degrees, and these are of a plane; .gpkg says of "
         "which";
}

bool CellsTargets::carryAttributes() const {
  return std::ranges::any_of(cells, [](const CellsTarget& target) { return target.format->attributes; });
}

bool CellsTargets::useStandardOutput() const {
  return std::ranges::any_of(cells, [](const CellsTarget& target) { return target.path == standard_output; });
}

void addCellsTargets(Options& options, CellsTargets& targets) {
  const auto cells = cellsExtensions(), edges = edgesExtensions(), in_space = extensionsInSpace();
  std::vector<std::string> all(cells.begin(), cells.end());
  all.insert(all.end(), in_space.begin(), in_space.end());
  addRepeatable(
      options, "-o", "FILE",
      fmt::format(
          "the cells in input order, by the extension: {}; in space also {}; or - for standard output, as "
          "--format says [csv]; repeatable",
          fmt::join(cells, ", "), fmt::join(in_space, ", ")),
      parseCells, [&targets](CellsTarget target) { targets.cells.push_back(std::move(target)); },
      {{}, std::move(all)});
  addRepeatable(
      options, "--edges", "FILE",
      fmt::format("the edges of all cells as lines, each once, with its two sites and its length: {}; "
                  "repeatable",
                  fmt::join(edges, ", ")),
      parseEdges, [&targets](EdgesTarget target) { targets.edges.push_back(std::move(target)); },
      {{}, {edges.begin(), edges.end()}});
  addRepeatable(
      options, "--triangulation", "FILE",
      fmt::format(
          "the edges of the Delaunay triangulation of all sites, whatever the domain, in the same way: "
          "{}; with weights, of the regular one; repeatable",
          fmt::join(edges, ", ")),
      parseEdges, [&targets](EdgesTarget target) { targets.triangulation.push_back(std::move(target)); },
      {{}, {edges.begin(), edges.end()}});
  addParsed(options, "--id", targets.id, "@NAME",
            "names sites by this attribute, which is another for each, where they are neighbors, owners and "
            "ends of edges [their numbers]",
            parseAttributeWord, {{"@"}, {}});
  addParsed(
      options, "--voro-format", targets.voro_format, "TEXT",
      "the lines of a .vol in space, as of option -c of Voro++: text with codes such as %i, %q, %v and %n "
      "[%i %q %v, with weights %i %q %v %r]",
      parseVoroFormat);
  options.addFlag("--share", targets.share,
                  "adds each cell's share of the area of all, where files have attributes");
  options.addFlag(
      "--only-cells", targets.only_cells,
      fmt::format("leaves out sites without a cell, in files of features: {}", extensionsOfFeatures()));
  addParsed(
      options, "--detail", targets.only_measures, "all or measures",
      "what a .npz has of the cells: all, or areas, centroids, numbers of neighbors and statuses alone, "
      "found in tiles that fit into the memory, of a .npy that is mapped and not read [all]",
      parseDetail, {{"all", "measures"}, {}});
}

Result<void> refuseFilesOfSpace(const CellsTargets& targets) {
  for (const CellsTarget& target : targets.cells) {
    if (target.format == nullptr && target.path != standard_output) {
      return inputError(fmt::format(
          "-o: {}: is a file of cells in space, and these are in the plane; --dim 3", target.path));
    }
  }
  if (targets.voro_format.empty()) return {};
  return inputError("--voro-format: is of files of cells in space, and these are in the plane; --dim 3");
}

Result<void> takeFormat(CellsTargets& targets, const std::string& kind) {
  bool taken = false;
  VORPIPE_TRY(refuseFilesOfSpace(targets));
  for (CellsTarget& target : targets.cells) {
    if (target.format != nullptr) continue;
    if (std::exchange(taken, true))
      return inputError("-o: standard output takes one file, and is named twice");
    const auto format = cellsFormatOf("-." + (kind.empty() ? "csv" : kind));
    if (!format) {
      return inputError(fmt::format("--format: {} is no kind of file for cells; known are {}", inQuotes(kind),
                                    fmt::join(cellsKinds(), ", ")));
    }
    target.format = *format;
  }
  const auto has_features = [](const CellsTarget& target) { return target.format->features; };
  if (targets.only_cells && std::ranges::none_of(targets.cells, has_features)) {
    return inputError(fmt::format("--only-cells: there is no output with features to leave out: -o with {}",
                                  extensionsOfFeatures()));
  }
  const auto named = [](const EdgesTarget& target) { return target.format->names; };
  if (!targets.id.empty() && !targets.carryAttributes() && std::ranges::none_of(targets.edges, named) &&
      std::ranges::none_of(targets.triangulation, named)) {
    return inputError("--id: there is no output with names of sites: .csv, .geojson, .geojsonl or .gpkg");
  }
  if (targets.share && !targets.carryAttributes()) {
    return inputError("--share: there is no output with shares: -o with .csv, .geojson, .geojsonl or .gpkg");
  }
  return targets.only_measures ? takeMeasures(targets) : Result<void>{};
}

}  // namespace vorpipe::cli
