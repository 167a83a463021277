/// Places of the domain that checks ask for, and where they lie beside an edge.
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

/// Anywhere in the domain, the same on every platform: 256 for each site, but 2,000 at least and 20,000 at
/// most. Of nine sites 20,000 took ten times as long as all other checks together.
std::vector<Point> samplePlaces(const CheckedCells& run, Random& random);

/// What places are sorted by: their bits, since in broken diagrams some are no numbers, which have no order.
/// 0 and -0 are one place.
struct PlaceKey {
  explicit PlaceKey(Point p)
      : x(std::bit_cast<std::uint64_t>(p.x + 0.0)), y(std::bit_cast<std::uint64_t>(p.y + 0.0)) {}
  std::uint64_t x, y;
  auto operator<=>(const PlaceKey&) const = default;
};

/// From p to the nearest point of the way from a to b.
double distance(Point p, Point a, Point b);

/// The part of a ring where dot(p, normal) <= offset (Sutherland and Hodgman 1974), in its place. Parts
/// of other rings that lie apart are joined along the line, which does not change the area.
void cutRing(Point normal, double offset, std::vector<Point>& ring);

/// Of a ring that runs counter-clockwise.
double areaOf(std::span<const Point> ring);

/// Whether the way from a to b crosses the ray from p to the right.
bool crossesRay(Point p, Point a, Point b);

}  // namespace vorpipe::core::checks
