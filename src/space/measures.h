/// Volume, surface, centroid and moments of cells, from their vertices.
#pragma once

#include <array>
#include <vector>

#include "space/cell_places.h"
#include "space/label.h"
#include "space/row_vertices.h"
#include "space/rows.h"

namespace vorpipe::space {

struct CellMeasures {
  double volume, surface;
  Point3 centroid;  ///< relative to the site
};

/// Measures cells one after another, whatever their condition: each vertex is at its place to the last bits.
class CarefulMeasures {
 public:
  explicit CarefulMeasures(const Places& places) : places_(places), corners_(places) {}

  /// Measures the cell of a site that has a row.
  void measure(Label site, const Row& row);

  [[nodiscard]] const CellMeasures& measures() const { return measures_; }
  [[nodiscard]] std::size_t vertices() const { return place_.size(); }
  /// Relative to the site.
  [[nodiscard]] Point3 vertex(std::size_t v) const {
    const Point3& p = place_[v];
    return {p.x + origin_.x, p.y + origin_.y, p.z + origin_.z};
  }
  /// By face.
  [[nodiscard]] const std::vector<double>& areas() const { return areas_; }
  /// About the centroid: xx, yy, zz, yz, xz, xy.
  [[nodiscard]] const std::array<double, 6>& secondMoments() const { return moments_; }

 private:
  void takePlaces(Label site, const Row& row);
  void addFace(const Ring& ring, std::size_t begin);

  const Places& places_;
  CellPlaces corners_;
  RowVertices vertices_;
  std::vector<Point3> place_;  ///< by vertex, relative to origin_
  Point3 origin_{};            ///< relative to the site
  std::vector<double> areas_;
  CellMeasures measures_{};
  std::array<double, 6> moments_{};
  double six_volumes_ = 0;
  std::array<double, 3> first_{};
};

}  // namespace vorpipe::space
