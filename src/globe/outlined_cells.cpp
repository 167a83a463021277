#include "globe/outlined_cells.h"

#include <fmt/core.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "base/parallel.h"
#include "base/refusal.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "domain/cells_run.h"
#include "domain/degrees.h"
#include "domain/rings.h"
#include "globe/sphere_measures.h"
#include "vorpipe/cell.h"
#include "vorpipe/maps.h"

namespace vorpipe::core {
namespace {

/// The gnomonic projection around a center (Snyder 1987, chapter 22), for places less than 90 degrees from
/// it. Cells on the sphere are those of a plane power diagram there: x . v, for x = center + u right + v up,
/// is largest for the site of least power (globe.md).
class Chart {
 public:
  explicit Chart(Point center);

  [[nodiscard]] Point toPlane(const Direction& at) const;
  [[nodiscard]] Direction toDirection(Point at) const;
  /// The plane's sites, of all sites on the sphere.
  [[nodiscard]] Sites toPlane(const SphereSites& sites, int threads) const;

 private:
  Direction center_, right_, up_;
};

Chart::Chart(Point center)
    : center_(directionOf(center)), right_(perpendicular(center_)), up_(cross(center_, right_)) {}

Point Chart::toPlane(const Direction& at) const {
  const double depth = dot(center_, at);
  return {dot(right_, at) / depth, dot(up_, at) / depth};
}

Direction Chart::toDirection(Point at) const { return normalized(center_ + at.x * right_ + at.y * up_); }

Sites Chart::toPlane(const SphereSites& sites, int threads) const {
  constexpr std::size_t grain = std::size_t{1} << 14;
  const auto count = sites.direction.size();
  Sites plane;
  for (auto* list : {&plane.x, &plane.y, &plane.weight}) list->resize(count);
  parallelFor(count, grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      const Direction way = sites.direction[i] - center_;
      const double excess = sites.excessOf(i), longer = 1 + excess;
      const double rise = longer * dot(way, way) / 2;
      plane.x[i] = longer * dot(right_, way);
      plane.y[i] = longer * dot(up_, way);
      // |v|^2 across the center's direction, plus 2 v along it, less 2.
      plane.weight[i] = 2 * excess * (1 + rise) - rise * rise;
    }
  });
  return plane;
}

constexpr std::size_t outlined_grain = 256;

/// How far polygons of one chart reach from its center, in degrees. Its plane reaches 29 Earth radii then.
constexpr double farthest_of_chart = 88;

/// Polygons that one chart has.
struct ChartedOutline {
  Point center;  ///< degrees
  Outline degrees;
};

double reachFrom(const Direction& center, const Outline& outline, std::size_t polygon) {
  double reach = 0;
  for (auto r = outline.polygon_offsets[polygon]; r < outline.polygon_offsets[polygon + 1]; ++r) {
    for (const Point place : ringAt(outline, r)) {
      reach = std::max(reach, angleBetween(center, directionOf(place)) / degree);
    }
  }
  return reach;
}

void addPolygon(const Outline& from, std::size_t polygon, Outline& outline) {
  if (outline.ring_offsets.empty()) outline.ring_offsets = outline.polygon_offsets = {0};
  for (auto r = from.polygon_offsets[polygon]; r < from.polygon_offsets[polygon + 1]; ++r) {
    const auto ring = ringAt(from, r);
    outline.points.insert(outline.points.end(), ring.begin(), ring.end());
    outline.ring_offsets.push_back(outline.points.size());
  }
  outline.polygon_offsets.push_back(outline.ring_offsets.size() - 1);
}

/// Distributes the polygons among as few charts as come of it: each begins with the first polygon that is
/// left, amid which it has its center.
Result<std::vector<ChartedOutline>> chartsOf(const Outline& outline) {
  VORPIPE_LET(amid, projectionAmid(outline));
  const auto polygons = outline.polygon_offsets.size() - 1;
  std::vector<ChartedOutline> charts;
  std::vector<std::uint8_t> is_taken(polygons);
  const auto addChart = [&](Point center) {
    const Direction direction = directionOf(center);
    ChartedOutline chart{center, {}};
    for (std::size_t p = 0; p < polygons; ++p) {
      if (is_taken[p] != 0 || reachFrom(direction, outline, p) > farthest_of_chart) continue;
      is_taken[p] = 1;
      addPolygon(outline, p, chart.degrees);
    }
    if (!chart.degrees.empty()) charts.push_back(std::move(chart));
  };
  addChart(amid.center());
  for (std::size_t p = 0; p < polygons; ++p) {
    if (is_taken[p] != 0) continue;
    Outline alone;
    addPolygon(outline, p, alone);
    VORPIPE_LET(around, projectionAmid(alone));
    addChart(around.center());
    if (is_taken[p] != 0) continue;
    return tl::unexpected(
        refusalOf(Subject::outline,
                  fmt::format("polygon {} reaches {:.0f} degrees from its center {}, {}; on the globe "
                              "a polygon reaches at most {:.0f}",
                              p, reachFrom(directionOf(around.center()), outline, p), around.center().x,
                              around.center().y, farthest_of_chart)));
  }
  return charts;
}

/// A chart's outline in its plane. Sides along parallels have points in between.
Result<Outline> outlineIn(const Chart& chart, const ChartedOutline& charted) {
  VORPIPE_LET(projection, Projection::around(charted.center));
  VORPIPE_VAR(plane, toPlane(projection, charted.degrees));
  for (Point& point : plane.points) point = chart.toPlane(directionOf(projection.toDegrees(point)));
  // It was valid in degrees: what is to be mended is rounding.
  VORPIPE_VAR(valid, mended(plane, true));
  return std::move(valid.outline);
}

/// The cells that one chart found.
struct ChartCells {
  Chart chart;
  Diagram diagram;
};

/// Puts the rings of all charts together, by site.
class Assembled {
 public:
  Assembled(const Sites& sites, const SphereSites& placed, const std::vector<ChartCells>& parts,
            Detail detail, int threads)
      : sites_(sites), placed_(placed), parts_(parts), detail_(detail), threads_(threads) {}

  Diagram run() {
    const auto count = sites_.size();
    diagram_.status.resize(count);
    diagram_.owner.resize(count);
    diagram_.area.resize(count);
    diagram_.solid_angle.resize(count);
    diagram_.centroid.resize(count);
    diagram_.perimeter.resize(count);
    each([this](std::size_t i) { settle(i); });
    listOffsets();
    diagram_.vertices.resize(diagram_.cell_offsets.back());
    diagram_.neighbors.resize(diagram_.cell_offsets.back());
    diagram_.edge_lengths.resize(diagram_.cell_offsets.back());
    each([this](std::size_t i) { write(i); });
    if (detail_ == Detail::measures) {
      diagram_.vertices = {};
      diagram_.edge_lengths = {};
      diagram_.perimeter = {};
      diagram_.ring_starts = {};
    }
    return std::move(diagram_);
  }

 private:
  template <class Work>
  void each(const Work& work) {
    parallelFor(sites_.size(), outlined_grain, threads_, [&](std::size_t begin, std::size_t end) {
      for (auto i = begin; i < end; ++i) work(i);
    });
  }

  void settle(std::size_t i) {
    diagram_.owner[i] = static_cast<std::uint32_t>(i);
    diagram_.status[i] = Status::empty;
    diagram_.centroid[i] = {sites_.x[i], sites_.y[i]};
    for (const auto& part : parts_) {
      const auto owner = part.diagram.owner[i];
      if (part.diagram.status[i] == Status::ok) diagram_.status[i] = Status::ok;
      // In a chart, a place and that opposite to it look alike.
      if (owner == i || placed_.direction[owner] != placed_.direction[i]) continue;
      diagram_.owner[i] = owner;
      diagram_.status[i] = Status::duplicate;
    }
  }

  void listOffsets() {
    auto& offsets = diagram_.cell_offsets;
    offsets.assign(1, 0);
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      auto at = offsets.back();
      for (const auto& part : parts_) {
        const CellRings rings = part.diagram.cell(i).rings();
        for (std::size_t r = 0; r < rings.size(); ++r) {
          diagram_.ring_starts.push_back(at);
          at += rings[r].size();
        }
      }
      offsets.push_back(at);
    }
  }

  void write(std::size_t i) {
    auto out = diagram_.cell_offsets[i];
    const auto begin = out;
    std::vector<Direction> vertices;
    for (const auto& part : parts_) {
      const auto first = part.diagram.cell_offsets[i], last = part.diagram.cell_offsets[i + 1];
      for (auto e = first; e < last; ++e) {
        diagram_.neighbors[out++] = part.diagram.neighbors[e];
        vertices.push_back(part.chart.toDirection(part.diagram.vertices[e]));
      }
    }
    if (vertices.empty()) return;
    std::vector<std::size_t> ends;
    const CellRings rings(diagram_, i);
    for (std::size_t r = 0; r < rings.size(); ++r) ends.push_back(rings.end(r) - begin);
    const auto lengths = std::span(diagram_.edge_lengths).subspan(begin, vertices.size());
    const SphereMeasures measures = measureRings(vertices, ends, lengths);
    for (double& length : lengths) length *= earthRadius();
    diagram_.area[i] = measures.area;
    diagram_.solid_angle[i] = measures.solid_angle;
    diagram_.perimeter[i] = earthRadius() * measures.perimeter;
    diagram_.centroid[i] = placeOf(measures.centroid);
    std::ranges::transform(vertices, diagram_.vertices.begin() + static_cast<std::ptrdiff_t>(begin), placeOf);
  }

  const Sites& sites_;
  const SphereSites& placed_;
  const std::vector<ChartCells>& parts_;
  Detail detail_;
  int threads_;
  Diagram diagram_;
};

}  // namespace

Result<Diagram> outlinedCellsOn(const Machine& machine, const Sites& sites, const SphereSites& placed,
                                const CellsOptions& options) {
  const int threads = threadCount(machine.threads);
  const Stopwatch watch;
  VORPIPE_LET(charts, chartsOf(options.outline));
  std::vector<ChartCells> parts;
  for (const ChartedOutline& charted : charts) {
    const Chart chart(charted.center);
    CellsOptions in_plane;
    VORPIPE_VAR(outline, outlineIn(chart, charted));
    const auto [west, east] = std::ranges::minmax(outline.points, {}, &Point::x);
    const auto [south, north] = std::ranges::minmax(outline.points, {}, &Point::y);
    // Wide enough for no side of the outline to be one of the box.
    constexpr double part = 0.01;
    const double x = part * (east.x - west.x), y = part * (north.y - south.y);
    in_plane.domain = {west.x - x, south.y - y, east.x + x, north.y + y};
    in_plane.outline = std::move(outline);
    in_plane.search = options.search;
    in_plane.detail = Detail::polygons;
    in_plane.progress = options.progress;
    VORPIPE_VAR(found, cellsOn(machine, chart.toPlane(placed, threads), in_plane));
    parts.push_back({chart, std::move(found)});
  }
  Diagram diagram = Assembled(sites, placed, parts, options.detail, threads).run();
  diagram.report = std::move(parts.front().diagram.report);
  diagram.report.time_ms.cells = watch.milliseconds();
  return diagram;
}

}  // namespace vorpipe::core
