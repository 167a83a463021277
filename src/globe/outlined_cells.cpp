#include "globe/outlined_cells.h"

#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "domain/cells_run.h"
#include "globe/chart.h"
#include "globe/sphere_measures.h"
#include "vorpipe/cell.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t outlined_grain = 256;

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
