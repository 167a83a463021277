#include "geometry/chord.h"

#include <algorithm>
#include <cmath>

#include "base/double_double.h"

namespace vorpipe::core {
namespace {

Point onLine(const EdgeLine& line, double along) {
  return {line.distance * line.normal.x - along * line.normal.y,
          line.distance * line.normal.y + along * line.normal.x};
}

/// Position along the line, from its point nearest to the center.
double alongLine(const EdgeLine& line, Point p) { return line.normal.x * p.y - line.normal.y * p.x; }

}  // namespace

EdgeLine lineThrough(Point a, Point b) {
  const double x = b.x - a.x, y = b.y - a.y, length = std::hypot(x, y);
  if (!(length > 0)) return {{0, 0}, 0};
  const DoubleDouble twice_area = DoubleDouble::product(a.x, b.y) - DoubleDouble::product(a.y, b.x);
  return {{y / length, -x / length}, twice_area.high / length};
}

double halfChord(const EdgeLine& line, double squared_radius) {
  return std::sqrt(std::max(std::fma(-line.distance, line.distance, squared_radius), 0.0));
}

Chord chordOf(const EdgeLine& line, const EdgeEnd& begin, const EdgeEnd& end, double squared_radius) {
  const double first = alongLine(line, begin.place), last = alongLine(line, end.place);
  const double half = halfChord(line, squared_radius);
  if (!begin.inside && !end.inside && !(half > 0 && first < 0 && last > 0)) return {};
  // Rounding may place an end on the wrong side of the crossing of edge and circle.
  const double from = begin.inside ? first : std::min(-half, end.inside ? last : half);
  const double to = end.inside ? last : std::max(half, from);
  return {begin.inside ? begin.place : onLine(line, from),
          end.inside ? end.place : onLine(line, to),
          std::max(to - from, 0.0),
          !begin.inside,
          !end.inside,
          true};
}

}  // namespace vorpipe::core
