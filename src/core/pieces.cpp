#include "core/pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vorpipe {
namespace {

/// Vertices nearer to each other than this part of the domain are one: no picture shows it, and the
/// direction from one to the other would be rounding.
constexpr double least_edge = 1e-9;

std::vector<Point> distinctVertices(std::span<const Point> polygon) {
  std::vector<Point> vertices;
  for (const auto p : polygon) {
    const auto isNear = [&](Point q) { return std::hypot(p.x - q.x, p.y - q.y) < least_edge; };
    if (vertices.empty() || !(isNear(vertices.back()) || isNear(vertices.front()))) vertices.push_back(p);
  }
  return vertices;
}

/// The line through a and b with the polygon on its left.
void appendLine(Point a, Point b, std::vector<Line<float>>& lines) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const double nx = (b.y - a.y) / length;
  const double ny = (a.x - b.x) / length;
  const double h = 0.5 * ((a.x + b.x) * nx + (a.y + b.y) * ny);
  lines.push_back({static_cast<float>(nx), static_cast<float>(ny), static_cast<float>(h), 0.0f});
}

}  // namespace

std::size_t appendPieces(std::span<const Point> polygon, std::size_t most_edges, CellBatch<float>& out) {
  const auto vertices = distinctVertices(polygon);
  std::size_t pieces = 0;
  for (std::size_t from = 1; from + 1 < vertices.size(); ++pieces) {
    const auto to = std::min(from + most_edges - 2, vertices.size() - 1);
    const auto first = static_cast<std::uint32_t>(out.lines.size());
    const auto corner = vertices[0];
    Box box{corner.x, corner.y, corner.x, corner.y};
    appendLine(corner, vertices[from], out.lines);
    for (auto v = from; v <= to; ++v) {
      const auto p = vertices[v];
      box = {std::min(box.xmin, p.x), std::min(box.ymin, p.y), std::max(box.xmax, p.x),
             std::max(box.ymax, p.y)};
      appendLine(p, v < to ? vertices[v + 1] : corner, out.lines);
    }
    out.entries.push_back({first, static_cast<std::uint32_t>(out.lines.size()) - first,
                           static_cast<float>(box.xmin), static_cast<float>(box.ymin),
                           static_cast<float>(box.xmax), static_cast<float>(box.ymax),
                           std::numeric_limits<float>::max(), 0.0f});
    from = to;
  }
  return pieces;
}

}  // namespace vorpipe
