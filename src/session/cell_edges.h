/// The edges of cells as solvers need them.
#pragma once

#include <span>

#include "domain/density_pixels.h"
#include "session/box_moments.h"
#include "session/disc_cells.h"
#include "vorpipe.h"

namespace vorpipe::core {

/// Returns the edges of cells that findMoments() found, in the order of `meet`, the result of neighborsOf()
/// for them. `pixels` is null if there is no density.
EdgesOfCells edgesOf(const FoundBox& found, const CellsThatMeet& meet, const DensityPixels* pixels,
                     int threads);

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
/// Returns the edges of cells that cutByDiscs() cut, as edgesOf() does.
EdgesOfCells edgesInDiscs(const FoundBox& found, const FreeSurface& surface, const CellsThatMeet& meet,
                          int threads);

}  // namespace vorpipe::core
