#include "picture/near_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sites/grid.h"

namespace vorpipe::core {
namespace {

/// A box is cut into at most 2^depth rows and columns. More would shrink the examined surroundings of each
/// part, but take longer.
constexpr int depth = 5;
/// A part is not cut further if its sites are farther away than this, in half diagonals of the part.
constexpr double far_away = 5;
/// Limit of examined sites, per site of the set; beyond this nothing is gained.
constexpr std::size_t most_looks = 6;
/// Number of sites of a bin examined for a bound: any of them gives one.
constexpr std::uint32_t most_of_bin = 16;
/// Slack for rounding of distances, and rounding of coordinates.
constexpr double slack = 1 + 1e-9, coordinate_rounding = 1e-14;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Collects sites part by part.
class NearSites {
 public:
  NearSites(const SiteSet& sites, const Box& box)
      : sites_(sites),
        grid_(sites.grid),
        rounding_(coordinate_rounding *
                  std::max({std::abs(box.xmin), std::abs(box.xmax), std::abs(box.ymin), std::abs(box.ymax)})),
        heaviest_(sites.weight.empty() ? 0 : grid_.heaviest.back()),
        left_(most_looks * sites.size()),
        marks_(sites.size()) {}

  /// Returns false if too many sites would have to be examined.
  bool add(const Box& part, int level) {
    const Point center{(part.xmin + part.xmax) / 2, (part.ymin + part.ymax) / 2};
    const double half = std::hypot(part.xmax - part.xmin, part.ymax - part.ymin) / 2;
    // Upper bound of the least power of every place in the part to a site.
    const double bound = leastBound(center, half);
    const double reach = half + std::sqrt(std::max(0.0, powerLeft(bound, heaviest_)));
    if (level > 0 && reach < far_away * half) {
      const Point c = center;
      return add({part.xmin, part.ymin, c.x, c.y}, level - 1) &&
             add({c.x, part.ymin, part.xmax, c.y}, level - 1) &&
             add({part.xmin, c.y, c.x, part.ymax}, level - 1) &&
             add({c.x, c.y, part.xmax, part.ymax}, level - 1);
    }
    for (const auto i : sites_.heavy) mark(i, center, half, bound);
    return markAround(center, half, bound, reach * slack + rounding_);
  }

  [[nodiscard]] std::vector<std::uint32_t> marked() const {
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < marks_.size(); ++i) {
      if (marks_[i] != 0) near.push_back(i);
    }
    return near;
  }

 private:
  [[nodiscard]] double weight(std::uint32_t i) const { return sites_.weight.empty() ? 0 : sites_.weight[i]; }

  /// Returns the largest squared distance at which a site of this weight matters, plus the rounding of the
  /// sum.
  [[nodiscard]] static double powerLeft(double bound, double weight) {
    constexpr double lost = 1e-14;
    return bound + weight + lost * (std::abs(bound) + (std::isfinite(weight) ? std::abs(weight) : 0));
  }

  [[nodiscard]] double distance(std::uint32_t i, Point p) const {
    return std::hypot(sites_.x[i] - p.x, sites_.y[i] - p.y);
  }

  /// Returns the best bound of the power from sites of the nearest nonempty bins and from heavy sites.
  [[nodiscard]] double leastBound(Point p, double half) const {
    double best = infinite;
    const auto look = [&](std::uint32_t i) {
      const double farthest = distance(i, p) + half;
      best = std::min(best, farthest * farthest - weight(i));
    };
    for (const auto i : sites_.heavy) look(i);
    const auto column = binAlong(p.x, grid_.xmin, grid_.size, grid_.columns);
    const auto row = binAlong(p.y, grid_.ymin, grid_.size, grid_.rows);
    bool any = false;
    const auto look_at = [&](std::uint32_t r, std::uint32_t c) {
      const std::size_t bin = std::size_t{r} * grid_.columns + c;
      const std::uint32_t first = grid_.offsets[bin];
      const std::uint32_t end = std::min(grid_.offsets[bin + 1], first + most_of_bin);
      for (std::uint32_t i = first; i < end; ++i) look(i);
      any = any || end > first;
    };
    for (std::uint32_t ring = 0; !any && ring <= std::max(grid_.columns, grid_.rows); ++ring) {
      const std::uint32_t west = column - std::min(column, ring), south = row - std::min(row, ring);
      const std::uint32_t east = std::min(column + ring, grid_.columns - 1);
      const std::uint32_t north = std::min(row + ring, grid_.rows - 1);
      for (std::uint32_t r = south; r <= north; ++r) {
        if (ring == 0 || row - r == ring || r - row == ring) {
          for (std::uint32_t c = west; c <= east; ++c) look_at(r, c);
          continue;
        }
        if (column >= ring) look_at(r, west);
        if (column + ring < grid_.columns) look_at(r, east);
      }
    }
    return best;
  }

  /// Marks the site if its cell may contain a place of the part.
  void mark(std::uint32_t i, Point p, double half, double bound) {
    const double power = powerLeft(bound, weight(i));
    if (power < 0) return;
    const double reach = (half + std::sqrt(power)) * slack + rounding_;
    const double x = sites_.x[i] - p.x, y = sites_.y[i] - p.y;
    if (x * x + y * y <= reach * reach) marks_[i] = 1;
  }

  bool markAround(Point p, double half, double bound, double reach) {
    const auto west = binAlong(p.x - reach, grid_.xmin, grid_.size, grid_.columns);
    const auto east = binAlong(p.x + reach, grid_.xmin, grid_.size, grid_.columns);
    const auto south = binAlong(p.y - reach, grid_.ymin, grid_.size, grid_.rows);
    const auto north = binAlong(p.y + reach, grid_.ymin, grid_.size, grid_.rows);
    const bool weighted = !sites_.weight.empty();
    const double most = reach * reach;
    for (std::uint32_t row = south; row <= north; ++row) {
      const std::size_t first = std::size_t{row} * grid_.columns;
      const std::uint32_t begin = grid_.offsets[first + west], end = grid_.offsets[first + east + 1];
      if (end - begin > left_) return false;
      left_ -= end - begin;
      for (std::uint32_t i = begin; i < end; ++i) {
        if (weighted) {
          mark(i, p, half, bound);
          continue;
        }
        const double x = sites_.x[i] - p.x, y = sites_.y[i] - p.y;
        marks_[i] = static_cast<std::uint8_t>(marks_[i] | (x * x + y * y <= most ? 1 : 0));
      }
    }
    return true;
  }

  const SiteSet& sites_;
  const Grid& grid_;
  double rounding_;
  double heaviest_;   ///< except heavy sites
  std::size_t left_;  ///< number of sites that may still be examined
  std::vector<std::uint8_t> marks_;
};

}  // namespace

std::vector<std::uint32_t> sitesNear(const SiteSet& sites, const Box& box) {
  NearSites near(sites, box);
  if (near.add(box, depth)) return near.marked();
  std::vector<std::uint32_t> all(sites.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

}  // namespace vorpipe::core
