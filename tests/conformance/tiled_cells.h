/// A periodic domain as an ordinary one: its tile with copies all around it.
#pragma once

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "support/oracles/oracle.h"
#include "vorpipe.h"

namespace vorpipe::test {

/// A neighbor and which image of it.
using ImageOf = std::tuple<std::int64_t, std::int32_t, std::int32_t>;

inline std::set<ImageOf> imagesBeside(const Diagram& d, std::size_t i) {
  std::set<ImageOf> images;
  for (auto e = d.cell_offsets[i]; e < d.cell_offsets[i + 1]; ++e) {
    images.insert({d.neighbors[e], d.neighbor_shifts[e][0], d.neighbor_shifts[e][1]});
  }
  return images;
}

/// The sites of a periodic domain, in it, and then their images in the tiles around it.
struct Tiled {
  Sites sites;
  Box domain;  ///< of all tiles
  std::size_t count;
  std::vector<std::array<std::int32_t, 2>> shifts;  ///< by tile

  [[nodiscard]] ImageOf imageAt(std::int64_t i) const {
    if (i < 0) return {i, 0, 0};
    const auto& shift = shifts[static_cast<std::size_t>(i) / count];
    return {i % static_cast<std::int64_t>(count), shift[0], shift[1]};
  }
};

inline Tiled tile(const Sites& sites, const CellsOptions& wanted) {
  const auto inside = *wrapped(sites, wanted.domain, wanted.periodic);
  const Box& box = wanted.domain;
  const double width = box.xmax - box.xmin, height = box.ymax - box.ymin;
  const int x = wanted.periodic != Periodic::y ? 1 : 0, y = wanted.periodic != Periodic::x ? 1 : 0;
  Tiled tiled{inside,
              {box.xmin - x * width, box.ymin - y * height, box.xmax + x * width, box.ymax + y * height},
              sites.size(),
              {{0, 0}}};
  for (int sy = -y; sy <= y; ++sy) {
    for (int sx = -x; sx <= x; ++sx) {
      if (sx == 0 && sy == 0) continue;
      tiled.shifts.push_back({sx, sy});
      for (std::size_t i = 0; i < inside.size(); ++i) {
        tiled.sites.x.push_back(inside.x[i] + sx * width);
        tiled.sites.y.push_back(inside.y[i] + sy * height);
        if (!inside.weight.empty()) tiled.sites.weight.push_back(inside.weight[i]);
      }
    }
  }
  return tiled;
}

/// Compares cells of a periodic domain with those of its tiles, none of which is a duplicate; areas may
/// differ by `slack` of themselves and as much of the mean.
inline void expectMiddle(const Diagram& periodic, const Diagram& tiles, const Tiled& tiled, double slack) {
  const double mean = areaSum(periodic) / static_cast<double>(tiled.count);
  for (std::size_t i = 0; i < tiled.count; ++i) {
    EXPECT_EQ(periodic.status[i], tiles.status[i]) << "site " << i;
    EXPECT_NEAR(periodic.area[i], tiles.area[i], slack * (periodic.area[i] + mean)) << "site " << i;
    EXPECT_NEAR(periodic.centroid[i].x, tiles.centroid[i].x, slack) << "site " << i;
    EXPECT_NEAR(periodic.centroid[i].y, tiles.centroid[i].y, slack) << "site " << i;
    std::set<ImageOf> around;
    for (auto e = tiles.cell_offsets[i]; e < tiles.cell_offsets[i + 1]; ++e) {
      around.insert(tiled.imageAt(tiles.neighbors[e]));
    }
    EXPECT_EQ(imagesBeside(periodic, i), around) << "site " << i;
  }
}

/// The index among the tiled sites of the copy of `id` that is nearest to a pixel's center.
inline std::uint32_t nearestCopy(const Image& image, const Tiled& tiled, const Box& domain, std::uint32_t id,
                                 std::ptrdiff_t pixel) {
  if (id >= tiled.count) return id;
  const double x = domain.xmin + (static_cast<double>(pixel % image.width) + 0.5) / image.width *
                                     (domain.xmax - domain.xmin);
  const double y = domain.ymax - (static_cast<double>(pixel / image.width) + 0.5) / image.height *
                                     (domain.ymax - domain.ymin);
  std::size_t best = id;
  const auto distance = [&](std::size_t i) { return std::hypot(tiled.sites.x[i] - x, tiled.sites.y[i] - y); };
  for (std::size_t i = id; i < tiled.sites.size(); i += tiled.count) {
    if (distance(i) < distance(best)) best = i;
  }
  return static_cast<std::uint32_t>(best);
}

}  // namespace vorpipe::test
