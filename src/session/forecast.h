/// What forecasts of cells and of pictures have in common.
#pragma once

#include "backend/device_needs.h"
#include "vorpipe.h"

namespace vorpipe::core {

/// The arrays of a Prepared with its grid, by what they are for.
struct PlannedSet {
  std::vector<MemoryPlan::Array> sites;  ///< x, y, id, weight, and the grid
  MemoryPlan::Array owner;
};

/// Plans prepare().
PlannedSet planPrepare(MemoryPlan& plan, std::uint64_t sites, bool weighted);

/// Plans what a backend is given: sites and their grid on the device, and what it compiles.
void planUpload(MemoryPlan& plan, const Workload& work, std::uint64_t sites, bool drawn);

/// Plans triangulate() of all sites: a device may leave any number of cells. Returns the mesh.
std::vector<MemoryPlan::Array> planMesh(MemoryPlan& plan, const Workload& work, std::uint64_t sites);

using Arrays = std::vector<MemoryPlan::Array>;

inline void append(Arrays& to, const Arrays& from) { to.insert(to.end(), from.begin(), from.end()); }

/// What cells take, by how long they stay.
struct PlannedCells {
  Arrays diagram;
  Arrays run;  ///< where a picture follows: the sites, and the neighbors of cells
};

/// Plans findCells, and mass.
PlannedCells planCellsFor(MemoryPlan& plan, const Workload& work, Detail detail, ImagesFor purpose);

/// Plans a reserve of 3 % of what there is so far: for what is smaller than arrays by site, and because
/// threads take arrays in any order, so that they fit together in one way or another.
MemoryPlan::Array planReserve(MemoryPlan& plan);

/// The cells that a session asks a device about at a time, at most: so that few times are planned, and long
/// runs are planned for the longest steps.
std::uint64_t plannedStep(std::uint64_t sites);

/// How many devices share the cells.
std::uint64_t plannedDevices(const DeviceNeeds& needs, std::uint64_t sites);

/// A part of a number, rounded up.
std::uint64_t partOf(std::uint64_t number, double part);

inline DeviceNeeds needsOf(const Workload& work) { return deviceNeeds(work.backend, work.threads); }

inline constexpr std::uint64_t word = 4, number = 8, point = 16;

}  // namespace vorpipe::core
