#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "check/outline.h"
#include "check/places.h"

namespace vorpipe::core::checks {
namespace {

/// The possible difference between the area of a cell before ties join its corners, which the record has, and
/// the area that its rings enclose. Each true edge lies on its line, which its ends may be off. Around each
/// vertex, a region as wide as ties may belong to another cell.
double movedByTies(const CheckedCells& run, const CellRings& rings, std::size_t i, double reach) {
  const double off = run.ties(reach) + run.rounding(i);
  const double at_vertex = 4 * off * off;
  double moved = at_vertex;
  rings.eachEdge([&](std::size_t e, Point a, Point b) {
    const std::int64_t neighbor = run.diagram.neighbors[e];
    if (neighbor < 0) return;
    moved += 2 * at_vertex;
    const auto j = static_cast<std::size_t>(neighbor);
    const auto beyond = [&](Point p) { return std::abs(run.beyond(i, j, p)); };
    moved += std::max(beyond(a), beyond(b)) * length(b - a);
  });
  return moved;
}

struct RingSums {
  double area, perimeter, rounding;
};

std::string wrongRingArea(const CheckedCells& run, const CheckedOutline& outline, const CellRings& rings,
                          const RingSums& sums, std::size_t i, double reach) {
  const double said = run.diagram.area[i];
  const double apart = std::abs(sums.area - said * run.scale * run.scale);
  if (apart <= sums.rounding + movedByTies(run, rings, i, reach)) return {};
  // Along the outline, ties may have removed all of a cell's own area, or added area of cells that it has no
  // edge with; its rings do not determine how much.
  const double longest_tie = run.ties(run.shorter_side);
  if (apart <= longest_tie * (sums.perimeter + longest_tie) && wrongArea(run, &outline, i).empty()) return {};
  return fmt::format("the rings of site {} have the area {}, its record says {}", i,
                     sums.area / run.scale / run.scale, said);
}

std::string wrongRings(const CheckedCells& run, const CheckedOutline& outline, std::size_t i, double reach) {
  const CellRings rings(run, i);
  if (run.edges(i) == 0) return {};
  if (rings.size() == 0 || rings.begin(0) != run.begin(i)) {
    return fmt::format("no ring of site {} begins where its cell does", i);
  }
  double area = 0, perimeter = 0, longest = 0;
  const Point origin = run.vertex(run.begin(i));
  std::string wrong;
  rings.eachEdge([&](std::size_t e, Point a, Point b) {
    area += cross(a - origin, b - origin) / 2;
    const double side = length(b - a);
    perimeter += side;
    longest = std::max(longest, length(a - origin));
    if (std::abs(side - run.diagram.edge_lengths[e] * run.scale) > run.rounding(i)) {
      wrong = fmt::format("edge {} of site {} is not as long as its ends are apart", e - run.begin(i), i);
    }
  });
  if (!wrong.empty()) return wrong;
  const RingSums sums{area, perimeter, run.rounding(i) * (perimeter + longest)};
  wrong = wrongRingArea(run, outline, rings, sums, i, reach);
  if (!wrong.empty()) return wrong;
  const double summed = run.rounding(i) * static_cast<double>(run.edges(i)) * (1 + perimeter);
  if (std::abs(perimeter - run.diagram.perimeter[i] * run.scale) <= summed) return {};
  return fmt::format("the rings of site {} have the perimeter {}, its record says {}", i,
                     perimeter / run.scale, run.diagram.perimeter[i]);
}

bool isOnWall(const CheckedCells& run, std::int64_t wall, Point p) {
  const Box& box = run.domain;
  const double x = countedCoordinate(p.x), y = countedCoordinate(p.y);
  return wall == wall_xmin   ? x == box.xmin
         : wall == wall_xmax ? x == box.xmax
         : wall == wall_ymin ? y == box.ymin
                             : y == box.ymax;
}

std::string wrongEdges(const CheckedCells& run, std::size_t i, double reach) {
  std::string wrong;
  CellRings(run, i).eachEdge([&](std::size_t e, Point a, Point b) {
    const std::int64_t neighbor = run.diagram.neighbors[e];
    const auto j = static_cast<std::size_t>(neighbor);
    const double slack = run.ties(reach) + run.rounding(i) + (neighbor < 0 ? 0 : run.rounding(j));
    const auto beyond = [&](Point p) { return std::abs(run.beyond(i, j, p)); };
    // checkBorder() covers edges of the outline.
    const bool right =
        neighbor == wall_outline || (neighbor < 0 ? isOnWall(run, neighbor, a) && isOnWall(run, neighbor, b)
                                                  : beyond(a) <= slack && beyond(b) <= slack);
    if (!right) wrong = fmt::format("edge {} of site {} is not where {} is", e - run.begin(i), i, neighbor);
  });
  return wrong;
}

/// Whether the outline cut cell i: its reach before, where ties may have moved the ends of its edges, is then
/// unknown. For a cell in a narrow end of the outline, edges along that may be points.
bool isCut(const CheckedCells& run, const CheckedOutline& outline, std::size_t i) {
  for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
    if (run.diagram.neighbors[e] == wall_outline) return true;
    if (outline.at(run.vertex(e), run.rounding(i)) == CheckedOutline::Side::edge) return true;
  }
  return false;
}

/// The edges of each cell, searchable by neighbor and ends. A hub has an edge with each of its many
/// neighbors, and with an outline of many narrow parts two cells may share thousands of edges. Searching them
/// linearly for each edge would take quadratic time.
class SortedEdges {
 public:
  explicit SortedEdges(const CheckedCells& run) : run_(run), edges_(run.diagram.neighbors.size()) {
    constexpr std::size_t grain = 4096;
    const bool placed = run.detail != Detail::measures;
    parallelFor(run.size(), grain, run.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto edges = std::span(edges_).subspan(run.begin(i), run.edges(i));
        std::iota(edges.begin(), edges.end(), 0U);
        if (placed) {
          std::ranges::sort(edges, {},
                            [&](std::uint32_t k) { return std::pair(neighbor(i, k), PlaceKey(from(i, k))); });
        } else {
          std::ranges::sort(edges, {}, [&](std::uint32_t k) { return neighbor(i, k); });
        }
      }
    });
  }

  /// Whether cell i has an edge with site j.
  [[nodiscard]] bool has(std::size_t i, std::size_t j) const {
    const auto site = static_cast<std::int64_t>(j);
    const auto neighbor_of = [&](std::uint32_t k) { return neighbor(i, k); };
    const auto edges = edgesOf(i);
    const auto first = std::ranges::lower_bound(edges, site, {}, neighbor_of);
    return first != edges.end() && neighbor_of(*first) == site;
  }
  /// The same for an edge from a to b, in a diagram with valid polygons and rings.
  [[nodiscard]] bool has(std::size_t i, std::size_t j, Point a, Point b) const {
    const std::pair wanted(static_cast<std::int64_t>(j), PlaceKey(a));
    const auto place_of = [&](std::uint32_t k) { return std::pair(neighbor(i, k), PlaceKey(from(i, k))); };
    const auto edges = edgesOf(i);
    for (auto k = std::ranges::lower_bound(edges, wanted, {}, place_of);
         k != edges.end() && place_of(*k) == wanted; ++k) {
      if (to(i, *k) == b) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] std::int64_t neighbor(std::size_t i, std::uint32_t k) const {
    return run_.diagram.neighbors[run_.begin(i) + k];
  }
  /// The start of edge k of cell i.
  [[nodiscard]] Point from(std::size_t i, std::uint32_t k) const { return run_.vertex(run_.begin(i) + k); }
  /// Its end, in its ring.
  [[nodiscard]] Point to(std::size_t i, std::uint32_t k) const {
    const auto& starts = run_.diagram.ring_starts;
    const std::uint64_t edge = run_.begin(i) + k;
    const auto next_ring = std::ranges::upper_bound(starts, edge);
    const std::uint64_t end = next_ring != starts.end() ? *next_ring : run_.diagram.neighbors.size();
    return run_.vertex(edge + 1 < end ? edge + 1 : *std::prev(next_ring));
  }
  [[nodiscard]] std::span<const std::uint32_t> edgesOf(std::size_t i) const {
    return std::span(edges_).subspan(run_.begin(i), run_.edges(i));
  }

  const CheckedCells& run_;
  std::vector<std::uint32_t> edges_;  ///< of each cell, sorted by neighbor and start
};

std::string wrongTwin(const CheckedCells& run, const SortedEdges& edges, std::size_t i) {
  std::string wrong;
  CellRings(run, i).eachEdge([&](std::size_t e, Point a, Point b) {
    const std::int64_t neighbor = run.diagram.neighbors[e];
    if (neighbor < 0 || edges.has(static_cast<std::size_t>(neighbor), i, b, a)) return;
    wrong = fmt::format("site {} has an edge with {}, which has another or none", i, neighbor);
  });
  return wrong;
}

std::string oneSided(const CheckedCells& run, const SortedEdges& edges, std::size_t i) {
  for (std::size_t e = run.begin(i); e < run.end(i); ++e) {
    const std::int64_t neighbor = run.diagram.neighbors[e];
    if (neighbor < 0 || edges.has(static_cast<std::size_t>(neighbor), i)) continue;
    return fmt::format("site {} has {} as a neighbor, and not the other way round", i, neighbor);
  }
  return {};
}

/// What is wrong if p belongs to the cell of `owner`.
std::string wrongInCell(const CheckedCells& run, const CheckedOutline& outline, std::uint32_t owner,
                        Point p) {
  bool inside = false;
  double away = std::numeric_limits<double>::infinity();
  CellRings(run, owner).eachEdge([&](std::size_t, Point a, Point b) {
    inside = inside != crossesRay(p, a, b);
    away = std::min(away, distance(p, a, b));
  });
  return run.wrongAtAnyReach(owner, [&](double reach) -> std::string {
    const double slack = run.ties(reach) + run.rounding(owner);
    const auto side = outline.at(p, slack);
    if (away <= slack || side == CheckedOutline::Side::edge) return {};
    if (inside == (side == CheckedOutline::Side::inside)) return {};
    return fmt::format("{} lies {} the outline, but {} in the cell of its nearest site {}", run.text(p),
                       inside ? "outside" : "inside", inside ? "" : "not ", owner);
  });
}

std::string wrongPlace(const CheckedCells& run, const CheckedOutline& outline, const NearestSite& nearest,
                       Point p) {
  std::string wrong;
  // Any of the sites that double cannot distinguish may own it.
  for (const auto site : nearest.allAt(p)) {
    wrong = wrongInCell(run, outline, run.diagram.owner[site], p);
    if (wrong.empty()) break;
  }
  return wrong;
}

bool haveRings(const CheckedCells& run, const CheckedOutline& outline, Broken& broken) {
  if (!std::ranges::is_sorted(run.diagram.ring_starts)) {
    broken.add("rings", "ring_starts do not ascend");
    return false;
  }
  return broken.expectEach("rings", run, [&](std::size_t i) {
    return run.wrongAtAnyReach(i, [&](double reach) { return wrongRings(run, outline, i, reach); });
  });
}

}  // namespace

void checkClipped(const CheckedCells& run, const CheckedOutline& outline, const NearestSite& nearest,
                  Broken& broken) {
  const SortedEdges edges(run);
  if (run.detail == Detail::measures || !haveRings(run, outline, broken)) {
    broken.expectEach("neighbors", run, [&](std::size_t i) { return oneSided(run, edges, i); });
    return;
  }
  broken.expectEach("edges", run, [&](std::size_t i) {
    const auto wrong = run.wrongAtAnyReach(i, [&](double reach) { return wrongEdges(run, i, reach); });
    return wrong.empty() || !isCut(run, outline, i) ? wrong : wrongEdges(run, i, run.shorter_side);
  });
  broken.expectEach("rings", run, [&](std::size_t i) { return wrongShape(run, outline, i); });
  broken.expectEach("neighbors", run, [&](std::size_t i) { return wrongTwin(run, edges, i); });
  checkBorder(run, outline, broken);
  Random random(1);
  checkNearestInCells(run, nearest, random, broken);
  const std::vector<Point> places = samplePlaces(run, random);
  broken.expect("nearest sites", places.size(), run.threads,
                [&](std::size_t k) { return wrongPlace(run, outline, nearest, places[k]); });
}

}  // namespace vorpipe::core::checks
