/// What `cells` writes: files of cells and of edges.
#pragma once

#include <string>
#include <vector>

#include "cli/options/command_line.h"
#include "io/cells/cells_file.h"
#include "io/cells/edges_file.h"
#include "vorpipe.h"

namespace vorpipe::cli {

struct CellsTarget {
  std::string path;
  const CellsFormat* format;  ///< null for standard output until takeFormat()
};

struct EdgesTarget {
  std::string path;
  const EdgesFormat* format;
};

struct CellsTargets {
  std::vector<CellsTarget> cells;
  std::vector<EdgesTarget> edges;
  bool only_cells = false;
  bool only_measures = false;

  /// The paths of all, in the order in which they are created.
  [[nodiscard]] std::vector<std::string> paths() const;
  /// The parts of a Diagram that they take.
  [[nodiscard]] Detail detail() const;
  [[nodiscard]] std::vector<const EdgesFormat*> edgesFormats() const;
  /// Whether one of them has the input's attributes.
  [[nodiscard]] bool carryAttributes() const;
  /// Whether one of them is standard output.
  [[nodiscard]] bool useStandardOutput() const;
};

/// -o, --edges, --only-cells, --detail
void addCellsTargets(Options& options, CellsTargets& targets);

/// Gives what goes to standard output its format, the extension `kind` without its dot, or csv; and refuses
/// what contradicts itself. Errors (input): the kind is none of cells; standard output is named twice;
/// --only-cells has nothing to leave out; --detail measures, for which .npz has a format of its own, has
/// another output.
Result<void> takeFormat(CellsTargets& targets, const std::string& kind);

}  // namespace vorpipe::cli
