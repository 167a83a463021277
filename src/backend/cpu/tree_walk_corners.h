/// The corners of the cell in tree_walk.h: cutting the cell, rounding noise, and which sites may be left out.
#pragma once

#include "backend/cpu/tree_walk.h"

namespace vorpipe::cpu {

/// Error of a rotated box, whose direction is rounded to double, as a fraction of a squared distance.
constexpr double box_rounding = 4e-15;
template <class Real, std::size_t Room>
Real TreeWalk<Real, Room>::weightDifference(double weight) const {
  return differenceOf<Real>(weight_, weight);
}

template <class Real, std::size_t Room>
Offset<Real> TreeWalk<Real, Room>::offsetTo(std::uint32_t site) const {
  return offsetToRank(tree_.rank[site]);
}

template <class Real, std::size_t Room>
Offset<Real> TreeWalk<Real, Room>::offsetToRank(std::uint32_t rank) const {
  return {differenceOf<Real>(tree_.x[rank], site_x_), differenceOf<Real>(tree_.y[rank], site_y_),
          hasWeights() ? weightDifference(tree_.weight[rank]) : Real(0.0)};
}

/// Part of a difference of weights by which rounding may be off in a depth: d is squared, and what it is
/// the difference of may be as large.
template <class Real>
Real weightNoise(const Real& weight_difference) {
  using real = Real;
  return Real(16.0) * ROUNDING * abs(weight_difference);
}

/// Returns how deep the site at d lies in the circle around a corner, as a difference of powers.
template <class Real, std::size_t Room>
Real TreeWalk<Real, Room>::depthOf(std::size_t corner, const Offset<Real>& d) const {
  return Real(2.0) * (x_[corner] * d.x + y_[corner] * d.y) - (d.x * d.x + d.y * d.y) - d.weight_difference;
}

/// Returns the rounding error of that depth. The corner's uncertainty along its lines counts only as far as
/// the bisector is not parallel to them.
template <class Real, std::size_t Room>
Real TreeWalk<Real, Room>::noiseOf(std::size_t corner, const Offset<Real>& d) const {
  const Real cross = line_x_[corner] * d.y - line_y_[corner] * d.x;
  return Real(2.0) * (across_[corner] * (abs(d.x) + abs(d.y)) + noise_[corner] * abs(cross)) +
         weightNoise(d.weight_difference);
}

/// Whether the site at d is nearer to a corner than the cell's own, despite the noise. Sets `perhaps` to
/// whether it may be, and `wholly` to whether it is nearer to all corners.
template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::isCut(const Offset<Real>& d, bool& perhaps, bool& wholly) const {
  const Real squared = d.x * d.x + d.y * d.y + d.weight_difference;
  const Real length = abs(d.x) + abs(d.y);
  const Real weight_noise = weightNoise(d.weight_difference);
  Real beyond[Room];
  Real noise[Room];
  for (std::size_t k = 0; k < corners_end_; ++k) {
    beyond[k] = Real(2.0) * (x_[k] * d.x + y_[k] * d.y) - squared;
    const Real cross = line_x_[k] * d.y - line_y_[k] * d.x;
    noise[k] = Real(2.0) * (across_[k] * length + noise_[k] * abs(cross)) + weight_noise;
  }
  Real most = -FAR;
  Real most_surely = -FAR;
  Real least_surely = FAR;
  for (std::size_t k = 0; k < corners_; ++k) {
    most = max(most, beyond[k] + noise[k]);
    most_surely = max(most_surely, beyond[k] - noise[k]);
    least_surely = min(least_surely, beyond[k] - noise[k]);
  }
  perhaps = !(most < Real(0.0));
  wholly = least_surely > Real(0.0);
  return most_surely > Real(0.0);
}

template <class Real, std::size_t Room>
void TreeWalk<Real, Room>::cut(const Offset<Real>& d, std::int32_t site) {
  const Real distance = sqrt(d.x * d.x + d.y * d.y);
  const Real inverse = Real(1.0) / distance;
  const vec2 n(d.x * inverse, d.y * inverse);
  const Real moved = Real(0.5) * d.weight_difference * inverse;
  new_moved_ = abs(moved);
  new_apart_ = distance;
  clip_.cutCell(cell_, n, (Real(0.5) * distance + moved) + (origin_offset_.x * n.x + origin_offset_.y * n.y),
                site);
  if (!cell_.overflow) findCorners();
  ++version_;
}

template <class Real, std::size_t Room>
void TreeWalk<Real, Room>::findCorners() {
  std::size_t ring[Room];
  std::size_t count = 0;
  for (std::size_t k = 0; k < Room; ++k) {
    if (!(cell_.lo[k] < cell_.hi[k])) continue;
    if (line_[k] != cell_.line[k]) {
      line_[k] = cell_.line[k];
      known_after_[k] = no_line;
      moved_[k] = new_moved_;
      apart_[k] = new_apart_;
      angle_[k] = clip_.pseudoAngle(cell_.nx[k], cell_.ny[k]);
    }
    auto at = count++;
    for (; at > 0 && angle_[k] < angle_[ring[at - 1]]; --at) ring[at] = ring[at - 1];
    ring[at] = k;
  }
  corners_ = count < 3 ? 0 : count;
  corners_end_ = std::is_floating_point_v<Real> ? (corners_ + 3) / 4 * 4 : corners_;
  most_margin_ = Real(0.0);
  for (std::size_t c = 0; c < corners_; ++c) placeCorner(c, ring[c], ring[c + 1 < count ? c + 1 : 0]);
}

template <class Real, std::size_t Room>
void TreeWalk<Real, Room>::placeCorner(std::size_t c, std::size_t before, std::size_t after) {
  const Real x = cell_.nx[before] * cell_.h[before] - cell_.ny[before] * cell_.hi[before];
  const Real y = cell_.ny[before] * cell_.h[before] + cell_.nx[before] * cell_.hi[before];
  const Real turn = cell_.nx[before] * cell_.ny[after] - cell_.ny[before] * cell_.nx[after];
  const Real near = abs(cell_.h[before]) + moved_[before] + abs(cell_.h[after]) + moved_[after] +
                    abs(origin_offset_.x) + abs(origin_offset_.y);
  corner_[c] = {before, after, turn, known_after_[before] == cell_.line[after]};
  x_[c] = x - origin_offset_.x;
  y_[c] = y - origin_offset_.y;
  line_x_[c] = cell_.nx[before];
  line_y_[c] = cell_.ny[before];
  noise_[c] = cornerNoise<Real>(near, abs(x) + abs(y), turn);
  across_[c] = cornerNoise<Real>(near, abs(x) + abs(y), Real(1.0));
  widening_[c] = (Real(2.0) * (abs(x_[c]) + abs(y_[c])) + noise_[c]) * noise_[c];
  squared_[c] = x_[c] * x_[c] + y_[c] * y_[c];
  margin_[c] = widening_[c] + Real(box_rounding) * squared_[c];
  most_margin_ = max(most_margin_, margin_[c]);
}

/// Whether the bisector with the site at d, which touches the edge in a slot, coincides with its line as far
/// as long numbers can tell.
template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::liesIn(std::size_t slot, const Offset<Real>& d, Real length) const {
  if (std::is_floating_point_v<Real>) return false;
  const Real cross = abs(cell_.nx[slot] * d.y - cell_.ny[slot] * d.x);
  return cell_.nx[slot] * d.x + cell_.ny[slot] * d.y > Real(0.0) && cross <= Real(16.0) * ROUNDING * length;
}

/// Whether the edge then keeps its owner: the wall, or the farther of two sites, since the nearer has no cell
/// beyond that line.
template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::liesBehind(std::size_t slot, const Offset<Real>& d, Real length) const {
  return (cell_.line[slot] < 0 || apart_[slot] > length) && liesIn(slot, d, length);
}

/// Gives a site that cuts no corner the edge that belongs to it by that rule.
template <class Real, std::size_t Room>
void TreeWalk<Real, Room>::takeOver(std::uint32_t site) {
  const auto d = offsetTo(site);
  const Real length = sqrt(d.x * d.x + d.y * d.y);
  for (std::size_t c = 0; c < corners_; ++c) {
    if (depthOf(c, d) + noiseOf(c, d) < Real(0.0)) continue;
    for (const auto slot : {corner_[c].before, corner_[c].after}) {
      if (cell_.line[slot] < 0 || !(apart_[slot] < length) || !liesIn(slot, d, length)) continue;
      cell_.line[slot] = line_[slot] = static_cast<std::int32_t>(site);
      apart_[slot] = length;
      moved_[slot] = abs(d.weight_difference) / (Real(2.0) * length);
    }
  }
}

/// Whether a site that barely reaches into the circle around a corner may have an edge that counts.
template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::mayMatter(std::size_t corner, const Offset<Real>& d) {
  const Real squared = d.x * d.x + d.y * d.y;
  const Real beyond = depthOf(corner, d) + noiseOf(corner, d);
  const auto [before, after, turn, known] = corner_[corner];
  if (beyond < Real(0.0) || cell_.line[before] == inner_wall || cell_.line[after] == inner_wall) return false;
  const Real length = sqrt(squared);
  const Real a = abs(cell_.nx[before] * d.y - cell_.ny[before] * d.x);
  const Real b = abs(cell_.nx[after] * d.y - cell_.ny[after] * d.x);
  if (liesBehind(before, d, length) || liesBehind(after, d, length)) return false;
  const Real depth = beyond / (Real(2.0) * length);
  if (depth * turn * squared >= Real(no_edge) * tieScale(length, shorter_side_) * a * b) return true;
  blur_ = max(blur_, depth * length / min(a, b));
  return false;
}

/// Whether every site that could cut the cell is in the set.
template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::isKnownAround() const {
  const auto& coverage = sites_.coverage;
  // All sites are known, even around corners so far away that their squares overflow a double.
  const bool is_whole = std::isinf(coverage.xmin) && std::isinf(coverage.xmax) && std::isinf(coverage.ymin) &&
                        std::isinf(coverage.ymax);
  if (is_whole) return true;
  const auto heaviest = std::max(heaviest_anywhere_, tree_.bounds[1].heaviest);
  const auto heavier = hasWeights() ? -static_cast<double>(weightDifference(heaviest)) : 0.0;
  const auto lift = heavier + box_rounding * std::abs(heavier);
  for (std::size_t k = 0; k < corners_; ++k) {
    const auto x = sites_.x[site_] + static_cast<double>(x_[k]);
    const auto y = sites_.y[site_] + static_cast<double>(y_[k]);
    const auto inside =
        std::min({x - coverage.xmin, coverage.xmax - x, y - coverage.ymin, coverage.ymax - y});
    const auto squared = static_cast<double>(squared_[k] + widening_[k]) + lift;
    const auto most_off = 2 * std::sqrt(std::max(heavier, 0.0)) * static_cast<double>(noise_[k]);
    if (!(inside * std::abs(inside) > squared + most_off)) return false;
  }
  return true;
}

/// The box is widened so that no edge of the cell lies on a wall.
template <class Real, std::size_t Room>
Walls<Real> TreeWalk<Real, Room>::bounds(Walls<Real> walls) const {
  const auto [west, east] = std::minmax_element(x_, x_ + corners_);
  const auto [south, north] = std::minmax_element(y_, y_ + corners_);
  const Real margin = ((*east - *west) + (*north - *south)) * Real(0.015625);
  const auto take = [](Real& wall, Real tighter, bool& inner, bool is_tighter) {
    if (is_tighter) wall = tighter;
    inner = inner || is_tighter;
  };
  const Real to_west = *west + origin_offset_.x - margin;
  const Real to_south = *south + origin_offset_.y - margin;
  const Real to_east = *east + origin_offset_.x + margin;
  const Real to_north = *north + origin_offset_.y + margin;
  take(walls.west, to_west, walls.inner[0], to_west > walls.west);
  take(walls.east, to_east, walls.inner[1], to_east < walls.east);
  take(walls.south, to_south, walls.inner[2], to_south > walls.south);
  take(walls.north, to_north, walls.inner[3], to_north < walls.north);
  return walls;
}

/// A box is left out only if that adds at most this multiple of a corner's noise to the error of the edges'
/// ends.
constexpr double most_blur = 16;

/// A box of the tree, relative to the site.
template <class Real, std::size_t Room>
struct TreeWalk<Real, Room>::Seen {
  Real x, y, ux, uy, low_a, high_a, low_b, high_b;
  Real lift{};  ///< by how much the heaviest site is heavier than the cell's own, rounded up
  Real root{};  ///< twice the square root of that, where it is positive

  Seen(const TreeWalk& walk, const Bounds& bounds)
      : x(differenceOf<Real>(bounds.x, walk.site_x_)),
        y(differenceOf<Real>(bounds.y, walk.site_y_)),
        ux(bounds.ux),
        uy(bounds.uy),
        low_a(bounds.low_a),
        high_a(bounds.high_a),
        low_b(bounds.low_b),
        high_b(bounds.high_b) {
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
