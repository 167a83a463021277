/// The edges of cells that were found as polygons, as solvers ask for them.
#pragma once

#include <span>

#include "vorpipe.h"

namespace vorpipe::core {

/// What of a diagram is kept for its edges.
struct CellPolygons {
  std::vector<Point> vertices{};
  std::vector<double> edge_lengths{};
  std::vector<std::uint64_t> ring_starts{};
};

/// Where polygons stand. All of it outlives the call.
struct PolygonScene {
  const Sites& places;  ///< of the sites, as wrapped() has them
  const Box& domain;
  Periodic periodic;
  const Density& density;  ///< may be none
  int threads;
};

/// Of cells that meet as `meet` says and have these polygons.
EdgesOfCells edgesOf(const CellPolygons& polygons, const CellsThatMeet& meet, const PolygonScene& scene);

}  // namespace vorpipe::core
