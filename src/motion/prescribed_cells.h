/// Cells of prescribed masses around sites that may move from one time to the next.
#pragma once

#include <memory>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::moving {

/// What is asked of one time; `diagrams` and `tolerance` as in TransportOptions.
struct PrescribedLimits {
  double tolerance = 1e-8;
  std::uint64_t diagrams = 400;
};

/// Memory and the linear solver stay from one time to the next. The session outlives this.
class PrescribedCells {
 public:
  /// `masses` are by site, and what TransportOptions says of them holds.
  PrescribedCells(Session& session, const CellsOptions& options, Surface surface, std::vector<double> masses);
  PrescribedCells(PrescribedCells&&) noexcept;
  PrescribedCells& operator=(PrescribedCells&&) noexcept;
  ~PrescribedCells();

  /// Finds the weights of `sites`, which are best in memoryOrder(). It begins with the weights that they come
  /// with, where they have any and these leave every cell some of its mass. They end with the weights that
  /// were found, whatever the end says. Errors: those of Session::cells; two sites at one place.
  Result<TransportEnd> solve(Sites& sites, const PrescribedLimits& limits,
                             const TransportWatcher& watcher = {});

  /// Whether cells() are those of the weights that solve() left: not if progress stopped it in a diagram.
  [[nodiscard]] bool areMeasured() const;
  /// The cells of the sites and weights that solve() left.
  [[nodiscard]] const MovingCells& cells() const;
  /// Each diagram of the last solve().
  [[nodiscard]] const std::vector<TransportStep>& trace() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::moving
