#include "core/corner_batch.h"

#include "core/circumcenter.h"

// A second version of a loop, for processors that do four doubles at once. The results are the same to
// the bit, since no product and sum are ever fused. The thread sanitizer is not ready yet when such
// versions are chosen.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_THREAD__)
#define FOR_WIDE_TOO __attribute__((target_clones("avx2", "default")))
#else
#define FOR_WIDE_TOO
#endif

namespace vorpipe {

CornerBatch::Added CornerBatch::add(std::uint32_t cell, std::span<const std::int32_t> row) {
  const auto edges = row.size();
  const double x = sites_.x[cell], y = sites_.y[cell];
  const Box& domain = sites_.domain;
  const bool inside = (x >= domain.xmin) & (x <= domain.xmax) & (y >= domain.ymin) & (y <= domain.ymax);
  if (edges < 3 || edges > most_edges || !inside) return Added::other;
  if (cells_ == most_cells || slots_ + edges + 1 > most_slots) return Added::full;
  const auto begin = slots_;
  for (std::size_t e = 0; e < edges; ++e) {
    const auto neighbor = static_cast<std::size_t>(static_cast<std::uint32_t>(row[e]));
    if (neighbor >= sites_.size()) return Added::other;
    site_x_[begin + e] = x;
    site_y_[begin + e] = y;
    after_x_[begin + e] = before_x_[begin + e + 1] = sites_.x[neighbor];
    after_y_[begin + e] = before_y_[begin + e + 1] = sites_.y[neighbor];
  }
  const auto last = begin + edges;
  site_x_[last] = x;
  site_y_[last] = y;
  after_x_[last] = after_x_[begin];
  after_y_[last] = after_y_[begin];
  before_x_[begin] = before_x_[last];
  before_y_[begin] = before_y_[last];
  cell_[cells_] = cell;
  slot_[cells_] = begin;
  row_[cells_] = row;
  if (!sites_.weight.empty()) addWeights(cells_);
  ++cells_;
  slots_ = last + 1;
  return Added::yes;
}

void CornerBatch::addWeights(std::size_t cell) {
  const auto row = row_[cell];
  const auto begin = slot_[cell];
  for (std::size_t e = 0; e <= row.size(); ++e) {
    const auto before = static_cast<std::size_t>(row[e == 0 ? row.size() - 1 : e - 1]);
    const auto after = static_cast<std::size_t>(row[e == row.size() ? 0 : e]);
    site_w_[begin + e] = sites_.weight[cell_[cell]];
    before_w_[begin + e] = sites_.weight[before];
    after_w_[begin + e] = sites_.weight[after];
  }
}

/// Inlined into each version of place().
template <bool weighted>
[[gnu::always_inline]] inline void CornerBatch::placeAll() {
  for (std::size_t s = 0; s < slots_; ++s) {
    const auto c = circumcenterOf<weighted>(site_x_[s], site_y_[s], weighted ? site_w_[s] : 0, before_x_[s],
                                            before_y_[s], weighted ? before_w_[s] : 0, after_x_[s],
                                            after_y_[s], weighted ? after_w_[s] : 0);
    base_x_[s] = c.base_x;
    base_y_[s] = c.base_y;
    rest_x_[s] = c.rest_x;
    rest_y_[s] = c.rest_y;
    sure_[s] = c.sure;
  }
}

FOR_WIDE_TOO void CornerBatch::place() {
  if (sites_.weight.empty()) {
    placeAll<false>();
  } else {
    placeAll<true>();
  }
  placeWhereUnsure();
  for (std::size_t s = 0; s + 1 < slots_; ++s) {
    const double ex = (base_x_[s + 1] - base_x_[s]) + (rest_x_[s + 1] - rest_x_[s]);
    const double ey = (base_y_[s + 1] - base_y_[s]) + (rest_y_[s + 1] - rest_y_[s]);
    excess_[s] = excessLength(after_x_[s] - site_x_[s], after_y_[s] - site_y_[s], ex, ey);
  }
}

void CornerBatch::placeWhereUnsure() {
  for (std::size_t k = 0; k < cells_; ++k) {
    const auto row = row_[k];
    for (std::size_t e = 0; e <= row.size(); ++e) {
      const auto s = slot_[k] + e;
      if (sure_[s] != 0) continue;
      const auto before = row[e == 0 ? row.size() - 1 : e - 1];
      const auto after = row[e == row.size() ? 0 : e];
      const Place place = cornerPlace(sites_, static_cast<std::int32_t>(cell_[k]), before, after);
      base_x_[s] = place.base.x;
      base_y_[s] = place.base.y;
      rest_x_[s] = place.rest.x;
      rest_y_[s] = place.rest.y;
    }
  }
}

/// Every slot of a cell gets the place of its first.
void CornerBatch::takeOrigins() {
  for (std::size_t k = 0; k < cells_; ++k) {
    const Point origin = positionOf(placeOf(slot_[k]));
    for (auto s = slot_[k]; s <= slot_[k] + row_[k].size(); ++s) {
      origin_x_[s] = origin.x;
      origin_y_[s] = origin.y;
    }
  }
}

FOR_WIDE_TOO void CornerBatch::measureAbout(const Lane& x, const Lane& y) {
  for (std::size_t s = 0; s + 1 < slots_; ++s) {
    const double ax = (base_x_[s] - x[s]) + rest_x_[s];
    const double ay = (base_y_[s] - y[s]) + rest_y_[s];
    const double bx = (base_x_[s + 1] - x[s]) + rest_x_[s + 1];
    const double by = (base_y_[s + 1] - y[s]) + rest_y_[s + 1];
    const double cross = ax * by - bx * ay;
    cross_[s] = cross;
    moment_x_[s] = cross * (ax + bx);
    moment_y_[s] = cross * (ay + by);
  }
}

void CornerBatch::measure() {
  if (sites_.weight.empty()) return measureAbout(site_x_, site_y_);
  takeOrigins();
  measureAbout(origin_x_, origin_y_);
}

}  // namespace vorpipe
