#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "check/checks.h"

namespace vorpipe::core::checks {
namespace {

/// Relative to the sum of the terms of a predicate.
constexpr double predicate_slack = 1e-13;

/// One side of a triangle, with the corner opposite to it.
struct Side {
  std::uint64_t sites;  ///< the lower index in the high bits, then the higher, to sort by
  std::uint32_t opposite;
  bool upward;  ///< runs from the lower index to the higher
};

Side sideOf(const std::array<std::uint32_t, 3>& triangle, std::size_t corner) {
  const std::uint32_t from = triangle[(corner + 1) % 3], to = triangle[(corner + 2) % 3];
  const std::uint64_t low = std::min(from, to), high = std::max(from, to);
  return {low << 32 | high, triangle[corner], from < to};
}

std::uint32_t lowOf(const Side& side) { return static_cast<std::uint32_t>(side.sites >> 32); }
std::uint32_t highOf(const Side& side) { return static_cast<std::uint32_t>(side.sites); }
std::uint32_t fromOf(const Side& side) { return side.upward ? lowOf(side) : highOf(side); }
std::uint32_t toOf(const Side& side) { return side.upward ? highOf(side) : lowOf(side); }

/// The cotangent of the angle at a corner of a triangle, and its possible rounding error.
struct Cotangent {
  double value, rounding;
};

/// The angle opposite to the edge from `from`. Relative to a far corner, the ends of a short edge may
/// coincide.
Cotangent cotangentOpposite(Point corner, Point from, Point to) {
  const Point u = from - corner, v = to - corner, edge = to - from;
  const double twice_area = std::abs(cross(edge, u));
  const double sides = length(u) * length(v) / twice_area, turned = length(edge) * length(u) / twice_area;
  return {dot(u, v) / twice_area, 16 * epsilon * sides * (1 + turned)};
}

/// The contribution of weights to the cotangent at the corner of[2] of a triangle. Half of the sum is still
/// the distance of the center from the edge of[0], of[1], over that edge's length.
Cotangent weighed(const CheckedCells& run, const std::array<std::uint32_t, 3>& of) {
  const Point from = run.site(of[0]), edge = run.site(of[1]) - from, corner = run.site(of[2]) - from;
  const double twice_area = std::abs(cross(edge, corner)), square = dot(edge, edge);
  const double to_corner = run.weightDifference(of[0], of[2]),
               to_end = run.weightDifference(of[0], of[1]) * dot(corner, edge) / square;
  const double sides = length(edge) * length(corner) / twice_area;
  return {(to_corner - to_end) / twice_area,
          16 * epsilon * (std::abs(to_corner) + std::abs(to_end)) / twice_area * (1 + sides)};
}

/// Whether the centers of the circles on both sides of an edge lie in the wrong order: their distance,
/// over that of the edge's ends, is half the sum of the cotangents of the angles opposite to it.
bool isInsideCircle(const CheckedCells& run, std::array<std::uint32_t, 4> of) {
  const Point from = run.site(of[0]), to = run.site(of[1]);
  Cotangent sum{0, 0};
  for (const auto opposite : {of[2], of[3]}) {
    const Cotangent part = cotangentOpposite(run.site(opposite), from, to);
    const Cotangent more = run.weighted ? weighed(run, {of[0], of[1], opposite}) : Cotangent{0, 0};
    sum = {sum.value + (part.value + more.value), sum.rounding + (part.rounding + more.rounding)};
  }
  // Any triangles may fill ties, of which a few may follow each other in a row.
  return sum.value / 2 < -tie_slack - sum.rounding;
}

bool isClockwise(const CheckedCells& run, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const Point ab = run.site(b) - run.site(a), ac = run.site(c) - run.site(a);
  return cross(ab, ac) < -4 * epsilon * length(ab) * length(ac);
}

bool checkEach(const CheckedCells& run, Broken& broken) {
  const auto& triangles = run.diagram.triangles;
  return broken.expect("triangles", triangles.size(), run.threads, [&](std::size_t t) -> std::string {
    const auto [a, b, c] = triangles[t];
    bool sites = std::max({a, b, c}) < run.size() && a != b && b != c && a != c;
    for (const auto site : triangles[t]) sites = sites && run.diagram.status[site] != Status::duplicate;
    if (!sites) return fmt::format("number {} is not of three sites: {}, {}, {}", t, a, b, c);
    if (isClockwise(run, a, b, c)) return fmt::format("number {}, {}, {}, {}, is clockwise", t, a, b, c);
    return {};
  });
}

std::vector<Side> sidesInOrder(const CheckedCells& run) {
  const auto& triangles = run.diagram.triangles;
  std::vector<Side> sides(3 * triangles.size());
  for (std::size_t s = 0; s < sides.size(); ++s) sides[s] = sideOf(triangles[s / 3], s % 3);
  std::ranges::sort(sides, {}, [](const Side& side) { return std::pair(side.sites, side.upward); });
  return sides;
}

/// What is wrong with side s of the sorted sides, as one of a pair or of the hull.
std::string wrongSide(const CheckedCells& run, const std::vector<Side>& sides, std::size_t s) {
  const Side& side = sides[s];
  if (s + 1 == sides.size() || sides[s + 1].sites != side.sites) return {};
  const Side& other = sides[s + 1];
  if (other.upward == side.upward) {
    return fmt::format("two lie on the same side of {}, {}", lowOf(side), highOf(side));
  }
  const std::array<std::uint32_t, 4> of{fromOf(side), toOf(side), side.opposite, other.opposite};
  if (isInsideCircle(run, of)) {
    return fmt::format("site {} lies inside of the circle of {}, {}, {}", of[3], of[0], of[1], of[2]);
  }
  return {};
}

/// The number of sites that the triangles should have: all except duplicates. With weights, the number that
/// they do have, provided that it includes all sites with cells.
std::size_t cornersOf(const CheckedCells& run, Broken& broken) {
  if (!run.weighted) {
    return static_cast<std::size_t>(
        std::ranges::count_if(run.diagram.status, [](Status status) { return status != Status::duplicate; }));
  }
  std::vector<std::uint8_t> is_corner(run.size());
  for (const auto& triangle : run.diagram.triangles) {
    for (const auto site : triangle) is_corner[site] = 1;
  }
  broken.expectEach("triangles", run, [&](std::size_t i) {
    return is_corner[i] == 0 && run.ok(i) ? fmt::format("site {} has a cell, but none", i) : std::string();
  });
  return static_cast<std::size_t>(std::ranges::count(is_corner, 1));
}

/// Checks the sides that only one triangle has: one circuit of the hull, turning left.
void checkHull(const CheckedCells& run, const std::vector<Side>& sides, Broken& broken) {
  std::vector<std::uint32_t> after(run.size(), no_site);
  std::uint32_t first = no_site;
  std::size_t hull = 0;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const bool paired = (s > 0 && sides[s - 1].sites == sides[s].sites) ||
                        (s + 1 < sides.size() && sides[s + 1].sites == sides[s].sites);
    if (paired) continue;
    ++hull;
    first = fromOf(sides[s]);
    after[first] = toOf(sides[s]);
  }
  std::size_t walked = 0;
  for (std::uint32_t at = first; at != no_site && walked <= hull;) {
    const std::uint32_t next = after[at];
    ++walked;
    if (next != no_site && after[next] != no_site && isClockwise(run, at, next, after[next])) {
      broken.add("triangles", fmt::format("their hull is not convex at site {}", next));
      return;
    }
    at = next == first ? no_site : next;
  }
  const std::size_t unique = cornersOf(run, broken);
  const std::size_t count = run.diagram.triangles.size();
  if (walked != hull || count + hull + 2 != 2 * unique) {
    broken.add("triangles", fmt::format("{} triangles of {} sites with {} on the hull are no triangulation",
                                        count, unique, hull));
  }
}

/// Whether all sites, or with weights all sites with cells, lie on one line, up to rounding.
bool areCollinear(const CheckedCells& run) {
  std::vector<std::size_t> sites;
  for (std::size_t i = 0; i < run.size(); ++i) {
    if (!run.weighted || run.ok(i)) sites.push_back(i);
  }
  if (sites.empty()) return true;
  const Point first = run.site(sites.front());
  Point line{0, 0};
  for (const auto i : sites) {
    const Point to = run.site(i) - first;
    if (length(to) > length(line)) line = to;
  }
  return std::ranges::all_of(sites, [&](std::size_t i) {
    const Point to = run.site(i) - first;
    return std::abs(cross(line, to)) <= predicate_slack * length(line) * length(to);
  });
}

}  // namespace

void checkTriangles(const CheckedCells& run, Broken& broken) {
  if (run.repeats()) {
    if (!run.diagram.triangles.empty()) broken.add("triangles", "a periodic domain has none");
    return;
  }
  if (run.diagram.triangles.empty()) {
    if (!areCollinear(run)) broken.add("triangles", "there are none, and the sites are not on one line");
    return;
  }
  if (!checkEach(run, broken)) return;
  const auto sides = sidesInOrder(run);
  const bool delaunay = broken.expect("triangles", sides.size(), run.threads,
                                      [&](std::size_t s) { return wrongSide(run, sides, s); });
  if (delaunay) checkHull(run, sides, broken);
}

}  // namespace vorpipe::core::checks
