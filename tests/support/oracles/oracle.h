/// What every picture is judged by: brute force in double, from differences of coordinates.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "vorpipe.h"

namespace vorpipe::test {

/// The lowest index of a site nearest to (x, y). By pointers: tests are compiled without inlining what a
/// vector's
/// `[]` calls, and this loop runs for each pixel.
inline std::uint32_t nearestByBruteForce(const Sites& sites, double x, double y) {
  const double* const site_x = sites.x.data();
  const double* const site_y = sites.y.data();
  const auto count = static_cast<std::uint32_t>(sites.size());
  std::uint32_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < count; ++i) {
    const double dx = site_x[i] - x;
    const double dy = site_y[i] - y;
    const double squared = dx * dx + dy * dy;
    if (squared < least) {
      least = squared;
      best = i;
    }
  }
  return best;
}

/// How far (x, y) lies on b's side of the bisector of sites a and b, in pixels of the given size;
/// negative on a's side.
inline double pixelsBeyondBisector(const Sites& sites, std::uint32_t a, std::uint32_t b, double x, double y,
                                   double pixel_width, double pixel_height) {
  const double dx = sites.x[b] - sites.x[a];
  const double dy = sites.y[b] - sites.y[a];
  const double twice =
      ((x - sites.x[a]) + (x - sites.x[b])) * dx + ((y - sites.y[a]) + (y - sites.y[b])) * dy;
  return 0.5 * twice / std::hypot(dx * pixel_width, dy * pixel_height);
}

/// Checks the promise of every pixel: it belongs to a nearest site, ties within 1/128 px aside.
inline void expectNearestEverywhere(const Image& image, const Sites& sites, const Box& domain) {
  const double pixel_width = (domain.xmax - domain.xmin) / image.width;
  const double pixel_height = (domain.ymax - domain.ymin) / image.height;
  int wrong = 0;
  for (int row = 0; row < image.height && wrong < 5; ++row) {
    for (int column = 0; column < image.width && wrong < 5; ++column) {
      const double x = domain.xmin + (column + 0.5) * pixel_width;
      const double y = domain.ymax - (row + 0.5) * pixel_height;
      const auto id = image.ids[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                                static_cast<std::size_t>(column)];
      if (id >= sites.size()) {
        ADD_FAILURE() << "pixel (" << row << ", " << column << ") has no site: " << id;
        ++wrong;
        continue;
      }
      const auto nearest = nearestByBruteForce(sites, x, y);
      if (id == nearest) continue;
      const bool same_place = sites.x[id] == sites.x[nearest] && sites.y[id] == sites.y[nearest];
      const double beyond = same_place
                                ? std::numeric_limits<double>::infinity()
                                : pixelsBeyondBisector(sites, id, nearest, x, y, pixel_width, pixel_height);
      if (beyond > 1.0 / 128) {
        ADD_FAILURE() << "pixel (" << row << ", " << column << ") belongs to site " << nearest << ", not "
                      << id << ", by " << beyond << " px";
        ++wrong;
      }
    }
  }
}

}  // namespace vorpipe::test
