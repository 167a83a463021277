#include "globe/globe_cells.h"

#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "globe/sphere_measures.h"
#include "globe/sphere_mesh.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t globe_grain = 1024;

std::vector<Direction> directionsOf(const Sites& sites, int threads) {
  std::vector<Direction> directions(sites.size());
  parallelFor(sites.size(), globe_grain, threadsForSteps(sites.size(), threads),
              [&](std::size_t begin, std::size_t end) {
                for (auto i = begin; i < end; ++i) directions[i] = directionOf({sites.x[i], sites.y[i]});
              });
  return directions;
}

/// Writes a cell's measures and its row.
void writeCell(std::span<const Direction> directions, const SphereCells& cells, std::size_t site,
               Diagram& diagram) {
  const auto begin = cells.offsets[site], end = cells.offsets[site + 1];
  const double radius = earthRadius();
  const SphereMeasures measures =
      begin == end ? wholeSphere(directions[site]) : measureCell(directions, cells, site);
  diagram.area[site] = measures.area;
  diagram.solid_angle[site] = measures.solid_angle;
  diagram.centroid[site] = placeOf(measures.centroid);
  if (diagram.vertices.empty()) return;
  diagram.perimeter[site] = radius * measures.perimeter;
  for (auto e = begin; e < end; ++e) {
    diagram.vertices[e] = placeOf(cells.vertex[e]);
    diagram.edge_lengths[e] = radius * arcOf(directions, cells, site, e).angle;
  }
}

void writeDiagram(std::span<const Direction> directions, const Sites& sites, const SphereCells& cells,
                  Detail detail, int threads, Diagram& diagram) {
  const auto count = sites.size();
  diagram.cell_offsets = cells.offsets;
  diagram.neighbors.assign(cells.neighbor.begin(), cells.neighbor.end());
  diagram.status.assign(count, Status::ok);
  diagram.area.resize(count);
  diagram.solid_angle.resize(count);
  diagram.centroid.resize(count);
  if (detail != Detail::measures) {
    diagram.perimeter.resize(count);
    diagram.vertices.resize(cells.vertex.size());
    diagram.edge_lengths.resize(cells.vertex.size());
  }
  parallelFor(count, globe_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      if (diagram.owner[i] != i) {
        diagram.status[i] = Status::duplicate;
        diagram.centroid[i] = {sites.x[i], sites.y[i]};
      } else {
        writeCell(directions, cells, i, diagram);
      }
    }
  });
}

}  // namespace

Result<Diagram> globeCellsOn(const Machine& machine, const Sites& sites, const CellsOptions& options) {
  const int threads = threadCount(machine.threads);
  const auto directions = directionsOf(sites, threads);
  Diagram diagram;
  VORPIPE_VAR(mesh, triangulateSphere(machine, directions, options, diagram.report));
  const Stopwatch watch;
  VORPIPE_LET(cells, cellsOfSphere(directions, mesh, threads));
  diagram.owner = std::move(mesh.owner);
  writeDiagram(directions, sites, cells, options.detail, threads, diagram);
  if (options.detail == Detail::everything) diagram.triangles = std::move(mesh.triangles);
  auto& report = diagram.report;
  report.duplicate = static_cast<std::uint64_t>(std::ranges::count(diagram.status, Status::duplicate));
  report.ok = sites.size() - report.duplicate;
  report.empty = report.hidden = 0;
  report.time_ms.cells = std::max(report.time_ms.cells, 0.0) + 1e3 * watch.seconds();
  nameDevice(machine.backend, report);
  return diagram;
}

}  // namespace vorpipe::core
