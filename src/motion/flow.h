/// One step of a fluid's parcels, by each scheme.
#pragma once

#include <cstdint>

#include "motion/parcels.h"
#include "motion/prescribed_cells.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::moving {

/// Moves parcels, and keeps their areas.
class Flow {
 public:
  Flow(Session& session, const FluidOptions& options, const Parcels& parcels);

  /// Finds the cells of the parcels where they are, and what accelerates them; `time` since they had others.
  /// Whether all have their areas.
  Result<bool> place(Parcels& parcels, double time = 0);
  /// A step of that much time. Whether all cells have their areas at its end; if not, the parcels are
  /// somewhere on their way.
  Result<bool> advance(Parcels& parcels, double length);
  /// The time of the next step, where the options leave it open.
  [[nodiscard]] double length(const Parcels& parcels) const;

  /// Energies, momentum and errors of parcels that were placed last.
  void measure(const Parcels& parcels, FluidStep& step) const;
  /// Diagrams and iterations since the last call are added.
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
