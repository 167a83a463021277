#include "globe/sphere_centers.h"

#include <limits>

#include "base/processors.h"

namespace vorpipe::core {

void SphereCenterBatch::set(std::size_t lane, const SphereSites& sites,
                            const std::array<std::size_t, 3>& triple) {
  const auto vectors = sites.vectors();
  const Direction& from = vectors[triple[0]];
  direction_.set(lane, sites.direction[triple[0]]);
  a_.set(lane, vectors[triple[1]] - from);
  b_.set(lane, vectors[triple[2]] - from);
  depth_a_[lane] = depthOf(sites, triple[0], triple[1]);
  depth_b_[lane] = depthOf(sites, triple[0], triple[2]);
}

/// At right angles to the plane through the three vectors. Near a site it is that site's direction p plus the
/// part of a vector at right angles to that plane: (p + u) . (v - w) = 0 for its vector v and both others, w.
/// That keeps the digits of sites that are near to each other.
FOR_WIDE_TOO void SphereCenterBatch::find() {
  constexpr double few = 8, near = 0.5, epsilon = std::numeric_limits<double>::epsilon();
  for (std::size_t k = 0; k < room; ++k) {
    const Direction p = direction_.at(k), a = a_.at(k), b = b_.at(k), across = cross(a, b);
    const double aa = dot(a, a), bb = dot(b, b);
    const double size = std::sqrt(dot(across, across)), longest = std::sqrt(aa < bb ? bb : aa);
    const Direction way =
        1 / (size * size) * (depth_a_[k] * cross(b, across) + depth_b_[k] * cross(across, a));
    const double radius = std::sqrt(dot(way, way));
    const bool is_near = (radius < near) & (dot(p, across) > 0);
    const Direction there = p + way;
    const double by = 1 / (is_near ? std::sqrt(dot(there, there)) : size);
    const double rounded = (is_near ? (longest + radius) * longest : few * epsilon * longest) / size;
    at_.x[k] = by * (is_near ? there.x : across.x);
    at_.y[k] = by * (is_near ? there.y : across.y);
    at_.z[k] = by * (is_near ? there.z : across.z);
    rounding_[k] = is_near ? few * epsilon * (1 + rounded) : rounded;
  }
}

}  // namespace vorpipe::core
