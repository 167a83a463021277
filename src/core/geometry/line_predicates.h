/// Whether a vertex of the diagram lies exactly on a line through two given points: in the range of
/// predicates.h, with a filter in double. line_predicates.cpp derives the bounds.
#pragma once

#include "core/geometry/predicates.h"

namespace vorpipe::core {

/// Whether the power center of a, b and c, without weights their circumcenter, lies on the line through p and
/// q. False where a, b and c lie on a line.
bool isCenterOnLine(Point p, Point q, const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c);

/// The same for the point of the wall x = `wall` where the powers to a and b are equal. False where their
/// bisector is parallel to the wall.
bool isOnLineAtWall(Point p, Point q, const WeightedPoint& a, const WeightedPoint& b, double wall);

}  // namespace vorpipe::core
