/// Whether a node of the tree can matter to the cell in tree_walk.h.
#pragma once

#include "backend/cpu/tree_walk.h"
#include "backend/cpu/tree_walk_corners.h"

namespace vorpipe::cpu {

/// A box is left out only if that adds at most this multiple of a corner's noise to the error of the edges'
/// ends.
constexpr double most_blur = 16;

/// A box of the tree, relative to the site.
template <class Real, std::size_t Room>
struct TreeWalk<Real, Room>::Seen {
  Real x, y, ux, uy, low_a, high_a, low_b, high_b;
  Real lift;  ///< by how much the heaviest site is heavier than the cell's own, rounded up
  Real root;  ///< twice the square root of that, where it is positive

  Seen(const TreeWalk& walk, const Bounds& bounds)
      : x(differenceOf<Real>(bounds.x, walk.site_x_)),
        y(differenceOf<Real>(bounds.y, walk.site_y_)),
        ux(bounds.ux),
        uy(bounds.uy),
        low_a(bounds.low_a),
        high_a(bounds.high_a),
        low_b(bounds.low_b),
        high_b(bounds.high_b),
        lift{},
        root{} {
    if (!walk.hasWeights()) return;
    const Real heavier = -walk.weightDifference(bounds.heaviest);
    lift = heavier + Real(box_rounding) * abs(heavier);
    root = Real(2.0) * sqrt(max(heavier, Real(0.0)));
  }

  /// Returns an upper bound of how deep the box reaches into the circle around a corner, as a difference of
  /// powers.
  [[nodiscard]] Real reach(const TreeWalk& walk, std::size_t corner) const {
    const Real to_x = walk.x_[corner] - x;
    const Real to_y = walk.y_[corner] - y;
    const Real a = to_x * ux + to_y * uy;
    const Real b = to_y * ux - to_x * uy;
    const Real da = max(max(low_a - a, a - high_a), Real(0.0));
    const Real db = max(max(low_b - b, b - high_b), Real(0.0));
    return walk.squared_[corner] - (da * da + db * db) + liftAt(walk, corner);
  }

  /// Returns a tighter bound where all sites of the node lie on the circle of `bounds` or outside of it.
  [[nodiscard]] Real reachOverCircle(const TreeWalk& walk, std::size_t corner, const Bounds& bounds,
                                     const Real& reached) const {
    const Real to_x = walk.x_[corner] - x - Real(bounds.center_x);
    const Real to_y = walk.y_[corner] - y - Real(bounds.center_y);
    const Real inside = Real(bounds.radius) - sqrt(to_x * to_x + to_y * to_y);
    if (!(inside > Real(0.0))) return reached;
    return min(reached, walk.squared_[corner] - inside * inside + liftAt(walk, corner));
  }

  /// Returns how much the weight of the heaviest site raises the bound, including the noise of the corner.
  [[nodiscard]] Real liftAt(const TreeWalk& walk, std::size_t corner) const {
    return lift + root * walk.noise_[corner];
  }
};

/// Returns how deep a node reaches into the circle around a corner.
template <class Real, std::size_t Room>
Real TreeWalk<Real, Room>::reach(std::size_t corner, const Bounds& bounds) const {
  const Seen seen(*this, bounds);
  const auto reached = seen.reach(*this, corner);
  return bounds.radius == 0 ? reached : seen.reachOverCircle(*this, corner, bounds, reached);
}

/// Returns how deep a node reaches at most into the circle of any corner.
template <class Real, std::size_t Room>
Real TreeWalk<Real, Room>::reach(const Bounds& bounds) const {
  const Seen seen(*this, bounds);
  Real reached[Room];
  for (std::size_t c = 0; c < corners_end_; ++c) reached[c] = seen.reach(*this, c);
  Real most = -FAR;
  for (std::size_t c = 0; c < corners_; ++c) {
    if (bounds.radius != 0 && reached[c] > most)
      reached[c] = seen.reachOverCircle(*this, c, bounds, reached[c]);
    most = max(most, reached[c]);
  }
  return most;
}

/// Whether a site in a box that barely reaches into the circle around a corner may have an edge that counts.
/// If the lines a and b meet in the corner, a site at distance D and in direction n cuts off no more than
/// depth = reach / (2 D). Its edge is no longer than depth sin(a, b) / (sin(a, n) sin(n, b)), and it shortens
/// the two others by depth / sin(a, n) and depth / sin(n, b). The least |cross(a, d)| over a box is at a
/// corner of the box, or zero if the signs differ.
template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::mayMatter(std::size_t corner, const Bounds& bounds, Real reached) {
  const Real ux = Real(bounds.ux);
  const Real uy = Real(bounds.uy);
  const Real x = differenceOf<Real>(bounds.x, site_x_);
  const Real y = differenceOf<Real>(bounds.y, site_y_);
  // The box, relative to the site and in its own rotated axes.
  const Real a[2] = {x * ux + y * uy + Real(bounds.low_a), x * ux + y * uy + Real(bounds.high_a)};
  const Real b[2] = {y * ux - x * uy + Real(bounds.low_b), y * ux - x * uy + Real(bounds.high_b)};
  const auto leastCross = [&](std::size_t slot) {
    const Real na = cell_.nx[slot] * ux + cell_.ny[slot] * uy;
    const Real nb = cell_.ny[slot] * ux - cell_.nx[slot] * uy;
    const Real least = min(na * b[0], na * b[1]) - max(nb * a[0], nb * a[1]);
    const Real most = max(na * b[0], na * b[1]) - min(nb * a[0], nb * a[1]);
    return max(max(least, -most), Real(0.0));
  };
  const Real before = leastCross(corner_[corner].before);
  const Real after = leastCross(corner_[corner].after);
  const Real near_a = max(max(a[0], -a[1]), Real(0.0));
  const Real near_b = max(max(b[0], -b[1]), Real(0.0));
  const Real nearest = sqrt(near_a * near_a + near_b * near_b);
  if (!(nearest > Real(0.0) && before > Real(0.0) && after > Real(0.0))) return true;
  const Real far_a = max(abs(a[0]), abs(a[1]));
  const Real far_b = max(abs(b[0]), abs(b[1]));
  const Real squared = far_a * far_a + far_b * far_b;
  const Real depth = (max(reached, Real(0.0)) + margin_[corner]) / (Real(2.0) * nearest);
  const Real scale = tieScale(nearest, shorter_side_);
  if (depth * corner_[corner].turn * squared >= Real(no_edge) * scale * before * after) return true;
  const Real blur = depth * sqrt(squared) / min(before, after);
  if (blur > Real(most_blur) * noise_[corner]) return true;
  blur_ = max(blur_, blur);
  return false;
}

}  // namespace vorpipe::cpu
