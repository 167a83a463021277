#include "globe/globe_cells.h"

#include <algorithm>
#include <array>
#include <atomic>
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
  CellsToWrite(const SphereSites& sites, bool has_places) : measured_(sites, has_places) {}

  void add(const SphereCell& cell) {
    neighbor_.insert(neighbor_.end(), cell.neighbor.begin(), cell.neighbor.end());
    place_.insert(place_.end(), cell.place.begin(), cell.place.end());
    cells_.push_back({cell.site, neighbor_.size()});
    measured_.add(cell);
  }

  /// Writes the cells into rows whose places are known.
  void write(Diagram& diagram) {
    const double radius = earthRadius();
    measured_.finish();
    for (double& length : measured_.length) length *= radius;
    std::size_t begin = 0;
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      fetchAhead(k, diagram);
      const auto [site, end] = cells_[k];
      const auto copyRow = [&](const auto& from, auto& to) {
        if (!from.empty())
          std::copy_n(from.data() + begin, end - begin, to.data() + diagram.cell_offsets[site]);
      };
      copyRow(neighbor_, diagram.neighbors);
      copyRow(place_, diagram.vertices);
      copyRow(measured_.length, diagram.edge_lengths);
      const SphereMeasures& measures = measured_.measures[k];
      diagram.status[site] = Status::ok;
      diagram.area[site] = measures.area;
      diagram.solid_angle[site] = measures.solid_angle;
      diagram.centroid[site] = placeOf(measures.centroid);
      if (!diagram.perimeter.empty()) diagram.perimeter[site] = radius * measures.perimeter;
      begin = end;
    }
  }

 private:
  /// Has the processor fetch the rows of a cell that follows: they lie anywhere. (Not inlined, GCC would drop
  /// the call.)
  [[gnu::always_inline]] inline void fetchAhead(std::size_t k, Diagram& diagram) const {
    constexpr std::size_t ahead = 8, line = 64;
    if (k + 2 * ahead < cells_.size()) __builtin_prefetch(&diagram.cell_offsets[cells_[k + 2 * ahead].site]);
    if (k + ahead >= cells_.size()) return;
    const auto site = cells_[k + ahead].site;
    const auto row = diagram.cell_offsets[site];
    __builtin_prefetch(diagram.neighbors.data() + row, 1);
    __builtin_prefetch(diagram.area.data() + site, 1);
    __builtin_prefetch(diagram.solid_angle.data() + site, 1);
    __builtin_prefetch(diagram.centroid.data() + site, 1);
    __builtin_prefetch(diagram.status.data() + site, 1);
    if (place_.empty()) return;
    __builtin_prefetch(diagram.perimeter.data() + site, 1);
    __builtin_prefetch(diagram.edge_lengths.data() + row, 1);
    __builtin_prefetch(diagram.vertices.data() + row, 1);
    __builtin_prefetch(diagram.vertices.data() + row + line / sizeof(Point), 1);
  }

  struct Rows {
    std::size_t site, end;
  };

  MeasuredCells measured_;
  std::vector<Rows> cells_;
  std::vector<std::int64_t> neighbor_;
  std::vector<Point> place_;
};

/// Stages of a run, as large as each other, for the progress: the triangulation counts as two.
constexpr std::size_t globe_stages = 4;

Result<void> reportStage(const Progress& progress, std::size_t done) {
  return reportProgress(progress, "cells", done, globe_stages);
}

/// Allocates a diagram's arrays at the same time, the largest first: the time goes into their pages.
void makeRoom(Diagram& diagram, std::size_t triangles, bool has_places, int threads) {
  const auto sites = diagram.owner.size(), edges = diagram.cell_offsets.back();
  has_places |= edges == 0;
  const std::array<std::function<void()>, 5> tasks{
      [&] { diagram.vertices.resize(has_places ? edges : 0); }, [&] { diagram.neighbors.resize(edges); },
      [&] { diagram.edge_lengths.resize(has_places ? edges : 0); },
      [&] {
        diagram.area.resize(sites);
        diagram.solid_angle.resize(sites);
        diagram.centroid.resize(sites);
        diagram.status.resize(sites);
        if (has_places) diagram.perimeter.resize(sites);
      },
      [&] { diagram.triangles.resize(triangles); }};
  parallelEach(tasks.size(), 1, threadsForSteps(edges, threads), [&](std::size_t k) { tasks[k](); });
}

Result<void> writeDiagram(const SphereSites& placed, const Sites& sites, SphereCells& cells, bool has_places,
                          int threads, const Progress& progress, Diagram& diagram) {
  const auto count = sites.size();
  parallelEach(count, globe_grain, threads, [&](std::size_t i) {
    if (diagram.cell_offsets[i] < diagram.cell_offsets[i + 1]) return;
    diagram.status[i] = diagram.owner[i] != i ? Status::duplicate : Status::empty;
    diagram.centroid[i] = {sites.x[i], sites.y[i]};
  });
  const auto steps = cells.steps();
  const StageRange last{steps, (globe_stages - 1) * steps, globe_stages * steps};
  return runInSteps(progress, "cells", last, steps, [&](std::size_t first, std::size_t some) -> Result<void> {
    parallelFor(some, globe_grain, threads, [&](std::size_t begin, std::size_t end) {
      CellsToWrite written(placed, has_places);
      cells.visit(first + begin, first + end, [&](const SphereCell& cell) { written.add(cell); });
      written.write(diagram);
    });
    return {};
  });
}

/// The triangles by input index, counter-clockwise from the lowest, ascending: a mesh has them in any order.
void writeTriangles(const SphereMesh& mesh, std::size_t sites, int threads, Diagram& diagram) {
  constexpr std::size_t grain = 4096;
  const auto count = mesh.triangles.size();
  const auto named = [&](std::size_t t) {
    const auto siteAt = [&](std::int32_t v) { return mesh.site[static_cast<std::size_t>(v)]; };
    const auto& corner = mesh.triangles[t].corner;
    return fromLowest(std::array{siteAt(corner[0]), siteAt(corner[1]), siteAt(corner[2])});
  };
  std::vector<std::uint32_t> end(sites + 1);
  const auto next = [](std::uint32_t& number) {
    return std::atomic_ref(number).fetch_add(1, std::memory_order_relaxed);
  };
  parallelEach(count, grain, threads, [&](std::size_t t) { next(end[named(t)[0] + std::size_t{1}]); });
  std::partial_sum(end.begin(), end.end(), end.begin());
  diagram.triangles.resize(count);
  parallelFor(count, grain, threads, [&](std::size_t begin, std::size_t stop) {
    // Some at once, so that they wait for memory together.
    constexpr std::size_t some = 32;
    std::array<std::array<std::uint32_t, 3>, some> triangle{};
    std::array<std::uint32_t, some> place{};
    for (; begin < stop; begin += some) {
      const auto here = std::min(some, stop - begin);
      for (std::size_t k = 0; k < here; ++k) {
        triangle[k] = named(begin + k);
        __builtin_prefetch(&end[triangle[k][0]], 1);
      }
      for (std::size_t k = 0; k < here; ++k) {
        place[k] = next(end[triangle[k][0]]);
        __builtin_prefetch(&diagram.triangles[place[k]], 1);
      }
      for (std::size_t k = 0; k < here; ++k) diagram.triangles[place[k]] = triangle[k];
    }
  });
  // Threads came in any order; of those with the same lowest site, the next ones differ.
  parallelEach(sites, grain, threads, [&](std::size_t i) {
    const auto first = i > 0 ? end[i - 1] : 0;
    if (end[i] - first < 2) return;
    std::ranges::sort(std::span(diagram.triangles).subspan(first, end[i] - first), {},
                      [](const auto& triangle) { return triangle[1]; });
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
  diagram.cell_offsets = std::move(cells.offsets);
  makeRoom(diagram, detail == Detail::everything ? mesh.triangles.size() : 0, has_places, threads);
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
