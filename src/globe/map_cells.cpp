#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "base/try.h"
#include "domain/degrees.h"
#include "domain/rings.h"
#include "globe/sphere_map.h"
#include "vorpipe/cell.h"
#include "vorpipe/globe.h"
#include "vorpipe/shapes.h"

namespace vorpipe {
namespace {

using namespace core;

constexpr std::size_t map_grain = 1024;

/// Twice the area of a ring, and six times its moment.
struct RingSums {
  double area = 0, x = 0, y = 0;

  explicit RingSums(const std::vector<Point>& ring) {
    for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
      const Point o = ring[0], a = ring[k], b = ring[k + 1];
      const double cross = (a.x - o.x) * (b.y - o.y) - (b.x - o.x) * (a.y - o.y);
      area += cross;
      x += cross * (o.x + a.x + b.x);
      y += cross * (o.y + a.y + b.y);
    }
  }
};

/// Adds a cell's rings to a diagram.
void addRings(const std::vector<std::vector<Point>>& rings, std::size_t site, Diagram& diagram) {
  double largest = 0;
  for (const auto& ring : rings) {
    const RingSums sums(ring);
    diagram.area[site] += sums.area / 2;
    if (sums.area > largest) {
      largest = sums.area;
      diagram.centroid[site] = {sums.x / (3 * sums.area), sums.y / (3 * sums.area)};
    }
    diagram.ring_starts.push_back(diagram.vertices.size());
    diagram.vertices.insert(diagram.vertices.end(), ring.begin(), ring.end());
  }
  diagram.cell_offsets.push_back(diagram.vertices.size());
}

void append(std::span<const Point> line, MapLines& lines) {
  lines.points.insert(lines.points.end(), line.begin(), line.end());
  lines.ends.push_back(lines.points.size());
}

/// Draws an arc for each edge between cells; `arcOfEdge` makes it of a cell and its edge.
template <class Draw>
MapLines linesBetween(const Diagram& diagram, int threads, const Draw& arcOfEdge, const SphereMap& map) {
  std::vector<MapLines> of_part((diagram.size() + map_grain - 1) / map_grain);
  parallelFor(diagram.size(), map_grain, threadCount(threads), [&](std::size_t begin, std::size_t end) {
    MapLines& lines = of_part[begin / map_grain];
    for (auto i = begin; i < end; ++i) {
      const auto neighbors = diagram.cell(i).neighbors();
      for (std::size_t k = 0; k < neighbors.size(); ++k) {
        if (neighbors[k] < static_cast<std::int64_t>(i)) continue;
        for (const auto& line : linesOf(map, arcOfEdge(i, k))) append(line, lines);
      }
    }
  });
  MapLines all;
  for (MapLines& lines : of_part) {
    for (std::size_t k = 0; k < lines.size(); ++k) append(lines[k], all);
    lines = {};
  }
  return all;
}

/// Rings that are filled by the even-odd rule, each a polygon here.
Outline outlineOf(const std::vector<std::vector<Point>>& rings) {
  Outline outline;
  if (rings.empty()) return outline;
  outline.ring_offsets = outline.polygon_offsets = {0};
  for (const auto& ring : rings) {
    outline.points.insert(outline.points.end(), ring.begin(), ring.end());
    outline.ring_offsets.push_back(outline.points.size());
    outline.polygon_offsets.push_back(outline.ring_offsets.size() - 1);
  }
  return outline;
}

using MapRings = std::vector<std::vector<Point>>;

/// Adds what a map shows of an outline.
Result<void> addRings(const SphereMap& map, const Outline& degrees, MapRings& rings) {
  VORPIPE_LET(polygons, spherePolygonsOf(degrees));
  for (const SpherePolygon& polygon : polygons) {
    for (auto& ring : ringsOf(map, polygon)) rings.push_back(std::move(ring));
  }
  return {};
}

/// What a map shows of each polygon by itself: neighbors share sides.
Result<Outline> bordersOnMap(const SphereMap& map, const Outline& degrees) {
  MapRings rings;
  for (std::size_t p = 0; p + 1 < degrees.polygon_offsets.size(); ++p) {
    MapRings polygon;
    for (auto r = degrees.polygon_offsets[p]; r < degrees.polygon_offsets[p + 1]; ++r) {
      const auto ring = ringAt(degrees, r);
      polygon.emplace_back(ring.begin(), ring.end());
    }
    Outline alone = outlineOf(polygon);
    alone.polygon_offsets = {0, polygon.size()};
    VORPIPE_TRY(addRings(map, alone, rings));
  }
  return outlineOf(rings);
}

}  // namespace

Result<std::optional<Box>> domainOnMap(const RenderOptions& options) {
  if (options.view_from || options.outline.empty()) return std::nullopt;
  VORPIPE_LET(plane, optionsOnMap(options));
  const Box box = boxOf(plane.outline.points), &whole = plane.domain;
  if (2 * (box.xmax - box.xmin) > whole.xmax - whole.xmin) return std::nullopt;
  return box;
}

Result<RenderOptions> optionsOnMap(const RenderOptions& options) {
  const SphereMap map(options);
  RenderOptions plane = options;
  plane.globe = false;
  plane.domain = map.box();
  plane.fit = Fit::letterbox;
  plane.periodic = Periodic::none;
  plane.graticule = 0;
  plane.outline = {};
  if (!options.borders.empty()) {
    VORPIPE_VAR(borders, bordersOnMap(map, options.borders));
    plane.borders = std::move(borders);
  }
  if (options.outline.empty()) {
    if (const auto border = map.border(); !border.empty()) plane.outline = outlineOf({border});
    return plane;
  }
  MapRings rings;
  VORPIPE_TRY(addRings(map, options.outline, rings));
  plane.outline = outlineOf(rings);
  return plane;
}

Sites sitesOnMap(const Sites& sites, const RenderOptions& options) {
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN(), inside = 1 - 1e-9;
  const SphereMap map(options);
  Sites shown;
  shown.x.resize(sites.size());
  shown.y.resize(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const auto at = map.at(directionOf({sites.x[i], sites.y[i]}));
    // Sites on the border have pixels.
    const Point place = at.value_or(Point{nowhere, nowhere});
    shown.x[i] = inside * place.x;
    shown.y[i] = inside * place.y;
  }
  return shown;
}

Result<MapCells> cellsOnMap(const Sites& sites, const Diagram& diagram, const RenderOptions& options,
                            int threads) {
  const SphereMap map(options);
  const auto vectors = vectorsOf(sites, threads);
  std::vector<std::vector<std::vector<Point>>> rings(sites.size());
  parallelEach(sites.size(), map_grain, threadCount(threads),
               [&](std::size_t i) { rings[i] = ringsOf(map, sites, vectors, diagram, i); });
  VORPIPE_VAR(plane, optionsOnMap(options));
  MapCells cells{std::move(plane), sitesOnMap(sites, options), {}};
  Diagram& flat = cells.diagram;
  flat.status = diagram.status;
  flat.owner = diagram.owner;
  flat.area.resize(sites.size());
  flat.centroid.resize(sites.size());
  flat.cell_offsets.push_back(0);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    addRings(rings[i], i, flat);
    rings[i] = {};
  }
  flat.neighbors.assign(flat.vertices.size(), static_cast<std::int64_t>(Wall::outline));
  return cells;
}

MapLines edgesOnMap(const Sites& sites, const Diagram& diagram, const RenderOptions& options, int threads) {
  const SphereMap map(options);
  const auto sideAt = [&](std::size_t site, std::size_t k) {
    return sideOf(sites, diagram, site, diagram.cell_offsets[site] + k);
  };
  if (!diagram.ring_starts.empty()) return linesBetween(diagram, threads, sideAt, map);
  const auto vectors = vectorsOf(sites, threads);
  return linesBetween(
      diagram, threads, [&](std::size_t site, std::size_t k) { return arcOf(vectors, diagram, site, k); },
      map);
}

MapLines dualOnMap(const Sites& sites, const Diagram& diagram, const RenderOptions& options, int threads) {
  const SphereMap map(options);
  const auto arcBetweenSites = [&](std::size_t site, std::size_t k) {
    const auto other = static_cast<std::size_t>(diagram.neighbors[diagram.cell_offsets[site] + k]);
    const Direction from = directionOf({sites.x[site], sites.y[site]}),
                    to = directionOf({sites.x[other], sites.y[other]});
    const Direction turn = cross(from, to);
    const Direction axis = lengthOf(turn) > 0 ? normalized(turn) : perpendicular(from);
    return GreatArc{from, to, axis, angleBetween(from, to)};
  };
  return linesBetween(diagram, threads, arcBetweenSites, map);
}

}  // namespace vorpipe
