/// Bisectors of sites in exact numbers.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <cstdint>

#include "vorpipe.h"

namespace vorpipe::test {

using Number = CGAL::Exact_predicates_exact_constructions_kernel::FT;

struct Vector {
  Number x, y;
};

inline Number dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y; }
inline Number cross(const Vector& a, const Vector& b) { return a.x * b.y - a.y * b.x; }

/// Where the powers to two sites are equal, seen from the first of them. It crosses the way to the other at
/// half of `reach` of that way. Places on it count from there to the left, in distances of the two sites.
struct Bisector {
  Vector way;
  Number squared;  ///< the square of the distance of the sites
  Number reach;    ///< 1 where both have one weight
};

/// Differences of sites; they outlive it.
class ExactPlaces {
 public:
  explicit ExactPlaces(const Sites& sites) : sites_(sites) {}

  [[nodiscard]] Vector way(std::uint32_t from, std::uint32_t to) const {
    return {Number(sites_.x[to]) - Number(sites_.x[from]), Number(sites_.y[to]) - Number(sites_.y[from])};
  }

  [[nodiscard]] Bisector bisector(std::uint32_t from, std::uint32_t to) const {
    const auto d = way(from, to);
    const Number squared = dot(d, d);
    return {d, squared, hasWeights() ? 1 + heavier(from, to) / squared : Number(1)};
  }

  /// Where on the bisector of `from` and another site the power to a third one is the same. The three do not
  /// lie on one line.
  [[nodiscard]] Number meeting(std::uint32_t from, const Bisector& bisector, std::uint32_t third) const {
    const auto& d = bisector.way;
    const auto e = way(from, third);
    const Number twice_across = 2 * cross(d, e);
    if (!hasWeights()) return (e.x * (e.x - d.x) + e.y * (e.y - d.y)) / twice_across;
    return (dot(e, e) + heavier(from, third) - bisector.reach * dot(d, e)) / twice_across;
  }

 private:
  [[nodiscard]] bool hasWeights() const { return !sites_.weight.empty(); }
  [[nodiscard]] Number heavier(std::uint32_t a, std::uint32_t b) const {
    return Number(sites_.weight[a]) - Number(sites_.weight[b]);
  }

  const Sites& sites_;
};

}  // namespace vorpipe::test
