/// Cells on the whole Earth: see CellsOptions::globe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vorpipe/cells.h"
#include "vorpipe/outline.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

/// An outline on the globe, in degrees, mended as in mendedToPlane(): sides are straight in longitude and
/// latitude, with points added in between, and what a file cuts at longitude 180 or leads to a pole is one
/// again. Errors (input): those of mendedToPlane(); the outline goes around the Earth on all sides.
Result<MendedOutline> mendedOnGlobe(const Outline& degrees, bool repair);

/// The polygons of a cell on the globe, in degrees. A cell is cut at longitude 180, and a ring around a pole
/// follows it, as RFC 7946 asks (3.1.9). Edges are great circles, with points in between: a quarter of a
/// degree apart or less, so many that straight lines of longitude and latitude are within 1e-5 of the Earth's
/// radius. None for a site without a cell.
Outline globePolygons(const Sites& sites, const Diagram& diagram, std::size_t site);

/// A line in degrees with the points in between of globePolygons: longitudes continue beyond 180. It is an
/// edge of a cell, by its index in Diagram::neighbors, from its vertex to the next; or the shortest way
/// between two places.
std::vector<Point> globeEdge(const Sites& sites, const Diagram& diagram, std::size_t site,
                             std::uint64_t edge);
std::vector<Point> globeWay(Point from, Point to);

/// The parts of such a line, cut at longitude 180.
std::vector<std::vector<Point>> cutAtTurns(const std::vector<Point>& line);

/// Kilometers between two places, on the sphere of the Earth's area.
double globeDistance(Point from, Point to);

/// A point in space; on the unit sphere it stands for a place. z points to the north pole, x to longitude 0.
struct SpacePoint {
  double x, y, z;
  friend auto operator<=>(const SpacePoint&, const SpacePoint&) = default;
};

SpacePoint onGlobe(Point degrees);

/// The border of a cell on the unit sphere, counter-clockwise, the first point not repeated. Great circles
/// are in pieces of `longest` degrees or less; both cells of an edge have the same points. Around a site
/// alone, which has no edges, it is a whole great circle.
struct GlobeBorder {
  std::vector<SpacePoint> points;
  std::vector<std::size_t> begins;  ///< by edge of the cell: its vertex among the points
};
GlobeBorder globeBorder(const Sites& sites, const Diagram& diagram, std::size_t site, double longest);

}  // namespace vorpipe
