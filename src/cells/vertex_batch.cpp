#include "cells/vertex_batch.h"

#include <algorithm>

#include "base/processors.h"
#include "geometry/power_center.h"

namespace vorpipe::core {

void CornerBatch::takeShape(std::size_t edges) {
  constexpr std::size_t side_by_side = 8;
  const auto room = std::min(most_cells, most_corners / edges);
  edges_ = edges;
  width_ = room < side_by_side ? room : room / side_by_side * side_by_side;
}

CornerBatch::Added CornerBatch::add(std::uint32_t cell, std::span<const std::int32_t> row) {
  const double x = sites_.x[cell], y = sites_.y[cell];
  const Box& domain = sites_.domain;
  const bool inside = (x >= domain.xmin) & (x <= domain.xmax) & (y >= domain.ymin) & (y <= domain.ymax);
  if (row.size() < 3 || row.size() > most_edges || !inside) return Added::other;
  if (cells_ == 0 && edges_ != row.size()) takeShape(row.size());
  if (cells_ == width_ || edges_ != row.size()) return Added::full;
  for (std::size_t e = 0; e < row.size(); ++e) {
    const auto neighbor = static_cast<std::size_t>(static_cast<std::uint32_t>(row[e]));
    if (neighbor >= sites_.size()) return Added::other;
    other_x_[at(cells_, e)] = sites_.x[neighbor];
    other_y_[at(cells_, e)] = sites_.y[neighbor];
  }
  site_x_[cells_] = x;
  site_y_[cells_] = y;
  cell_[cells_] = cell;
  row_[cells_] = row;
  if (!sites_.weight.empty()) addWeights(cells_);
  ++cells_;
  return Added::yes;
}

void CornerBatch::addWeights(std::size_t k) {
  site_w_[k] = sites_.weight[cell_[k]];
  for (std::size_t e = 0; e < edges_; ++e) {
    other_w_[at(k, e)] = sites_.weight[static_cast<std::size_t>(row_[k][e])];
  }
}

template <bool weighted>
[[gnu::always_inline]] inline void CornerBatch::placeAll() {
  for (std::size_t k = 0; k < cells_; ++k) all_sure_[k] = 1;
  for (std::size_t e = 0; e < edges_; ++e) {
    const auto p = before(e) * width_, q = e * width_;
    for (std::size_t k = 0; k < cells_; ++k) {
      const auto c = powerCenter<weighted>(site_x_[k], site_y_[k], weighted ? site_w_[k] : 0, other_x_[p + k],
                                           other_y_[p + k], weighted ? other_w_[p + k] : 0, other_x_[q + k],
                                           other_y_[q + k], weighted ? other_w_[q + k] : 0);
      base_x_[q + k] = c.base_x;
      base_y_[q + k] = c.base_y;
      rest_x_[q + k] = c.rest_x;
      rest_y_[q + k] = c.rest_y;
      sure_[q + k] = c.sure;
      all_sure_[k] *= c.sure;
    }
  }
}

FOR_WIDE_TOO void CornerBatch::place() {
  if (sites_.weight.empty()) {
    placeAll<false>();
  } else {
    placeAll<true>();
  }
  placeWhereUnsure();
  double farthest = 0;
  for (std::size_t e = 0; e < edges_; ++e) {
    const auto p = e * width_, q = after(e) * width_;
    for (std::size_t k = 0; k < cells_; ++k) {
      const double ex = (base_x_[q + k] - base_x_[p + k]) + (rest_x_[q + k] - rest_x_[p + k]);
      const double ey = (base_y_[q + k] - base_y_[p + k]) + (rest_y_[q + k] - rest_y_[p + k]);
      const double dx = other_x_[p + k] - site_x_[k], dy = other_y_[p + k] - site_y_[k];
      excess_[p + k] = excessLength(dx, dy, ex, ey);
      const double squared = dx * dx + dy * dy;
      farthest = farthest > squared ? farthest : squared;
    }
  }
  const double shorter_side = shorterSide(sites_);
  if (farthest > shorter_side * shorter_side) measureFarEdges(shorter_side);
}

/// Recomputes the excess length of every edge, if some sites are farther apart than the domain's shorter
/// side. Such batches are rare, so the usual path needs no square root.
void CornerBatch::measureFarEdges(double shorter_side) {
  for (std::size_t e = 0; e < edges_; ++e) {
    for (std::size_t k = 0; k < cells_; ++k) {
      const Point way = wayBetween(placeOf(k, e), placeOf(k, after(e)));
      const auto c = at(k, e);
      excess_[c] =
          excessLength(other_x_[c] - site_x_[k], other_y_[c] - site_y_[k], way.x, way.y, shorter_side);
    }
  }
}

void CornerBatch::placeWhereUnsure() {
  for (std::size_t k = 0; k < cells_; ++k) {
    if (all_sure_[k] != 0) continue;
    for (std::size_t e = 0; e < edges_; ++e) {
      if (sure_[at(k, e)] != 0) continue;
      unsure_.add(at(k, e),
                  tripleOf(sites_, static_cast<std::int32_t>(cell_[k]), row_[k][before(e)], row_[k][e]));
      if (unsure_.isFull()) placeUnsure();
    }
  }
  placeUnsure();
}

void CornerBatch::placeUnsure() {
  unsure_.place();
  for (std::size_t n = 0; n < unsure_.size(); ++n) {
    const auto c = unsure_.corner(n);
    const AnchoredPoint center = unsure_.center(n);
    base_x_[c] = center.base.x;
    base_y_[c] = center.base.y;
    rest_x_[c] = center.rest.x;
    rest_y_[c] = center.rest.y;
  }
  unsure_.clear();
}

void CornerBatch::takeOrigins() {
  for (std::size_t k = 0; k < cells_; ++k) {
    const Point origin = positionOf(placeOf(k, 0));
    origin_x_[k] = origin.x;
    origin_y_[k] = origin.y;
  }
}

template <bool spread>
[[gnu::always_inline]] inline void CornerBatch::measureAll(const ByCell& x, const ByCell& y) {
  for (std::size_t k = 0; k < cells_; ++k) {
    twice_area_[k] = moment_x_[k] = moment_y_[k] = 0;
    if constexpr (spread) spread_[k] = 0;
  }
  for (std::size_t e = 0; e < edges_; ++e) {
    const auto p = e * width_, q = after(e) * width_;
    for (std::size_t k = 0; k < cells_; ++k) {
      const double ax = (base_x_[p + k] - x[k]) + rest_x_[p + k];
      const double ay = (base_y_[p + k] - y[k]) + rest_y_[p + k];
      const double bx = (base_x_[q + k] - x[k]) + rest_x_[q + k];
      const double by = (base_y_[q + k] - y[k]) + rest_y_[q + k];
      const double cross = ax * by - bx * ay;
      twice_area_[k] += cross;
      moment_x_[k] += cross * (ax + bx);
      moment_y_[k] += cross * (ay + by);
      if constexpr (spread) {
        spread_[k] += cross * ((ax * (ax + bx) + bx * bx) + (ay * (ay + by) + by * by));
      }
    }
  }
}

FOR_WIDE_TOO void CornerBatch::measure() {
  if (sites_.weight.empty()) return measureAll<false>(site_x_, site_y_);
  takeOrigins();
  measureAll<false>(origin_x_, origin_y_);
}

FOR_WIDE_TOO void CornerBatch::measureSpread() {
  if (sites_.weight.empty()) return measureAll<true>(site_x_, site_y_);
  takeOrigins();
  measureAll<true>(origin_x_, origin_y_);
}

}  // namespace vorpipe::core
