/// The corners of the cell in tree_walk.h: cutting it, what is near them, and what may be left out.
#pragma once

#include "backend/cpu/tree_walk.h"

namespace vorpipe::cpu {

/// By how much a turned box may be off, for its direction is rounded to double: part of a distance squared.
constexpr double box_rounding = 4e-15;
/// A box is left out if that makes the ends of edges no more unsure than so many times their noise.
constexpr double most_blur = 16;

/// By how much rounding may be off in how much deeper the site at d lies in the circle around a corner: where
/// the corner may lie along its lines counts only as far as the bisector is not parallel to them.
template <class Real, std::size_t Room>
Real TreeWalk<Real, Room>::noiseOf(std::size_t corner, const Shift<Real>& d) const {
  const Real cross = line_x_[corner] * d.y - line_y_[corner] * d.x;
  return Real(2.0) * (across_[corner] * (abs(d.x) + abs(d.y)) + noise_[corner] * abs(cross));
}

/// Whether the site at d is nearer to a corner than the cell's own, whatever the noise; perhaps: whether
/// it may be; wholly: whether it is to all corners.
template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::isCut(const Shift<Real>& d, bool& perhaps, bool& wholly) const {
  const Real squared = d.x * d.x + d.y * d.y;
  const Real length = abs(d.x) + abs(d.y);
  Real beyond[Room];
  Real noise[Room];
  for (std::size_t k = 0; k < corners_end_; ++k) {
    beyond[k] = Real(2.0) * (x_[k] * d.x + y_[k] * d.y) - squared;
    const Real cross = line_x_[k] * d.y - line_y_[k] * d.x;
    noise[k] = Real(2.0) * (across_[k] * length + noise_[k] * abs(cross));
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
void TreeWalk<Real, Room>::cut(const Shift<Real>& d, std::int32_t site) {
  const Real distance = sqrt(d.x * d.x + d.y * d.y);
  const Real inverse = Real(1.0) / distance;
  const vec2 n(d.x * inverse, d.y * inverse);
  clip_.cutCell(cell_, n, Real(0.5) * distance + (shift_.x * n.x + shift_.y * n.y), site);
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
  const Real near = abs(cell_.h[before]) + abs(cell_.h[after]) + abs(shift_.x) + abs(shift_.y);
  corner_[c] = {before, after, turn, known_after_[before] == cell_.line[after]};
  x_[c] = x - shift_.x;
  y_[c] = y - shift_.y;
  line_x_[c] = cell_.nx[before];
  line_y_[c] = cell_.ny[before];
  noise_[c] = cornerNoise<Real>(near, abs(x) + abs(y), turn);
  across_[c] = cornerNoise<Real>(near, abs(x) + abs(y), Real(1.0));
  widening_[c] = (Real(2.0) * (abs(x_[c]) + abs(y_[c])) + noise_[c]) * noise_[c];
  squared_[c] = x_[c] * x_[c] + y_[c] * y_[c];
  margin_[c] = widening_[c] + Real(box_rounding) * squared_[c];
  most_margin_ = max(most_margin_, margin_[c]);
}

/// A box of the tree, seen from the site.
template <class Real, std::size_t Room>
struct TreeWalk<Real, Room>::Seen {
  Real x, y, ux, uy, low_a, high_a, low_b, high_b;

  Seen(const TreeWalk& walk, const Bounds& bounds)
      : x(differenceOf<Real>(bounds.x, walk.site_x_)),
        y(differenceOf<Real>(bounds.y, walk.site_y_)),
        ux(bounds.ux),
        uy(bounds.uy),
        low_a(bounds.low_a),
        high_a(bounds.high_a),
        low_b(bounds.low_b),
        high_b(bounds.high_b) {}

  /// How deep it reaches into a circle, as a difference of squared distances.
  [[nodiscard]] Real reach(const Real& corner_x, const Real& corner_y, const Real& squared) const {
    const Real to_x = corner_x - x;
    const Real to_y = corner_y - y;
    const Real a = to_x * ux + to_y * uy;
    const Real b = to_y * ux - to_x * uy;
    const Real da = max(max(low_a - a, a - high_a), Real(0.0));
    const Real db = max(max(low_b - b, b - high_b), Real(0.0));
    return squared - (da * da + db * db);
  }
};

/// How deep a node reaches into the circle around a corner.
template <class Real, std::size_t Room>
Real TreeWalk<Real, Room>::reach(std::size_t corner, const Bounds& bounds) const {
  const auto reached = Seen(*this, bounds).reach(x_[corner], y_[corner], squared_[corner]);
  return bounds.radius == 0 ? reached : reachOverCircle(corner, bounds, reached);
}

/// The same where the sites of the node lie on a circle or outside of it.
template <class Real, std::size_t Room>
Real TreeWalk<Real, Room>::reachOverCircle(std::size_t corner, const Bounds& bounds, Real reached) const {
  const Real to_x = x_[corner] - differenceOf<Real>(bounds.x, site_x_) - Real(bounds.center_x);
  const Real to_y = y_[corner] - differenceOf<Real>(bounds.y, site_y_) - Real(bounds.center_y);
  const Real inside = Real(bounds.radius) - sqrt(to_x * to_x + to_y * to_y);
  return inside > Real(0.0) ? min(reached, squared_[corner] - inside * inside) : reached;
}

/// The most that it reaches into any.
template <class Real, std::size_t Room>
Real TreeWalk<Real, Room>::reach(const Bounds& bounds) const {
  const Seen seen(*this, bounds);
  Real reached[Room];
  for (std::size_t c = 0; c < corners_end_; ++c) reached[c] = seen.reach(x_[c], y_[c], squared_[c]);
  Real most = -FAR;
  for (std::size_t c = 0; c < corners_; ++c) {
    if (bounds.radius != 0 && reached[c] > most) reached[c] = reachOverCircle(c, bounds, reached[c]);
    most = max(most, reached[c]);
  }
  return most;
}

/// Whether a site in a box that hardly reaches into the circle around a corner may have an edge that counts.
/// If the lines a and b meet in the corner, a site at distance D and in direction n cuts off no more
/// than depth = reach / (2 D). Its edge is no longer than depth sin(a, b) / (sin(a, n) sin(n, b)), and it
/// shortens the two others by depth / sin(a, n) and depth / sin(n, b). Of cross(a, d) over a box, the
/// least is that of a corner of the box, or none if the signs differ.
template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::mayMatter(std::size_t corner, const Bounds& bounds, Real reached) {
  const Real ux = Real(bounds.ux);
  const Real uy = Real(bounds.uy);
  const Real x = differenceOf<Real>(bounds.x, site_x_);
  const Real y = differenceOf<Real>(bounds.y, site_y_);
  // The box, seen from the site and turned as it is.
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
  if (depth * corner_[corner].turn * squared >= Real(no_edge) * nearest * before * after) return true;
  const Real blur = depth * sqrt(squared) / min(before, after);
  if (blur > Real(most_blur) * noise_[corner]) return true;
  blur_ = max(blur_, blur);
  return false;
}

/// Whether the bisector with the site at d, which touches a wall, lies in it as far as many digits can tell:
/// then the edge is the wall's.
template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::liesIn(std::size_t wall, const Shift<Real>& d, Real cross, Real length) const {
  const bool along = cell_.nx[wall] * d.x + cell_.ny[wall] * d.y > Real(0.0);
  return !std::is_floating_point_v<Real> && cell_.line[wall] < 0 && along &&
         cross <= Real(16.0) * ROUNDING * length;
}

/// The same for one site.
template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::mayMatter(std::size_t corner, const Shift<Real>& d) {
  const Real squared = d.x * d.x + d.y * d.y;
  const Real beyond = Real(2.0) * (x_[corner] * d.x + y_[corner] * d.y) - squared + noiseOf(corner, d);
  const auto [before, after, turn, known] = corner_[corner];
  if (beyond < Real(0.0) || cell_.line[before] == inner_wall || cell_.line[after] == inner_wall) return false;
  const Real length = sqrt(squared);
  const Real a = abs(cell_.nx[before] * d.y - cell_.ny[before] * d.x);
  const Real b = abs(cell_.nx[after] * d.y - cell_.ny[after] * d.x);
  if (liesIn(before, d, a, length) || liesIn(after, d, b, length)) return false;
  const Real depth = beyond / (Real(2.0) * length);
  if (depth * turn * squared >= Real(no_edge) * length * a * b) return true;
  blur_ = max(blur_, depth * length / min(a, b));
  return false;
}

/// Whether every site that could cut the cell is in the set.
template <class Real, std::size_t Room>
bool TreeWalk<Real, Room>::isKnownAround() const {
  const auto& known = sites_.known;
  for (std::size_t k = 0; k < corners_; ++k) {
    const auto x = sites_.x[site_] + static_cast<double>(x_[k]);
    const auto y = sites_.y[site_] + static_cast<double>(y_[k]);
    const auto inside = std::min({x - known.xmin, known.xmax - x, y - known.ymin, known.ymax - y});
    if (!(inside * std::abs(inside) > static_cast<double>(squared_[k] + widening_[k]))) return false;
  }
  return true;
}

/// Widened, so that no edge of the cell comes to lie on a wall.
template <class Real, std::size_t Room>
Walls<Real> TreeWalk<Real, Room>::bounds(Walls<Real> walls) const {
  const auto [west, east] = std::minmax_element(x_, x_ + corners_);
  const auto [south, north] = std::minmax_element(y_, y_ + corners_);
  const Real margin = ((*east - *west) + (*north - *south)) * Real(0.015625);
  const auto take = [](Real& wall, Real tighter, bool& inner, bool is_tighter) {
    if (is_tighter) wall = tighter;
    inner = inner || is_tighter;
  };
  const Real to_west = *west + shift_.x - margin;
  const Real to_south = *south + shift_.y - margin;
  const Real to_east = *east + shift_.x + margin;
  const Real to_north = *north + shift_.y + margin;
  take(walls.west, to_west, walls.inner[0], to_west > walls.west);
  take(walls.east, to_east, walls.inner[1], to_east < walls.east);
  take(walls.south, to_south, walls.inner[2], to_south > walls.south);
  take(walls.north, to_north, walls.inner[3], to_north < walls.north);
  return walls;
}

}  // namespace vorpipe::cpu
