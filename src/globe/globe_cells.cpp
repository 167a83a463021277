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

/// Writes a cell's measures.
void writeCell(const SphereSites& sites, const SphereCells& cells, std::size_t site, Diagram& diagram) {
  const auto begin = cells.offsets[site], end = cells.offsets[site + 1];
  std::span<double> lengths;
  if (!diagram.edge_lengths.empty()) lengths = std::span(diagram.edge_lengths).subspan(begin, end - begin);
  const SphereMeasures measures =
      begin == end ? wholeSphere(sites.direction[site]) : measureCell(sites, cells, site, lengths);
  diagram.area[site] = measures.area;
  diagram.solid_angle[site] = measures.solid_angle;
  diagram.centroid[site] = placeOf(measures.centroid);
  if (diagram.perimeter.empty()) return;
  const double radius = earthRadius();
  diagram.perimeter[site] = radius * measures.perimeter;
  for (double& length : lengths) length *= radius;
}

void writeDiagram(const SphereSites& placed, const Sites& sites, const SphereCells& cells, int threads,
                  Diagram& diagram) {
  const auto count = sites.size();
  const bool is_alone = cells.neighbor.empty(), has_places = !cells.place.empty() || is_alone;
  diagram.status.assign(count, Status::ok);
  diagram.area.resize(count);
  diagram.solid_angle.resize(count);
  diagram.centroid.resize(count);
  if (has_places) diagram.perimeter.resize(count);
  diagram.edge_lengths.resize(cells.place.size());
  parallelFor(count, globe_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      const bool is_owned = diagram.owner[i] != i;
      if (!is_owned && (is_alone || cells.offsets[i] < cells.offsets[i + 1])) {
        writeCell(placed, cells, i, diagram);
      } else {
        diagram.status[i] = is_owned ? Status::duplicate : Status::empty;
        diagram.centroid[i] = {sites.x[i], sites.y[i]};
      }
    }
  });
}

/// The triangles by input index, counter-clockwise from the lowest.
void writeTriangles(const SphereMesh& mesh, int threads, Diagram& diagram) {
  diagram.triangles.resize(mesh.triangles.size());
  parallelFor(mesh.triangles.size(), globe_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto t = begin; t < end; ++t) {
      auto& triangle = diagram.triangles[t];
      std::ranges::transform(mesh.triangles[t].corner, triangle.begin(),
                             [&](auto v) { return mesh.site[static_cast<std::size_t>(v)]; });
      std::ranges::rotate(triangle, std::ranges::min_element(triangle));
    }
  });
}

}  // namespace

Result<Diagram> globeCellsOn(const Machine& machine, const Sites& sites, const CellsOptions& options) {
  const int threads = threadCount(machine.threads);
  const Stopwatch watch;
  const SphereSites placed = placedOn(sites, threads);
  Diagram diagram;
  auto& report = diagram.report;
  VORPIPE_VAR(mesh, triangulateSphere(placed, threads));
  report.time_ms.order = watch.milliseconds();
  VORPIPE_VAR(cells, cellsOfSphere(placed, mesh, options.detail != Detail::measures, threads));
  diagram.owner = std::move(mesh.owner);
  writeDiagram(placed, sites, cells, threads, diagram);
  diagram.cell_offsets = std::move(cells.offsets);
  diagram.neighbors = std::move(cells.neighbor);
  diagram.vertices = std::move(cells.place);
  if (options.detail == Detail::everything) writeTriangles(mesh, threads, diagram);
  report.duplicate = static_cast<std::uint64_t>(std::ranges::count(diagram.status, Status::duplicate));
  report.empty = static_cast<std::uint64_t>(std::ranges::count(diagram.status, Status::empty));
  report.hidden = report.empty;
  report.ok = sites.size() - report.duplicate - report.empty;
  report.time_ms.cells = watch.milliseconds() - report.time_ms.order;
  nameDevice(machine.backend, report);
  return diagram;
}

}  // namespace vorpipe::core
