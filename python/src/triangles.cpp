#include "triangles.h"

#include <algorithm>
#include <cstddef>

namespace vorpipe::python {
namespace {

struct HalfEdge {
  std::uint32_t high;  ///< the larger of its two points; it lies with those of the smaller one
  std::int32_t triangle;
  std::int32_t corner;  ///< that it is opposite to
};

std::size_t next(std::size_t corner) { return corner == 2 ? 0 : corner + 1; }

std::size_t cornerOf(const Triangle& triangle, std::size_t point) {
  return triangle[0] == point ? 0 : triangle[1] == point ? 1 : 2;
}

/// Where the half-edges of each point begin, by the smaller of their points.
std::vector<std::size_t> edgeOffsets(std::span<const Triangle> triangles, std::size_t points) {
  std::vector<std::size_t> offsets(points + 1);
  for (const Triangle& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++offsets[std::min(triangle[k], triangle[next(k)]) + 1];
  }
  for (std::size_t i = 0; i < points; ++i) offsets[i + 1] += offsets[i];
  return offsets;
}

std::vector<HalfEdge> edgesByPoint(std::span<const Triangle> triangles,
                                   std::span<const std::size_t> offsets) {
  std::vector<std::size_t> place(offsets.begin(), offsets.end());
  std::vector<HalfEdge> edges(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[t][k], b = triangles[t][next(k)];
      edges[place[std::min(a, b)]++] = {std::max(a, b), static_cast<std::int32_t>(t),
                                        static_cast<std::int32_t>(next(next(k)))};
    }
  }
  return edges;
}

void join(std::vector<Adjacent>& adjacent, const HalfEdge& a, const HalfEdge& b) {
  adjacent[static_cast<std::size_t>(a.triangle)][static_cast<std::size_t>(a.corner)] = b.triangle;
  adjacent[static_cast<std::size_t>(b.triangle)][static_cast<std::size_t>(b.corner)] = a.triangle;
}

/// The next triangle around `point`, counter-clockwise where `turn` is 1, clockwise where it is 2.
std::int32_t turned(std::span<const Triangle> triangles, std::span<const Adjacent> adjacent,
                    std::int32_t triangle, std::size_t point, std::size_t turn) {
  const auto t = static_cast<std::size_t>(triangle);
  return adjacent[t][(cornerOf(triangles[t], point) + turn) % 3];
}

}  // namespace

std::vector<Adjacent> adjacentTriangles(std::span<const Triangle> triangles, std::size_t points) {
  const auto offsets = edgeOffsets(triangles, points);
  auto edges = edgesByPoint(triangles, offsets);
  std::vector<Adjacent> adjacent(triangles.size(), Adjacent{-1, -1, -1});
  for (std::size_t i = 0; i < points; ++i) {
    const auto begin = edges.begin() + static_cast<std::ptrdiff_t>(offsets[i]);
    const auto end = edges.begin() + static_cast<std::ptrdiff_t>(offsets[i + 1]);
    std::sort(begin, end, [](const HalfEdge& a, const HalfEdge& b) { return a.high < b.high; });
    for (auto edge = begin; edge != end && edge + 1 != end; ++edge) {
      if (edge->high == (edge + 1)->high) join(adjacent, *edge, *(edge + 1));
    }
  }
  return adjacent;
}

Fans fansOf(std::span<const Triangle> triangles, std::span<const Adjacent> adjacent, std::size_t points) {
  std::vector<std::int32_t> first(points, -1);
  Fans fans{std::vector<std::int64_t>(points + 1), std::vector<std::int32_t>(3 * triangles.size()),
            std::vector<std::uint8_t>(points)};
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t point : triangles[t]) {
      first[point] = static_cast<std::int32_t>(t);
      ++fans.offsets[point + 1];
    }
  }
  for (std::size_t i = 0; i < points; ++i) fans.offsets[i + 1] += fans.offsets[i];
  for (std::size_t i = 0; i < points; ++i) {
    if (first[i] < 0) continue;
    std::int32_t begin = first[i];
    for (;;) {
      const std::int32_t before = turned(triangles, adjacent, begin, i, 2);
      if (before < 0) break;
      begin = before;
      if (begin == first[i]) break;
    }
    fans.are_closed[i] = turned(triangles, adjacent, begin, i, 2) >= 0;
    auto place = static_cast<std::size_t>(fans.offsets[i]);
    std::int32_t at = begin;
    do {
      fans.triangles[place++] = at;
      at = turned(triangles, adjacent, at, i, 1);
    } while (at >= 0 && at != begin);
  }
  return fans;
}

}  // namespace vorpipe::python
