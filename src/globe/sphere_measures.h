/// What cells on a sphere measure, and the Earth's area in them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "globe/arc_batch.h"
#include "globe/sphere_cells.h"

namespace vorpipe::core {

struct SphereMeasures {
  double solid_angle = 0;  ///< steradians
  double area = 0;         ///< km2 on the ellipsoid WGS 84
  double perimeter = 0;    ///< radians
  Direction centroid{};    ///< the direction of the cell's center of mass on the sphere
};

/// Measures cells, the arcs of many at once.
class MeasuredCells {
 public:
  MeasuredCells(const SphereSites& sites, bool has_lengths) : sites_(sites), has_lengths_(has_lengths) {}

  void add(const SphereCell& cell);
  /// Measures those that wait for others.
  void finish();

  std::vector<SphereMeasures> measures;  ///< in the order of add(), valid after finish()
  std::vector<double> length;            ///< of their edges, in radians, if wanted

 private:
  struct Waiting {
    std::size_t cell, first_length, arcs;
    Direction apex;
    bool is_small;
  };

  const SphereSites& sites_;
  bool has_lengths_;
  std::vector<Waiting> waiting_;
  ArcBatch batch_;
};

/// Measures what rings enclose, on their left; ring k of `vertices` ends before ends[k]. Sides are great
/// circles shorter than half a turn. `lengths` becomes theirs, in radians.
SphereMeasures measureRings(std::span<const Direction> vertices, std::span<const std::size_t> ends,
                            std::span<double> lengths);

}  // namespace vorpipe::core
