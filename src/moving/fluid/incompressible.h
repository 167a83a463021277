/// Velocities that change no area.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "moving/transport/prescribed_cells.h"
#include "vorpipe.h"

namespace vorpipe::moving {

/// How areas of cells change as their sites move, while weights stay: D in d area = D v, with a row for each
/// cell. With b the middle of the edge between the cells i and j, and c its coupling (see EdgesOfCells),
///
///     (D v)_i = sum over j of 2 c (p_j - b) . v_j - 2 c (p_i - b) . v_i.
///
/// No flow through the domain's walls follows from it: nothing else would take what leaves there.
class AreaChange {
 public:
  /// Of cells that fill the domain, which is periodic or not.
  AreaChange(const MovingCells& cells, const Sites& sites, const Box& domain, int threads);

  void apply(std::span<const Point> velocity, std::vector<double>& change) const;  ///< D v
  /// D^T p, divided by the mass: the acceleration that this pressure gives.
  void push(std::span<const double> pressure, std::span<const double> mass, std::vector<Point>& result) const;
  /// The diagonal of D M^-1 D^T.
  [[nodiscard]] std::vector<double> diagonal(std::span<const double> mass) const;

 private:
  struct Entry {
    std::uint32_t other;
    Point from_other, from_own;  ///< 2 c (p_j - b) and 2 c (p_i - b)
  };
  int threads_;
  std::vector<std::uint64_t> offsets_;
  std::vector<Entry> entries_;
};

/// Takes from the velocities what changes areas: v -= M^-1 D^T p, where (D M^-1 D^T) p = D v. This is the
/// nearest velocity with D v = 0, as masses weigh it. `pressure` is where the search for p begins, and the p
/// that was found. Returns the iterations of conjugate gradients, which end where |D v| is `tolerance` of
/// what it was.
std::uint64_t project(const AreaChange& change, std::span<const double> mass, double tolerance, int threads,
                      std::vector<double>& pressure, std::vector<Point>& velocity);

}  // namespace vorpipe::moving
