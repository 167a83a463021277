/// Natural neighbors (Sibson 1981, "A brief description of natural neighbour interpolation").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "triangles.h"

namespace vorpipe::python {

/// An exact Delaunay triangulation.
struct Delaunay : Mesh {
  std::vector<Point> points;
};

/// By place, rows of sites, ascending, and of weights, which are more than 0 and add up to 1.
struct NaturalNeighbors {
  std::vector<std::int64_t> offsets;  ///< places + 1
  std::vector<std::int32_t> sites;
  std::vector<double> weights;
};

/// A site's weight is the part that the cell of the place, if it had one, would have of the site's, in the
/// whole plane. On the hull of the sites it is shared by two, at a site it is 1; beyond the hull, and where a
/// place is not finite, there are none. The same for any number of threads.
NaturalNeighbors naturalNeighbors(const Delaunay& mesh, std::span<const Point> places, int threads);

}  // namespace vorpipe::python
