#include "globe/sphere_measures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "globe/arc_batch.h"
#include "globe/ellipsoid.h"

namespace vorpipe::core {
namespace {

/// Below this a cell's centroid is that of its flat triangles.
constexpr double small_cell = 1e-4;  // radians

/// Adds up a cell over short arcs of its border.
class Sums {
 public:
  Sums(const Direction& apex, bool is_small) : apex_(apex), is_small_(is_small) {}

  void add(const ArcShare& share) {
    solid_ += share.solid;
    perimeter_ += share.angle;
    ellipsoid_ += share.ellipsoid;
    center_ = center_ + share.center;
  }

  /// Returns the arc's angle.
  double add(const Direction& from, const Direction& to) {
    const ArcShare share = shareOf(apex_, from, to, is_small_);
    add(share);
    return share.angle;
  }

  /// Adds an arc of any length piece by piece.
  double add(const GreatArc& arc) {
    const int pieces = static_cast<int>(std::ceil(arc.angle / longest_arc));
    Direction last = arc.begin;
    for (int k = 1; k <= pieces; ++k) {
      const Direction here = k == pieces ? arc.end : pieceEnd(arc, k, pieces);
      add(last, here);
      last = here;
    }
    return arc.angle;
  }

  [[nodiscard]] SphereMeasures measures() const {
    const Direction center = is_small_ ? apex_ + 1 / solid_ * center_ : center_;
    return {solid_, squaredEarthRadius() * (solid_ + ellipsoid_), perimeter_, normalized(center)};
  }

 private:
  Direction apex_;
  bool is_small_;
  double solid_ = 0, perimeter_ = 0, ellipsoid_ = 0;
  Direction center_{0, 0, 0};
};

double squareOf(const Direction& a) { return dot(a, a); }

/// The square of how far from its site a cell reaches.
double squaredReachOf(const SphereCell& cell) {
  double reach = 0;
  for (const Direction& vertex : cell.vertex) reach = std::max(reach, squareOf(vertex - cell.direction));
  return reach;
}

bool isSmall(double squared_reach) { return squared_reach < small_cell * small_cell; }

/// Measures a cell that has edges. `lengths`, if not empty, become those of its edges.
SphereMeasures measureCell(const SphereSites& sites, const SphereCell& cell, double squared_reach,
                           std::span<double> lengths) {
  constexpr double large = 1;  // radians
  const auto count = cell.vertex.size();
  Direction apex = cell.direction;
  if (squared_reach > large * large) {
    Direction center{0, 0, 0};
    for (std::size_t e = 0; e < count; ++e) {
      const GreatArc arc = arcOf(sites.vectors(), cell, e);
      center = center + arc.angle * arc.axis;
    }
    apex = normalized(center);
  }
  Sums sums(apex, isSmall(squared_reach));
  for (std::size_t e = 0; e < count; ++e) {
    const auto next = e + 1 < count ? e + 1 : 0;
    const Direction &from = cell.vertex[e], &to = cell.vertex[next];
    const double angle = next != e && squareOf(to - from) <= longest_arc * longest_arc
                             ? sums.add(from, to)
                             : sums.add(arcOf(sites.vectors(), cell, e));
    if (!lengths.empty()) lengths[e] = angle;
  }
  return sums.measures();
}

}  // namespace

double earthRadius() { return std::sqrt(squaredEarthRadius()); }

void MeasuredCells::add(const SphereCell& cell) {
  // Between vertices that are so near to the site there is no longer arc.
  constexpr double near = 0.48 * longest_arc;
  const auto count = cell.vertex.size();
  if (has_lengths_) length.resize(length.size() + count);
  measures.emplace_back();
  if (count == 0) {
    constexpr double whole_sphere = 4 * std::numbers::pi;
    measures.back() = {whole_sphere, whole_sphere * squaredEarthRadius(), 0, cell.direction};
    return;
  }
  const double reach = squaredReachOf(cell);
  if (reach < near * near && count > 1 && count <= ArcBatch::room) {
    if (batch_.size() + count > ArcBatch::room) finish();
    waiting_.push_back({measures.size() - 1, length.size() - (has_lengths_ ? count : 0), count,
                        cell.direction, isSmall(reach)});
    batch_.add(cell.direction, cell.vertex, isSmall(reach));
    return;
  }
  const std::span lengths(length);
  measures.back() = measureCell(sites_, cell, reach, has_lengths_ ? lengths.last(count) : lengths.first(0));
}

void MeasuredCells::finish() {
  batch_.measure();
  std::size_t k = 0;
  for (const auto& [cell, first_length, count, apex, is_small] : waiting_) {
    Sums sums(apex, is_small);
    for (std::size_t e = 0; e < count; ++e, ++k) {
      const ArcShare share = batch_.share(k);
      sums.add(share);
      if (has_lengths_) length[first_length + e] = share.angle;
    }
    measures[cell] = sums.measures();
  }
  waiting_.clear();
  batch_.clear();
}

SphereMeasures measureRings(std::span<const Direction> vertices, std::span<const std::size_t> ends,
                            std::span<double> lengths) {
  Direction apex{0, 0, 0};
  for (const Direction& vertex : vertices) apex = apex + vertex;
  apex = normalized(apex);
  double reach = 0;
  for (const Direction& vertex : vertices) reach = std::max(reach, lengthOf(vertex - apex));
  Sums sums(apex, reach < small_cell);
  std::size_t begin = 0;
  for (const std::size_t end : ends) {
    for (auto e = begin; e < end; ++e) {
      const Direction &from = vertices[e], &to = vertices[e + 1 < end ? e + 1 : begin];
      lengths[e] = lengthOf(to - from) <= longest_arc
                       ? sums.add(from, to)
                       : sums.add(GreatArc{from, to, normalized(cross(from, to)), angleBetween(from, to)});
    }
    begin = end;
  }
  return sums.measures();
}

}  // namespace vorpipe::core
