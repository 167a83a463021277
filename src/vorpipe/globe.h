/// Cells on the whole Earth: see CellsOptions::globe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "vorpipe/cells.h"
#include "vorpipe/outline.h"
#include "vorpipe/picture.h"
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

/// Lines on the map of a picture of the globe, in the map's unit.
struct MapLines {
  std::vector<Point> points;
  std::vector<std::size_t> ends;  ///< by line: where its points end

  [[nodiscard]] std::size_t size() const { return ends.size(); }
  [[nodiscard]] std::span<const Point> operator[](std::size_t line) const {
    const std::size_t begin = line > 0 ? ends[line - 1] : 0;
    return std::span(points).subspan(begin, ends[line] - begin);
  }
};

/// Cells on the map of a picture of the globe: a picture of a plane.
struct MapCells {
  RenderOptions options;  ///< the domain and the outline are those of the map
  Sites sites;            ///< without weights; NaN beyond the horizon
  /// Polygons, cut at the map's border, with areas and centroids in the map. Neighbors are walls, since a
  /// neighbor has several sides here.
  Diagram diagram;
};

/// Returns what a map shows of sites and of cells with Detail::polygons, by the options of a picture of the
/// globe. Errors: those of optionsOnMap.
Sites sitesOnMap(const Sites& sites, const RenderOptions& options);
Result<MapCells> cellsOnMap(const Sites& sites, const Diagram& diagram, const RenderOptions& options,
                            int threads = 0);

/// Returns the options of a picture of the plane with the map's border, or with what it shows of the outline.
/// Errors (input): those of cells in that outline.
Result<RenderOptions> optionsOnMap(const RenderOptions& options);

/// The box around what a flat map has of the outline, in the map's unit, which is what a picture of it shows
/// by itself. None without an outline, for one that is wider than half of the map, and seen from above: all
/// of the map is shown then. Errors: those of optionsOnMap.
Result<std::optional<Box>> domainOnMap(const RenderOptions& options);

/// Returns the edges between cells with Detail::polygons, each once, and the lines between sites whose cells
/// share an edge: parts of great circles.
MapLines edgesOnMap(const Sites& sites, const Diagram& diagram, const RenderOptions& options,
                    int threads = 0);
MapLines dualOnMap(const Sites& sites, const Diagram& diagram, const RenderOptions& options, int threads = 0);

/// Returns the meridians and parallels of a picture's graticule, and the border of the map, each at least
/// once.
MapLines graticuleOnMap(const RenderOptions& options);

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

/// Where a place is on the unit sphere: z points to the north pole, x to longitude 0.
Point3 onGlobe(Point degrees);

/// The border of a cell on the unit sphere, counter-clockwise, the first point not repeated. Great circles
/// are in pieces of `longest` degrees or less; both cells of an edge have the same points. Around a site
/// alone, which has no edges, it is a whole great circle.
struct GlobeBorder {
  std::vector<Point3> points;
  std::vector<std::size_t> begins;  ///< by edge of the cell: its vertex among the points
};
GlobeBorder globeBorder(const Sites& sites, const Diagram& diagram, std::size_t site, double longest);

/// Generators of places that are spread evenly over the globe.
enum class GlobePattern : std::uint8_t {
  icosahedral,  ///< a geodesic grid: the corners of an icosahedron, whose faces have k^2 triangles each
  fibonacci,    ///< a spiral by the golden angle
};

/// n places in degrees. A geodesic grid has n = 10 k^2 + 2. Halves of edges are along great circles, other
/// parts are of equal length in the face. Error (input): no grid has n places.
Result<Sites> generateOnGlobe(GlobePattern pattern, std::uint64_t n);

}  // namespace vorpipe
