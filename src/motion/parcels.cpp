#include "motion/parcels.h"

#include "motion/memory_order.h"

namespace vorpipe::moving {
namespace {

template <class Value>
std::vector<Value> taken(const std::vector<Value>& from, const std::vector<std::uint32_t>& order) {
  std::vector<Value> to(from.empty() ? 0 : order.size());
  for (std::size_t k = 0; k < to.size(); ++k) to[k] = from[order[k]];
  return to;
}

template <class Value>
void putBack(const std::vector<Value>& from, const std::vector<std::uint32_t>& order,
             std::vector<Value>& to) {
  to.resize(from.size());
  for (std::size_t k = 0; k < from.size(); ++k) to[order[k]] = from[k];
}

}  // namespace

Parcels parcelsOf(const FluidState& state, const Box& domain) {
  Parcels parcels;
  parcels.order = state.order.empty() ? memoryOrder(state.sites, domain) : state.order;
  parcels.sites = inOrder(state.sites, parcels.order);
  parcels.velocity = taken(state.velocity, parcels.order);
  parcels.volume = taken(state.volume, parcels.order);
  parcels.pressure = taken(state.pressure, parcels.order);
  parcels.trend = taken(state.trend, parcels.order);
  parcels.carried = state.carried;
  parcels.mass = parcels.volume;
  const std::vector<double> density = taken(state.density, parcels.order);
  for (std::size_t i = 0; i < density.size(); ++i) parcels.mass[i] *= density[i];
  return parcels;
}

void backFrom(const Parcels& parcels, FluidState& state) {
  state.order = parcels.order;
  state.carried = parcels.carried;
  putBack(parcels.sites.x, parcels.order, state.sites.x);
  putBack(parcels.sites.y, parcels.order, state.sites.y);
  putBack(parcels.sites.weight, parcels.order, state.sites.weight);
  putBack(parcels.velocity, parcels.order, state.velocity);
  putBack(parcels.pressure, parcels.order, state.pressure);
  putBack(parcels.trend, parcels.order, state.trend);
}

}  // namespace vorpipe::moving
