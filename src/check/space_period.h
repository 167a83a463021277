/// Sites in space that repeat, for the checks. Nothing here relies on the code that computes cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core::checks {

/// Of an image: how many vectors of the options it is moved by.
using Shift3 = std::array<std::int32_t, 3>;

/// The vectors by which sites repeat, scaled.
class SpacePeriod {
 public:
  SpacePeriod(const Cells3Options& options, double scale);

  /// A vector of the period, and what it is of those of the options.
  struct Step {
    Point3 way;
    Shift3 shift;
  };

  [[nodiscard]] bool repeats() const { return !basis_.empty(); }
  [[nodiscard]] bool along(std::size_t axis) const { return is_lattice_ || repeats_[axis]; }
  [[nodiscard]] bool isLattice() const { return is_lattice_; }
  [[nodiscard]] Point3 of(const Shift3& shift) const;
  /// The place with these parts of the options' vectors.
  [[nodiscard]] Point3 placeOf(const std::array<double, 3>& parts) const;
  /// By what p is moved to be nearest to the origin among its images.
  [[nodiscard]] Shift3 toOrigin(const Point3& p) const;

  /// As many vectors as repeat. Of a lattice they and their sum with another sign have no acute angles.
  [[nodiscard]] const std::vector<Step>& basis() const { return basis_; }
  /// The part of p along a vector of the basis, and the most that it is of a vector of length 1.
  [[nodiscard]] double part(std::size_t r, const Point3& p) const;
  [[nodiscard]] double partOfLength(std::size_t r) const;
  /// Which steps of the basis lead from the period around the origin to p.
  [[nodiscard]] Shift3 stepsTo(const Point3& p) const;
  /// p minus steps[r] times vector r of the basis, for each r; the sum is rounded as little as possible.
  [[nodiscard]] Point3 less(const Point3& p, const Shift3& steps) const;

  [[nodiscard]] double volume() const;
  /// The shortest vector of the period; infinite without.
  [[nodiscard]] double shortest() const;
  /// Whether differences of places and vectors are exact, as in a period of a few digits.
  [[nodiscard]] bool isCoarse() const;

 private:
  void takeObtuse();
  void takeDual();

  bool is_lattice_;
  std::array<bool, 3> repeats_;
  std::array<Point3, 3> vector_;  ///< of the options
  std::vector<Step> basis_;
  std::array<Point3, 3> dual_{};
  std::vector<Step> relevant_;  ///< where an image is not the nearest to the origin, one of them leads nearer
};

}  // namespace vorpipe::core::checks
