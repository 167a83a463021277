/// Centers on the sphere of the circles through three sites each, of many at once.
#pragma once

#include <array>
#include <cstddef>

#include "globe/direction.h"

namespace vorpipe::core {

/// The direction in which three sites share a vertex.
struct SphereCenter {
  Direction at;
  double rounding;  ///< how far rounding may move it, in radians
};

/// Vectorized over the triples. A lane has numbers of its own.
class SphereCenterBatch {
 public:
  static constexpr std::size_t room = 64;

  /// The sites of a lane, counter-clockwise; digits are kept best near the first.
  void set(std::size_t lane, const SphereSites& sites, const std::array<std::size_t, 3>& triple);

  void find();

  [[nodiscard]] SphereCenter center(std::size_t lane) const { return {at_.at(lane), rounding_[lane]}; }

 private:
  DirectionLanes<room> direction_, vector_, a_, b_, at_;
  std::array<double, room> depth_a_{}, depth_b_{}, rounding_{};
};

}  // namespace vorpipe::core
