/// The parcels of a fluid, and one time step of them, by each scheme.
#pragma once

#include <cstdint>
#include <vector>

#include "motion/movable.h"
#include "motion/prescribed_cells.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::moving {

/// Cells with their velocities, in an order in which neighbors are near each other in memory. All arrays
/// except `order` follow that order.
struct Parcels {
  std::vector<std::uint32_t> order;  ///< the caller's index of each parcel
  Sites sites;
  std::vector<Point> velocity;
  std::vector<double> volume, mass, pressure;
  std::vector<double> trend;        ///< of weights: their last change per time
  std::vector<Point> acceleration;  ///< of springs and gravity, where the sites are now
  std::vector<Point> off_center;    ///< from the sites to the centroids, where options ask for centering
  Point carried{0, 0};              ///< as in FluidState

  [[nodiscard]] std::size_t size() const { return sites.size(); }
};

/// Makes parcels of a state. Chooses an order if the state has none. The state has velocities and volumes for
/// all sites.
Parcels parcelsOf(const FluidState& state, const Box& domain);

/// Writes all that changes back in the caller's order.
void backFrom(const Parcels& parcels, FluidState& state);

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

  /// Measures energies, momentum and errors of the parcels placed last, at the time of the step.
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
  void keepInside(Parcels& parcels) const;
  void accelerate(Parcels& parcels) const;
  Result<void> diffuse(Parcels& parcels, double time);

  const FluidOptions& options_;
  int threads_;
  double spacing_;
  double stiffness_;  ///< of springs, by volume
  PrescribedCells cells_;
  AllowedPlaces allowed_;
  std::uint64_t diagrams_ = 0, iterations_ = 0;
};

}  // namespace vorpipe::moving
