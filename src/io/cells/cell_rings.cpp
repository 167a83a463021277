#include "io/cells/cell_rings.h"

#include <algorithm>

namespace vorpipe {
namespace {

constexpr std::uint64_t least_vertices = 3;

/// Whether the area that the vertices enclose is negative.
bool isClockwise(std::span<const Point> vertices) {
  const Point& origin = vertices.front();
  double twice_area = 0;
  for (std::size_t k = 1; k + 1 < vertices.size(); ++k) {
    const Point &a = vertices[k], &b = vertices[k + 1];
    twice_area += (a.x - origin.x) * (b.y - origin.y) - (b.x - origin.x) * (a.y - origin.y);
  }
  return twice_area < 0;
}

}  // namespace

std::vector<Ring> ringsOf(const Diagram& diagram, std::size_t site) {
  const std::uint64_t begin = diagram.cell_offsets[site], end = diagram.cell_offsets[site + 1];
  const auto& starts = diagram.ring_starts;
  std::vector<Ring> rings;
  if (starts.empty()) {
    if (end - begin >= least_vertices) {
      rings.push_back({begin, end, false});
    }
    return rings;
  }
  for (auto start = std::ranges::lower_bound(starts, begin); start != starts.end() && *start < end; ++start) {
    Ring ring{*start, start + 1 == starts.end() ? end : std::min(end, *(start + 1)), false};
    if (ring.end - ring.begin >= least_vertices) {
      ring.hole = !rings.empty() && isClockwise(verticesOf(diagram, ring));
      rings.push_back(ring);
    }
  }
  return rings;
}

std::vector<std::span<const Ring>> piecesOf(std::span<const Ring> rings) {
  std::vector<std::span<const Ring>> pieces;
  while (!rings.empty()) {
    const auto next =
        std::find_if(rings.begin() + 1, rings.end(), [](const Ring& ring) { return !ring.hole; });
    const auto size = static_cast<std::size_t>(next - rings.begin());
    pieces.push_back(rings.first(size));
    rings = rings.subspan(size);
  }
  return pieces;
}

bool hasPolygon(const Diagram& diagram, std::size_t site) { return !ringsOf(diagram, site).empty(); }

}  // namespace vorpipe
