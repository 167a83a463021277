/// The interface between core and what finds cells and pixels in double and exactly: what devices leave.
#pragma once

#include "backend/backend.h"

namespace vorpipe {

/// The numbers that a cell is found with. No certified cell of either is wrong.
enum class Precision : std::uint8_t {
  in_double,  ///< any number of edges, any distribution of sites
  exact,      ///< as many digits as it takes
};

/// Runs on the processor beside every device. It never fails.
class ExactTier {
 public:
  virtual ~ExactTier() = default;

  /// Replaces the sites, which outlive every later call.
  virtual void take(const SiteSet& sites) = 0;

  /// Finds the cells of the sites `which`, indices in the set. `out` is replaced, with an entry for each:
  /// certified or empty, or in_double also `open`, where double does not decide.
  virtual void cells(std::span<const std::uint32_t> which, Precision precision, CellNeighbors& out) = 0;

  /// Finds the site nearest to the center of each of some pixels of a view, by power, in double: its index in
  /// the set, or no_site where all of them are hidden. A pixel's number is row * width + column, from the
  /// bottom row on.
  virtual void nearest(const View& view, std::span<const std::uint32_t> pixels,
                       std::span<std::uint32_t> sites) = 0;
};

/// Finds the sites that are nearest to single places, by power, in double, as ExactTier does for pixels.
/// Thread safe, and never fails.
class PlaceSearch {
 public:
  virtual ~PlaceSearch() = default;

  /// The index in the set of the site nearest to a place in scaled units, or no_site where all are hidden.
  [[nodiscard]] virtual std::uint32_t nearest(Point place) const = 0;
};

}  // namespace vorpipe
