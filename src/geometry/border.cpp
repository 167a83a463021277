#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/polygon_measures.h"
#include "vorpipe.h"
#include "vorpipe/free_surface.h"

namespace vorpipe {
namespace {

constexpr auto free_surface = static_cast<std::int64_t>(Wall::outline);

/// The angle that a line from a to b, counter-clockwise around `from`, subtends there.
double angleOf(Point a, Point b, Point from) {
  const double ax = a.x - from.x, ay = a.y - from.y, bx = b.x - from.x, by = b.y - from.y;
  return std::atan2(ax * by - ay * bx, ax * bx + ay * by);
}

}  // namespace

std::vector<BorderPart> borderOf(const Cell& cell, Point site) {
  const auto vertices = cell.vertices();
  const auto neighbors = cell.neighbors();
  std::vector<BorderPart> parts;
  bool in_arc = false;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const Point from = vertices[k], to = core::nextOf(vertices, k);
    const bool is_arc = neighbors[k] == free_surface;
    if (!in_arc || !is_arc) parts.push_back({from, to, 0, neighbors[k]});
    if (is_arc) {
      parts.back().to = to;
      parts.back().angle += angleOf(from, to, site);
    }
    in_arc = is_arc;
  }
  if (parts.size() == 1) parts[0].angle = 2 * std::numbers::pi;
  return parts;
}

bool hasFreeSurface(const Diagram& diagram, const Outline& outline) {
  return outline.empty() && !diagram.vertices.empty() &&
         std::ranges::find(diagram.neighbors, free_surface) != diagram.neighbors.end();
}

}  // namespace vorpipe
