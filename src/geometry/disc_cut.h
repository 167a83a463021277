/// The intersection of a disc with a convex polygon.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

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
  bool enters = false, leaves = false;  ///< the edge begins, or ends, outside, and crosses the circle
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

/// Returns the chord of the edge from `begin` to `end`, which lies on `line`. Errors are some 1e-16 of the
/// disc's radius, however far the ends are.
Chord chordOf(const EdgeLine& line, const EdgeEnd& begin, const EdgeEnd& end, double squared_radius);

/// Measures of a disc's segment, which lies between a chord and its arc.
struct SegmentMeasures {
  double area;
  double height;         ///< of the centroid above the chord, away from the disc's center
  double along, across;  ///< second moments about the centroid: along the chord, and across it
};

/// Measures the segment whose arc subtends twice `half_angle` at the center; `half_angle` is 0 to pi. A
/// segment of more than half a disc contains the center. Accurate to some 1e-15, for small angles too.
SegmentMeasures measureSegment(double radius, double half_angle);

/// A part of the disc's circle inside of the polygon, counter-clockwise.
struct Arc {
  Point from, to;
  double angle;         ///< that it subtends at the center, up to a whole turn
  std::uint32_t after;  ///< the edge whose chord ends where the arc begins; no_edge for a whole circle

  static constexpr std::uint32_t no_edge = ~std::uint32_t{0};
};

enum class DiscShape : std::uint8_t {
  nothing,
  polygon,  ///< the whole polygon
  part,     ///< part of both, or the whole disc
};

/// Measures the intersection by closed formulas; reusable for any number of polygons. Corners run
/// counter-clockwise; edge k runs from corner k to the next. Corners may coincide.
class DiscCut {
 public:
  /// `corners` are relative to the disc's center, and lines[k] is the line of edge k. Accepts discs of any
  /// size, but loses more digits the larger the disc is relative to the polygon. If isFar() holds, use
  /// cutFar() instead.
  DiscShape cut(std::span<const Point> corners, std::span<const EdgeLine> lines, double squared_radius);

  /// Cuts with a disc for which isFar() holds. `corners` and `center` are relative to one of the corners.
  DiscShape cutFar(std::span<const Point> corners, Point center, double squared_radius);

  static bool isFar(std::span<const Point> corners, double squared_radius);

  // For DiscShape::part. Positions are relative to the origin of the corners.
  [[nodiscard]] double area() const { return area_; }
  [[nodiscard]] Point centroid() const { return centroid_; }
  /// Integrals of xx, xy, yy about the centroid.
  [[nodiscard]] std::array<double, 3> secondMoments() const { return second_; }
  /// The integral of the squared distance to the centroid.
  [[nodiscard]] double spread() const { return second_[0] + second_[2]; }
  /// The sum over all arcs.
  [[nodiscard]] double arcAngle() const;
  [[nodiscard]] std::span<const Chord> chords() const { return chords_; }  ///< by edge
  [[nodiscard]] std::span<const Arc> arcs() const { return arcs_; }        ///< counter-clockwise

 private:
  struct Part {
    double area;
    Point centroid;
    std::array<double, 3> second;
  };

  void findArcs(std::span<const EdgeLine> lines, double squared_radius);
  void findFarArcs(double radius);
  template <class Take>
  void eachGap(const Take& take) const;
  void measure(double radius);
  void addPolygon();
  void addSegment(const Arc& arc, double radius);
  void addUp();

  std::vector<Chord> chords_;
  std::vector<Arc> arcs_;
  std::vector<Point> polygon_;
  std::vector<Part> parts_;
  double area_ = 0;
  Point centroid_{0, 0};
  std::array<double, 3> second_{};
};

}  // namespace vorpipe::core
