/// The results of `vorpipe compare`: all backends, and every pair of them.
#pragma once

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

struct PairDiff {
  std::size_t a = 0, b = 0;  ///< indices into Comparison::runs
  IdDiff pixels;
  std::uint64_t statuses = 0;  ///< sites of different status or owner in the pictures
  CellsDiff cells;
  [[nodiscard]] bool agree() const { return pixels.agree() && statuses == 0 && cells.agree(); }
};

struct Comparison {
  std::vector<BackendRun> runs;
  std::vector<PairDiff> pairs;
};

/// Compares every pair of runs. All have pictures of the same size, and cells of the input's domain.
Result<std::vector<PairDiff>> comparePairs(const std::vector<BackendRun>& runs, const Input& input,
                                           const RenderOptions& options);

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

/// Returns a montage. Above: the pictures side by side; below: a gray picture for each pair with its
/// differences marked.
Picture comparisonMontage(const Comparison& comparison);

}  // namespace vorpipe::cli
