/// The nearest site of a place, in double, for the checks.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "check/run.h"

namespace vorpipe::core::checks {

/// Of a squared distance: two or three differences, squares and sums, of each of two sites, with some room.
inline constexpr double squared_rounding = 16 * epsilon;

/// A kd-tree that shares nothing with what computes cells and pictures.
class NearestSite {
 public:
  /// Keeps a reference to `run`.
  /// `owner` is who is said to own each site's position: of sites that stand where theirs does, and are no
  /// heavier, it alone is kept, since every place near a crowd of equal ones would be compared with all of
  /// them.
  NearestSite(const CheckedSites& run, std::span<const std::uint32_t> owner);
  NearestSite(NearestSite&&) noexcept;
  ~NearestSite();

  /// A site, in scaled coordinates, of least distance to p, with weights of least power; of equal ones any.
  /// Sites near each other are told apart by the bisector between them.
  [[nodiscard]] std::uint32_t at(Point p) const;

  /// All sites that double does not tell from the nearest, that first: their squared distances to p, or
  /// powers, differ from the least by no more than rounding.
  [[nodiscard]] std::vector<std::uint32_t> allAt(Point p) const;

  /// A heaviest of the sites that may be nearest to a place; any without weights.
  [[nodiscard]] std::uint32_t heaviest() const;

  /// Number of tree nodes visited by long searches so far. Most searches are short; they are long
  /// where most sites are about as far, as seen from the center of a circle.
  [[nodiscard]] std::uint64_t visited() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace vorpipe::core::checks
