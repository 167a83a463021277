/// The Delaunay triangulation of points in any position, degenerate ones included.
#pragma once

#include <vector>

#include "geometry/mesh.h"
#include "vorpipe.h"

namespace vorpipe::core {

/// Triangulates distinct points with exact predicates; with weights it is the regular triangulation. Ties of
/// cocircular points are broken by their positions (inCirclePerturbed). So the mesh is unique, whatever the
/// order of the points and the number of threads; only the numbers of its triangles depend on these. A point
/// whose cell has no area is hidden. Empty if all lie on a line. Points near each other in the plane should
/// be near each other in the order: then walks are short, and most insertions run on several threads.
/// Coordinates: as in predicates.h; or up to 2^300, then with differences not below 2^-136.
Mesh delaunay(const std::vector<Point>& points, const std::vector<double>& weights = {}, int threads = 1);

}  // namespace vorpipe::core
