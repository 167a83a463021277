/// Cells in a box with a free surface: the parts of cells inside discs around the sites.
#pragma once

#include <cmath>
#include <vector>

#include "geometry/disc_cut.h"
#include "session/box_moments.h"

namespace vorpipe::core {

/// Refuses options that a free surface does not support yet. Errors (input).
Result<void> checkFreeSurface(const CellsOptions& options, const Density& density);

/// Data of the last cells that their edges need, by input index.
struct FreeSurface {
  std::vector<double> weight;
  std::vector<double> arc;  ///< as in EdgesOfCells::arc
};

/// Removes the parts outside of the discs from the moments of cells that findMoments() found. The weights are
/// the squared radii of the discs around the sites. Cells with nothing left are empty.
void cutByDiscs(const FoundBox& found, const Sites& sites, int threads, CellMoments& moments, Report& report,
                FreeSurface& surface);

/// All values are in scaled units. The constructor's arguments outlive the object.
class Discs {
 public:
  /// `weight` is by input index, in the caller's units.
  Discs(const FoundBox& found, const std::vector<double>& weight)
      : set_(found.run->prepared.set), exponent_(found.run->prepared.exponent), weight_(weight) {}

  [[nodiscard]] double squaredRadius(std::size_t cell) const {
    return weight_.empty() ? 0 : std::ldexp(weight_[set_.id[cell]], 2 * exponent_);
  }

  /// Returns the line of the edge to `neighbor`, relative to the site of `cell`. It is computed from the two
  /// sites: the ends of an edge may be too far from a small disc to locate the line exactly.
  [[nodiscard]] EdgeLine lineOf(std::size_t cell, std::int32_t neighbor) const {
    if (neighbor < 0) return wallLine(cell, neighbor);
    const auto other = static_cast<std::size_t>(neighbor);
    const double dx = set_.x[other] - set_.x[cell], dy = set_.y[other] - set_.y[cell];
    const double squared = dx * dx + dy * dy, distance = std::sqrt(squared);
    const double lead = set_.weight.empty() ? 0 : set_.weight[cell] - set_.weight[other];
    return {{dx / distance, dy / distance}, (squared + lead) / (2 * distance)};
  }

  /// Returns the site whose disc locates more exactly where the sites' edge crosses the circles. That is the
  /// smaller disc, or the one of lower index if they are equal.
  [[nodiscard]] std::size_t smallerOf(std::size_t cell, std::size_t other) const {
    const double a = squaredRadius(cell), b = squaredRadius(other);
    return a < b || (a == b && set_.id[cell] < set_.id[other]) ? cell : other;
  }

  [[nodiscard]] Point siteOf(std::size_t cell) const { return {set_.x[cell], set_.y[cell]}; }

 private:
  [[nodiscard]] EdgeLine wallLine(std::size_t cell, std::int32_t wall) const {
    const double at = wallCoordinate(set_.domain, wall);
    const double out = outward(wall);
    if (isVerticalWall(wall)) return {{out, 0}, out * (at - set_.x[cell])};
    return {{0, out}, out * (at - set_.y[cell])};
  }

  const SiteSet& set_;
  int exponent_;
  const std::vector<double>& weight_;
};

}  // namespace vorpipe::core
