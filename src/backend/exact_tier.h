/// The interface between core and the exact tier, which finds the cells and pixels that devices leave, in
/// double and exactly.
#pragma once

#include "backend/backend.h"

namespace vorpipe {

/// The arithmetic used to find a cell. With either, certified cells are correct.
enum class Precision : std::uint8_t {
  in_double,  ///< any number of edges, any distribution of sites
  exact,      ///< as many digits as necessary
};

/// Runs on the processor beside every device. It never fails.
class ExactTier {
 public:
  virtual ~ExactTier() = default;

  /// Replaces the sites, which must outlive every later call.
  virtual void take(const SiteSet& sites) = 0;

  /// Finds the cells of the sites `which`, indices in the set. Replaces `out` with one entry for each:
  /// certified or empty, or with in_double also `open` if double does not decide.
  virtual void cells(std::span<const std::uint32_t> which, Precision precision, CellNeighbors& out) = 0;

  /// Finds the site nearest by power to the center of each of the given pixels of a view, in double. Writes
  /// its index in the set, or no_site if all of them are hidden. A pixel's number is row * width + column,
  /// from the bottom row up.
  virtual void nearest(const View& view, std::span<const std::uint32_t> pixels,
                       std::span<std::uint32_t> sites) = 0;
};

/// Finds the site nearest to a single place, by power and in double, as ExactTier does for pixels. Thread
/// safe, and never fails.
class PlaceSearch {
 public:
  virtual ~PlaceSearch() = default;

  /// Returns the index in the set of the site nearest to a place in scaled units, or no_site if all are
  /// hidden.
  [[nodiscard]] virtual std::uint32_t nearest(Point place) const = 0;
};

}  // namespace vorpipe
