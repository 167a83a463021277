/// What `vorpipe compare` found: backends side by side, and every pair of them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/difference_picture.h"
#include "cli/input.h"
#include "vorpipe.h"

namespace vorpipe::cli {

struct BackendRun {
  std::string name;  ///< as --backends has it
  Rendering rendering;
  Diagram cells;
  double render_ms = 0, cells_ms = 0;
  std::vector<std::string> broken{};  ///< promises that a check found broken
  std::string choice{};               ///< why this device was taken, where the name leaves a choice
};

struct PairDiff {
  std::size_t a = 0, b = 0;  ///< of Comparison::runs
  IdDiff pixels;
  std::uint64_t statuses = 0;  ///< sites of different status or owner in the pictures
  CellsDiff cells;
  [[nodiscard]] bool agree() const { return pixels.agree() && statuses == 0 && cells.agree(); }
};

struct Comparison {
  std::vector<BackendRun> runs;
  std::vector<PairDiff> pairs;
};

/// Compares every pair of runs; all are pictures of the same size and cells of the input's domain.
Result<std::vector<PairDiff>> comparePairs(const std::vector<BackendRun>& runs, const Input& input,
                                           const RenderOptions& options);

/// The tables for people.
std::string comparisonTable(const Comparison& comparison);

/// Which pairs differ and what in the first of them, in one line; empty when all agree.
std::string disagreementText(const Comparison& comparison);

/// What all runs did together: sums, and the names of the backends and devices. The statuses are those of the
/// first run's cells.
Report reportOf(const Comparison& comparison);

/// Why devices were taken, of all runs that had a choice.
std::string choiceOf(std::span<const BackendRun> runs);

/// The object that `--report` writes, with a line's end; without what no run has again, if `times` is false.
std::string comparisonJson(const Comparison& comparison, const Input& input, bool times);

/// Above, the pictures side by side; below, a gray picture for each pair with its differences marked.
Picture comparisonMontage(const Comparison& comparison);

}  // namespace vorpipe::cli
