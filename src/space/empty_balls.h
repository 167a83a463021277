/// The balls that cells promise to be empty.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "space/label.h"

namespace vorpipe::space {

/// No site lies in the ball around a vertex through the sites of its cells; with weights, none that is as
/// heavy as the heaviest lies in a larger one. Beyond a box these promises are worth nothing if sites there
/// are left out: a cell is right among all sites if the balls of all its vertices lie in the box.
struct EmptyBalls {
  Box3 box;
  std::array<bool, 3> axes;  ///< along which sites are left out beyond the box
  double heaviest = 0;       ///< the largest weight

  /// How far balls of a cell reach beyond the box: vertex(v) for v < count is relative to the site. Negative
  /// if all lie within.
  template <class Vertex>
  [[nodiscard]] double beyond(const Point3& site, double weight, std::size_t count,
                              const Vertex& vertex) const {
    constexpr double margin = 1 + 1e-9;
    const double heavier = std::max(0.0, heaviest - weight);
    double squared = 0;
    for (std::size_t v = 0; v < count; ++v) {
      const Point3 p = vertex(v);
      squared = std::max(squared, (p.x * p.x + p.y * p.y) + p.z * p.z);
    }
    // Of most cells all balls are far within.
    const double reach = margin * (std::sqrt(squared) + std::sqrt(squared + heavier));
    const auto beside = [&](bool counts, double at, double low, double high) {
      return counts ? std::max(low - (at - reach), at + reach - high) : -HUGE_VAL;
    };
    double beyond =
        std::max({beside(axes[0], site.x, box.xmin, box.xmax), beside(axes[1], site.y, box.ymin, box.ymax),
                  beside(axes[2], site.z, box.zmin, box.zmax)});
    if (beyond < 0) return beyond;
    beyond = -HUGE_VAL;
    for (std::size_t v = 0; v < count; ++v) {
      const Point3 p = vertex(v);
      const double radius = margin * std::sqrt(((p.x * p.x + p.y * p.y) + p.z * p.z) + heavier);
      const auto take = [&](bool counts, double at, double low, double high) {
        if (counts) beyond = std::max({beyond, low - (at - radius), at + radius - high});
      };
      take(axes[0], site.x + p.x, box.xmin, box.xmax);
      take(axes[1], site.y + p.y, box.ymin, box.ymax);
      take(axes[2], site.z + p.z, box.zmin, box.zmax);
    }
    return beyond;
  }
};

}  // namespace vorpipe::space
