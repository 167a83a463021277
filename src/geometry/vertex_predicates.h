/// On which side of a wall, or of a line through two given points, a vertex of the diagram lies: exact signs,
/// in the range of predicates.h, with a filter in double. vertex_predicates.cpp derives the bounds.
#pragma once

#include <cstdint>
#include <optional>

#include "geometry/predicates.h"

namespace vorpipe::core {

/// 1, 2, 4, 8 for the walls xmin, xmax, ymin, ymax; 0 for a site.
constexpr std::uint8_t wallBit(std::int32_t wall) {
  return wall < 0 ? static_cast<std::uint8_t>(1u << (-wall - 1)) : std::uint8_t{0};
}

/// The bits of the walls on or beyond which the power center of a, b, c lies; without weights, their
/// circumcenter. 0: it lies inside the domain. a, b, c run counter-clockwise.
std::uint8_t wallsReached(const Box& domain, const WeightedPoint& a, const WeightedPoint& b,
                          const WeightedPoint& c);

/// -1: the power of p to a is less than that to b; 1: it is greater; 0: p lies on their bisector.
int nearerOf(const WeightedPoint& a, const WeightedPoint& b, Point p);

/// For a and b of equal y, whose bisector is vertical. 1: it lies at a larger x; -1: at a smaller; 0: at x.
int middleSide(const WeightedPoint& a, const WeightedPoint& b, double x);

/// Returns the side of the line from p to q on which the power center of a, b and c (without weights, their
/// circumcenter) lies. 1: left; -1: right; 0: on it. Nothing if a, b and c lie on a line.
std::optional<int> centerSide(Point p, Point q, const WeightedPoint& a, const WeightedPoint& b,
                              const WeightedPoint& c);

/// The same for the point of the wall x = `wall` where the powers to a and b are equal. Nothing if their
/// bisector is parallel to the wall.
std::optional<int> sideAtWall(Point p, Point q, const WeightedPoint& a, const WeightedPoint& b, double wall);

}  // namespace vorpipe::core
