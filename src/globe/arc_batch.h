/// What short arcs of cells' borders add to the cells' measures.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "globe/direction.h"

namespace vorpipe::core {

/// Arcs up to this chord are short.
inline constexpr double longest_arc = 0.25;

/// What a short arc of a cell's border adds to the cell's solid angle, perimeter, area on the ellipsoid, and
/// center of mass.
struct ArcShare {
  double solid, angle, ellipsoid;
  Direction center;
};

/// `is_small`: the centroid is to be that of flat triangles from the apex. The angle is the same to the last
/// bit from the arc's other end.
ArcShare shareOf(const Direction& apex, const Direction& from, const Direction& to, bool is_small);

/// The shares of many arcs at once, vectorized; each is shareOf() to the bit.
class ArcBatch {
 public:
  static constexpr std::size_t room = 128;

  [[nodiscard]] std::size_t size() const { return size_; }
  void clear() { size_ = 0; }
  /// Adds the border of a cell: `vertices` in order, seen from `apex`, the cell's site. The batch must have
  /// room for it.
  void add(const Direction& apex, std::span<const Direction> vertices, bool is_small);

  void measure();

  [[nodiscard]] ArcShare share(std::size_t k) const {
    return {solid_[k], angle_[k], ellipsoid_[k], center_.at(k)};
  }

 private:
  using Numbers = std::array<double, room>;

  void findAngles();
  void findLongAngles();
  void findShares();
  void findLongShares();

  std::size_t size_ = 0;
  DirectionLanes<room> apex_, from_, to_, center_;
  Numbers small_{}, height_{}, base_{}, sine_{}, cosine_{};  ///< small: 1 or 0
  Numbers solid_{}, angle_{}, ellipsoid_{};
};

}  // namespace vorpipe::core
