#include "backend/cpu/grid_pixels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "backend/cpu/nearest_site.h"
#include "backend/cpu/picture.h"
#include "base/parallel.h"

namespace vorpipe::cpu {
namespace {

constexpr std::size_t grid_pixels_grain = 4096;
/// Beyond these, the tree finds a site sooner.
constexpr std::uint32_t most_sites = 160, most_rows = 24;
/// What rounding may put between a site and its bin, of the distance to it and of the grid.
constexpr double slack = 1 + 1e-9;
/// If pixels are smaller than this fraction of a bin, a search looks one bin farther than necessary. It then
/// determines how far away another site becomes nearest.
constexpr double small_pixel = 1.0 / 24;
/// The first sites of a bin estimate the nearest distance well enough.
constexpr std::uint32_t looked_at_first = 4;

/// Searches for one pixel after the other.
class GridSearch {
 public:
  /// `step` is the distance from one pixel to the next.
  GridSearch(const SiteSet& sites, Point base, double step)
      : sites_(sites),
        grid_(sites.grid),
        base_(base),
        low_{grid_.xmin - base.x, grid_.ymin - base.y},
        per_bin_(1 / grid_.size),
        rounding_(1e-12 * grid_.size * std::max(grid_.columns, grid_.rows)),
        farther_(step < small_pixel * grid_.size ? grid_.size : 0) {}

  /// Returns the site nearest to a place relative to the base; no_site if it is not found here.
  std::uint32_t nearest(Point p) {
    if (alone_ > 0) {
      const double x = p.x - from_.x, y = p.y - from_.y;
      if (x * x + y * y < alone_) return before_;
    }
    alone_ = 0;
    reset();
    if (before_ != no_site) take(before_, p);
    const std::uint32_t column = along(p.x - low_.x, grid_.columns), row = along(p.y - low_.y, grid_.rows);
    const std::size_t bin = std::size_t{row} * grid_.columns + column;
    const std::uint32_t first = grid_.offsets[bin];
    const std::uint32_t end = std::min(grid_.offsets[bin + 1], first + looked_at_first);
    for (std::uint32_t i = first; i < end; ++i) take(i, p);
    before_ = no_site;
    if (best_ == no_site) return no_site;
    const double least_reach = std::sqrt(least_) * slack + rounding_, reach = least_reach + farther_;
    const std::uint32_t west = along(p.x - reach - low_.x, grid_.columns);
    const std::uint32_t east = along(p.x + reach - low_.x, grid_.columns);
    const std::uint32_t south = along(p.y - reach - low_.y, grid_.rows);
    const std::uint32_t north = along(p.y + reach - low_.y, grid_.rows);
    if (north - south >= most_rows) return no_site;
    reset();
    std::uint32_t looked_at = 0;
    for (std::uint32_t r = south; r <= north; ++r) {
      const std::size_t first_bin = std::size_t{r} * grid_.columns;
      const std::uint32_t begin = grid_.offsets[first_bin + west];
      const std::uint32_t stop = grid_.offsets[first_bin + east + 1];
      looked_at += stop - begin;
      if (looked_at > most_sites) return no_site;
      for (std::uint32_t i = begin; i < stop; ++i) take(i, p);
    }
    before_ = best_;
    // Sites whose distances differ only by rounding must be compared by their bisector.
    constexpr double near_tie = 1e-13;
    if (second_ <= least_ * (1 + near_tie)) return no_site;
    if (farther_ > 0) {
      // Sites that were not examined are farther away than that.
      const double other = std::min(std::sqrt(second_), least_reach + farther_ - rounding_);
      const double way = (other - std::sqrt(least_)) / 2 - rounding_;
      alone_ = way > 0 ? way * way / (slack * slack) : 0;
      from_ = p;
    }
    return best_;
  }

 private:
  void reset() {
    best_ = no_site;
    least_ = second_ = std::numeric_limits<double>::infinity();
  }

  void take(std::uint32_t i, Point p) {
    const double x = p.x - (sites_.x[i] - base_.x), y = p.y - (sites_.y[i] - base_.y);
    const double squared = x * x + y * y;
    if (squared < least_) {
      second_ = least_;
      least_ = squared;
      best_ = i;
    } else if (squared < second_) {
      second_ = squared;
    }
  }

  /// Returns the bin of a coordinate relative to the grid's corner.
  [[nodiscard]] std::uint32_t along(double from_corner, std::uint32_t bins) const {
    const double place = from_corner * per_bin_;
    return place > 0 ? static_cast<std::uint32_t>(std::min(place, static_cast<double>(bins - 1))) : 0u;
  }

  const SiteSet& sites_;
  const Grid& grid_;
  Point base_, low_;
  double per_bin_, rounding_, farther_;
  std::uint32_t before_ = no_site, best_ = no_site;  ///< of the previous pixel, and of this one
  double least_ = 0, second_ = 0;                    ///< squared
  Point from_{};                                     ///< the last place that was searched for
  double alone_ = 0;  ///< within this distance of it, squared, `before_` is nearest
};

}  // namespace

std::vector<std::uint32_t> nearestOnGrid(const SiteSet& sites, const View& view, int threads,
                                         std::span<std::uint32_t> out) {
  std::vector<std::uint32_t> left;
  const bool plain = sites.weight.empty() && sites.hidden.empty() && sites.size() > 0 &&
                     sites.grid.offsets.size() > std::size_t{sites.grid.columns} * sites.grid.rows;
  if (!plain) {
    left.resize(out.size());
    std::iota(left.begin(), left.end(), 0u);
    return left;
  }
  const PixelCenters centers(view);
  const Point base = countedFrom(sites.domain);
  const Point corner{view.corner.x - base.x, view.corner.y - base.y};
  const double step = (view.box.xmax - view.box.xmin) / view.width;
  parallelFor(out.size(), grid_pixels_grain, threads, [&](std::size_t begin, std::size_t end) {
    GridSearch search(sites, base, step);
    for (auto pixel = begin; pixel < end; ++pixel) {
      const Point p = centers.at(pixel);
      out[pixel] = search.nearest({corner.x + p.x, corner.y + p.y});
    }
  });
  for (std::size_t pixel = 0; pixel < out.size(); ++pixel) {
    if (out[pixel] == no_site) left.push_back(static_cast<std::uint32_t>(pixel));
  }
  return left;
}

}  // namespace vorpipe::cpu
