#include "core/drawing/near_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "core/sites/grid.h"

namespace vorpipe::core {
namespace {

/// Into as many rows and columns a box is cut. More would make the parts beyond the box smaller that are
/// looked at with it, and take longer.
constexpr int cuts = 32;
/// Sites of a bin that are looked at: any of them bounds a distance.
constexpr std::uint32_t most_of_bin = 16;
/// What rounding may take of a distance, and what coordinates are rounded by.
constexpr double slack = 1 + 1e-9, least = 1e-14;

struct Bins {
  std::uint32_t west, east, south, north;  ///< all inclusive
};

Bins binsAround(const Grid& grid, Point p, double reach) {
  return {binAlong(p.x - reach, grid.xmin, grid.size, grid.columns),
          binAlong(p.x + reach, grid.xmin, grid.size, grid.columns),
          binAlong(p.y - reach, grid.ymin, grid.size, grid.rows),
          binAlong(p.y + reach, grid.ymin, grid.size, grid.rows)};
}

/// The distance to some site that is about as near as the nearest, squared.
class SomeSite {
 public:
  explicit SomeSite(const SiteSet& sites) : sites_(sites), grid_(sites.grid) {}

  [[nodiscard]] double squaredDistance(Point p) const {
    const auto column = binAlong(p.x, grid_.xmin, grid_.size, grid_.columns);
    const auto row = binAlong(p.y, grid_.ymin, grid_.size, grid_.rows);
    double best = std::numeric_limits<double>::infinity();
    for (std::uint32_t ring = 0; ring <= std::max(grid_.columns, grid_.rows); ++ring) {
      const std::uint32_t west = column - std::min(column, ring), south = row - std::min(row, ring);
      const std::uint32_t east = std::min(column + ring, grid_.columns - 1);
      const std::uint32_t north = std::min(row + ring, grid_.rows - 1);
      for (std::uint32_t r = south; r <= north; ++r) {
        const bool whole = ring == 0 || row - r == ring || r - row == ring;
        if (whole) {
          for (std::uint32_t c = west; c <= east; ++c) look(r, c, p, best);
          continue;
        }
        if (column >= ring) look(r, west, p, best);
        if (column + ring < grid_.columns) look(r, east, p, best);
      }
      if (best < std::numeric_limits<double>::infinity()) break;
    }
    return best;
  }

 private:
  void look(std::uint32_t row, std::uint32_t column, Point p, double& best) const {
    const std::size_t bin = std::size_t{row} * grid_.columns + column;
    const std::uint32_t first = grid_.offsets[bin];
    const std::uint32_t end = std::min(grid_.offsets[bin + 1], first + most_of_bin);
    for (std::uint32_t i = first; i < end; ++i) {
      const double x = sites_.x[i] - p.x, y = sites_.y[i] - p.y;
      best = std::min(best, x * x + y * y);
    }
  }

  const SiteSet& sites_;
  const Grid& grid_;
};

/// Marks the sites within `reach` of a place.
void markAround(const SiteSet& sites, Point p, double reach, std::vector<std::uint8_t>& marks) {
  const Grid& grid = sites.grid;
  const Bins bins = binsAround(grid, p, reach);
  const double most = reach * reach;
  for (std::uint32_t row = bins.south; row <= bins.north; ++row) {
    const std::size_t first = std::size_t{row} * grid.columns;
    const std::uint32_t end = grid.offsets[first + bins.east + 1];
    for (std::uint32_t i = grid.offsets[first + bins.west]; i < end; ++i) {
      const double x = sites.x[i] - p.x, y = sites.y[i] - p.y;
      marks[i] = static_cast<std::uint8_t>(marks[i] | (x * x + y * y <= most ? 1 : 0));
    }
  }
}

}  // namespace

std::vector<std::uint32_t> sitesNear(const SiteSet& sites, const Box& box, int threads) {
  const double width = (box.xmax - box.xmin) / cuts, height = (box.ymax - box.ymin) / cuts;
  const double diagonal = std::hypot(width, height);
  const double largest =
      std::max({std::abs(box.xmin), std::abs(box.xmax), std::abs(box.ymin), std::abs(box.ymax)});
  std::vector<double> reach(std::size_t{cuts} * cuts);
  const auto placeOf = [&](std::size_t part) {
    return Point{box.xmin + (static_cast<double>(part % cuts) + 0.5) * width,
                 box.ymin + (static_cast<double>(part / cuts) + 0.5) * height};
  };
  const SomeSite some(sites);
  parallelFor(reach.size(), cuts, threads, [&](std::size_t begin, std::size_t end) {
    for (auto part = begin; part < end; ++part) {
      // Half a diagonal to the farthest place of this part, and from there to its site as far again.
      reach[part] = (std::sqrt(some.squaredDistance(placeOf(part))) + diagonal) * slack + least * largest;
    }
  });
  std::vector<std::uint8_t> marks(sites.size());
  for (std::size_t part = 0; part < reach.size(); ++part) {
    markAround(sites, placeOf(part), reach[part], marks);
  }
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < marks.size(); ++i) {
    if (marks[i] != 0) near.push_back(i);
  }
  return near;
}

}  // namespace vorpipe::core
