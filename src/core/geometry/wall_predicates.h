/// On which side of a wall of the domain vertices of a diagram lie: decisions that rounding cannot change,
/// for coordinates as predicates.h has them.
#pragma once

#include <cstdint>

#include "core/geometry/predicates.h"

namespace vorpipe::core {

/// One bit for each wall: 1, 2, 4, 8 for xmin, xmax, ymin, ymax; 0 for what is none.
constexpr std::uint8_t wallBit(std::int32_t wall) {
  return wall < 0 ? static_cast<std::uint8_t>(1u << (-wall - 1)) : std::uint8_t{0};
}

/// The walls on or beyond which the center of the circle through a, b, c lies, which run counter-clockwise;
/// by weight, the point whose powers to all three are equal.
std::uint8_t wallsReached(const Box& domain, const WeightedPoint& a, const WeightedPoint& b,
                          const WeightedPoint& c);

/// Negative if p is nearer to a, positive if it is nearer to b, 0 on their bisector.
int nearerOf(const WeightedPoint& a, const WeightedPoint& b, Point p);

/// For two points that differ in x alone, and in weight: the sign of their bisector's x, less a given one.
int middleSide(const WeightedPoint& a, const WeightedPoint& b, double x);

}  // namespace vorpipe::core
