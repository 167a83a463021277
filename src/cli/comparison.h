/// The results of `vorpipe compare`: all backends, the picture that is kept, and every pair of them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/difference.h"
#include "cli/input.h"
#include "vorpipe.h"

namespace vorpipe::cli {

struct BackendRun {
  std::string name;  ///< as in --backends
  Rendering rendering;
  Diagram cells;
  double render_ms = 0, cells_ms = 0;
  std::vector<std::string> broken{};  ///< broken promises that a check found
  std::string choice{};               ///< why this device was chosen, if the name leaves a choice
};

/// Ids, or a picture in colors, that an earlier run wrote.
struct Reference {
  std::string path;
  Image image;  ///< has ids or rgba
};

/// Reads ids (.npy) or a picture (.png). Errors: those of readNpyIds and readPng.
Result<Reference> readReference(const std::string& path);

struct PairDiff {
  std::size_t a = 0, b = 0;  ///< indices into Comparison::runs; their number stands for the reference
  IdDiff pixels;
  std::uint64_t statuses = 0;        ///< sites of different status or owner in the pictures
  std::optional<CellsDiff> cells{};  ///< none with the reference
  [[nodiscard]] bool agree() const { return pixels.agree() && statuses == 0 && (!cells || cells->agree()); }
};

struct Comparison {
  std::vector<BackendRun> runs;
  std::optional<Reference> reference{};
  std::vector<PairDiff> pairs{};

  /// The name of a run, or the reference's path.
  [[nodiscard]] const std::string& nameOf(std::size_t index) const {
    return index < runs.size() ? runs[index].name : reference->path;
  }
};

/// Compares every pair of runs, and each run with the reference. All have pictures of the same size, and
/// cells of the input's domain. Ids of a reference in colors are those of the run's pixels, the same or one
/// beside, that have its color. Errors: those of diffIds and diffCells.
Result<void> comparePairs(Comparison& comparison, const Input& input, const RenderOptions& options);

/// Returns the tables for human readers.
std::string comparisonTable(const Comparison& comparison);

/// Returns, in one line, which pairs differ, and how the first of them does; empty when all agree.
std::string disagreementText(const Comparison& comparison);

/// Returns a report of all runs together: sums, and the names of backends and devices. The statuses are those
/// of the first run's cells.
Report reportOf(const Comparison& comparison);

/// Returns why devices were chosen, for all runs with a choice.
std::string choiceOf(std::span<const BackendRun> runs);

/// Returns the object that `--report` writes, with a line end; without values that vary between runs if
/// `times` is false.
std::string comparisonJson(const Comparison& comparison, const Input& input, bool times);

/// Returns a montage. Above: the pictures side by side, the reference last; below: a gray picture for each
/// pair with its differences marked. A heading of two lines says what each one is.
Picture comparisonMontage(const Comparison& comparison);

/// Returns the height of these headings over pictures of a width, in pixels.
int headingHeight(int width);

}  // namespace vorpipe::cli
