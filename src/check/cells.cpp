#include <fmt/core.h>

#include <algorithm>
#include <future>
#include <new>

#include "check/outline.h"

namespace vorpipe::core::checks {
namespace {

/// Relative to the domain's area: cells are measured in double.
constexpr double area_sum_slack = 1e-12;
/// The same with an outline, where rounding of the domain's coordinates dominates.
constexpr double clipped_sum_slack = 1e-9;

bool isWall(const CheckedCells& run, std::int64_t neighbor) {
  if (neighbor == wall_outline) return run.outline != nullptr;
  const bool across_x = neighbor == wall_xmin || neighbor == wall_xmax;
  const bool across_y = neighbor == wall_ymin || neighbor == wall_ymax;
  return (across_x && !run.repeats_x) || (across_y && !run.repeats_y);
}

/// Whether the neighbor across an edge is another site, or another image of the same site.
bool isOther(const CheckedCells& run, std::size_t i, std::size_t e) {
  const auto [x, y] = run.shift(e);
  if ((x != 0 && !run.repeats_x) || (y != 0 && !run.repeats_y)) return false;
  return run.diagram.neighbors[e] != static_cast<std::int64_t>(i) || x != 0 || y != 0;
}

std::string wrongNeighbor(const CheckedCells& run, std::size_t i) {
  for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
    const std::int64_t neighbor = run.diagram.neighbors[e];
    const auto j = static_cast<std::size_t>(neighbor);
    if (neighbor < 0 ? isWall(run, neighbor) : j < run.size() && run.ok(j) && isOther(run, i, e)) continue;
    return fmt::format("site {} has {}, which is no wall and no other site with a cell", i, neighbor);
  }
  return {};
}

std::string wrongBesideCell(const CheckedCells& run, std::size_t i) {
  const Diagram& d = run.diagram;
  if (run.ok(i)) return {};
  const double perimeter = run.detail == Detail::measures ? 0 : d.perimeter[i];
  if (run.edges(i) != 0 || d.area[i] != 0 || perimeter != 0) {
    return fmt::format("site {} has no cell, but {} edges, area {} and perimeter {}", i, run.edges(i),
                       d.area[i], perimeter);
  }
  const Point centroid = d.centroid[i];
  if (centroid.x == run.sites.x[i] && centroid.y == run.sites.y[i]) return {};
  return fmt::format("site {} has no cell, and its centroid ({}, {}) is not the site", i, centroid.x,
                     centroid.y);
}

/// Across a flat domain, positions are rounded as much as along it. Sides that repeat are rounded as much as
/// coordinates, relative to the sides.
double sumSlack(const CheckedCells& run) {
  constexpr double steps = 4;
  const Box& box = run.domain;
  const double longer_side = std::max(box.xmax - box.xmin, box.ymax - box.ymin);
  double slack = area_sum_slack + steps * epsilon * longer_side / run.shorter_side;
  if (run.repeats_x) slack += steps * epsilon * run.largest / (box.xmax - box.xmin);
  if (run.repeats_y) slack += steps * epsilon * run.largest / (box.ymax - box.ymin);
  return slack;
}

/// Rounding of the area inside: corners on the outline are rounded like coordinates.
double outlineRounding(const CheckedCells& run, const CheckedOutline& outline) {
  constexpr double steps = 4;
  return steps * epsilon * run.largest * outline.length() / run.scale / run.scale;
}

std::vector<std::string> brokenBy(const CheckedCells& run) {
  // The tree is built concurrently with the other checks, which also need one thread.
  auto building = std::async(run.threads > 1 ? std::launch::async : std::launch::deferred,
                             [&] { return NearestSite(run, run.diagram.owner); });
  Broken broken;
  const Diagram& d = run.diagram;
  if (!checkOutcome(run, {d.status, d.owner, d.report}, broken)) return broken.take();
  if (!checkArrays(run, broken)) return broken.take();
  checkMass(run, broken);
  if (run.outline != nullptr) {
    const CheckedOutline outline(run);
    const double area = outline.area();
    checkMeasures(run, area, clipped_sum_slack + outlineRounding(run, outline) / area, broken);
    if (run.detail == Detail::everything) checkTriangles(run, broken);
    checkThinAreas(run, &outline, broken);
    checkClipped(run, outline, building.get(), broken);
    return broken.take();
  }
  const Box& box = run.caller_domain;
  checkMeasures(run, (box.xmax - box.xmin) * (box.ymax - box.ymin), sumSlack(run), broken);
  checkThinAreas(run, nullptr, broken);
  const Twins twins = findTwins(run);
  if (checkSymmetry(run, twins, broken)) checkPartition(run, twins, broken);
  if (run.detail == Detail::everything) checkTriangles(run, broken);
  if (run.detail != Detail::measures) checkPolygons(run, broken);
  checkNearest(run, building.get(), broken);
  return broken.take();
}

}  // namespace

bool checkArrays(const CheckedCells& run, Broken& broken) {
  const Diagram& d = run.diagram;
  const auto has = [&](std::string_view name, std::size_t size, std::size_t wanted) {
    if (size != wanted) broken.add("arrays", fmt::format("{} has {} records, not {}", name, size, wanted));
    return size == wanted;
  };
  const bool polygons = run.detail != Detail::measures;
  bool right = has("area", d.area.size(), run.size()) && has("centroid", d.centroid.size(), run.size()) &&
               has("cell_offsets", d.cell_offsets.size(), run.size() + 1) &&
               (!polygons || (has("perimeter", d.perimeter.size(), run.size()) &&
                              has("second_moments", d.second_moments.size(), run.size())));
  if (!right) return false;
  if (d.cell_offsets.front() != 0 || !std::ranges::is_sorted(d.cell_offsets)) {
    broken.add("arrays", "cell_offsets do not ascend from 0");
    return false;
  }
  const std::size_t entries = d.cell_offsets.back();
  right = has("neighbors", d.neighbors.size(), entries) &&
          has("neighbor_shifts", d.neighbor_shifts.size(), run.repeats() ? entries : 0) &&
          has("mass", d.mass.size(), run.density != nullptr ? run.size() : 0) &&
          has("mass_centroid", d.mass_centroid.size(), d.mass.size()) &&
          (!polygons || (has("vertices", d.vertices.size(), entries) &&
                         has("edge_lengths", d.edge_lengths.size(), entries)));
  return right && broken.expect("neighbors", run.size(), run.threads,
                                [&](std::size_t i) { return wrongNeighbor(run, i); });
}

void checkMeasures(const CheckedCells& run, double domain, double slack, Broken& broken) {
  broken.expect("cells", run.size(), run.threads, [&](std::size_t i) { return wrongBesideCell(run, i); });
  const double sum = areaSum(run.diagram);
  if (std::abs(sum - domain) <= slack * domain) return;
  broken.add("areas", fmt::format("they add up to {}, the domain has {} ({:.1e} of it more)", sum, domain,
                                  sum / domain - 1));
}

}  // namespace vorpipe::core::checks

namespace vorpipe {

Result<std::vector<std::string>> check(const Sites& sites, const CellsOptions& options,
                                       const Diagram& diagram, int threads) {
  try {
    const auto inside = core::checks::insideOf(sites, options.domain, options.periodic, threads);
    if (!inside) return tl::unexpected(inside.error());
    return core::checks::brokenBy(core::checks::CheckedCells(inside->of(sites), options, diagram, threads));
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Error{ErrorCode::device, "there is not enough memory to check the cells"});
  }
}

}  // namespace vorpipe
