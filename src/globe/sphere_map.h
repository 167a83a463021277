/// Maps of the sphere in a plane: flat ones, and the globe as it is seen from far above.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "domain/degrees.h"
#include "globe/chart.h"
#include "globe/direction.h"
#include "globe/sphere_cells.h"
#include "vorpipe/picture.h"

namespace vorpipe::core {

inline constexpr double antimeridian = whole_turn / 2;  ///< longitude, in degrees

/// Degrees between points along the antimeridian, which is a curve on some maps.
inline constexpr double border_step = 0.5;

/// The box around the whole map of a picture of the globe, in the map's unit: degrees, meters, or radii of
/// the globe.
const Box& boxOfMap(const RenderOptions& options);

/// The map of a picture.
class SphereMap {
 public:
  explicit SphereMap(const RenderOptions& options);

  [[nodiscard]] const Box& box() const { return box_; }
  /// The width of what the picture shows of it.
  [[nodiscard]] double shownWidth() const { return shown_width_; }
  [[nodiscard]] bool isFlat() const { return !seen_from_; }

  /// Where a flat map has a place in degrees, of longitude -180 to 180.
  [[nodiscard]] Point flat(Point degrees) const;

  /// The globe is seen in parallel from this direction; what is at right angles to it is its horizon.
  [[nodiscard]] const Direction& viewer() const { return viewer_; }
  [[nodiscard]] Point seen(const Direction& at) const { return {dot(right_, at), dot(up_, at)}; }

  /// Where the map has a direction; none beyond the horizon.
  [[nodiscard]] std::optional<Point> at(const Direction& direction) const;

  /// The map's border, counter-clockwise; empty if that is the box.
  [[nodiscard]] std::vector<Point> border() const;

  /// The directions of the map's places with one y.
  class Row {
   public:
    Row(const SphereMap& map, double y);
    /// None beyond the map's border.
    [[nodiscard]] std::optional<Direction> at(double x) const;

   private:
    const SphereMap& map_;
    double y_, radians_ = 0;        ///< of longitude, for each unit of x
    double sine_ = 0, cosine_ = 0;  ///< of the latitude
  };

 private:
  bool equal_earth_;
  bool seen_from_;
  Box box_;
  double shown_width_;
  Direction viewer_{}, right_{}, up_{};
};

/// The visible parts of `arc` on `map`, as polylines with enough points to look smooth. A polyline ends where
/// the arc leaves the map, and at a pole, which flat maps draw as a line.
std::vector<std::vector<Point>> linesOf(const SphereMap& map, const GreatArc& arc);

/// Rings around what a map shows of a cell; `vectors` are those of all sites.
std::vector<std::vector<Point>> ringsOf(const SphereMap& map, const Sites& sites,
                                        const std::vector<Direction>& vectors, const Diagram& diagram,
                                        std::size_t site);

/// Rings around what a map shows of a polygon.
std::vector<std::vector<Point>> ringsOf(const SphereMap& map, const SpherePolygon& polygon);

/// Edge k of a site's cell on the whole sphere.
GreatArc arcOf(const std::vector<Direction>& vectors, const Diagram& diagram, std::size_t site,
               std::size_t edge);

/// The edge of a site's cell with an index in Diagram::neighbors, from its vertex to the next of its ring.
GreatArc sideOf(const Sites& sites, const Diagram& diagram, std::size_t site, std::uint64_t entry);

/// The rings of a cell in an outline.
SpherePolygon sphereRingsOf(const Diagram& diagram, std::size_t site);

/// Polygons in degrees as of globePolygons(), of rings whose sides are shorter than half a turn.
Outline polygonsInDegrees(const SpherePolygon& rings);

/// The vector of each site, as in SphereSites.
std::vector<Direction> vectorsOf(const Sites& sites, int threads);

}  // namespace vorpipe::core
