#include "domain/ring_faults.h"

#include <algorithm>
#include <array>

#include "geometry/predicates.h"

namespace vorpipe::core {
namespace {

/// Up to this many pairs of edges are compared one by one; for more, a tree of edges finds candidates.
constexpr std::size_t few_pairs = std::size_t{1} << 16;

bool isWithin(Point low, Point high, Point p) {
  return p.x >= std::min(low.x, high.x) && p.x <= std::max(low.x, high.x) && p.y >= std::min(low.y, high.y) &&
         p.y <= std::max(low.y, high.y);
}

/// Whether p, on the line of a and b, lies strictly between them.
bool isInside(Point a, Point b, Point p) { return p != a && p != b && isWithin(a, b, p); }

bool haveMoreThanEnds(Point a, Point b, Point c, Point d) {
  if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) ||
      std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y)) {
    return false;
  }
  const int c_side = orientation(a, b, c), d_side = orientation(a, b, d);
  if (c_side * d_side > 0) return false;
  const int a_side = orientation(c, d, a), b_side = orientation(c, d, b);
  if (a_side * b_side > 0) return false;
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  return (c_side == 0 && isInside(a, b, c)) || (d_side == 0 && isInside(a, b, d)) ||
         (a_side == 0 && isInside(c, d, a)) || (b_side == 0 && isInside(c, d, b));
}

}  // namespace

void findFaults(const ClippedCell& cell, std::span<const std::uint32_t> asked,
                std::vector<EdgePair>& faults) {
  const auto ends = cell.ends();
  const auto compare = [&](std::uint32_t e, std::uint32_t f) {
    if (haveMoreThanEnds(cell.vertices[e], ends[e], cell.vertices[f], ends[f])) faults.push_back({e, f});
  };
  const auto count = static_cast<std::uint32_t>(cell.vertices.size());
  if (asked.size() * count <= few_pairs) {
    for (const auto e : asked) {
      for (std::uint32_t f = 0; f < count; ++f) compare(e, f);
    }
    return;
  }
  Rings rings{cell.vertices, cell.ring_starts, {}, {}};
  rings.offsets.push_back(count);
  for (std::uint32_t r = 0; r < cell.ring_starts.size(); ++r) rings.ring.resize(rings.offsets[r + 1], r);
  const OutlineIndex index(rings);
  std::vector<std::uint32_t> near;
  for (const auto e : asked) {
    const std::array way{cell.vertices[e], ends[e]};
    index.edgesIn(boxOf(way), near);
    for (const auto f : near) compare(e, f);
  }
}

}  // namespace vorpipe::core
