/// Cells of prescribed masses around sites that may move between solutions.
#pragma once

#include <memory>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::moving {

/// Limits of one solution; `diagrams` and `tolerance` as in TransportOptions.
struct PrescribedLimits {
  double tolerance = 1e-8;
  std::uint64_t diagrams = 400;
};

/// Keeps memory and the linear solver between solutions. The session outlives this.
class PrescribedCells {
 public:
  /// `masses` are by site, with the same conditions as in TransportOptions.
  PrescribedCells(Session& session, const CellsOptions& options, Surface surface, std::vector<double> masses);
  PrescribedCells(PrescribedCells&&) noexcept;
  PrescribedCells& operator=(PrescribedCells&&) noexcept;
  ~PrescribedCells();

  /// Finds the weights of `sites`, which are best in memoryOrder(). Starts with the present weights of
  /// `sites`, if there are any and they leave every cell some of its mass. Afterwards `sites` have the
  /// weights found, whatever the returned end. Errors: those of Session::cells; two sites at one place.
  Result<TransportEnd> solve(Sites& sites, const PrescribedLimits& limits,
                             const TransportWatcher& watcher = {});

  /// Whether cells() are those of the weights from solve(): false if progress stopped it during a diagram.
  [[nodiscard]] bool areMeasured() const;
  /// Returns the cells of the sites and weights from the last solve().
  [[nodiscard]] const MovingCells& cells() const;
  /// Returns each diagram of the last solve().
  [[nodiscard]] const std::vector<TransportStep>& trace() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::moving
