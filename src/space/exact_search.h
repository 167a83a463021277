/// Cells that proposals leave in dispute, by exact signs.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "space/cell_memo.h"
#include "space/exact_cell.h"
#include "space/site_bins.h"
#include "space/weighted_candidates.h"

namespace vorpipe::space {

/// Cells by exact signs, one after another; one for each thread.
class ExactSearch {
 public:
  explicit ExactSearch(const SiteBins& bins)
      : bins_(bins), cell_(bins.places(), 0), memo_(bins), by_power_(bins) {}
  /// The exact cell of a site, cut by all sites that can cut it. It is valid until the next. `around` are
  /// those within the root of `squared_reach`, if they are known.
  const ExactCell& cellOf(Label site, std::span<const Label> around = {}, double squared_reach = 0);
  /// The same as a row, computed only if no cell with the same surroundings was.
  const ExactRow& rowOf(Label site);
  /// Why the last cell is empty, if it is.
  [[nodiscard]] const NoCell& emptiedBy() const { return cell_.emptiedBy(); }
  /// How many rows were known.
  [[nodiscard]] std::size_t known() const { return memo_.found(); }

 private:
  struct Candidate {
    double squared;  ///< distance
    Label site;
    bool operator<(const Candidate& other) const {
      return squared < other.squared || (squared == other.squared && site < other.site);
    }
  };
  [[nodiscard]] double squaredReach() const;
  const ExactCell& weightedCellOf(Label site);
  void begin(Label site);
  double takeAround(Label site, std::span<const Label> around, double squared_reach);
  Label next(double limit);
  void addShell(double limit);
  void addLine(int x, int end, int y, int z, double limit);

  const SiteBins& bins_;
  ExactCell cell_;
  CellMemo memo_;
  ExactRow row_;
  WeightedCandidates by_power_;
  Label site_ = 0;
  Point3 from_{};
  int bin_[3] = {}, shell_ = 0, last_shell_ = 0;
  double last_reach_ =
      std::numeric_limits<double>::infinity();  ///< squared, of the last cell; with weights its radius
  double certain_ = 0;                          ///< all sites whose squared distance is less are found
  std::vector<Candidate> found_;  ///< up to `sorted_` ascending, and all others are beyond `certain_`
  std::size_t next_ = 0, sorted_ = 0;
};

}  // namespace vorpipe::space
