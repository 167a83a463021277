/// White noise in the unit square, packed as core would pack it if every site were a candidate of
/// every other.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "backend/backend.h"

namespace vorpipe::test {

struct Scene {
  Sites sites;
  CellBatch<double> batch;
  std::vector<DrawMark> marks;
};

inline Scene makeScene(std::size_t count, std::uint64_t seed) {
  Scene scene;
  scene.sites = generate(Pattern::random, count, seed);
  const std::vector<double>& x = scene.sites.x;
  const std::vector<double>& y = scene.sites.y;
  for (std::size_t i = 0; i < count; i++) {
    std::vector<Line<double>> lines;
    for (std::size_t j = 0; j < count; j++) {
      const double distance = std::hypot(x[j] - x[i], y[j] - y[i]);
      if (j != i)
        lines.push_back({(x[j] - x[i]) / distance, (y[j] - y[i]) / distance, distance / 2, distance});
    }
    std::ranges::sort(lines, {}, &Line<double>::bound);
    const auto first = static_cast<std::uint32_t>(scene.batch.lines.size());
    scene.batch.entries.push_back({first, static_cast<std::uint32_t>(lines.size()), -x[i], -y[i], 1 - x[i],
                                   1 - y[i], std::numeric_limits<double>::infinity(), 0});
    scene.batch.lines.insert(scene.batch.lines.end(), lines.begin(), lines.end());
    scene.marks.push_back({static_cast<float>(2 * x[i] - 1), static_cast<float>(2 * y[i] - 1),
                           static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i % 256)});
  }
  return scene;
}

inline CellBatch<float> toFloat(const CellBatch<double>& batch) {
  const auto f = [](double value) { return static_cast<float>(value); };
  CellBatch<float> converted;
  for (const auto& entry : batch.entries) {
    converted.entries.push_back({entry.first, entry.count, f(entry.west), f(entry.south), f(entry.east),
                                 f(entry.north), f(entry.reach), f(entry.shift)});
  }
  for (const auto& line : batch.lines) {
    converted.lines.push_back({f(line.nx), f(line.ny), f(line.h), f(line.bound)});
  }
  return converted;
}

/// The unit square in width * height pixels; color c of the palette is c in every channel.
inline View makeView(int width, int height) {
  View view{{0, 0, 1, 1}, width, height, {}};
  for (std::uint32_t shade = 0; shade < view.palette.size(); shade++)
    view.palette[shade] = shade * 0x01010101U;
  return view;
}

/// By how many pixels the center of a pixel lies on the wrong side of the bisector of its nearest
/// site and the site that got it; 0 if that is the nearest. Row 0 is the bottom.
inline double pixelError(const Sites& sites, const View& view, int row, int column, std::uint32_t id) {
  const double x = (column + 0.5) / view.width;
  const double y = (row + 0.5) / view.height;
  const auto squared = [&](std::size_t i) {
    return (sites.x[i] - x) * (sites.x[i] - x) + (sites.y[i] - y) * (sites.y[i] - y);
  };
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < sites.size(); i++) {
    if (squared(i) < squared(nearest)) nearest = i;
  }
  if (nearest == id) return 0;
  const double apart = std::hypot(sites.x[id] - sites.x[nearest], sites.y[id] - sites.y[nearest]);
  return (squared(id) - squared(nearest)) / (2 * apart) * std::max(view.width, view.height);
}

}  // namespace vorpipe::test
