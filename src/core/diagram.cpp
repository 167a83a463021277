#include "core/diagram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/corners.h"
#include "core/dual.h"
#include "core/measure.h"
#include "core/prepare.h"
#include "core/stopwatch.h"
#include "core/topology.h"
#include "parallel.h"

namespace vorpipe {
namespace {

constexpr std::size_t grain = 4096;

/// From scaled units to the caller's.
struct Unscale {
  int exponent;
  double operator()(double value, int power = 1) const { return std::ldexp(value, -power * exponent); }
  Point operator()(Point p) const { return {(*this)(p.x), (*this)(p.y)}; }
};

/// Finds cells that agree with each other: those in dispute are found again in double, once.
Result<Agreement> findAgreement(const TopologyInput& input, Topology& topology, std::uint64_t& in_double) {
  auto agreement = agreeOnCorners(input.sites, topology, input.threads);
  if (agreement.disputed.empty()) return agreement;
  in_double += agreement.disputed.size();
  if (auto found = findAgain(input, agreement.disputed, topology); !found)
    return tl::unexpected(found.error());
  agreement = agreeOnCorners(input.sites, topology, input.threads);
  if (agreement.disputed.empty()) return agreement;
  return tl::unexpected(Error{
      ErrorCode::input, fmt::format("the cells of {} sites around site {} disagree beyond double precision",
                                    agreement.disputed.size(), input.sites.id[agreement.disputed[0]])});
}

/// Counts the edges that are not ties, and the statuses, by input index.
void countEdges(const Prepared& prepared, const Topology& topology, const Corners& corners,
                Diagram& diagram) {
  const auto& set = prepared.set;
  diagram.status.assign(prepared.owner.size(), Status::duplicate);
  diagram.cell_offsets.assign(prepared.owner.size() + 1, 0);
  for (std::size_t i = 0; i < set.size(); ++i) {
    const bool empty = topology.status[i] == CellStatus::empty;
    diagram.status[set.id[i]] = empty ? Status::empty : Status::ok;
    ++(empty ? diagram.report.empty : diagram.report.ok);
    auto& count = diagram.cell_offsets[set.id[i] + std::size_t{1}];
    for (auto e = topology.first[i]; e < topology.first[i + 1]; ++e) count += corners.tie[e] ? 0u : 1u;
  }
  std::partial_sum(diagram.cell_offsets.begin(), diagram.cell_offsets.end(), diagram.cell_offsets.begin());
}

struct Filling {
  const SiteSet& set;
  const Topology& topology;
  const Corners& corners;
  Unscale unscale;
  Diagram& diagram;

  /// Writes the cell at place i of the set. A corner after which only ties follow is left out, so that
  /// each vertex stands once and begins the edge that it stands with.
  void fill(std::size_t i, std::vector<Point>& polygon) const {
    const auto id = set.id[i];
    auto out = diagram.cell_offsets[id];
    const Point site{set.x[i], set.y[i]};
    polygon.clear();
    for (auto e = topology.first[i]; e < topology.first[i + 1]; ++e) {
      if (corners.tie[e]) continue;
      const auto start = corners.position[e];
      const auto end = corners.position[corners.next[e]];
      polygon.push_back({start.x - site.x, start.y - site.y});
      const auto neighbor = topology.neighbor[e];
      diagram.vertices[out] = unscale(start);
      diagram.neighbors[out] =
          neighbor < 0 ? neighbor : std::int64_t{set.id[static_cast<std::size_t>(neighbor)]};
      diagram.edge_lengths[out] = unscale(std::hypot(end.x - start.x, end.y - start.y));
      ++out;
    }
    const auto m = measurePolygon(polygon);
    diagram.area[id] = unscale(m.area, 2);
    diagram.perimeter[id] = unscale(m.perimeter);
    diagram.centroid[id] = unscale(Point{site.x + m.centroid.x, site.y + m.centroid.y});
    for (std::size_t k = 0; k < 3; ++k) diagram.second_moments[id][k] = unscale(m.second_moments[k], 4);
  }
};

void fillCells(const Filling& filling, const Sites& sites, int threads) {
  auto& diagram = filling.diagram;
  const auto count = sites.size();
  diagram.area.assign(count, 0);
  diagram.perimeter.assign(count, 0);
  diagram.second_moments.assign(count, {0, 0, 0});
  diagram.centroid.resize(count);
  for (std::size_t i = 0; i < count; ++i) diagram.centroid[i] = {sites.x[i], sites.y[i]};
  diagram.vertices.resize(diagram.cell_offsets.back());
  diagram.neighbors.resize(diagram.cell_offsets.back());
  diagram.edge_lengths.resize(diagram.cell_offsets.back());
  parallelFor(filling.set.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Point> polygon;
    for (auto i = begin; i < end; ++i) {
      if (filling.topology.status[i] != CellStatus::empty) filling.fill(i, polygon);
    }
  });
}

}  // namespace

Result<Diagram> cellsOn(Backend& backend, Backend& judge, int threads, const Sites& sites,
                        const CellsOptions& options) {
  if (auto checked = checkSearch(options.search); !checked) return tl::unexpected(checked.error());
  Diagram diagram;
  auto& times = diagram.report.time_ms;
  Stopwatch order_watch;
  auto prepared = prepare(sites, options.domain, threads);
  if (!prepared) return tl::unexpected(prepared.error());
  times.order = 1e3 * order_watch.seconds();

  Stopwatch search_watch;
  const FlannSearch search(prepared->set, threads);
  times.search = 1e3 * search_watch.seconds();

  Stopwatch cells_watch;
  const TopologyInput input{
      backend, judge,           prepared->set, search, static_cast<std::size_t>(options.search.neighbors),
      threads, options.progress};
  auto topology = findTopology(input, diagram.report.in_double);
  if (!topology) return tl::unexpected(topology.error());
  const auto agreement = findAgreement(input, *topology, diagram.report.in_double);
  if (!agreement) return tl::unexpected(agreement.error());
  countEdges(*prepared, *topology, agreement->corners, diagram);
  diagram.report.duplicate = prepared->owner.size() - prepared->set.size();
  fillCells({prepared->set, *topology, agreement->corners, {prepared->exponent}, diagram}, sites, threads);
  diagram.triangles = dualTriangles(prepared->set, *topology, agreement->corners);
  times.cells = 1e3 * cells_watch.seconds();

  diagram.owner = std::move(prepared->owner);
  const auto& device = backend.info().device;
  diagram.report.backend = device.backend;
  diagram.report.device = device.name;
  diagram.report.driver = device.driver;
  diagram.report.validation_messages = backend.validationMessages();
  return diagram;
}

}  // namespace vorpipe
