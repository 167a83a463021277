/// What a fluid is made of.
#pragma once

#include <cstdint>
#include <vector>

#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::moving {

/// Cells with their velocities, in an order in which neighbors are near each other in memory. All but the
/// order are of that order.
struct Parcels {
  std::vector<std::uint32_t> order;  ///< for each place the caller's index
  Sites sites;
  std::vector<Point> velocity;
  std::vector<double> volume, mass, pressure;
  std::vector<double> trend;        ///< of weights: by how much they changed last, per time
  std::vector<Point> acceleration;  ///< of springs and gravity, where the sites are now
  Point carried{0, 0};              ///< as a state has it

  [[nodiscard]] std::size_t size() const { return sites.size(); }
};

/// Where the state has no order, one is chosen. The state has velocities and volumes for all sites.
Parcels parcelsOf(const FluidState& state, const Box& domain);

/// Puts what changes back into the caller's order.
void backFrom(const Parcels& parcels, FluidState& state);

}  // namespace vorpipe::moving
