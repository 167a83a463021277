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

}  // namespace vorpipe::cpu
