/// Whether a point lies in a box, and where it is nearest to a line.
#pragma once

#include <algorithm>

#include "vorpipe.h"

namespace vorpipe {

/// True on the walls; false for NaN.
inline bool isInside(const Box& box, double x, double y) {
  return x >= box.xmin && x <= box.xmax && y >= box.ymin && y <= box.ymax;
}

/// Returns the point of the line from a to b that is nearest to p.
inline Point nearestOnLine(Point a, Point b, Point p) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  if (square == 0) return a;
  const double along = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0);
  return {a.x + along * dx, a.y + along * dy};
}

}  // namespace vorpipe
