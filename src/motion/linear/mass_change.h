/// How masses change as weights change or sites move, and the least moves for given changes.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "motion/linear/laplacian.h"
#include "vorpipe.h"

namespace vorpipe::moving {

/// Fills `matrix` with d mass / d weight. Walls, and images of a cell's own site, do not contribute.
void massMatrix(const CellsThatMeet& meet, const EdgesOfCells& edges, int threads, Laplacian& matrix);

/// How masses of cells change as their sites move, while weights stay: D in d mass = D v, with a row for each
/// cell. With b the middle of the edge between the cells i and j, and c its coupling (see EdgesOfCells),
///
///     (D v)_i = sum over j of 2 c (p_j - b) . v_j - 2 c (p_i - b) . v_i.
///
/// It includes no flow through the domain's walls: no other cell would receive what leaves there.
class MassChange {
 public:
  /// For cells that fill the domain, which is periodic or not.
  MassChange(const MovingCells& cells, const Sites& sites, const Box& domain, int threads);

  void apply(std::span<const Point> velocity, std::vector<double>& change) const;  ///< D v
  /// Computes D^T p, each row divided by the site's inertia: the acceleration due to this pressure.
  void push(std::span<const double> pressure, std::span<const double> inertia,
            std::vector<Point>& result) const;
  /// The diagonal of D M^-1 D^T.
  [[nodiscard]] std::vector<double> diagonal(std::span<const double> inertia) const;

 private:
  struct Entry {
    std::uint32_t other;
    Point from_other, from_own;  ///< 2 c (p_j - b) and 2 c (p_i - b)
  };
  int threads_;
  std::vector<std::uint64_t> offsets_;
  std::vector<Entry> entries_;
};

/// Finds p with (D M^-1 D^T) p = wanted. Of all v with D v = wanted, M^-1 D^T p is then the one with the
/// least sum of inertia |v|^2. `pressure` is the initial guess, 0 if its size differs, and becomes the p that
/// was found. Returns the number of conjugate gradient iterations. They end when the residual of `wanted` has
/// the norm `least` or less, when rounding allows no more progress, or when `continues`, called before each,
/// returns false.
std::uint64_t solvePressure(
    const MassChange& change, std::span<const double> inertia, std::span<const double> wanted, double least,
    int threads, std::vector<double>& pressure, const std::function<bool()>& continues = [] { return true; });

}  // namespace vorpipe::moving
