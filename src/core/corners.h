/// Where cells meet: positions that all cells of a vertex share, and whether the cells agree.
#pragma once

#include "backend/backend.h"
#include "core/topology.h"

namespace vorpipe {

/// The corners of all cells. Corner e is where edge e of the topology begins. Corners that are the same
/// vertex have the same root, and so the same position, to the bit.
struct Corners {
  std::vector<Point> position;      ///< scaled units
  std::vector<std::uint64_t> root;  ///< a corner of the same vertex
  std::vector<std::uint64_t> next;  ///< the corner where the edge ends
  std::vector<bool> tie;            ///< the edge is too short to count
};

struct Agreement {
  Corners corners;
  std::vector<std::uint32_t> disputed;  ///< cells, ascending, whose edges their neighbors do not have
};

/// Computes the corners from the cells' neighbors. A corner's position follows from the three sites
/// that meet there, in the order of their input indices (or two sites and a wall), by one formula
/// whichever cell asks. An edge is a tie when it is shorter than 1e-6 of the distance between its two
/// sites, seen from either.
Agreement agreeOnCorners(const SiteSet& sites, const Topology& topology, int threads);

}  // namespace vorpipe
