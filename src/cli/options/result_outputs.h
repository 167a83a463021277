/// The outputs of `relax` and `transport`: files of sites, cells and pictures, and the trace.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/cells_outputs.h"
#include "cli/options/command_line.h"
#include "cli/options/options.h"
#include "cli/options/picture_files.h"
#include "io/cells/points_file.h"

namespace vorpipe::cli {

struct PointsTarget {
  std::string path;
  const PointsFormat* format;  ///< null for standard output until takeFormat()
};

struct ResultTargets {
  std::vector<PointsTarget> points;
  std::vector<CellsTarget> cells;
  std::vector<PictureFile> pictures;
  std::string trace;        ///< empty: not requested
  std::string frames;       ///< a film or a folder, with a picture of each diagram; empty: not requested
  std::uint64_t every = 0;  ///< diagrams between two numbered files of each; 0: no numbered files

  /// Returns the paths of sites, cells and pictures, in the order in which they are created; the trace comes
  /// after them.
  [[nodiscard]] std::vector<std::string> paths() const;
  /// The same, followed by the nonempty paths of `others`.
  [[nodiscard]] std::vector<std::string> pathsWith(std::initializer_list<std::string> others) const;
  /// The same with a number before each extension: sites-0010.csv.
  [[nodiscard]] std::vector<std::string> numberedPaths(std::uint64_t diagram) const;
  /// Returns the parts of a Diagram that files of cells need.
  [[nodiscard]] Detail detail() const;
  [[nodiscard]] bool carryAttributes() const;
  [[nodiscard]] bool useStandardOutput() const;
};

/// -o, --cells, --picture; `sites` describes the contents of -o.
void addResultTargets(Options& options, ResultTargets& targets, std::string_view sites);
/// The same, and --trace, --save-every and --frames.
void addRelaxTargets(Options& options, ResultTargets& targets);

/// Sets the format of standard output: that of --format, or csv. Also rejects contradictions. Errors (input):
/// the kind is no format of sites, or no output uses it; standard output is named twice; --save-every has no
/// file to number.
Result<void> takeFormat(ResultTargets& targets, const InputOptions& input);

}  // namespace vorpipe::cli
