/// Decisions on points of the plane that rounding cannot change.
#pragma once

#include "vorpipe.h"

namespace vorpipe {

/// Positive if a, b, c run counter-clockwise, negative if clockwise, 0 if they lie on a line.
int orientation(Point a, Point b, Point c);

/// Positive if d lies inside the circle through a, b, c, which run counter-clockwise; 0 if on it.
///
/// Both are exact for coordinates up to 2^240 whose differences are not below 2^-200.
int inCircle(Point a, Point b, Point c, Point d);

}  // namespace vorpipe
