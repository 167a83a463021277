#include "core/drawing/convex_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vorpipe::core {
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

double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
Point between(Point a, Point b) { return {b.x - a.x, b.y - a.y}; }

/// A vertex, and how far at most it is from the polygon that had the edges which were left out.
struct Corner {
  Point at;
  double excess;
};

/// From p to the nearest point between a and b. How far p is beyond the line through them would not do:
/// beside the tip of a sliver that is next to nothing, however far p is from the sliver.
double distance(Point p, Point a, Point b) {
  const Point edge = between(a, b), way = between(a, p);
  const double length = edge.x * edge.x + edge.y * edge.y;
  const double t = std::clamp((way.x * edge.x + way.y * edge.y) / length, 0.0, 1.0);
  return std::hypot(way.x - t * edge.x, way.y - t * edge.y);
}

/// Where the edges beside the one from b to c meet, the one from a and the one to d; excess is infinite if it
/// is not beyond that.
Corner meetingBeyond(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
  const Point before = between(a.at, b.at), edge = between(b.at, c.at), after = between(c.at, d.at);
  const double turn = cross(before, after);
  const double ahead = cross(edge, after) / turn;
  if (!(turn > 0) || !(ahead >= 0)) return {{}, std::numeric_limits<double>::infinity()};
  const Point met{b.at.x + before.x * ahead, b.at.y + before.y * ahead};
  return {met, distance(met, b.at, c.at) + std::max(b.excess, c.excess)};
}

/// The vertices of a polygon that reaches no farther than `tolerance` beyond the given one, and has none
/// that matter less: where many nearly parallel edges meet, a device loses track of them.
std::vector<Point> simplified(std::span<const Point> polygon, double tolerance) {
  std::vector<Corner> corners;
  for (const auto p : distinctVertices(polygon)) corners.push_back({p, 0});
  for (std::size_t k = 0, kept = 0; kept < corners.size() && corners.size() > 3;) {
    const auto count = corners.size();
    const auto b = k % count, c = (k + 1) % count;
    const auto met =
        meetingBeyond(corners[(b + count - 1) % count], corners[b], corners[c], corners[(c + 1) % count]);
    if (met.excess <= tolerance) {
      corners[b] = met;
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(c));
      k = (c == 0 ? b - 1 : b) + corners.size() - 1;
      kept = 0;
    } else {
      ++k;
      ++kept;
    }
  }
  std::vector<Point> vertices;
  for (const auto& corner : corners) vertices.push_back(corner.at);
  return vertices;
}

/// The line through a and b with the polygon on its left.
void appendLine(Point a, Point b, std::vector<HalfPlane<float>>& lines) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const double nx = (b.y - a.y) / length;
  const double ny = (a.x - b.x) / length;
  const double h = 0.5 * ((a.x + b.x) * nx + (a.y + b.y) * ny);
  lines.push_back({static_cast<float>(nx), static_cast<float>(ny), static_cast<float>(h), 0.0f});
}

}  // namespace

std::size_t appendPieces(std::span<const Point> polygon, std::size_t most_edges, double tolerance,
                         CellBatch<float>& out) {
  const auto vertices = simplified(polygon, tolerance);
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

}  // namespace vorpipe::core
