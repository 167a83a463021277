/// Sites on the globe, and what pictures show of it, for the checks.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core::checks {

inline constexpr double pi = std::numbers::pi, half_turn = 180;
/// km2, of WGS 84: 2 pi a^2 + pi b^2 / e ln((1 + e) / (1 - e))
inline constexpr double earth_area = 510065621.7240887;

/// A place in space, and a fourth coordinate: of sites with weights, what makes the nearest of them in four
/// dimensions the one whose cell has a place of the sphere, x . v largest: |x - v|^2 + |v'|^2 - |v|^2 least,
/// where v' is the longest.
using SpaceVector = std::array<double, 4>;

inline SpaceVector toward(Point degrees) {
  const double x = degrees.x / half_turn * std::numbers::pi, y = degrees.y / half_turn * std::numbers::pi;
  return {std::cos(y) * std::cos(x), std::cos(y) * std::sin(x), std::sin(y), 0};
}

inline double chordOf(const SpaceVector& a, const SpaceVector& b) {
  return std::hypot(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), a[3] - b[3]);
}

/// The sites in space.
class GlobeSites {
 public:
  explicit GlobeSites(const Sites& sites);
  ~GlobeSites();
  GlobeSites(const GlobeSites&) = delete;
  GlobeSites& operator=(const GlobeSites&) = delete;

  [[nodiscard]] std::size_t size() const { return at_.size(); }
  [[nodiscard]] bool hasWeights() const { return has_weights_; }
  [[nodiscard]] const SpaceVector& operator[](std::size_t i) const { return at_[i]; }
  /// The site whose cell has a place.
  [[nodiscard]] std::uint32_t nearestTo(const SpaceVector& place) const;
  /// How far a place of the sphere is beyond the border of sites i and j, seen from i, in radians.
  [[nodiscard]] double beyond(std::size_t i, std::size_t j, const SpaceVector& place) const;

 private:
  struct Tree;
  bool has_weights_;
  std::vector<SpaceVector> at_;
  std::unique_ptr<Tree> tree_;
};

/// An outline in degrees, whose sides are straight in longitude and latitude.
class GlobeOutline {
 public:
  explicit GlobeOutline(const Outline& outline);

  enum class Side : std::uint8_t { inside, outside, edge };
  /// Where a place is; on the edge, if it is as near to a side as these may differ from great circles.
  [[nodiscard]] Side at(const SpaceVector& place) const;

 private:
  struct Edge {
    Point from, to;  ///< longitudes of any turn
  };
  void addRing(std::span<const Point> ring);

  std::vector<std::vector<Edge>> by_degree_;  ///< of longitude
  bool has_pole_ = false;                     ///< the north pole is inside
};

/// The places of a picture's pixels on the globe.
class GlobePixels {
 public:
  explicit GlobePixels(const RenderOptions& options);

  /// The place of a pixel's center; none beside the map. A row and a column of the frame.
  [[nodiscard]] std::optional<SpaceVector> at(int row, int column) const;
  /// Whether a pixel's center is so near to the map's border that rounding decides where it is.
  [[nodiscard]] bool isOnBorder(int row, int column) const;
  [[nodiscard]] const PictureFrame& frame() const { return frame_; }
  /// Pixels of a radian in the middle of the map.
  [[nodiscard]] double pixelsOfRadian() const;

 private:
  /// From -1 to 1 on the map, right and upward.
  [[nodiscard]] Point partOf(int row, int column) const;
  /// How far a pixel is from the middle of the map's row, and the disc: 1 on the border.
  [[nodiscard]] double reachOf(int row, int column) const;

  RenderOptions options_;
  PictureFrame frame_;
  Box shown_{-1, -1, 1, 1};               ///< part of the map
  std::vector<double> latitude_, width_;  ///< by row, of flat maps; in degrees, and of half the frame
};

}  // namespace vorpipe::core::checks
