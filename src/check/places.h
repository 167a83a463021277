/// Sample places of the domain for checks, and their position relative to an edge.
#pragma once

#include <bit>
#include <compare>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "check/run.h"

namespace vorpipe::core::checks {

using Random = std::mt19937_64;

/// Places anywhere in the domain, the same on every platform: 256 for each site, but at least 2,000 and at
/// most 20,000. With nine sites, 20,000 took ten times as long as all other checks together.
std::vector<Point> samplePlaces(const CheckedCells& run, Random& random);

/// Sort key of places: their bits, since in broken diagrams some are NaN, which has no order. 0 and -0 are
/// the same place.
struct PlaceKey {
  explicit PlaceKey(Point p)
      : x(std::bit_cast<std::uint64_t>(p.x + 0.0)), y(std::bit_cast<std::uint64_t>(p.y + 0.0)) {}
  std::uint64_t x, y;
  auto operator<=>(const PlaceKey&) const = default;
};

/// Distance from p to the nearest point of the segment from a to b.
double distance(Point p, Point a, Point b);

/// Reduces a ring to its part where dot(p, normal) <= offset (Sutherland and Hodgman 1974), in place.
/// Separate parts of the result are joined along the line, which does not change the area.
void cutRing(Point normal, double offset, std::vector<Point>& ring);

/// The area of a counter-clockwise ring.
double areaOf(std::span<const Point> ring);

/// Whether the segment from a to b crosses the ray from p to the right.
bool crossesRay(Point p, Point a, Point b);

}  // namespace vorpipe::core::checks
