#include "globe/globe_cells.h"

#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "base/progress_steps.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "globe/outlined_cells.h"
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

/// Stages of a run, as large as each other, for the progress: the triangulation counts as two.
constexpr std::size_t globe_stages = 4;

Result<void> reportStage(const Progress& progress, std::size_t done) {
  return reportProgress(progress, "cells", done, globe_stages);
}

Result<void> writeDiagram(const SphereSites& placed, const Sites& sites, const SphereCells& cells,
                          int threads, const Progress& progress, Diagram& diagram) {
  const auto count = sites.size();
  const bool is_alone = cells.neighbor.empty(), has_places = !cells.place.empty() || is_alone;
  diagram.status.assign(count, Status::ok);
  diagram.area.resize(count);
  diagram.solid_angle.resize(count);
  diagram.centroid.resize(count);
  if (has_places) diagram.perimeter.resize(count);
  diagram.edge_lengths.resize(cells.place.size());
  const auto write = [&](std::size_t i) {
    const bool is_owned = diagram.owner[i] != i;
    if (!is_owned && (is_alone || cells.offsets[i] < cells.offsets[i + 1])) {
      writeCell(placed, cells, i, diagram);
    } else {
      diagram.status[i] = is_owned ? Status::duplicate : Status::empty;
      diagram.centroid[i] = {sites.x[i], sites.y[i]};
    }
  };
  const StageRange last{count, (globe_stages - 1) * count, globe_stages * count};
  return runInSteps(progress, "cells", last, count, [&](std::size_t first, std::size_t some) -> Result<void> {
    parallelEach(some, globe_grain, threads, [&](std::size_t k) { write(first + k); });
    return {};
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

/// The cells of the whole sphere.
Result<Diagram> wholeCellsOn(const Sites& sites, const SphereSites& placed, const CellsOptions& options,
                             int threads) {
  const Detail detail = options.detail;
  const Progress& progress = options.progress;
  const Stopwatch watch;
  VORPIPE_TRY(reportStage(progress, 0));
  Diagram diagram;
  auto& times = diagram.report.time_ms;
  VORPIPE_VAR(mesh, triangulateSphere(placed, threads));
  times.order = watch.milliseconds();
  VORPIPE_TRY(reportStage(progress, 2));
  VORPIPE_VAR(cells, cellsOfSphere(placed, mesh, detail != Detail::measures, threads));
  diagram.owner = std::move(mesh.owner);
  VORPIPE_TRY(writeDiagram(placed, sites, cells, threads, progress, diagram));
  diagram.cell_offsets = std::move(cells.offsets);
  diagram.neighbors = std::move(cells.neighbor);
  diagram.vertices = std::move(cells.place);
  if (detail == Detail::everything) writeTriangles(mesh, threads, diagram);
  times.cells = watch.milliseconds() - times.order;
  return diagram;
}

/// Those inside of an outline.
Result<Diagram> partCellsOn(const Machine& machine, const Sites& sites, const SphereSites& placed,
                            const CellsOptions& options, int threads) {
  VORPIPE_VAR(diagram, outlinedCellsOn(machine, sites, placed, options));
  diagram.report.hidden = 0;
  const bool has_triangles = options.detail == Detail::everything;
  if (!has_triangles && placed.excess.empty()) return std::move(diagram);
  VORPIPE_LET(mesh, triangulateSphere(placed, threads));
  if (has_triangles) writeTriangles(mesh, threads, diagram);
  for (std::size_t v = 0; v < mesh.at.size(); ++v) {
    if (mesh.at[v] < 0 && mesh.owner[mesh.site[v]] == mesh.site[v]) ++diagram.report.hidden;
  }
  return std::move(diagram);
}

}  // namespace

Result<Diagram> globeCellsOn(const Machine& machine, const Sites& sites, const CellsOptions& options) {
  const int threads = threadCount(machine.threads);
  const SphereSites placed = placedOn(sites, threads);
  VORPIPE_VAR(diagram, options.outline.empty() ? wholeCellsOn(sites, placed, options, threads)
                                               : partCellsOn(machine, sites, placed, options, threads));
  auto& report = diagram.report;
  report.duplicate = static_cast<std::uint64_t>(std::ranges::count(diagram.status, Status::duplicate));
  report.empty = static_cast<std::uint64_t>(std::ranges::count(diagram.status, Status::empty));
  if (options.outline.empty()) report.hidden = report.empty;
  report.ok = sites.size() - report.duplicate - report.empty;
  nameDevice(machine.backend, report);
  return std::move(diagram);
}

}  // namespace vorpipe::core
