/// The outputs of `cells`: files of cells and of edges.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/command_line.h"
#include "cli/options/parse.h"
#include "io/base/coordinate_system.h"
#include "io/cells/cells_file.h"
#include "io/cells/edges_file.h"
#include "io/sites/sites_file.h"
#include "vorpipe.h"

namespace vorpipe::cli {

struct CellsTarget {
  std::string path;
  /// Null for a file of cells in space alone, and for standard output until takeFormat().
  const CellsFormat* format;
};

struct EdgesTarget {
  std::string path;
  const EdgesFormat* format;
};

struct CellsTargets {
  std::vector<CellsTarget> cells;
  std::vector<EdgesTarget> edges, triangulation;
  std::string id;           ///< attribute that names sites in lists of them; empty: their numbers do
  std::string voro_format;  ///< of a .vol; empty: the usual one
  bool share = false;
  bool only_cells = false;
  bool only_measures = false;

  /// Returns all paths, in the order in which the files are created.
  [[nodiscard]] std::vector<std::string> paths() const;
  /// Returns the parts of a Diagram that the files need.
  [[nodiscard]] Detail detail() const;
  /// Whether one of the files has the input's attributes.
  [[nodiscard]] bool carryAttributes() const;
  /// Whether one of the files is standard output.
  [[nodiscard]] bool useStandardOutput() const;
};

/// Returns the formats of files of lines.
std::vector<const EdgesFormat*> formatsOf(const std::vector<EdgesTarget>& targets);

/// Returns what readers need so that --id can name each site; none without --id.
std::optional<NeededAttribute> neededFor(const CellsTargets& targets);

/// Returns the attribute of --id; null without it. Error (input): there is none of that name.
Result<const Attribute*> namesOf(const CellsTargets& targets, std::span<const Attribute> attributes);

/// Error (input): a file, or its format, is of cells in space.
Result<void> refuseFilesOfSpace(const CellsTargets& targets);

/// -o, --edges, --triangulation, --id, --voro-format, --share, --only-cells, --detail
void addCellsTargets(Options& options, CellsTargets& targets);

/// Returns a note that GeoJSON has coordinates of a plane without its name, which readers take for degrees;
/// empty if it has not.
std::string noteOnGeoJson(const CellsTargets& targets, const CoordinateSystem& system);

/// Sets the format of standard output: the extension `kind` without its dot, or csv. Also rejects
/// contradictions. Errors (input): the kind is no format of cells; standard output is named twice;
/// --only-cells has nothing to leave out; --id or --share has no output that holds it; --detail measures, for
/// which .npz has a format of its own, has another output.
Result<void> takeFormat(CellsTargets& targets, const std::string& kind);

}  // namespace vorpipe::cli
