/// The parcels of a fluid.
#pragma once

#include <cstdint>
#include <vector>

#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::moving {

/// Cells with their velocities, in an order in which neighbors are near each other in memory. All arrays
/// except `order` follow that order.
struct Parcels {
  std::vector<std::uint32_t> order;  ///< by place, the caller's index
  Sites sites;
  std::vector<Point> velocity;
  std::vector<double> volume, mass, pressure;
  std::vector<double> trend;        ///< of weights: their last change per time
  std::vector<Point> acceleration;  ///< of springs and gravity, where the sites are now
  Point carried{0, 0};              ///< as in FluidState

  [[nodiscard]] std::size_t size() const { return sites.size(); }
};

/// Makes parcels of a state. Chooses an order if the state has none. The state has velocities and volumes for
/// all sites.
Parcels parcelsOf(const FluidState& state, const Box& domain);

/// Writes all that changes back in the caller's order.
void backFrom(const Parcels& parcels, FluidState& state);

}  // namespace vorpipe::moving
