/// Friction between parcels, and at walls.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "motion/flow.h"
#include "motion/linear/laplacian.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::moving {

/// The force of friction on each parcel, -K v, where
///
///     (K v)_i = sum over j of mu_ij (l_ij / d_ij) (v_i - v_j) + T_i v_i,
///
/// with l the length of an edge and d the distance between the two sites, to which edges of power cells are
/// orthogonal: K of any linear field is 0 away from walls. mu is the harmonic mean of density times
/// viscosity. T is the friction at walls: with n their normal and d the distance to them, mu (l / d) n n^T
/// where the fluid slides, and mu (l / d) times the unit matrix where it sticks to them. K is symmetric and
/// positive semidefinite, and conserves momentum but for walls.
class Friction {
 public:
  /// Of parcels with these cells. The parcels outlive it.
  Friction(const MovingCells& cells, const Parcels& parcels, const FluidOptions& options, int threads);

  /// Solves M v' = -K v over a time, with M the masses; of second order, and stable for any time (the
  /// diagonally implicit Runge-Kutta method of Alexander 1977 with two stages, which is L-stable). Returns
  /// the number of conjugate gradient iterations; `continues`, called before each, may stop them.
  [[nodiscard]] std::uint64_t act(double time, std::vector<Point>& velocity,
                                  const std::function<bool()>& continues) const;

 private:
  /// A symmetric 2 x 2 matrix.
  struct Tensor {
    double xx = 0, xy = 0, yy = 0;
    [[nodiscard]] Point times(Point v) const { return {xx * v.x + xy * v.y, xy * v.x + yy * v.y}; }
  };

  void addWall(std::size_t i, Point outward, double distance, double spacing);
  void addBoxWalls(std::size_t i, Point outward, const CellsThatMeet& meet);
  void addOutline(std::size_t i, Point outward, const CellsThatMeet& meet, const EdgesOfCells& edges);
  [[nodiscard]] Point forceAt(const std::vector<Point>& velocity, std::size_t i) const;
  std::uint64_t solve(double time, std::vector<Point>& velocity,
                      const std::function<bool()>& continues) const;

  const Parcels& parcels_;
  const FluidOptions& options_;
  int threads_;
  Laplacian between_;         ///< of the couplings between parcels
  std::vector<Tensor> wall_;  ///< T by parcel
};

}  // namespace vorpipe::moving
