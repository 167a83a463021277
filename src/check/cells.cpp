#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <future>
#include <new>
#include <span>

#include "base/try.h"
#include "check/outline.h"
#include "check/places.h"

namespace vorpipe::core::checks {
namespace {

/// Relative to the domain's area: cells are measured in double.
constexpr double area_sum_slack = 1e-12;
/// The same with an outline, where rounding of the domain's coordinates dominates.
constexpr double clipped_sum_slack = 1e-9;

/// The position of site i, equal for sites that the period makes equal.
Point positionOf(const CheckedSites& run, std::size_t i) {
  const auto placed = [&](double at) { return countedCoordinate(at * run.scale) == 0 ? 0 : at; };
  Point p{placed(run.sites.x[i]), placed(run.sites.y[i])};
  const auto& [low, high] = run.corners;
  if (run.repeats_x && p.x == high.x) p.x = low.x;
  if (run.repeats_y && p.y == high.y) p.y = low.y;
  return p;
}

std::size_t hash(Point p) {
  const PlaceKey key(p);
  std::uint64_t bits = (key.x ^ std::rotl(key.y, 32)) * 0x9E3779B97F4A7C15u;
  bits ^= bits >> 32;
  bits *= 0xD6E8FEB86659FD93u;
  return bits ^ bits >> 32;
}

/// For each site, the owner of its position: the heaviest, then the first. In a periodic domain scaled
/// weights are compared, which rounds those below 1e-308.
std::vector<std::uint32_t> ownersOfPositions(const CheckedSites& run) {
  std::vector<std::uint32_t> slots(std::bit_ceil(2 * run.size() + 1), no_site), first(run.size());
  const std::size_t mask = slots.size() - 1;
  for (std::uint32_t i = 0; i < run.size(); ++i) {
    std::size_t slot = hash(positionOf(run, i)) & mask;
    while (slots[slot] != no_site && !(positionOf(run, slots[slot]) == positionOf(run, i)))
      slot = (slot + 1) & mask;
    if (slots[slot] == no_site) slots[slot] = i;
    first[i] = slots[slot];
  }
  if (!run.weighted) return first;
  const double scale = run.repeats() ? run.scale : 1;
  const auto weight = [&](std::uint32_t i) { return run.sites.weight[i] * scale * scale; };
  std::vector<std::uint32_t> heaviest = first;
  for (std::uint32_t i = 0; i < run.size(); ++i) {
    auto& best = heaviest[first[i]];
    if (weight(i) > weight(best)) best = i;
  }
  for (auto& owner : first) owner = heaviest[owner];
  return first;
}

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

bool checkOutcome(const CheckedSites& run, const Outcome& outcome, Broken& broken) {
  // No structured binding, which lambdas of Clang before 16 cannot capture.
  const std::span<const Status> status = outcome.status;
  const std::span<const std::uint32_t> owner = outcome.owner;
  const Report& report = outcome.report;
  if (status.size() != run.size() || owner.size() != run.size()) {
    broken.add("statuses", fmt::format("{} sites have {} statuses and {} owners", run.size(), status.size(),
                                       owner.size()));
    return false;
  }
  const auto owners = ownersOfPositions(run);
  const bool owned = broken.expectEach("owners", run, [&](std::size_t i) {
    return owner[i] == owners[i]
               ? std::string()
               : fmt::format("site {} is owned by site {}, but site {} has its position first", i, owner[i],
                             owners[i]);
  });
  broken.expectEach("statuses", run, [&](std::size_t i) -> std::string {
    const bool duplicate = status[i] == Status::duplicate;
    if (status[i] > Status::duplicate) return fmt::format("site {} has none that is known", i);
    if (duplicate != (owners[i] != i)) {
      return fmt::format("site {} is {}a duplicate", i, duplicate ? "" : "not ");
    }
    const bool may_be_empty = run.weighted || run.outline != nullptr || !run.inDomain(run.site(i));
    if (status[i] != Status::empty || may_be_empty) return {};
    return fmt::format("site {} lies in the domain and cannot be empty", i);
  });
  std::array<std::uint64_t, 4> counts{};
  for (const Status each : status) ++counts[std::min<std::size_t>(static_cast<std::size_t>(each), 3)];
  if (counts != std::array<std::uint64_t, 4>{report.ok, report.empty, report.duplicate, 0}) {
    broken.add("statuses", fmt::format("{} ok, {} empty, {} duplicate; the report says {}, {}, {}", counts[0],
                                       counts[1], counts[2], report.ok, report.empty, report.duplicate));
  }
  return owned;
}

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
  return right && broken.expectEach("neighbors", run, [&](std::size_t i) { return wrongNeighbor(run, i); });
}

void checkMeasures(const CheckedCells& run, double domain, double slack, Broken& broken) {
  broken.expectEach("cells", run, [&](std::size_t i) { return wrongBesideCell(run, i); });
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
    if (options.globe) return core::checks::brokenOnGlobe(sites, options, diagram, threads);
    VORPIPE_LET(inside, core::checks::wrappedIfPeriodic(sites, options.domain, options.periodic, threads));
    return core::checks::brokenBy(
        core::checks::CheckedCells(inside ? *inside : sites, options, diagram, threads));
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Error{ErrorCode::device, "there is not enough memory to check the cells"});
  }
}

}  // namespace vorpipe
