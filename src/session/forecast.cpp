#include "session/forecast.h"

#include <algorithm>
#include <cmath>

#include "geometry/mesh.h"
#include "sites/grid.h"

namespace vorpipe::core {
namespace {

std::uint64_t binsOf(std::uint64_t sites) {
  return static_cast<std::uint64_t>(static_cast<double>(sites) / sites_per_bin) + 1;
}

}  // namespace

std::uint64_t partOf(std::uint64_t number_, double part) {
  return static_cast<std::uint64_t>(std::ceil(static_cast<double>(number_) * part));
}

MemoryPlan::Array planReserve(MemoryPlan& plan) {
  // Longer than any gap between other arrays.
  constexpr std::uint64_t longest = std::uint64_t{1} << 50;
  return plan.take("a reserve", longest, plan.peak() / 24);
}

std::uint64_t plannedStep(std::uint64_t sites) {
  constexpr std::uint64_t usual = std::uint64_t{1} << 18, most_steps = 16;
  return std::max(std::min(sites, usual), (sites + most_steps - 1) / most_steps);
}

std::uint64_t plannedDevices(const DeviceNeeds& needs, std::uint64_t sites) {
  return std::clamp<std::uint64_t>(sites / cells_per_device, 1, needs.devices);
}

PlannedSet planPrepare(MemoryPlan& plan, std::uint64_t sites, bool weighted) {
  const std::string_view what = "sites in their bins";
  const auto by_input = plan.take(what, weighted ? sites * number : 0);
  constexpr std::uint64_t placed_bytes = 2 * number + 2 * word;
  const auto placed = plan.take("sorting sites into bins", sites * placed_bytes);
  PlannedSet set;
  for (const auto bytes : {number, number, word}) set.sites.push_back(plan.take(what, sites * bytes));
  set.owner = plan.take("owners of sites", sites * word);
  set.sites.push_back(plan.take(what, binsOf(sites) * word));
  plan.drop(placed);
  if (weighted) {
    set.sites.push_back(plan.take(what, sites * number));
    const auto all = plan.take(what, sites * word);
    plan.drop(all);
    // The numbers of the bins, and a third as many for the levels above.
    set.sites.push_back(plan.take(what, binsOf(sites) * number * 4 / 3));
  }
  plan.drop(by_input);
  return set;
}

void planUpload(MemoryPlan& plan, const Workload& work, std::uint64_t sites, bool drawn) {
  const DeviceNeeds needs = needsOf(work);
  const auto compiling = plan.take("the driver", needs.compiling);
  plan.drop(compiling);
  if (!work.device_on_host) return;
  const std::string_view what = "sites on the device";
  const auto devices = plannedDevices(needs, sites);
  plan.take("the driver", (devices - 1) * needs.further_device);
  for (std::uint64_t device = 0; device < devices; ++device) {
    plan.take(what, binsOf(sites) * needs.bin);
    const auto passing = plan.take(what, sites * needs.passing_site);
    plan.take(what, sites * needs.site);
    plan.drop(passing);
    if (work.weighted) {
      plan.take(what, sites * needs.weight);
      plan.take(what, binsOf(sites) * needs.heaviest * 4 / 3);
    }
    if (drawn) plan.take(what, sites * needs.mark);
  }
}

std::vector<MemoryPlan::Array> planMesh(MemoryPlan& plan, const Workload& work, std::uint64_t sites) {
  const std::string_view what = "the triangulation of sites";
  constexpr std::uint64_t on_curve = 16;
  const auto site = plan.take(what, sites * word);
  const auto placed = plan.take(what, sites * on_curve), other = plan.take(what, sites * on_curve);
  plan.drop({placed, other});
  const auto points = plan.take(what, sites * point);
  const auto weights = plan.take(what, work.weighted ? sites * number : 0);
  const auto order = plan.take(what, sites * word);
  const auto triangles = plan.take(what, 2 * sites * sizeof(MeshTriangle));
  const auto cavity = plan.take(what, work.weighted ? 2 * sites : 0);
  const auto near = plan.take(what, sites * word);
  const auto left = plan.take(what, sites * word);
  const auto region = plan.take(what, 3 * sites);
  const auto of_parts = plan.take(what, sites * word);
  plan.drop({of_parts, left});
  const auto at = plan.take(what, sites * word);
  plan.drop({region, near, cavity, order});
  return {site, points, weights, triangles, at};
}

}  // namespace vorpipe::core

namespace vorpipe {

void planSession(MemoryPlan& plan, const Workload& work) {
  plan.take("the program, its libraries and the driver", core::needsOf(work).program);
  if (work.beside_drivers) plan.take("drivers that were looked through for hardware", looked_through_bytes);
}

}  // namespace vorpipe
