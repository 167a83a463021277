/// The edges of cells found as polygons, as solvers need them.
#pragma once

#include <span>

#include "vorpipe.h"

namespace vorpipe::core {

/// The data of a diagram that its edges need.
struct CellPolygons {
  std::vector<Point> vertices{};
  std::vector<double> edge_lengths{};
  std::vector<std::uint64_t> ring_starts{};
};

/// The surroundings of polygons. All of it outlives the call.
struct PolygonScene {
  const Sites& places;  ///< of the sites, as from wrapped()
  const Box& domain;
  Periodic periodic;
  const Density& density;  ///< may be empty
  int threads;
};

/// Returns the edges of cells with these neighbors, `meet`, and these polygons.
EdgesOfCells edgesOf(const CellPolygons& polygons, const CellsThatMeet& meet, const PolygonScene& scene);

}  // namespace vorpipe::core
