#include "io/cells/wetted_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace vorpipe {
namespace {

using std::numbers::pi;

/// Corners of a whole circle.
constexpr double corners_of_circle = 48;

/// The part of a segment inside the disc around the origin: from and to in [0, 1]; from > to if there is
/// none.
struct Inside {
  double from = 1, to = 0;
};

Inside insideDisc(Point begin, Point end, double radius) {
  const double wx = end.x - begin.x, wy = end.y - begin.y;
  const double a = wx * wx + wy * wy, b = begin.x * wx + begin.y * wy;
  const double c = begin.x * begin.x + begin.y * begin.y - radius * radius;
  const double square = b * b - a * c;
  if (!(a > 0) || !(square > 0)) return {};
  const double root = std::sqrt(square);
  return {std::max(0.0, (-b - root) / a), std::min(1.0, (-b + root) / a)};
}

/// The part of a convex polygon around the origin inside the disc, counter-clockwise.
class DiscPart {
 public:
  explicit DiscPart(double radius) : radius_(radius) {}

  void cut(std::span<const Point> polygon, bool holds_center) {
    points.clear();
    bool any = false;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Point begin = polygon[k], end = polygon[k + 1 < polygon.size() ? k + 1 : 0];
      const auto [from, to] = insideDisc(begin, end, radius_);
      if (!(from < to)) continue;
      const auto at = [&](double part) {
        return Point{begin.x + part * (end.x - begin.x), begin.y + part * (end.y - begin.y)};
      };
      if (any && from > 0) arc(points.back(), at(from));
      points.push_back(at(from));
      if (to < 1) points.push_back(at(to));
      any = true;
    }
    if (any) {
      arc(points.back(), points.front());
    } else if (holds_center) {
      for (double k = 0; k < corners_of_circle; ++k) onCircle(2 * pi * k / corners_of_circle);
    }
  }

  std::vector<Point> points{};

 private:
  void onCircle(double angle) { points.push_back({radius_ * std::cos(angle), radius_ * std::sin(angle)}); }
  /// Adds the corners between two points, if both are on the circle and differ.
  void arc(Point from, Point to) {
    const double first = std::atan2(from.y, from.x);
    double turn = std::atan2(to.y, to.x) - first;
    if (turn < 0) turn += 2 * pi;
    const double gap = std::hypot(from.x - to.x, from.y - to.y);
    const bool on_circle = std::abs(std::hypot(from.x, from.y) - radius_) < 1e-9 * radius_ &&
                           std::abs(std::hypot(to.x, to.y) - radius_) < 1e-9 * radius_;
    if (!on_circle || gap < 1e-12 * radius_) return;
    const double parts = std::ceil(turn / (2 * pi) * corners_of_circle);
    for (double k = 1; k < parts; ++k) onCircle(first + turn * k / parts);
  }

  double radius_;
};

bool holdsOrigin(std::span<const Point> polygon) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point a = polygon[k], b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    if (a.x * b.y - a.y * b.x < 0) return false;
  }
  return true;
}

}  // namespace

CellsMesh wettedCells(const Sites& sites, const Diagram& diagram) {
  CellsMesh mesh;
  mesh.offsets.push_back(0);
  std::vector<Point> polygon;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const double weight = sites.weight.empty() ? 0 : sites.weight[i];
    polygon.clear();
    for (auto k = diagram.cell_offsets[i]; k < diagram.cell_offsets[i + 1]; ++k) {
      polygon.push_back({diagram.vertices[k].x - sites.x[i], diagram.vertices[k].y - sites.y[i]});
    }
    if (polygon.empty() || !(weight > 0)) continue;
    DiscPart part(std::sqrt(weight));
    part.cut(polygon, holdsOrigin(polygon));
    if (part.points.size() < 3) continue;
    for (const Point& point : part.points) {
      mesh.corners.push_back(static_cast<std::int32_t>(mesh.points.size()));
      mesh.points.push_back({point.x + sites.x[i], point.y + sites.y[i]});
    }
    mesh.offsets.push_back(mesh.corners.size());
    mesh.sites.push_back(static_cast<std::uint32_t>(i));
  }
  return mesh;
}

}  // namespace vorpipe
