/// What the faces of a cell in space are named by.
#pragma once

#include <cstdint>

#include "vorpipe/space.h"

namespace vorpipe::space {

/// A site, by its index among the sites of a run, or a wall of the box: -1 - w, w = 0..5 for xmin, xmax,
/// ymin, ymax, zmin, zmax.
using Label = std::int32_t;

constexpr int walls = 6;
constexpr bool isWallLabel(Label label) { return label < 0; }
constexpr Label labelOfWall(int wall) { return -1 - wall; }
constexpr int wallOf(Label label) { return -1 - label; }
constexpr int axisOf(int wall) { return wall / 2; }
constexpr bool isUpper(int wall) { return wall % 2 != 0; }

/// The places that labels stand for: sites that are finite and all different, and a box. A site's cell is
/// where the squared distance from it less its weight is least.
struct Places {
  const Point3* sites;
  Box3 box;
  const double* weights = nullptr;  ///< by site; without, all are equal

  [[nodiscard]] double offset(int wall) const {
    const double of[walls] = {box.xmin, box.xmax, box.ymin, box.ymax, box.zmin, box.zmax};
    return of[wall];
  }
};

}  // namespace vorpipe::space
