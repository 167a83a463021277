/// The site whose cell has a place of the sphere, by a walk over cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "globe/direction.h"
#include "vorpipe/cells.h"

namespace vorpipe::core {

/// Sites and their neighbors. The cell of a direction x is that of the site whose vector v has the largest
/// x . v. That is a linear program on the hull of the vectors, whose edges are the neighbors of cells: where
/// no neighbor is better, no site is.
class SphereWalk {
 public:
  /// The diagram, which outlives this, has the cells of the sites.
  SphereWalk(const Sites& sites, const Diagram& diagram, int threads);

  /// A site with a cell, the first.
  [[nodiscard]] std::uint32_t first() const { return first_; }

  /// The site whose cell has the direction; of equals the walk takes the first that it comes to. `begin` has
  /// a cell.
  [[nodiscard]] std::uint32_t to(const Direction& direction, std::uint32_t begin) const;

 private:
  /// A vector v, and |v|^2 - 1.
  struct Vector {
    Direction at;
    double height;
  };

  /// |x - v|^2 - |v|^2 + 1, which is 2 - 2 x . v, with the digits of sites that are near to x.
  [[nodiscard]] double lack(const Direction& x, std::uint32_t site) const {
    const Vector& v = vectors_[site];
    const Direction way = x - v.at;
    return dot(way, way) - v.height;
  }

  const Diagram& diagram_;
  std::vector<Vector> vectors_;
  std::uint32_t first_;
};

}  // namespace vorpipe::core
