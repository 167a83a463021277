#include "core/pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vorpipe {
namespace {

/// The line through a and b with the polygon on its left; none where a and b coincide.
void appendLine(Point a, Point b, std::vector<Line<float>>& lines) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (length == 0) return;
  const double nx = (b.y - a.y) / length;
  const double ny = (a.x - b.x) / length;
  const double h = 0.5 * ((a.x + b.x) * nx + (a.y + b.y) * ny);
  lines.push_back({static_cast<float>(nx), static_cast<float>(ny), static_cast<float>(h), 0.0f});
}

}  // namespace

std::size_t appendPieces(std::span<const double> x, std::span<const double> y, std::size_t most_edges,
                         CellBatch<float>& out) {
  const auto count = x.size();
  std::size_t pieces = 0;
  for (std::size_t from = 1; from + 1 < count; ++pieces) {
    const auto to = std::min(from + most_edges - 2, count - 1);
    const auto first = static_cast<std::uint32_t>(out.lines.size());
    const auto vertex = [&](std::size_t v) { return Point{x[v], y[v]}; };
    appendLine(vertex(0), vertex(from), out.lines);
    for (auto v = from; v < to; ++v) appendLine(vertex(v), vertex(v + 1), out.lines);
    appendLine(vertex(to), vertex(0), out.lines);
    Box box{x[0], y[0], x[0], y[0]};
    for (auto v = from; v <= to; ++v) {
      box = {std::min(box.xmin, x[v]), std::min(box.ymin, y[v]), std::max(box.xmax, x[v]),
             std::max(box.ymax, y[v])};
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
