/// One time step of a fluid's parcels, by each scheme.
#pragma once

#include <cstdint>

#include "motion/parcels.h"
#include "motion/prescribed_cells.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::moving {

/// Moves parcels and preserves their areas.
class Flow {
 public:
  Flow(Session& session, const FluidOptions& options, const Parcels& parcels);

  /// Finds the cells and the accelerations of the parcels at their present places; `time` is the time since
  /// their last cells. Returns whether all cells have their areas.
  Result<bool> place(Parcels& parcels, double time = 0);
  /// Makes a step of that much time. Returns whether all cells have their areas at its end; if not, the
  /// parcels stop at some point along their way.
  Result<bool> advance(Parcels& parcels, double length);
  /// Returns the time of the next step, if the options leave it open.
  [[nodiscard]] double length(const Parcels& parcels) const;

  /// Measures energies, momentum and errors of the parcels placed last.
  void measure(const Parcels& parcels, FluidStep& step) const;
  /// Adds the diagrams and iterations since the last call.
  void count(FluidStep& step);
  [[nodiscard]] const Report& report() const { return cells_.cells().report(); }

 private:
  Result<bool> springs(Parcels& parcels, double length);
  Result<bool> reflection(Parcels& parcels, double length);
  Result<bool> place(Parcels& parcels, double time, double tolerance);
  Result<bool> areas(Parcels& parcels, double time, double tolerance);
  Result<void> wrap(Parcels& parcels) const;
  void drift(Parcels& parcels, double time) const;
  void accelerate(Parcels& parcels) const;

  const FluidOptions& options_;
  int threads_;
  double spacing_;
  double stiffness_;  ///< of springs, by volume
  PrescribedCells cells_;
  std::uint64_t diagrams_ = 0, iterations_ = 0;
};

}  // namespace vorpipe::moving
