/// Outlines for tests.
#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::test {

using RingPoints = std::vector<Point>;

/// Polygons, each its outer ring and then its holes.
inline Outline outlineOf(const std::vector<std::vector<RingPoints>>& polygons) {
  Outline outline;
  outline.ring_offsets.push_back(0);
  outline.polygon_offsets.push_back(0);
  for (const auto& polygon : polygons) {
    for (const auto& ring : polygon) {
      outline.points.insert(outline.points.end(), ring.begin(), ring.end());
      outline.ring_offsets.push_back(outline.points.size());
    }
    outline.polygon_offsets.push_back(outline.ring_offsets.size() - 1);
  }
  return outline;
}

inline RingPoints rectangle(double xmin, double ymin, double xmax, double ymax) {
  return {{xmin, ymin}, {xmax, ymin}, {xmax, ymax}, {xmin, ymax}};
}

/// A rugged ring around a center, which does not cross itself: every ray from the center meets it once. Its
/// radius varies by up to `rough` of itself, over all wavelengths.
inline RingPoints coast(Point center, double radius, std::size_t points, double rough, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> height{uniform(random)};
  double step = 1;
  while (height.size() < points) {
    std::vector<double> finer;
    step *= 0.6;
    for (std::size_t k = 0; k < height.size(); ++k) {
      finer.push_back(height[k]);
      finer.push_back((height[k] + height[(k + 1) % height.size()]) / 2 + step * uniform(random));
    }
    height = std::move(finer);
  }
  RingPoints ring;
  for (std::size_t k = 0; k < points; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(points);
    const double away = radius * (1 + rough * std::tanh(height[k * height.size() / points]));
    ring.push_back({center.x + away * std::cos(angle), center.y + away * std::sin(angle)});
  }
  return ring;
}

/// A country in the unit square with lakes, an island in one of them, and islands off its coast; about that
/// many points in all.
inline Outline country(std::size_t points, std::uint64_t seed = 1) {
  const std::size_t few = std::max<std::size_t>(points / 40, 8);
  std::vector<std::vector<RingPoints>> polygons;
  polygons.push_back({coast({0.45, 0.5}, 0.32, points - 8 * few, 0.3, seed)});
  polygons.back().push_back(coast({0.4, 0.5}, 0.08, 3 * few, 0.4, seed + 1));
  polygons.back().push_back(coast({0.55, 0.55}, 0.03, few, 0.4, seed + 2));
  polygons.back().push_back(coast({0.55, 0.45}, 0.001, few, 0.4, seed + 3));
  polygons.push_back({coast({0.4, 0.5}, 0.02, few, 0.4, seed + 4)});
  polygons.push_back({coast({0.92, 0.2}, 0.05, few, 0.4, seed + 5)});
  polygons.push_back({coast({0.93, 0.9}, 0.0005, few, 0.4, seed + 6)});
  return outlineOf(polygons);
}

inline double ringArea(std::span<const Point> ring) {
  double twice = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point a = ring[k], b = ring[(k + 1) % ring.size()];
    twice += (a.x - ring[0].x) * (b.y - ring[0].y) - (a.y - ring[0].y) * (b.x - ring[0].x);
  }
  return twice / 2;
}

/// Outer rings less holes.
inline double outlineArea(const Outline& outline) {
  double area = 0;
  for (std::size_t p = 0; p + 1 < outline.polygon_offsets.size(); ++p) {
    for (auto r = outline.polygon_offsets[p]; r < outline.polygon_offsets[p + 1]; ++r) {
      const auto begin = outline.ring_offsets[r], end = outline.ring_offsets[r + 1];
      const double ring = std::abs(ringArea(std::span(outline.points).subspan(begin, end - begin)));
      area += r == outline.polygon_offsets[p] ? ring : -ring;
    }
  }
  return area;
}

/// Where the rings of a cell begin, and where the last one ends.
inline std::vector<std::uint64_t> ringBounds(const Diagram& diagram, std::size_t cell) {
  const auto begin = diagram.cell_offsets[cell], end = diagram.cell_offsets[cell + 1];
  std::vector<std::uint64_t> bounds;
  for (const auto start : diagram.ring_starts) {
    if (start >= begin && start < end) bounds.push_back(start);
  }
  bounds.push_back(end);
  return bounds;
}

/// What cells inside an outline are asked for with.
inline CellsOptions inside(const Outline& outline, const Box& domain = {0, 0, 1, 1}) {
  CellsOptions options{};
  options.domain = domain;
  options.outline = outline;
  return options;
}

}  // namespace vorpipe::test
