/// Shared parts of the memory forecasts for cells and for pictures.
#pragma once

#include "backend/device_needs.h"
#include "vorpipe.h"

namespace vorpipe::core {

/// The arrays of a Prepared with its grid, by purpose.
struct PlannedSet {
  std::vector<MemoryPlan::Array> sites;  ///< x, y, id, weight, and the grid
  MemoryPlan::Array owner;
};

/// Plans prepare().
PlannedSet planPrepare(MemoryPlan& plan, std::uint64_t sites, bool weighted);

/// Plans the memory of a backend: sites and their grid on the device, and compilation.
void planUpload(MemoryPlan& plan, const Workload& work, std::uint64_t sites, bool drawn);

/// Plans triangulate() of all sites, since a device may leave any number of cells unsolved. Returns the mesh.
std::vector<MemoryPlan::Array> planMesh(MemoryPlan& plan, const Workload& work, std::uint64_t sites);

using Arrays = std::vector<MemoryPlan::Array>;

inline void append(Arrays& to, const Arrays& from) { to.insert(to.end(), from.begin(), from.end()); }

/// The memory that cells take, by lifetime.
struct PlannedCells {
  Arrays diagram;
  Arrays run;  ///< if a picture follows: the sites, and the neighbors of cells
};

/// Plans findCells, and mass.
PlannedCells planCellsFor(MemoryPlan& plan, const Workload& work, Detail detail, ImagesFor purpose);

/// Plans a reserve of 1/24 of the peak so far. It covers what is smaller than arrays by site. It also covers
/// gaps, since threads allocate arrays in any order.
MemoryPlan::Array planReserve(MemoryPlan& plan);

/// Returns the largest number of cells per request to a device, for planning. It keeps the planned requests
/// few, and plans long runs with the longest requests.
std::uint64_t plannedStep(std::uint64_t sites);

/// How many devices share the cells.
std::uint64_t plannedDevices(const DeviceNeeds& needs, std::uint64_t sites);

/// Returns a fraction of a number, rounded up.
std::uint64_t partOf(std::uint64_t number, double part);

inline DeviceNeeds needsOf(const Workload& work) { return deviceNeeds(work.backend, work.threads); }

inline constexpr std::uint64_t word = 4, number = 8, point = 16;

}  // namespace vorpipe::core
