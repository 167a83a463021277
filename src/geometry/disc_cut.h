/// The intersection of a disc with a convex polygon.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/chord.h"

namespace vorpipe::core {

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
