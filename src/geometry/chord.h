/// The part of a polygon's edge that lies in a disc.
#pragma once

#include <span>

#include "vorpipe.h"

namespace vorpipe::core {

/// The line that a polygon's edge lies on, relative to a disc's center: all p with p . normal = distance. The
/// normal is a unit vector that points out of the polygon.
struct EdgeLine {
  Point normal;
  double distance;  ///< negative where the center is on the outer side
};

/// The line from a to b, with the polygon on its left.
EdgeLine lineThrough(Point a, Point b);

/// The part of an edge that lies in a disc, in the edge's direction.
struct Chord {
  Point from, to;
  double length = 0;
  bool enters = false,
       leaves = false;  ///< the edge begins, or ends, outside of the disc, and crosses the circle
  bool is_there = false;
};

/// One end of an edge, relative to a disc's center.
struct EdgeEnd {
  Point place;
  bool inside;  ///< of the disc, its rim included
};

inline EdgeEnd endAt(Point place, double squared_radius) {
  return {place, place.x * place.x + place.y * place.y <= squared_radius};
}

/// Half the length of the infinite line inside the disc; 0 if the line misses it.
double halfChord(const EdgeLine& line, double squared_radius);

/// Returns the chord of the edge from `begin` to `end`, which lies on `line`. Errors are some 1e-16 of the
/// disc's radius, however far the ends are.
Chord chordOf(const EdgeLine& line, const EdgeEnd& begin, const EdgeEnd& end, double squared_radius);

}  // namespace vorpipe::core
