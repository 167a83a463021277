/// On which side of a line through two given points a vertex of the diagram lies, exactly: in the range of
/// predicates.h, with a filter in double. line_predicates.cpp derives the bounds.
#pragma once

#include <optional>

#include "geometry/predicates.h"

namespace vorpipe::core {

/// Returns the side of the line from p to q on which the power center of a, b and c (without weights, their
/// circumcenter) lies. 1: left; -1: right; 0: on it. Nothing if a, b and c lie on a line.
std::optional<int> centerSide(Point p, Point q, const WeightedPoint& a, const WeightedPoint& b,
                              const WeightedPoint& c);

/// The same for the point of the wall x = `wall` where the powers to a and b are equal. Nothing if their
/// bisector is parallel to the wall.
std::optional<int> sideAtWall(Point p, Point q, const WeightedPoint& a, const WeightedPoint& b, double wall);

}  // namespace vorpipe::core
