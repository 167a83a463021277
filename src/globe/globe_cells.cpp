#include "globe/globe_cells.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <span>
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

constexpr std::size_t globe_grain = 512;

/// Cells and their measures, to be written at once: sites lie anywhere in the input, and one after another
/// each cell would wait for memory.
class CellsToWrite {
 public:
  explicit CellsToWrite(const SphereSites& sites) : sites_(sites) {}

  void add(const SphereCell& cell) {
    neighbor_.insert(neighbor_.end(), cell.neighbor.begin(), cell.neighbor.end());
    place_.insert(place_.end(), cell.place.begin(), cell.place.end());
    length_.resize(place_.size());
    const auto lengths = std::span(length_).last(cell.place.size());
    const SphereMeasures measures =
        cell.vertex.empty() ? wholeSphere(cell.direction) : measureCell(sites_, cell, lengths);
    cells_.push_back({cell.site, neighbor_.size(), measures, placeOf(measures.centroid)});
  }

  /// Writes the cells into rows whose places are known.
  void write(Diagram& diagram) {
    const double radius = earthRadius();
    for (double& length : length_) length *= radius;
    std::size_t begin = 0;
    for (const auto& [site, end, measures, centroid] : cells_) {
      const auto copyRow = [&](const auto& from, auto& to) {
        if (!from.empty())
          std::copy_n(from.data() + begin, end - begin, to.data() + diagram.cell_offsets[site]);
      };
      copyRow(neighbor_, diagram.neighbors);
      copyRow(place_, diagram.vertices);
      copyRow(length_, diagram.edge_lengths);
      diagram.status[site] = Status::ok;
      diagram.area[site] = measures.area;
      diagram.solid_angle[site] = measures.solid_angle;
      diagram.centroid[site] = centroid;
      if (!diagram.perimeter.empty()) diagram.perimeter[site] = radius * measures.perimeter;
      begin = end;
    }
  }

 private:
  struct Measured {
    std::size_t site, end;  ///< of the cell's rows
    SphereMeasures measures;
    Point centroid;
  };

  const SphereSites& sites_;
  std::vector<Measured> cells_;
  std::vector<std::int64_t> neighbor_;
  std::vector<Point> place_;
  std::vector<double> length_;
};

/// Stages of a run, as large as each other, for the progress: the triangulation counts as two.
constexpr std::size_t globe_stages = 4;

Result<void> reportStage(const Progress& progress, std::size_t done) {
  return reportProgress(progress, "cells", done, globe_stages);
}

/// Allocates a diagram's arrays, the larger ones at the same time: the time goes into their pages.
void makeRoom(std::size_t sites, std::size_t edges, bool has_places, int threads, Diagram& diagram) {
  const std::array<std::function<void()>, 3> tasks{[&] { diagram.neighbors.resize(edges); },
                                                   [&] {
                                                     diagram.area.resize(sites);
                                                     diagram.solid_angle.resize(sites);
                                                     diagram.centroid.resize(sites);
                                                     diagram.status.resize(sites);
                                                     if (has_places) diagram.perimeter.resize(sites);
                                                   },
                                                   [&] {
                                                     if (!has_places) return;
                                                     diagram.vertices.resize(edges);
                                                     diagram.edge_lengths.resize(edges);
                                                   }};
  parallelEach(tasks.size(), 1, threadsForSteps(edges, threads), [&](std::size_t k) { tasks[k](); });
}

Result<void> writeDiagram(const SphereSites& placed, const Sites& sites, SphereCells& cells, bool has_places,
                          int threads, const Progress& progress, Diagram& diagram) {
  const auto count = sites.size();
  diagram.cell_offsets = std::move(cells.offsets);
  const auto edges = diagram.cell_offsets.back();
  makeRoom(count, edges, has_places || edges == 0, threads, diagram);
  parallelEach(count, globe_grain, threads, [&](std::size_t i) {
    if (diagram.cell_offsets[i] < diagram.cell_offsets[i + 1]) return;
    diagram.status[i] = diagram.owner[i] != i ? Status::duplicate : Status::empty;
    diagram.centroid[i] = {sites.x[i], sites.y[i]};
  });
  const auto steps = cells.steps();
  const StageRange last{steps, (globe_stages - 1) * steps, globe_stages * steps};
  return runInSteps(progress, "cells", last, steps, [&](std::size_t first, std::size_t some) -> Result<void> {
    parallelFor(some, globe_grain, threads, [&](std::size_t begin, std::size_t end) {
      CellsToWrite written(placed);
      cells.visit(first + begin, first + end, [&](const SphereCell& cell) { written.add(cell); });
      written.write(diagram);
    });
    return {};
  });
}

/// The triangles by input index, counter-clockwise from the lowest, ascending: a mesh has them in any order.
void writeTriangles(const SphereMesh& mesh, std::size_t sites, int threads, Diagram& diagram) {
  const auto lowest = [&](const MeshTriangle& triangle) {
    const auto siteAt = [&](std::int32_t v) { return mesh.site[static_cast<std::size_t>(v)]; };
    std::array<std::uint32_t, 3> named{};
    std::ranges::transform(triangle.corner, named.begin(), siteAt);
    std::ranges::rotate(named, std::ranges::min_element(named));
    return named;
  };
  std::vector<std::uint32_t> end(sites + 1);
  for (const MeshTriangle& triangle : mesh.triangles) ++end[lowest(triangle)[0] + std::size_t{1}];
  std::partial_sum(end.begin(), end.end(), end.begin());
  diagram.triangles.resize(mesh.triangles.size());
  for (const MeshTriangle& triangle : mesh.triangles) {
    const auto named = lowest(triangle);
    diagram.triangles[end[named[0]]++] = named;
  }
  parallelEach(sites, globe_grain, threads, [&](std::size_t i) {
    const auto at = [&](std::uint32_t k) { return diagram.triangles.begin() + k; };
    std::sort(at(i > 0 ? end[i - 1] : 0), at(end[i]));
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
  const bool has_places = detail != Detail::measures;
  VORPIPE_VAR(cells, cellsOfSphere(placed, mesh, has_places, threads));
  diagram.owner = std::move(mesh.owner);
  VORPIPE_TRY(writeDiagram(placed, sites, cells, has_places, threads, progress, diagram));
  if (detail == Detail::everything) writeTriangles(mesh, sites.size(), threads, diagram);
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
  if (has_triangles) writeTriangles(mesh, sites.size(), threads, diagram);
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
