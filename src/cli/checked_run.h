/// A run's cells, as the checks of check_cells see them.
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "cli/input.h"
#include "vorpipe.h"

namespace vorpipe::cli {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct CheckedRun {
  const Input& input;
  const Diagram& diagram;

  [[nodiscard]] const Box& domain() const { return input.domain; }
  [[nodiscard]] Point site(std::size_t i) const { return {input.sites.x[i], input.sites.y[i]}; }
  [[nodiscard]] bool inDomain(Point p) const {
    const Box& box = domain();
    return p.x >= box.xmin && p.x <= box.xmax && p.y >= box.ymin && p.y <= box.ymax;
  }
  [[nodiscard]] bool ok(std::size_t i) const { return diagram.status[i] == Status::ok; }
  /// The vertices and edges of cell i are begin(i) .. end(i) - 1.
  [[nodiscard]] std::size_t begin(std::size_t i) const { return diagram.cell_offsets[i]; }
  [[nodiscard]] std::size_t end(std::size_t i) const { return diagram.cell_offsets[i + 1]; }
  /// The vertex of cell i that follows vertex v.
  [[nodiscard]] Point after(std::size_t i, std::size_t v) const {
    return diagram.vertices[v + 1 < end(i) ? v + 1 : begin(i)];
  }
};

inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline bool operator==(Point a, Point b) { return a.x == b.x && a.y == b.y; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
inline double length(Point a) { return std::hypot(a.x, a.y); }

/// How far p lies beyond the bisector of two sites, seen from the first.
inline double beyondBisector(Point from, Point to, Point p) {
  const Point d = to - from;
  return dot(p - from, d) / length(d) - length(d) / 2;
}

/// The first cell that is no convex polygon, counter-clockwise and closed, with edges as long as they are
/// said to be and on the lines that its neighbors give. Relies on valid offsets and neighbors.
std::string brokenPolygon(const CheckedRun& run);

/// The first of 1000 pseudo-random cells with a site that is nearer to the cell's centroid, or to one of
/// its vertices, than its own. Of more than 20,000 sites as many are asked, and those around the cell;
/// of more than 16 vertices at least 8. Relies on valid offsets and neighbors.
std::string brokenNearest(const CheckedRun& run);

}  // namespace vorpipe::cli
