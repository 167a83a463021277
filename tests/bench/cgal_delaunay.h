/// The yardstick: CGAL's Delaunay triangulation.
#pragma once

#include <cstddef>

#include "vorpipe.h"

namespace vorpipe::test {

struct Triangulated {
  std::size_t triangles;
  double seconds;  ///< of Delaunay_triangulation_2's range insertion; points are CGAL's own before
};

Triangulated triangulate(const Sites& sites);

}  // namespace vorpipe::test
