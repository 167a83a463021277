#include "globe/globe_cells.h"

#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "globe/sphere_measures.h"
#include "globe/sphere_mesh.h"
#include "sites/weights.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t globe_grain = 1024;

SphereSites placedOn(const Sites& sites, int threads) {
  const auto count = sites.size();
  SphereSites placed;
  placed.direction.resize(count);
  const bool has_weights = hasWeights(sites);
  if (has_weights) placed.excess.resize(count), placed.scaled.resize(count);
  parallelFor(count, globe_grain, threadsForSteps(count, threads), [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      placed.direction[i] = directionOf({sites.x[i], sites.y[i]});
      if (!has_weights) continue;
      placed.excess[i] = excessOf(sites.weight[i]);
      placed.scaled[i] = (1 + placed.excess[i]) * placed.direction[i];
    }
  });
  return placed;
}

/// Writes a cell's measures and its row.
void writeCell(const SphereSites& sites, const SphereCells& cells, std::size_t site, Diagram& diagram) {
  const auto begin = cells.offsets[site], end = cells.offsets[site + 1];
  const double radius = earthRadius();
  const SphereMeasures measures =
      begin == end ? wholeSphere(sites.direction[site]) : measureCell(sites, cells, site);
  diagram.area[site] = measures.area;
  diagram.solid_angle[site] = measures.solid_angle;
  diagram.centroid[site] = placeOf(measures.centroid);
  if (diagram.vertices.empty()) return;
  diagram.perimeter[site] = radius * measures.perimeter;
  for (auto e = begin; e < end; ++e) {
    diagram.vertices[e] = placeOf(cells.vertex[e]);
    diagram.edge_lengths[e] = radius * arcOf(sites.vectors(), cells, site, e).angle;
  }
}

void writeDiagram(const SphereSites& placed, const Sites& sites, const SphereCells& cells, Detail detail,
                  int threads, Diagram& diagram) {
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
  const bool is_alone = cells.neighbor.empty();
  parallelFor(count, globe_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      if (diagram.owner[i] != i) {
        diagram.status[i] = Status::duplicate;
        diagram.centroid[i] = {sites.x[i], sites.y[i]};
      } else if (cells.offsets[i] == cells.offsets[i + 1] && !is_alone) {
        diagram.status[i] = Status::empty;
        diagram.centroid[i] = {sites.x[i], sites.y[i]};
      } else {
        writeCell(placed, cells, i, diagram);
      }
    }
  });
}

}  // namespace

Result<Diagram> globeCellsOn(const Machine& machine, const Sites& sites, const CellsOptions& options) {
  const int threads = threadCount(machine.threads);
  const SphereSites placed = placedOn(sites, threads);
  Diagram diagram;
  VORPIPE_VAR(mesh, triangulateSphere(machine, placed, options, diagram.report));
  const Stopwatch watch;
  VORPIPE_LET(cells, cellsOfSphere(placed, mesh, threads));
  diagram.owner = std::move(mesh.owner);
  writeDiagram(placed, sites, cells, options.detail, threads, diagram);
  if (options.detail == Detail::everything) diagram.triangles = std::move(mesh.triangles);
  auto& report = diagram.report;
  report.duplicate = static_cast<std::uint64_t>(std::ranges::count(diagram.status, Status::duplicate));
  report.empty = static_cast<std::uint64_t>(std::ranges::count(diagram.status, Status::empty));
  report.hidden = report.empty;
  report.ok = sites.size() - report.duplicate - report.empty;
  report.time_ms.cells = std::max(report.time_ms.cells, 0.0) + 1e3 * watch.seconds();
  nameDevice(machine.backend, report);
  return diagram;
}

}  // namespace vorpipe::core
